#pragma once
/// What the commands that take meshes share.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>

#include "geometry/base/error.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille::command {

/// Degrees that tell faces apart where the user does not say. Faces of .msh files come from a CAD model: a
/// fold inside one is a coarse curve, so none. In all else sets and parts tell nothing about the shape.
double usual_feature_angle(const std::filesystem::path& file, const ShellMesh& mesh);

/// Adds --feature-angle and --merge. \param fold what a side is where faces fold by the angle or more, and
/// what 0 means, for the help.
void add_surface_options(CLI::App& command, std::optional<double>& feature_angle,
                         std::optional<double>& merge, const std::string& fold);

/// An error in a mesh with the name of its file, and how elements are counted.
Error named_by_file(const Error& error, const ShellMesh& mesh, const std::string& file);

}  // namespace quadrille::command
