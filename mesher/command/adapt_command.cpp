/// quadrille adapt MESH RESULT -o SIZES.vdb: sizes from a solution.

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "geometry/base/atomic_file.hpp"
#include "mesher/adapt/adapt.hpp"
#include "mesher/command/command.hpp"
#include "mesher/quadrille.hpp"

namespace quadrille::command {

namespace {

struct AdaptArguments {
  std::filesystem::path mesh, result, output, report;
  AdaptOptions options;
  bool quiet = false, end_with_input = false;
};

void run(const AdaptArguments& arguments) {
  require_readable(arguments.mesh);
  require_readable(arguments.result);
  require_ending(arguments.output, ".vdb", "-o");
  if (!arguments.report.empty()) require_writable(arguments.report);
  require_different_files({{"MESH", arguments.mesh},
                           {"RESULT", arguments.result},
                           {"-o", arguments.output},
                           {"--report", arguments.report}});
  report_crashes(arguments.mesh, "reading");
  ExecutionContext context;
  const CancelOnSignal cancel(context);
  if (arguments.end_with_input) end_with_input();
  const AdaptResult result =
      adapt(read_mesh(arguments.mesh), arguments.result, arguments.output, arguments.options, context);
  if (!arguments.report.empty()) {
    const nlohmann::ordered_json report{{"error", result.error},
                                        {"quads", result.quads},
                                        {"quads_wanted", result.quads_wanted},
                                        {"error_wanted", result.error_wanted},
                                        {"size_min", result.least},
                                        {"size_max", result.largest}};
    write_file(arguments.report, report.dump(2) + "\n");
  }
  if (arguments.quiet) return;
  print(
      fmt::format("error        {:.3g} % of the energy norm, with {} quads\n"
                  "wanted       {:.3g} %, with about {:.0f} quads of {:.3g} to {:.3g} mm\n"
                  "mesh with    --size {:.3g} --size-min {:.3g} --size-field {}\n",
                  100 * result.error, result.quads, 100 * result.error_wanted, result.quads_wanted,
                  result.least, result.largest, result.largest, result.least, arguments.output.string()));
}

}  // namespace

void add_adapt_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("adapt", "sizes for the next mesh from a solution on this one");
  auto arguments = std::make_shared<AdaptArguments>();
  AdaptOptions& options = arguments->options;
  command->add_option("MESH", arguments->mesh, "mesh that was solved: .inp or .msh")->required();
  command
      ->add_option("RESULT", arguments->result,
                   "what CalculiX found: .frd, or .vtu, with U, of shells as bricks")
      ->required();
  command->add_option("-o,--output", arguments->output, "sizes as OpenVDB grids (.vdb), for --size-field")
      ->required();
  CLI::Option* error = command->add_option(
      "--error", options.error, "error of the stresses that is wanted, of the whole (default 0.05: 5 %)");
  command->add_option("--count", options.count, "number of elements that is wanted, in place of an error")
      ->excludes(error);
  command->add_option("--size-min", options.size_min, "no size below this, in mm");
  command->add_option("--size-max", options.size_max, "no size above this, in mm");
  command->add_option("--growth", options.growth, "how fast the size may change (default 0.3)");
  command->add_option("--poisson", options.poisson, "Poisson's ratio (default 0.3)");
  command->add_option("--report", arguments->report, "write error, counts and sizes as JSON");
  command->add_flag("--end-with-input", arguments->end_with_input,
                    "end the work when standard input closes, for programs that start this one");
  command->add_flag("--quiet", arguments->quiet, "print nothing");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace quadrille::command
