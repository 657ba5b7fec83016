#pragma once
/// quadrille recombine TRI.msh -o QUAD.msh: a mesh of triangles in, quads out.

#include <CLI/CLI.hpp>

namespace quadrille::command {

void add_recombine_command(CLI::App& app);

}  // namespace quadrille::command
