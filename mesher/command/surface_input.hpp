#pragma once
/// What the commands that read a surface mesh share.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "mesher/command/setting_options.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille::command {

/// What a command is given that turns a surface mesh into another mesh.
struct SurfaceArguments : RunArguments {
  double merge = -1;  ///< millimeters; negative = no nodes are merged
  std::optional<double> given_angle;

  /// The feature angle, degrees. If none is given, 0 for .msh files with several faces: they come from a CAD
  /// model, and a fold inside a face is a coarse curve. 40 for all others: their sets and parts do not follow
  /// the shape.
  double feature_angle(const ShellMesh& mesh) const;
};

/// Adds --feature-angle and --merge. \param fold text for the help: what a side becomes if the surface folds
/// there by the angle or more, and what 0 means.
void add_surface_options(CLI::App& command, SurfaceArguments& arguments, const std::string& fold);

/// What `make` makes of the mesh of a file. Its failures get the name of the file and, if they name a
/// triangle or point, how these are counted.
ShellMesh made_from(const ShellMesh& mesh, const std::filesystem::path& path,
                    const std::function<ShellMesh()>& make);

}  // namespace quadrille::command
