#include "mesher/command/recombine_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <numeric>
#include <tuple>

#include "mesher/command/command.hpp"
#include "mesher/command/print_quality.hpp"
#include "mesher/command/setting_options.hpp"
#include "mesher/io/report.hpp"
#include "mesher/quadrille.hpp"
#include "mesher/quads/improve.hpp"
#include "mesher/quads/triangulated_surface.hpp"

namespace quadrille::command {

namespace {

struct RecombineArguments {
  std::filesystem::path input, output, report;
  std::uint64_t seed = 1;
  GivenSettings options;
  bool no_improve = false, quiet = false;
  std::string prefer = "regular";
};

void check(const RecombineArguments& arguments) {
  check_format(arguments.output, 4);
  require_writable(arguments.output);
  if (!arguments.report.empty()) require_writable(arguments.report);
  require_readable(arguments.input);
  require_different_files(
      {{"TRI", arguments.input}, {"-o", arguments.output}, {"--report", arguments.report}});
}

/// Triangles without area, and points of which two lie on one place, leave cracks and folds: throws Error
/// (failure) that names them.
void check_shapes(const TriangleMesh& mesh, const std::string& name) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vector3 ab = mesh.points[b] - mesh.points[a], ac = mesh.points[c] - mesh.points[a];
    const double longest = std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()});
    if (ab.cross(ac).norm() <= 1e-14 * longest) {
      throw failure(name, fmt::format("{}: triangle {} has no area: its corners are the points {}, {} and {} "
                                      "(counted from 0, as they come in the file)",
                                      name, t, a, b, c));
    }
  }
  std::vector<int> order(mesh.points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto place = [&](int v) {
    const Vector3& p = mesh.points[v];
    return std::make_tuple(p.x(), p.y(), p.z(), v);
  };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return place(a) < place(b); });
  for (std::size_t k = 1; k < order.size(); ++k) {
    const Vector3& p = mesh.points[order[k]];
    if (mesh.points[order[k - 1]] != p) continue;
    throw failure(name,
                  fmt::format("{}: the points {} and {} (counted from 0, as they come in the file) lie on "
                              "one place, {} {} {}: join them first",
                              name, order[k - 1], order[k], p.x(), p.y(), p.z()));
  }
}

TriangleMesh triangles_of(const ShellMesh& shell, const std::string& name) {
  if (!shell.quads.empty()) {
    const auto& [a, b, c, d] = shell.quads.front();
    throw failure(
        name,
        fmt::format("{}: holds a quad, with the points {}, {}, {} and {} (counted from 0, as they come in "
                    "the file): only triangles can be recombined",
                    name, a, b, c, d));
  }
  if (shell.triangles.empty()) throw failure(name, fmt::format("{}: holds no triangle", name));
  TriangleMesh mesh;
  mesh.points = shell.points;
  mesh.triangles = shell.triangles;
  mesh.tags = shell.triangle_faces;
  check_shapes(mesh, name);
  return mesh;
}

/// Drops the points that no element uses. The input's groups of points and sides stay where those still
/// exist. \param renumbered point of the input -> of the quads, -1 = gone.
ShellMesh to_shell(const QuadMesh& quads, const ShellMesh& input, const std::vector<int>& renumbered) {
  ShellMesh shell;
  std::vector<int> number(quads.points.size(), -1);
  const auto renumber = [&](auto element) {
    for (int& v : element) {
      if (number[v] < 0) {
        number[v] = static_cast<int>(shell.points.size());
        shell.points.push_back(quads.points[v]);
      }
      v = number[v];
    }
    return element;
  };
  for (const auto& quad : quads.quads) shell.quads.push_back(renumber(quad));
  for (const auto& triangle : quads.triangles) shell.triangles.push_back(renumber(triangle));
  shell.quad_faces = quads.quad_tags;
  shell.triangle_faces = quads.triangle_tags;
  const auto now = [&](int v) { return v < 0 || renumbered[v] < 0 ? -1 : number[renumbered[v]]; };
  for (const ShellMesh::Segment& segment : input.segments) {
    const int a = now(segment.nodes[0]), b = now(segment.nodes[1]);
    if (a >= 0 && b >= 0) shell.segments.push_back({{a, b}, -1, segment.edge});
  }
  for (const ShellMesh::Corner& corner : input.corners) {
    if (now(corner.node) >= 0) shell.corners.push_back({now(corner.node), corner.vertex});
  }
  return shell;
}

void run(const RecombineArguments& arguments) {
  check(arguments);
  ProgressDisplay display(arguments.quiet);
  ExecutionContext context(arguments.options.settings.threads, [&](std::string_view stage, double fraction) {
    return display.show(stage, fraction);
  });
  context.expect({Stage::read, Stage::color, Stage::recombine, Stage::improve, Stage::write});
  const CancelOnSignal cancel(context);
  ShellMesh input;
  {
    const StageTimer timer(context, Stage::read);
    input = read_mesh(arguments.input);
  }
  const TriangleMesh triangles = triangles_of(input, arguments.input.string());
  RecombineOptions options;
  options.method = arguments.no_improve ? Method::paper : Method::quality;
  options.seed = arguments.seed;
  options.objective = arguments.prefer == "shape" ? Objective::shape : Objective::regular;
  QuadMesh quads;
  {
    context.report(Stage::color, 0);
    try {
      quads = recombine(triangles, options, context);
    } catch (const Error& error) {
      if (error.kind() != Error::Kind::failure) throw;
      throw failure(arguments.input.string(),
                    fmt::format("{}: {} (triangles and points counted from 0, as they come in the file)",
                                arguments.input.string(), error.what()));
    }
  }
  std::vector<int> renumbered(triangles.points.size());
  std::iota(renumbered.begin(), renumbered.end(), 0);
  if (!arguments.no_improve) {
    const StageTimer timer(context, Stage::improve);
    context.report(Stage::improve, 0);
    ImproveReport improved;
    quads = improve_on(triangles, quads, {}, renumbered, improved, context);
  }
  const ShellMesh result = to_shell(quads, input, renumbered);
  {
    const StageTimer timer(context, Stage::write);
    write_mesh(result, arguments.output, arguments.options.settings.write);
  }
  const QualitySummary summary = quality(result);
  if (!arguments.report.empty()) write_report(result, summary, context, arguments.input, arguments.report);
  if (!arguments.quiet) print(quality_table(summary));
}

/// CLI11 takes what is too large for the largest, and gives a range of 300 digits.
std::string seed_problem(const std::string& text) {
  std::uint64_t seed = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (error == std::errc() && end == text.data() + text.size()) return {};
  return fmt::format("must be a whole number from 0 to 2^64 - 1, not '{}'", text);
}

}  // namespace

void add_recombine_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("recombine", "make quads of a triangulation");
  auto arguments = std::make_shared<RecombineArguments>();
  command->add_option("TRI", arguments->input, "triangulation: .msh or .inp")->required();
  command
      ->add_option("-o,--output", arguments->output, "mesh file: .msh, .inp, .unv, .med, .vtu, .vtk or .bdf")
      ->required();
  command->add_option("--seed", arguments->seed, "seed of the random choices of --no-improve (default 1)")
      ->check([](const std::string& text) { return seed_problem(text); });
  command->add_flag("--no-improve", arguments->no_improve,
                    "the method of the 2018 paper as it stands: color, swap, remove; no node moves");
  command
      ->add_option(
          "--prefer", arguments->prefer,
          "what pairs are exchanged for: regular (points with four quads, default) or shape (mean q)")
      ->check(CLI::IsMember({"regular", "shape"}));
  command->add_option("--report", arguments->report, "write counts, quality and times as JSON");
  add_settings(*command, arguments->options, {"threads", "msh_version", "groups"});
  command->add_flag("--quiet", arguments->quiet, "no progress, no quality table");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace quadrille::command
