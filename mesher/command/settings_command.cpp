/// quadrille settings: the table of settings, for people and for programs.

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "mesher/command/command.hpp"
#include "mesher/io/io.hpp"
#include "mesher/settings.hpp"

namespace quadrille::command {

namespace {

struct SettingsArguments {
  bool json = false, tables = false;
};

std::string describe() {
  std::string text = fmt::format("{:<22} {:<25} {}\n", "Python", "command", "what it is");
  for (const Setting& setting : all_settings())
    text += fmt::format("{:<22} --{:<23} {}\n", setting.name, setting.option, setting.help);
  return text;
}

void run(const SettingsArguments& arguments) {
  print(arguments.tables ? tables_json() + "\n"
        : arguments.json ? settings_table().dump(1) + "\n"
                         : describe());
}

}  // namespace

void add_settings_command(CLI::App& app) {
  auto [command, arguments] =
      add_command<SettingsArguments>(app, "settings", "list the settings of mesh, by all their names");
  command.add_flag("--json", arguments.json, "all properties of each, as JSON");
  command
      .add_flag("--tables", arguments.tables, "instead, the mesh formats and the quality criteria, as JSON")
      ->excludes("--json");
}

}  // namespace quadrille::command
