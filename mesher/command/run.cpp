/// Parses arguments, runs the subcommand, and turns what is thrown into a line on stderr and an exit code.

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "mesher/command/command.hpp"
#include "mesher/io/modules.hpp"
#include "mesher/quadrille.hpp"

namespace quadrille::command {

namespace {

enum ExitCode : int { success = 0, work_failed = 1, bad_use = 2, work_cancelled = 130 };

/// Prints the message as one line on stderr, whatever it contains.
int complain(std::string message, ExitCode code) {
  while (!message.empty() && message.back() == '\n') message.pop_back();
  std::replace(message.begin(), message.end(), '\n', ' ');  // of CLI11
  say("quadrille: {}", message);
  return code;
}

int complain(const Error& error) {
  if (error.kind() == Error::Kind::cancelled) return complain(error.what(), work_cancelled);
  if (error.kind() == Error::Kind::usage) return complain(with_options(error.what()), bad_use);
  const bool is_over = error.subject() == ExecutionContext::time_subject;
  return complain(is_over ? error.what() + left_behind() : with_options(error.what()), work_failed);
}

void add_commands(CLI::App& app) {
  app.require_subcommand(1);
  app.set_version_flag("--version", "quadrille " + version());
  add_mesh_command(app);
  add_recombine_command(app);
  add_remesh_command(app);
  add_info_command(app);
  add_quality_command(app);
  add_midsurface_command(app);
  add_adapt_command(app);
  add_sizes_command(app);
  add_settings_command(app);
}

/// CLI11's own message, except for an option that is given more often than it may be.
std::string sentence_of(const CLI::ParseError& error) {
  const std::string text = error.what();
  const std::size_t end = text.find(": At Most 1 required");
  return end == std::string::npos ? text : text.substr(0, end) + " is given more than once: give it once";
}

/// --help and --version also arrive as parse "errors".
int answer(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) {
    std::ostringstream text;
    app.exit(error, text, text);
    print(text.str());
    return success;
  }
  return complain(sentence_of(error) + " (see quadrille --help)", bad_use);
}

int parse_and_work(std::vector<std::string> arguments) {
  // OpenCASCADE prints to std::cout, but stdout is for our results, which print() writes without std::cout.
  std::cout.setstate(std::ios::badbit);
  CLI::App app("All-quad shell meshes of CAD models", "quadrille");
  try {
    add_commands(app);
    arguments = with_options_repeated(arguments);
    std::reverse(arguments.begin(), arguments.end());  // the order that CLI11 expects
    app.parse(std::move(arguments));
  } catch (const CLI::ParseError& error) {
    return answer(app, error);
  }
  return success;
}

/// The arguments of a process on standby: waits for the first line of its input. Empty at the end of input.
std::vector<std::string> awaited_arguments() {
  open_med_module();
  std::string line;
  if (!std::getline(std::cin, line)) return {};
  try {
    return nlohmann::json::parse(line).get<std::vector<std::string>>();
  } catch (const nlohmann::json::exception&) {
    throw usage_error("standby", "standby: the first line of its input is not a JSON list of arguments");
  }
}

int work(const std::vector<std::string>& arguments) {
  if (arguments != std::vector<std::string>{"standby"}) return parse_and_work(arguments);
  const std::vector<std::string> awaited = awaited_arguments();
  return awaited.empty() ? success : parse_and_work(awaited);
}

}  // namespace

int run(int argc, char** argv) {
  try {
    return work({argv + std::min(argc, 1), argv + argc});
  } catch (const Error& error) {
    return complain(error);
  } catch (const std::exception& error) {
    return complain(quadrille::sentence_of(error), work_failed);
  } catch (...) {
    return complain("an error in the CAD library, without a description", work_failed);
  }
}

}  // namespace quadrille::command
