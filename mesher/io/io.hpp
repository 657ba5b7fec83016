#pragma once
/// Mesh files. The format follows from the file's ending.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/base/api.hpp"
#include "mesher/mesh/criteria.hpp"
#include "mesher/mesh/mesh_types.hpp"
#include "mesher/options.hpp"
#include "mesher/size_map.hpp"

namespace quadrille {

/// Writes .msh (Gmsh), .inp (Abaqus/CalculiX), .unv (I-deas), .bdf (Nastran), .med (Salome), .vtu, .vtk
/// (legacy): the quads with their CAD faces, the segments on CAD edges and the corners on CAD vertices as
/// groups named as in FreeCAD (Face3, Edge7, Vertex2), as far as options.groups wants them. Numbering is
/// dense from 1. The file appears whole or not at all. What the formats hold: docs/formats.md. Throws Error:
/// usage as check_format() does, failure when the file cannot be written.
QUADRILLE_API void write_mesh(const ShellMesh& mesh, const std::filesystem::path& path,
                              const WriteOptions& options = {});

/// Throws Error (usage) where no such file can hold the mesh: for unknown endings, for quads of nine nodes in
/// .inp, .unv and .bdf files, for .med files with names of more than 64 bytes without the ending.
/// \param quad_nodes 4, 8 or 9.
QUADRILLE_API void check_format(const std::filesystem::path& path, int quad_nodes);

/// True if write_mesh knows the file's ending.
QUADRILLE_API bool is_mesh_format(const std::filesystem::path& path);

/// True where solvers read such files: .inp, .unv, .med, .bdf.
QUADRILLE_API bool is_solver_format(const std::filesystem::path& path);

/// True if read_mesh knows the file's ending.
QUADRILLE_API bool is_readable_format(const std::filesystem::path& path);

/// Reads a surface mesh: Gmsh .msh (2.2 and 4.1, ASCII and binary), Abaqus/CalculiX .inp, I-deas .unv,
/// Nastran .bdf (.nas, .dat), .stl, .obj, .ply, .vtk, .vtu, .vtp. Sets and physical groups are in
/// ShellMesh::groups. \param notes takes a sentence for each thing in the file that a mesh has no place for.
/// Throws Error (failure) with one sentence that names the line, element or node at fault.
QUADRILLE_API ShellMesh read_mesh(const std::filesystem::path& path,
                                  std::vector<std::string>* notes = nullptr);

/// The measures of a mesh as a JSON object, named as in the report of the command, with nodes, quads,
/// triangles and criteria beside them.
QUADRILLE_API std::string quality_json(const ShellMesh& mesh, const CriteriaLimits& limits = {});

/// Draws the mesh, quads colored by q, sides drawn, with a color bar, into a PNG. Works without a screen.
/// Throws Error (failure) when the picture cannot be drawn.
QUADRILLE_API void write_picture(const ShellMesh& mesh, const std::filesystem::path& path, int width = 1600,
                                 int height = 1200);

/// Writes the sizes as .vtu: triangles with the arrays size and source at points and face in cells, lines on
/// CAD edges with the array edge, and the names of the sources in the field data `sources`. The file appears
/// whole or not at all. Throws Error (failure) when it cannot be written.
QUADRILLE_API void write_sizes_vtu(const SizeMap& map, const std::filesystem::path& path);

/// Draws the sizes, colored by their logarithm, and beside them which source rules where, into a PNG. Works
/// without a screen. Throws Error (failure) when the picture cannot be drawn.
QUADRILLE_API void write_size_picture(const SizeMap& map, const std::filesystem::path& path, int width = 1800,
                                      int height = 1000);

}  // namespace quadrille
