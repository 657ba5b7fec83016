#include <fmt/format.h>

#include "geometry/base/isolated_work.hpp"
#include "mesher/command/command.hpp"
#include "mesher/quadrille.hpp"

namespace quadrille::command {

void draw(const ShellMesh& mesh, const std::filesystem::path& path, ExecutionContext& context) {
  IsolatedWork options;
  options.subject = path.string();
  options.crashed = fmt::format(
      "{}: the picture cannot be drawn: the renderer crashed, for want of memory or threads "
      "perhaps",
      path.string());
  options.context = &context;
  options.stage = Stage::write;
  const auto work = [&](std::ostream&) {
    try {
      write_picture(mesh, path);
    } catch (const std::exception& problem) {
      const std::string sentence = problem.what();
      if (sentence.rfind(path.string(), 0) == 0) throw;  // the file, not the renderer
      throw failure(path.string(),
                    fmt::format("{}: the picture cannot be drawn ({})", path.string(), sentence));
    }
  };
  run_isolated(options, work, [](std::istream&) {});
}

}  // namespace quadrille::command
