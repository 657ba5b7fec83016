/// quadrille midsurface IN -o OUT: a thin solid in, its middle surface out.

#include <fmt/format.h>

#include "mesher/command/command.hpp"
#include "mesher/command/tables.hpp"
#include "mesher/quadrille.hpp"

namespace quadrille::command {

namespace {

struct MidsurfaceArguments : RunArguments {
  MidSurfaceOptions options;
};

void run(const MidsurfaceArguments& arguments) {
  for (const std::filesystem::path& output : arguments.outputs) check_midsurface_format(output);
  require_usable(arguments, "IN");
  Work work(arguments, {Stage::read, Stage::midsurface});
  const CadModel model = read_model(arguments, "finding the middle surface of", work);
  const MidSurface middle = midsurface(model, arguments.options, work.context);
  work.context.check();
  for (const std::filesystem::path& output : arguments.outputs) {
    write_midsurface(middle, output);
    work.cancel.wrote(output);
  }
  for (const std::string& warning : middle.warnings) say("quadrille: {}", warning);
  for (const std::string& problem : middle.problems) say("quadrille: {}", problem);
  if (!arguments.quiet) print(middle_table(middle));
}

}  // namespace

void add_midsurface_command(CLI::App& app) {
  auto [command, arguments] = add_command<MidsurfaceArguments>(
      app, "midsurface", "turn a thin solid into the surface in its middle, with its thickness");
  arguments.settings.threads = 1;
  add_model(command, arguments);
  add_outputs(command, arguments, "the middle surface as .brep or .step, the data of its faces as .json");
  command.add_flag("--partial", arguments.options.partial,
                   "if the solid is thin only in places, write the walls that were found");
  command.add_flag("--join", arguments.options.join, "treat solids that touch as one part, as if welded");
  add_settings(command, arguments, {"read_time_limit", "time_limit"});
  add_run_options(command, arguments, "no progress, no table");
}

}  // namespace quadrille::command
