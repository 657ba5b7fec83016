#pragma once
/// What the subcommands of `quadrille` share. Each subcommand is a function that adds itself to the parser.
/// Its callback does the work and throws Error, which run() turns into one line on stderr and the exit code.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/base/file_access.hpp"
#include "mesher/command/setting_options.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille::command {

/// Runs the command with the arguments of main(). Returns the exit code, throws nothing. With the single
/// argument "standby" it opens the MED module ahead of time and waits. The first line of standard input then
/// holds the arguments, as a JSON list of strings; if the input ends without a line, the process ends.
int run(int argc, char** argv);

void add_mesh_command(CLI::App& app);
void add_info_command(CLI::App& app);
void add_quality_command(CLI::App& app);
void add_midsurface_command(CLI::App& app);
void add_adapt_command(CLI::App& app);
void add_recombine_command(CLI::App& app);
void add_remesh_command(CLI::App& app);
void add_sizes_command(CLI::App& app);
void add_settings_command(CLI::App& app);

/// Writes to stdout at once, with what a terminal would obey shown escaped. Throws Error (failure) if stdout
/// is closed or full.
void print(std::string_view text);

/// Writes a line to stderr, with what a terminal would obey, line breaks too, shown escaped.
void say_line(std::string_view line);

/// The same with a format of fmt.
template <class... Values>
void say(fmt::format_string<Values...> format, Values&&... values) {
  say_line(fmt::format(format, std::forward<Values>(values)...));
}

/// A file named on the command line, and the argument that names it: "-o", "--report", "IN". Optional files
/// that are not given have no path.
struct NamedFile {
  std::string argument;
  std::filesystem::path path;
  std::string_view ending = {};  ///< that an output must have (".png"); empty = checked by the command
};

/// Throws Error: failure unless the inputs can be read, usage unless the outputs can be made (the folder
/// exists and is writable), have the right endings, and all files are different: no output replaces an input
/// or another output. Links are followed. Devices and pipes may be named twice.
/// \param input the argument that names the input \param others further inputs \param ending of the -o files
void require_usable(const RunArguments& arguments, const std::string& input,
                    const std::vector<NamedFile>& others = {}, std::string_view ending = {});

/// Draws the mesh in a child process, since the renderer ends its process if memory or threads run out.
/// Throws Error (failure) that names the file.
void draw_apart(const ShellMesh& mesh, const std::filesystem::path& path, ExecutionContext& context);

/// From now on a crash, mostly of the CAD library on a damaged file, ends the process with one line on stderr
/// that names the file, and exit code 1; unfinished files are removed. \param work what is being done, such
/// as "reading".
void report_crashes(const std::filesystem::path& file, std::string_view work);

/// From now on a closed pipe and a limit on file size show up as a failed write. The limit on the CPU time of
/// the process ends it with one line on stderr and exit code 1.
void tell_limits();

/// The progress of long work on stderr: a bar on a terminal; elsewhere lines "progress: STAGE PERCENT %", at
/// most two per second and none in the first half second.
class ProgressDisplay {
 public:
  ProgressDisplay();
  ~ProgressDisplay();  ///< clears the bar
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  /// Shows a stage and the fraction done. Always returns true: it never cancels.
  bool show(std::string_view stage, double fraction);

 private:
  void draw_bar(std::string_view stage, int percent);

  bool terminal_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point last_;
  std::string last_text_;
};

/// From now on the end of standard input raises SIGTERM, so that this process also ends if the program that
/// started it is killed.
void end_with_input();

/// During its lifetime, Ctrl-C and SIGTERM cancel the context, and the time limit, if any, ends the work. If
/// the work does not react within 0.15 s (CAD files are read in one call), the signal handler ends the
/// process with one line on stderr and removes unfinished files. A second signal ends the process at once.
/// Outside its lifetime there is nothing to clean up, and a signal ends the process at once.
class CancelOnSignal {
 public:
  /// \param time_limit seconds; 0 = none. \param partial work that lifts the context's time limit within a
  /// second after its end continues, to deliver what is done.
  explicit CancelOnSignal(ExecutionContext& context, double time_limit = 0, bool partial = false);

  /// Also limits the time until reading_is_done(): reading cannot be cancelled. \param seconds 0 = no limit.
  void reading(const std::filesystem::path& file, double seconds);
  void reading_is_done();

  /// Records a complete file: if the run is ended, the message names it.
  void wrote(const std::filesystem::path& file);

  ~CancelOnSignal();
  CancelOnSignal(const CancelOnSignal&) = delete;
  CancelOnSignal& operator=(const CancelOnSignal&) = delete;

 private:
  double time_limit_;
  std::chrono::steady_clock::time_point start_;
};

/// The work of a command: the progress that it shows, and what ends it. Ends with standard input if the
/// arguments say so.
struct Work {
  /// \param stages that it has \param partial as in CancelOnSignal
  explicit Work(const RunArguments& arguments, const std::vector<Stage>& stages = {}, bool partial = false);

  ProgressDisplay display;
  ExecutionContext context;
  CancelOnSignal cancel;
};

/// Reads a CAD file within the settings' limit on reading and joins its parts as they say. \param next what
/// is done with the file afterwards, as in report_crashes().
CadModel read_model(const RunArguments& arguments, std::string_view next, Work& work);

/// For the message of an ended run: ", and nothing was written", or the files that were written before.
std::string left_behind();

/// Writes the mesh files, titled with the version and the input's name, and draws the picture.
void write_outputs(const ShellMesh& mesh, const RunArguments& arguments, Work& work);

}  // namespace quadrille::command
