#pragma once
/// The readers behind read_mesh(). All but read_by_vtk() take the file's bytes, so that they can be fuzzed.
/// Each throws Error (failure) with one sentence that names the line, element or node at fault. `notes`
/// receives a sentence for each thing in the file that a mesh cannot hold.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// The bytes of a file. Throws Error (failure) if it cannot be read.
std::string whole_file(const std::filesystem::path& path);

/// Parses Gmsh .msh 2.2 or 4.1, ASCII or binary, or 1. A quad's face is its elementary tag (2.2) or its
/// entity (4.1); groups are the physical groups. \param name used in error messages.
ShellMesh read_msh(std::string_view bytes, const std::string& name,
                   std::vector<std::string>* notes = nullptr);

/// Parses Abaqus / CalculiX .inp. Groups are element and node sets; a quad's face is the number in the name
/// of its element set (Face3), else a number shared by the elements that are in the same sets.
ShellMesh read_inp(std::string_view bytes, const std::string& name,
                   std::vector<std::string>* notes = nullptr);

/// Reads .stl, .obj, .ply, .vtk, .vtu and .vtp with VTK. A quad's face is in a cell array named face (our
/// own), CellEntityIds (Gmsh) or gmsh:geometrical (meshio); solids of .stl files are groups. Nodes of .stl
/// and .obj files at the same position become one: these formats repeat them.
ShellMesh read_by_vtk(const std::filesystem::path& path, std::vector<std::string>* notes = nullptr);

}  // namespace quadrille
