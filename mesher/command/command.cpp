/// Checks of the files that commands are given, and the writing of those that they make.

#include "mesher/command/command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "geometry/base/atomic_file.hpp"
#include "geometry/base/error.hpp"
#include "geometry/base/file_access.hpp"
#include "geometry/base/isolated_work.hpp"
#include "mesher/io/modules.hpp"
#include "mesher/quadrille.hpp"

namespace quadrille::command {

void draw_apart(const ShellMesh& mesh, const std::filesystem::path& path, ExecutionContext& context) {
  IsolatedWork options;
  options.subject = path.string();
  options.crashed =
      fmt::format("{}: the picture cannot be drawn: the renderer crashed, probably out of memory or threads",
                  path.string());
  options.context = &context;
  options.stage = Stage::write;
  const auto work = [&](std::ostream&) {
    try {
      write_picture(mesh, path);
    } catch (const std::exception& problem) {
      const std::string sentence = problem.what();
      if (sentence.rfind(path.string(), 0) == 0) throw;  // a problem with the file, not with the renderer
      throw failure(path.string(),
                    fmt::format("{}: the picture cannot be drawn ({})", path.string(), sentence));
    }
  };
  run_isolated(options, work);
}

namespace {

void require_writable(const std::filesystem::path& path) {
  const std::string name = path.string();
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw usage_error(name, fmt::format("{}: is a folder, not a file", name));
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored)) return;
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  if (!std::filesystem::is_directory(folder, ignored))
    throw usage_error(name, fmt::format("{}: the folder {} does not exist", name, folder.string()));
  if (const std::string why = why_unwritable(folder); !why.empty())
    throw usage_error(name, fmt::format("{}: the folder {} is not writable: {}", name, folder.string(), why));
}

/// Throws Error (usage) unless the output can be made and has its ending.
void require_possible(const NamedFile& output) {
  if (!output.ending.empty() && lower_ending(output.path) != output.ending)
    throw usage_error(output.argument, fmt::format("{}: the file name must end in {}, not {}",
                                                   output.argument, output.ending, output.path.string()));
  if (output.ending == ".png") require_library(Library::pictures, output.ending);
  require_writable(output.path);
}

bool is_regular(const std::filesystem::path& path) {
  std::error_code none;
  const auto type = std::filesystem::status(path, none).type();
  return type == std::filesystem::file_type::regular || type == std::filesystem::file_type::not_found;
}

bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code none;
  if (std::filesystem::equivalent(a, b, none)) return is_regular(a);
  // Files that do not exist yet.
  const auto place = [&](const std::filesystem::path& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(written_file(path), none), none);
  };
  return is_regular(a) && is_regular(b) && place(a) == place(b);
}

void require_different(const NamedFile& first, const NamedFile& second) {
  if (first.path.empty() || second.path.empty() || !is_same_file(first.path, second.path)) return;
  throw usage_error(second.argument,
                    fmt::format("{} {} is the same file as {} {}: give each a file of its own",
                                second.argument, second.path.string(), first.argument, first.path.string()));
}

}  // namespace

void require_usable(const RunArguments& arguments, const std::string& input,
                    const std::vector<NamedFile>& others, std::string_view ending) {
  const MeshOptions& mesh = arguments.settings.mesh;
  std::vector<NamedFile> files{{input, arguments.input},
                               {"--size-field", mesh.sizing.size_field},
                               {"--size-points", mesh.sizing.size_points}};
  files.insert(files.end(), others.begin(), others.end());
  const std::size_t inputs = files.size();
  for (const std::filesystem::path& output : arguments.outputs) files.push_back({"-o", output, ending});
  files.insert(files.end(), {{"--report", arguments.report},
                             {"--picture", arguments.picture, ".png"},
                             {"--write-size-field", mesh.write_size_field, ".vdb"}});
  for (std::size_t i = inputs; i < files.size(); ++i)
    if (!files[i].path.empty()) require_possible(files[i]);
  for (std::size_t i = 0; i < inputs; ++i)
    if (i == 0 || !files[i].path.empty()) require_readable(files[i].path);
  for (std::size_t i = 0; i < files.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) require_different(files[k], files[i]);
}

Work::Work(const RunArguments& arguments, const std::vector<Stage>& stages, bool partial)
    : context(
          arguments.settings.threads,
          arguments.quiet
              ? ExecutionContext::Progress()
              : [this](std::string_view stage, double fraction) { return display.show(stage, fraction); }),
      cancel(context, arguments.settings.time_limit, partial) {
  context.expect(stages);
  if (arguments.end_with_input) end_with_input();
}

CadModel read_model(const RunArguments& arguments, std::string_view next, Work& work) {
  const StageTimer timer(work.context, Stage::read);
  report_crashes(arguments.input, "reading");
  work.cancel.reading(arguments.input, arguments.settings.read_time_limit);
  CadModel model = joined(arguments.settings, CadModel::read(arguments.input));
  work.cancel.reading_is_done();
  report_crashes(arguments.input, next);
  return model;
}

void write_outputs(const ShellMesh& mesh, const RunArguments& arguments, Work& work) {
  const StageTimer timer(work.context, Stage::write);
  WriteOptions options = arguments.settings.write;
  options.threads = arguments.settings.threads;
  options.title = fmt::format("Quadrille {}: {}", version(), arguments.input.filename().string());
  const double count = static_cast<double>(arguments.outputs.size());
  for (std::size_t i = 0; i < arguments.outputs.size(); ++i) {
    work.context.report(Stage::write, static_cast<double>(i) / count);
    write_mesh(mesh, arguments.outputs[i], options);
    work.cancel.wrote(arguments.outputs[i]);
  }
  if (!arguments.picture.empty()) draw_apart(mesh, arguments.picture, work.context);
}

}  // namespace quadrille::command
