#pragma once
/// Mesh files. The file's ending determines the format.

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
/// (legacy), .xdmf, .su2: the quads with their CAD faces, the segments on CAD edges and the corners on CAD
/// vertices as groups named as in FreeCAD (Face3, Edge7, Vertex2), as far as options.groups asks for them.
/// Numbering is dense from 1. The file appears whole or not at all. docs/formats.md describes what each
/// format contains. Plane and axisymmetric elements (options.element) turn the mesh in an .inp file into the
/// plane z = 0. Throws Error: usage as check_format() and check_element() do, for nine-node quads of a
/// first-order mesh, for a mesh that is not plane where options.element needs one, or that has negative radii
/// where the element is axisymmetric; failure when the file cannot be written.
QUADRILLE_API void write_mesh(const ShellMesh& mesh, const std::filesystem::path& path,
                              const WriteOptions& options = {});

/// Throws Error (usage) if such a file cannot hold the mesh: for unknown endings, for quads of nine nodes in
/// .inp, .unv and .bdf files, of eight or nine in .su2 files, for .med files whose name without the ending
/// has more than 64 bytes. \param quad_nodes 4, 8 or 9.
QUADRILLE_API void check_format(const std::filesystem::path& path, int quad_nodes);

/// Throws Error (usage) if .inp files cannot have this element type for a mesh of this order.
QUADRILLE_API void check_element(InpElement element, int order);

/// The endings of the files that write_mesh() knows: ".msh, .inp and .med". \param last_word the word before
/// the last ending, such as "or".
QUADRILLE_API std::string written_endings(std::string_view last_word);

/// The same of read_mesh().
QUADRILLE_API std::string read_endings(std::string_view last_word);

/// True for the formats that solvers read: .inp, .unv, .bdf, .med.
QUADRILLE_API bool is_solver_format(const std::filesystem::path& path);

/// The tables of mesh formats and of quality criteria as a JSON object, for other programs.
QUADRILLE_API std::string tables_json();

/// Reads a surface mesh: Gmsh .msh (2.2 and 4.1, ASCII and binary), Abaqus/CalculiX .inp, .stl, .obj, .ply,
/// .vtk, .vtu, .vtp. Sets and physical groups are in ShellMesh::groups. \param notes receives a sentence for
/// each thing in the file that a mesh cannot hold. Throws Error (failure) with one sentence that names the
/// line, element or node at fault.
QUADRILLE_API ShellMesh read_mesh(const std::filesystem::path& path,
                                  std::vector<std::string>* notes = nullptr);

/// The quality measures of a mesh as a JSON object, named as in the command's report, together with the
/// counts of nodes, quads and triangles, and the criteria.
QUADRILLE_API std::string quality_json(const ShellMesh& mesh, const CriteriaLimits& limits = {});

/// Draws the mesh as a PNG: quads colored by q, their sides, marked edges in red, and a color bar. Works
/// without a screen.
/// Throws Error (failure) when the picture cannot be drawn.
QUADRILLE_API void write_picture(const ShellMesh& mesh, const std::filesystem::path& path, int width = 1600,
                                 int height = 1200);

/// Writes the sizes as .vtu: triangles, and lines on CAD edges. Points have the arrays size and source, cells
/// the arrays face and edge. The field data `sources` holds the names of the sources. The file appears whole
/// or not at all. Throws Error (failure) when it cannot be written.
QUADRILLE_API void write_sizes_vtu(const SizeMap& map, const std::filesystem::path& path);

}  // namespace quadrille
