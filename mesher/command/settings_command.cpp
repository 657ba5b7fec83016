/// quadrille settings: the table of settings, for people and for programs.

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "mesher/command/command.hpp"
#include "mesher/io/io.hpp"
#include "mesher/settings.hpp"

namespace quadrille::command {

namespace {

std::string describe() {
  std::string text = fmt::format("{:<22} {:<25} {}\n", "Python", "command", "what it is");
  for (const Setting& setting : all_settings())
    text += fmt::format("{:<22} --{:<23} {}\n", setting.name, setting.option, setting.help);
  return text;
}

}  // namespace

void add_settings_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("settings", "list the settings of mesh, by all their names");
  auto as_json = std::make_shared<bool>(false);
  command->add_flag("--json", *as_json, "all properties of each, as JSON");
  auto tables = std::make_shared<bool>(false);
  command->add_flag("--tables", *tables, "instead, the mesh formats and the quality criteria, as JSON")
      ->excludes("--json");
  command->callback([as_json, tables] {
    print(*tables ? tables_json() + "\n" : *as_json ? settings_table().dump(1) + "\n" : describe());
  });
}

}  // namespace quadrille::command
