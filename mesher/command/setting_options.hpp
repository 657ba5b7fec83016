#pragma once
/// The command's options for the table of settings.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "mesher/settings.hpp"

namespace quadrille::command {

/// Settings as they come from the command line.
struct GivenSettings {
  Settings settings;
  std::set<std::string_view> given;  ///< names of those that were
};

/// Adds an option for each setting of the table, or for those named. `target` must live as long as the
/// command. Wrong values throw Error (usage) while the arguments are parsed.
void add_settings(CLI::App& command, GivenSettings& target, const std::set<std::string_view>& names = {});

/// The mesh's order: what is asked for, or second where a solver reads one of the files.
int order_of(const GivenSettings& given, const std::vector<std::filesystem::path>& outputs);

/// A sentence of the library with the command's own names: "`size_min`" becomes "--size-min".
std::string with_options(std::string sentence);

}  // namespace quadrille::command
