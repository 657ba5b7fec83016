#pragma once
/// The command's options for the table of settings.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geometry/base/number_rule.hpp"
#include "mesher/settings.hpp"

namespace quadrille::command {

/// What a command is given that turns one file into others.
struct RunArguments {
  Settings settings;
  std::set<std::string_view> given;              ///< names of the settings that were given
  std::filesystem::path input, report, picture;  ///< the last two empty = none
  std::vector<std::filesystem::path> outputs;
  bool quiet = false, end_with_input = false;
};

/// Adds a subcommand, which calls run() with its arguments.
template <class Arguments>
std::pair<CLI::App&, Arguments&> add_command(CLI::App& app, const std::string& name,
                                             const std::string& help) {
  CLI::App* command = app.add_subcommand(name, help);
  const auto arguments = std::make_shared<Arguments>();
  command->callback([arguments] { run(*arguments); });
  return {*command, *arguments};
}

/// Adds an option for each setting of the table, or only for those in `names`. `target` must live as long as
/// the command. Wrong values throw Error (usage) while the arguments are parsed.
void add_settings(CLI::App& command, RunArguments& target, const std::set<std::string_view>& names = {});

/// Adds IN.
void add_model(CLI::App& command, RunArguments& target);

/// Adds -o, which may be given more than once. \param help what the files hold, and their endings
CLI::Option* add_outputs(CLI::App& command, RunArguments& target, const std::string& help);

/// Adds --end-with-input and --quiet. \param quiet what --quiet leaves out
void add_run_options(CLI::App& command, RunArguments& target, const std::string& quiet);

/// Checks an option that is no setting: its text must be a number that the rule allows.
CLI::Validator number(const NumberRule& rule);

/// The arguments with the option repeated before each further value of a list: `--segments Edge1=4 Edge2=6`
/// becomes `--segments Edge1=4 --segments Edge2=6`. CLI11 would take everything up to the next option, the
/// input file too, or one value alone.
std::vector<std::string> with_options_repeated(const std::vector<std::string>& arguments);

/// The order of the mesh: the given one, else 2 for nine-node quads or if a solver reads one of the files.
int order_of(const RunArguments& arguments);

/// Throws Error (usage) if one of the files cannot hold the mesh that was asked for.
void check_formats(const RunArguments& arguments);

/// A library message with the names of the command's options: "`size_min`" becomes "--size-min".
std::string with_options(std::string sentence);

}  // namespace quadrille::command
