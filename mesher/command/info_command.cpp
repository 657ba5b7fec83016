/// quadrille info IN: what a CAD model holds, and the sizes that suit it.

#include <fmt/format.h>

#include "mesher/command/command.hpp"
#include "mesher/quadrille.hpp"

namespace quadrille::command {

namespace {

std::string describe(const CadModel& model) {
  std::string text;
  const auto line = [&](std::string_view label, const std::string& value) {
    text += fmt::format("{:<12} {}\n", label, value);
  };
  line("solids", std::to_string(model.solid_count()));
  line("shells", std::to_string(model.shell_count()));
  line("faces", std::to_string(model.face_count()));
  line("edges", std::to_string(model.edge_count()));
  line("vertices", std::to_string(model.vertex_count()));
  const Vector3 low = model.box_min(), high = model.box_max();
  line("box", fmt::format("({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g})", low.x(), low.y(), low.z(),
                          high.x(), high.y(), high.z()));
  line("diagonal", fmt::format("{:.6g} mm", model.diagonal()));
  line("area", fmt::format("{:.6g} mm2", model.area()));
  for (const int quads : {1000, 10000, 100000})
    line("size", fmt::format("--size {:.3g} for about {} quads", suggested_size(model, quads), quads));
  if (model.problems().empty()) line("problems", "none found");
  for (const std::string& problem : model.problems()) line("problem", problem);
  return text;
}

}  // namespace

void add_info_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("info", "tell what a CAD model holds, and the sizes that suit it");
  auto input = std::make_shared<std::filesystem::path>();
  command->add_option("IN", *input, "CAD file: .step, .stp, .iges, .igs, .brep")->required();
  command->callback([input] {
    require_readable(*input);
    report_crashes(*input, "reading");
    print(describe(CadModel::read(*input)));
  });
}

}  // namespace quadrille::command
