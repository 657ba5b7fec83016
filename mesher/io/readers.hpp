#pragma once
/// The readers behind read_mesh(). They take the file's bytes, so that they can be fuzzed.

#include <string>
#include <string_view>

#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// Parses Gmsh .msh 2.2 or 4.1, ASCII or binary. A quad's face is its elementary tag (2.2) or its entity
/// (4.1). \param name used in error messages. Throws Error (failure) with one sentence that names the line,
/// element or node at fault.
ShellMesh read_msh(std::string_view bytes, const std::string& name);

/// Parses Abaqus / CalculiX .inp. A quad's face is the number of its element set's name (Face3), else 0.
/// Throws Error (failure) with one sentence that names the line, element or node at fault.
ShellMesh read_inp(std::string_view bytes, const std::string& name);

}  // namespace quadrille
