/// quadrille midsurface IN -o OUT: a thin solid in, its middle surface out.

#include <fmt/format.h>

#include "mesher/command/command.hpp"
#include "mesher/quadrille.hpp"

namespace quadrille::command {

namespace {

struct Arguments {
  std::filesystem::path input;
  std::vector<std::filesystem::path> outputs;
  MidSurfaceOptions options;
  bool quiet = false, end_with_input = false;
};

std::string describe(const MidSurface& middle) {
  std::string text = fmt::format("{:<8} {:>12} {:>20}  {}\n", "face", "area", "thickness", "between");
  for (std::size_t i = 0; i < middle.faces.size(); ++i) {
    const MiddleFace& face = middle.faces[i];
    std::string thickness = fmt::format("{:.6g}", face.thickness);
    if (varies(face))
      thickness = fmt::format("{:.4g}..{:.4g} ({:.4g})", face.thinnest, face.thickest, face.thickness);
    text += fmt::format("Face{:<4} {:>12.6g} {:>20} ", i + 1, face.area, thickness);
    if (face.step) text += " a step between";
    for (const int number : face.solid_faces) text += fmt::format(" Face{}", number);
    if (face.fitted) text += fmt::format(", fitted within {:.2g}", face.off);
    text += "\n";
  }
  text += fmt::format(
      "area x thickness {:.6g} mm3, {:.2f} % of the volume ({:.2f} % without what counts twice where walls "
      "meet); {} part(s) of {} solid(s), "
      "{} free edges\n",
      middle.shell_volume, 100 * middle.shell_volume / middle.volume,
      100 * (middle.shell_volume - middle.counted_twice) / middle.volume, middle.parts, middle.solids,
      middle.free_edges);
  if (!middle.unpaired.empty()) {
    text += "neither side nor rim of a wall:";
    for (const int number : middle.unpaired) text += fmt::format(" Face{}", number);
    text += "\n";
  }
  return text;
}

void run(const Arguments& arguments) {
  require_readable(arguments.input);
  for (const std::filesystem::path& output : arguments.outputs) {
    if (!is_midsurface_format(output))
      throw usage_error(
          "-o", fmt::format("{}: a middle surface is written as .brep, .step or .json", output.string()));
    require_writable(output);
  }
  std::vector<NamedFile> files{{"IN", arguments.input}};
  for (const std::filesystem::path& output : arguments.outputs) files.push_back({"-o", output});
  require_different_files(files);
  ProgressDisplay display(arguments.quiet);
  ExecutionContext context(
      1, [&](std::string_view stage, double fraction) { return display.show(stage, fraction); });
  report_crashes(arguments.input, "reading");
  context.expect({Stage::read, Stage::midsurface});
  const CancelOnSignal cancel(context);
  if (arguments.end_with_input) end_with_input();
  const CadModel model = CadModel::read(arguments.input);
  report_crashes(arguments.input, "finding the middle surface of");
  const MidSurface middle = midsurface(model, arguments.options, context);
  context.check();
  for (const std::filesystem::path& output : arguments.outputs) write_midsurface(middle, output);
  for (const std::string& warning : middle.warnings) fmt::print(stderr, "quadrille: {}\n", warning);
  for (const std::string& problem : middle.problems) fmt::print(stderr, "quadrille: {}\n", problem);
  if (!arguments.quiet) print(describe(middle));
}

}  // namespace

void add_midsurface_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "midsurface", "turn a thin solid into the surface in its middle, with its thickness");
  auto arguments = std::make_shared<Arguments>();
  command->add_option("IN", arguments->input, "CAD file: .step, .stp, .iges, .igs, .brep")->required();
  command
      ->add_option(
          "-o,--output", arguments->outputs,
          "the middle surface as .brep or .step, what is known of its faces as .json; may be given more "
          "than once")
      ->required()
      ->allow_extra_args(false);
  command->add_flag("--partial", arguments->options.partial,
                    "write what could be paired where the solid is thin in places only");
  command->add_flag("--join", arguments->options.join, "take solids that touch for one part, as if welded");
  command->add_flag("--end-with-input", arguments->end_with_input,
                    "end the work when standard input closes, for programs that start this one");
  command->add_flag("--quiet", arguments->quiet, "no progress, no table");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace quadrille::command
