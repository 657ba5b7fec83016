#pragma once
/// The command's options for the table of settings.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/base/number_rule.hpp"
#include "mesher/settings.hpp"

namespace quadrille::command {

/// Settings as they come from the command line.
struct GivenSettings {
  Settings settings;
  std::set<std::string_view> given;  ///< names of the settings that were given
};

/// What a command is given that turns one file into others.
struct RunArguments : GivenSettings {
  std::filesystem::path input, report, picture;  ///< the last two empty = none
  std::vector<std::filesystem::path> outputs;
  bool quiet = false, end_with_input = false;
};

/// Adds an option for each setting of the table, or only for those in `names`. `target` must live as long as
/// the command. Wrong values throw Error (usage) while the arguments are parsed.
void add_settings(CLI::App& command, GivenSettings& target, const std::set<std::string_view>& names = {});

/// Checks an option that is no setting: its text must be a number that the rule allows.
CLI::Validator number(const NumberRule& rule);

/// The arguments with the option repeated before each further value of a list: `--segments Edge1=4 Edge2=6`
/// becomes `--segments Edge1=4 --segments Edge2=6`. CLI11 would take everything up to the next option, the
/// input file too, or one value alone.
std::vector<std::string> with_options_repeated(const std::vector<std::string>& arguments);

/// The order of the mesh: the given one, else 2 for nine-node quads or if a solver reads one of the files.
int order_of(const GivenSettings& given, const std::vector<std::filesystem::path>& outputs);

/// Throws Error (usage) if one of the files cannot hold the mesh that was asked for.
void check_formats(const GivenSettings& given, const std::vector<std::filesystem::path>& outputs);

/// A library message with the names of the command's options: "`size_min`" becomes "--size-min".
std::string with_options(std::string sentence);

}  // namespace quadrille::command
