#include <fmt/format.h>

#include <exception>
#include <new>
#include <utility>

#include "geometry/base/printable.hpp"
#include "mesher/command/command.hpp"
#include "mesher/command/recombine_command.hpp"
#include "mesher/quadrille.hpp"

namespace quadrille::command {

namespace {

enum ExitCode : int { success = 0, work_failed = 1, bad_use = 2, work_cancelled = 130 };

/// The core names settings as `size_min`: here they are options.
std::string with_options(std::string message) {
  for (std::size_t start = 0; (start = message.find('`', start)) != std::string::npos;) {
    const std::size_t end = message.find('`', start + 1);
    if (end == std::string::npos) break;
    std::string option = "--" + message.substr(start + 1, end - start - 1);
    std::replace(option.begin(), option.end(), '_', '-');
    message.replace(start, end + 1 - start, option);
    start += option.size();
  }
  return message;
}

/// One line on stderr, whatever the message holds.
int complain(std::string message, ExitCode code) {
  while (!message.empty() && message.back() == '\n') message.pop_back();
  fmt::print(stderr, "quadrille: {}\n", printable(std::move(message), ' '));
  return code;
}

int complain(const Error& error) {
  switch (error.kind()) {
    case Error::Kind::usage:
      return complain(with_options(error.what()), bad_use);
    case Error::Kind::cancelled:
      return complain(error.what(), work_cancelled);
    case Error::Kind::failure:
      break;
  }
  return complain(with_options(error.what()), work_failed);
}

void add_commands(CLI::App& app) {
  app.require_subcommand(1);
  app.set_version_flag("--version", "quadrille " + version());
  add_mesh_command(app);
  add_recombine_command(app);
  add_info_command(app);
  add_quality_command(app);
  add_midsurface_command(app);
}

/// --help and --version also come as parse "errors".
int answer(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) return app.exit(error);
  return complain(std::string(error.what()) + " (see quadrille --help)", bad_use);
}

int parse_and_work(int argc, char** argv) {
  CLI::App app("All-quad shell meshes of CAD models", "quadrille");
  try {
    add_commands(app);
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return answer(app, error);
  }
  return success;
}

}  // namespace

int run(int argc, char** argv) {
  try {
    return parse_and_work(argc, argv);
  } catch (const Error& error) {
    return complain(error);
  } catch (const std::bad_alloc&) {
    return complain("out of memory", work_failed);
  } catch (const std::exception& error) {
    return complain(error.what(), work_failed);
  } catch (...) {
    return complain("an error of the CAD library that says nothing more", work_failed);
  }
}

}  // namespace quadrille::command
