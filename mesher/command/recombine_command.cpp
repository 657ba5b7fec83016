/// quadrille recombine TRI.msh -o QUAD.msh: a mesh of triangles in, quads out.

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "geometry/base/text_parts.hpp"
#include "mesher/command/command.hpp"
#include "mesher/command/surface_input.hpp"
#include "mesher/command/tables.hpp"
#include "mesher/io/report.hpp"
#include "mesher/quadrille.hpp"
#include "mesher/shell/from_triangles.hpp"

namespace quadrille::command {

namespace {

struct RecombineArguments : SurfaceArguments {
  std::uint64_t seed = 1;
  bool no_improve = false;
};

void run(const RecombineArguments& arguments) {
  check_format(arguments.outputs.front(), 4);
  require_usable(arguments, "TRI");
  const std::string name = arguments.input.string();
  Work work(arguments, {Stage::read, Stage::color, Stage::recombine, Stage::improve, Stage::write});
  ExecutionContext& context = work.context;
  ShellMesh input;
  std::vector<std::string> notes;
  {
    const StageTimer timer(context, Stage::read);
    input = read_mesh(arguments.input, &notes);
  }
  FromTrianglesOptions options;
  options.merge = arguments.merge;
  options.feature_angle = arguments.feature_angle(input);
  options.improve = !arguments.no_improve;
  options.recombine.method = arguments.no_improve ? Method::paper : Method::quality;
  options.recombine.seed = arguments.seed;
  context.report(Stage::color, 0);
  const ShellMesh result =
      made_from(input, arguments.input, [&] { return quads_from_triangles(input, options, notes, context); });
  if (result.quads.empty())
    throw failure(name, fmt::format("{}: no quad can be made: no two of its triangles share a side in one "
                                    "face or property (--merge merges nodes that lie close together)",
                                    name));
  {
    const StageTimer timer(context, Stage::write);
    write_mesh(result, arguments.outputs.front(), arguments.settings.write);
  }
  const MeshMeasures measures = measure(result);
  if (!arguments.report.empty())
    write_report(
        make_report(result, measures, context, arguments.input, notes, arguments.settings.write.scale),
        arguments.report);
  for (const std::string& note : notes) say("{}: {}", name, note);
  if (!arguments.quiet) print(quality_table(measures.quality));
}

/// Needed since CLI11 clamps a number that is too large, and shows a range of 300 digits.
std::string seed_problem(const std::string& text) {
  if (exactly<std::uint64_t>(text)) return {};
  return fmt::format("must be a whole number from 0 to 2^64 - 1, not '{}'", text);
}

}  // namespace

void add_recombine_command(CLI::App& app) {
  auto [command, arguments] =
      add_command<RecombineArguments>(app, "recombine", "turn a triangulation into quads");
  command
      .add_option("TRI", arguments.input,
                  "mesh of triangles, or of triangles and quads: " + read_endings("or"))
      ->required();
  command.add_option("-o,--output", arguments.outputs, "mesh file: " + written_endings("or"))
      ->required()
      ->expected(1);
  command.add_option("--seed", arguments.seed, "seed of the random choices of --no-improve (default 1)")
      ->check([](const std::string& text) { return seed_problem(text); });
  command.add_flag("--no-improve", arguments.no_improve,
                   "the method of the 2018 paper, unmodified: color, swap, remove; no node moves");
  add_surface_options(command, arguments, "on their common side is kept as an edge; 0 = none");
  command.add_option("--report", arguments.report, "write counts, quality and times as JSON");
  add_settings(command, arguments, {"threads", "msh_version", "element", "scale", "groups"});
  command.add_flag("--quiet", arguments.quiet, "no progress, no quality table");
}

}  // namespace quadrille::command
