#pragma once
/// Mesh files. The format follows from the file's ending.

#include <filesystem>
#include <string>
#include <string_view>

#include "mesher/mesh/criteria.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// Of Gmsh's .msh, both as text.
enum class MshVersion { v2_2, v4_1 };

/// "2.2" or "4.1". Throws Error (usage) for others.
MshVersion msh_version(std::string_view text);

struct WriteOptions {
  MshVersion msh_version = MshVersion::v2_2;
  std::string title;  ///< put into formats that have a comment or title line, control characters as '?'
  int threads = 0;    ///< that make the text of .msh, .inp, .unv and .bdf; 0 = all cores
};

/// Writes .msh (Gmsh), .inp (Abaqus/CalculiX), .unv (I-deas), .bdf (Nastran), .med (Salome), .vtu, .vtk
/// (legacy): the quads with their CAD faces, the segments on CAD edges and the corners on CAD vertices as
/// groups named as in FreeCAD (Face3, Edge7, Vertex2). Numbering is dense from 1. The file appears whole or
/// not at all. Throws Error: usage for an unknown ending, failure when the file cannot be written.
void write_mesh(const ShellMesh& mesh, const std::filesystem::path& path, const WriteOptions& options = {});

/// True if write_mesh knows the file's ending.
bool is_mesh_format(const std::filesystem::path& path);

/// True where solvers read such files: .inp, .unv, .med, .bdf.
bool is_solver_format(const std::filesystem::path& path);

/// Reads a surface mesh: Gmsh .msh (2.2 and 4.1, ASCII and binary) or Abaqus/CalculiX .inp.
/// Throws Error (failure) with one sentence that names the line, element or node at fault.
ShellMesh read_mesh(const std::filesystem::path& path);

/// The measures of a mesh as a JSON object, named as in the report of the command, with nodes, quads,
/// triangles and criteria beside them.
std::string quality_json(const ShellMesh& mesh, const CriteriaLimits& limits = {});

/// Draws the mesh, quads coloured by q, sides drawn, with a colour bar, into a PNG. Works without a screen.
/// Throws Error (failure) when the picture cannot be drawn.
void write_picture(const ShellMesh& mesh, const std::filesystem::path& path, int width = 1600,
                   int height = 1200);

}  // namespace quadrille
