/// quadrille midsurface IN -o OUT: a thin solid in, its middle surface out.

#include <fmt/format.h>

#include "mesher/command/command.hpp"
#include "mesher/command/tables.hpp"
#include "mesher/quadrille.hpp"

namespace quadrille::command {

namespace {

struct Arguments : RunArguments {
  MidSurfaceOptions options;
};

void run(const Arguments& arguments) {
  for (const std::filesystem::path& output : arguments.outputs) {
    if (!is_midsurface_format(output))
      throw usage_error(
          "-o", fmt::format("{}: a middle surface is written as .brep, .step or .json", output.string()));
  }
  require_usable({{{"IN", arguments.input}}, with_outputs(arguments.outputs, {})});
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
  CLI::App* command = app.add_subcommand(
      "midsurface", "turn a thin solid into the surface in its middle, with its thickness");
  auto arguments = std::make_shared<Arguments>();
  arguments->settings.threads = 1;
  command->add_option("IN", arguments->input, "CAD file: .step, .stp, .iges, .igs, .brep")->required();
  command
      ->add_option("-o,--output", arguments->outputs,
                   "the middle surface as .brep or .step, the data of its faces as .json; may be given more "
                   "than once")
      ->required()
      ->allow_extra_args(false);
  command->add_flag("--partial", arguments->options.partial,
                    "if the solid is thin only in places, write the walls that were found");
  command->add_flag("--join", arguments->options.join, "treat solids that touch as one part, as if welded");
  add_settings(*command, *arguments, {"read_time_limit", "time_limit"});
  command->add_flag("--end-with-input", arguments->end_with_input,
                    "end the work when standard input closes, for programs that start this one");
  command->add_flag("--quiet", arguments->quiet, "no progress, no table");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace quadrille::command
