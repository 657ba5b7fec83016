#pragma once
/// The modules libquadrille_vtk.so, libquadrille_picture.so and libquadrille_med.so, which contain all code
/// that needs VTK, VTK with OpenGL and X11, and libmed, in this order. They are opened on demand, since
/// loading those libraries takes more time than meshing a small part.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mesher/io/mesh_builder.hpp"
#include "mesher/io/output_mesh.hpp"
#include "mesher/io/result_reader.hpp"
#include "mesher/mesh/mesh_types.hpp"
#include "mesher/size_map.hpp"

namespace quadrille {

/// What a build may lack, each with a module of its own.
enum class Library { none, vtk, pictures, med };

/// Throws Error (usage) if this build lacks the library. \param ending of the files that need it (".med").
void require_library(Library library, std::string_view ending);

/// A mesh read by VTK. Nodes are numbered from 1 in the order of the points.
struct ImportedMesh {
  std::vector<Vector3> points;
  std::vector<FileElement> elements;
  std::vector<char> set_names;                           ///< names of all sets, each followed by a 0
  std::vector<std::array<std::int64_t, 2>> in_set;       ///< index of an element, index of the set's name
  std::vector<std::array<std::int64_t, 2>> node_in_set;  ///< index of a point, index of the set's name
};

/// Types of the functions that the modules export as C symbols. Each function returns an empty string, or a
/// sentence that says what went wrong; no exception leaves a module.
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
/// numbers. \param qualities (quads) q of each quad. Throws Error (failure).
std::string vtu_file(const OutputMesh& mesh, const std::vector<double>& qualities);

/// The bytes of a PNG of the mesh. Throws Error (failure).
std::string vtk_picture(const ShellMesh& mesh, int width, int height);

/// The bytes of a .vtu file and of a PNG of the sizes. Both throw Error (failure).
std::string vtu_sizes(const SizeMap& map);
std::string size_picture(const SizeMap& map, int width, int height);

/// The mesh in a file. \param ending .stl, .obj, .ply, .vtk, .vtu or .vtp. Throws Error (failure) that does
/// not name the file.
ImportedMesh vtk_mesh(const std::string& path, const std::string& ending);

/// A solver's result from a .vtu file. Throws Error (failure) that does not name the file.
SolverResult vtk_result(const std::string& path);

/// Opens the module for .med files ahead of time. If it cannot be opened, med_file() reports why.
void open_med_module() noexcept;

/// The bytes of a .med file.
/// \param name name of the mesh in the file. FreeCAD reads only a mesh with the same name as its file,
/// without the ending. Throws Error (failure).
std::string med_file(const OutputMesh& mesh, const std::string& name, const std::string& description);

}  // namespace quadrille
