#pragma once
/// The modules libquadrille_vtk.so, libquadrille_picture.so and libquadrille_med.so, which hold all that
/// needs VTK, VTK with OpenGL and X11, and libmed. They are opened on demand, since loading those libraries
/// costs more time than meshing a small part.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mesher/io/mesh_builder.hpp"
#include "mesher/io/output_mesh.hpp"
#include "mesher/io/result_reader.hpp"
#include "mesher/mesh/mesh_types.hpp"
#include "mesher/size_map.hpp"

namespace quadrille {

/// A mesh as VTK has read it: nodes are numbered from 1 in the order of the points.
struct ImportedMesh {
  std::vector<Vector3> points;
  std::vector<FileElement> elements;
  std::vector<char> set_names;                           ///< each followed by a 0
  std::vector<std::array<std::int64_t, 2>> in_set;       ///< place of an element, place of the name
  std::vector<std::array<std::int64_t, 2>> node_in_set;  ///< place of a point, place of the name
};

/// What the modules export, as C symbols of these types. Each function returns an empty string, or the
/// sentence that says what went wrong; nothing is thrown across the border.
using VtkFileFunction = std::string(const OutputMesh& mesh, const std::vector<double>& qualities,
                                    std::string& bytes);
using PictureFunction = std::string(const ShellMesh& mesh, const std::vector<double>& qualities, int width,
                                    int height, std::string& bytes);
using VtkSizesFunction = std::string(const SizeMap& map, std::string& bytes);
using SizePictureFunction = std::string(const SizeMap& map, int width, int height, std::string& bytes);
using VtkResultFunction = std::string(const std::string& path, SolverResult& result);
using VtkReadFunction = std::string(const std::string& path, const std::string& ending, ImportedMesh& mesh);
using MedFileFunction = std::string(const OutputMesh& mesh, const std::string& name,
                                    const std::string& description, std::string& bytes);

/// The bytes of a .vtu file: shell elements, lines on CAD edges, points on CAD vertices, with their CAD
/// numbers. \param qualities q of each quad. Throws Error (failure).
std::string vtu_file(const OutputMesh& mesh, const std::vector<double>& qualities);

/// The bytes of a PNG of the mesh. Throws Error (failure).
std::string vtk_picture(const ShellMesh& mesh, int width, int height);

/// The bytes of a .vtu file and of a PNG of sizes. Throw Error (failure).
std::string vtu_sizes(const SizeMap& map);
std::string size_picture(const SizeMap& map, int width, int height);

/// What a file holds. \param ending .stl, .obj, .ply, .vtk, .vtu or .vtp. Throws Error (failure) that does
/// not name the file.
ImportedMesh vtk_mesh(const std::string& path, const std::string& ending);

/// What a solver found, from a .vtu file. Throws Error (failure) that does not name the file.
SolverResult vtk_result(const std::string& path);

/// Opens what .med files need ahead of time; where it cannot be opened, med_file() says why.
void open_med_module() noexcept;

/// The bytes of a .med file.
/// \param name of the mesh in the file; FreeCAD reads only a mesh that is named as its file, without the
/// ending. Throws Error (failure).
std::string med_file(const OutputMesh& mesh, const std::string& name, const std::string& description);

}  // namespace quadrille
