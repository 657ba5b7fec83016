#pragma once
/// What the commands that read a surface mesh share.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "mesher/mesh/mesh_types.hpp"

namespace quadrille::command {

/// The default feature angle, degrees. 0 for .msh files with several faces: they come from a CAD model, and a
/// fold inside a face is a coarse curve. 40 for all others: their sets and parts do not follow the shape.
double usual_feature_angle(const std::filesystem::path& file, const ShellMesh& mesh);

/// Adds --feature-angle and --merge. \param fold text for the help: what a side becomes if the surface folds
/// there by the angle or more, and what 0 means.
void add_surface_options(CLI::App& command, std::optional<double>& feature_angle,
                         std::optional<double>& merge, const std::string& fold);

/// What `make` makes of the mesh of a file. Its failures get the name of the file and, if they name a
/// triangle or point, how these are counted.
ShellMesh made_from(const ShellMesh& mesh, const std::filesystem::path& path,
                    const std::function<ShellMesh()>& make);

}  // namespace quadrille::command
