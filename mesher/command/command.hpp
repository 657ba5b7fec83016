#pragma once
/// What the subcommands of `quadrille` share. Each subcommand is a function that adds itself to the parser;
/// its callback does the work and throws Error, which main() turns into one line on stderr and the exit code.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "mesher/mesh/mesh_types.hpp"
#include "mesher/settings.hpp"

namespace quadrille::command {

/// The command as a whole, with the arguments of main(): gives its exit code, throws nothing. With the single
/// argument "standby" it opens what it needs ahead of time and waits; the first line of its input is then the
/// arguments, as a JSON list of strings, and the end of its input without one ends it.
int run(int argc, char** argv);

void add_mesh_command(CLI::App& app);
void add_info_command(CLI::App& app);
void add_quality_command(CLI::App& app);
void add_midsurface_command(CLI::App& app);
void add_adapt_command(CLI::App& app);
void add_remesh_command(CLI::App& app);
void add_sizes_command(CLI::App& app);
void add_settings_command(CLI::App& app);

/// Writes to stdout at once. Throws Error (failure) when it is closed or full.
void print(std::string_view text);

/// Whether somebody looks at stderr.
bool stderr_is_terminal();

/// Throws Error (failure) unless the path is a file that can be read.
void require_readable(const std::filesystem::path& path);

/// Throws Error (usage) unless a file can be made at the path: the folder exists and is writable, and the
/// path is not itself a folder.
void require_writable(const std::filesystem::path& path);

/// Throws Error (usage) unless the path has the ending (".png") and require_writable() holds.
void require_ending(const std::filesystem::path& path, std::string_view ending, std::string_view option);

/// A file that the command line names, and by which argument: "-o", "--report", "IN".
struct NamedFile {
  std::string argument;
  std::filesystem::path path;
};

/// Throws Error (usage) unless all files that have a name are different ones, links followed: what is written
/// must replace neither what is read nor what was written before. Devices and pipes may come twice.
void require_different_files(const std::vector<NamedFile>& files);

/// The files of a run on a model: what is read, and what is written where it has a name.
struct ModelFiles {
  const std::filesystem::path& input;
  const std::vector<std::filesystem::path>& outputs;
  const std::filesystem::path &size_field, &report, &picture, &write_size_field;
};

/// Throws Error (usage) unless what is read can be, what is written can be, with the endings that it takes,
/// and all are different files. The outputs' endings are the command's own affair.
void require_usable(const ModelFiles& files);

/// Draws a picture in a child process: the renderer ends the program where memory or threads run out. Throws
/// Error (failure) that names the file.
void draw_apart(const std::filesystem::path& path, ExecutionContext& context,
                const std::function<void()>& draw);

/// From now on a crash, of the CAD library on a damaged file above all, ends the process with one line on
/// stderr that names the file, and exit code 1; unfinished files are removed. \param work "reading" or what
/// else is going on.
void report_crashes(const std::filesystem::path& file, std::string_view work);

/// From now on a reader that goes away and a limit on the size of files show as a failed write, and the end
/// of the CPU time that the process may use ends it with one line on stderr and exit code 1.
void tell_limits();

/// The progress of long work on stderr: a bar on a terminal; elsewhere lines "progress: STAGE PERCENT %", at
/// most two a second and none in the first half second.
class ProgressDisplay {
 public:
  explicit ProgressDisplay(bool quiet);
  ~ProgressDisplay();  ///< clears the bar
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  /// Shows a stage and the fraction done. Always true: it never cancels.
  bool show(std::string_view stage, double fraction);

 private:
  void draw_bar(std::string_view stage, int percent);

  bool quiet_;
  bool terminal_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point last_;
  std::string last_text_;
};

/// From now on the end of standard input is a SIGTERM: a program that starts this one and is killed takes it
/// along.
void end_with_input();

/// While it lives, Ctrl-C and SIGTERM cancel the context, and the time limit, if there is one, ends the work.
/// Work that does not notice within 0.15 s (CAD files are read in one go) is ended from outside: one line on
/// stderr, unfinished files removed. A second signal ends the process at once. Outside, a signal ends the
/// process at once, when there is nothing to clean up.
class CancelOnSignal {
 public:
  /// \param time_limit seconds; 0 = none.
  explicit CancelOnSignal(ExecutionContext& context, double time_limit = 0);

  /// Until reading_is_done(), which cannot be asked to end, it has this limit too. \param seconds 0 = none.
  void reading(const std::filesystem::path& file, double seconds);
  void reading_is_done();

  /// A file is whole: the line that tells of the end names it.
  void wrote(const std::filesystem::path& file);

  ~CancelOnSignal();
  CancelOnSignal(const CancelOnSignal&) = delete;
  CancelOnSignal& operator=(const CancelOnSignal&) = delete;

 private:
  double time_limit_;
  std::chrono::steady_clock::time_point start_;
};

/// What a run that is ended has left: ", and nothing was written", or the files that were.
std::string left_behind();

/// What a mesh is made from and written to.
struct MeshFiles {
  const std::filesystem::path& input;
  const std::vector<std::filesystem::path>& outputs;
  const std::filesystem::path& picture;  ///< empty = none
};

/// Writes a mesh, with the command and the input's name as title, and draws it.
void write_outputs(const ShellMesh& mesh, const MeshFiles& files, const Settings& settings,
                   ExecutionContext& context, CancelOnSignal& cancel);

}  // namespace quadrille::command
