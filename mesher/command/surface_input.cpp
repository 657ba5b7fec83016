/// The options for folds and merging, and errors that name the file and how it counts.

#include "mesher/command/surface_input.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "geometry/base/error.hpp"
#include "geometry/base/execution_context.hpp"
#include "geometry/base/file_access.hpp"

namespace quadrille::command {

double SurfaceArguments::feature_angle(const ShellMesh& mesh) const {
  constexpr double usual = 40;
  const std::vector<int>& faces = mesh.triangle_faces.empty() ? mesh.quad_faces : mesh.triangle_faces;
  const bool several =
      std::any_of(faces.begin(), faces.end(), [&](int face) { return face != faces.front(); });
  return given_angle.value_or(lower_ending(input) == ".msh" && several ? 0 : usual);
}

void add_surface_options(CLI::App& command, SurfaceArguments& arguments, const std::string& fold) {
  command
      .add_option("--feature-angle", arguments.given_angle,
                  "angle in degrees between the normals of neighbors from which " + fold +
                      " (default 40, none in .msh files with several faces)")
      ->check(number({0, 180}));
  command
      .add_option("--merge", arguments.merge,
                  "merge nodes at most this far apart, in mm; 0 = only at the same position")
      ->check(number({}));
}

ShellMesh made_from(const ShellMesh& mesh, const std::filesystem::path& path,
                    const std::function<ShellMesh()>& make) try {
  return make();
} catch (const Error& error) {
  if (error.kind() != Error::Kind::failure || error.subject() == ExecutionContext::time_subject) throw;
  const std::string file = path.string();
  const bool counts = error.subject().rfind("triangle ", 0) == 0 || error.subject().rfind("point ", 0) == 0;
  if (!counts) throw failure(file, fmt::format("{}: {}", file, with_options(error.what())));
  const char* counted = mesh.quads.empty()
                            ? "triangles and points counted from 0, as they come in the file"
                            : "points counted from 0, triangles too, and after them two for each quad";
  throw failure(file, fmt::format("{}: {} ({})", file, with_options(error.what()), counted));
}

}  // namespace quadrille::command
