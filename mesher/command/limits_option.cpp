/// Reads the limits that were named, and fails where a mesh does not keep them.

#include "mesher/command/limits_option.hpp"

#include <fmt/format.h>

#include "geometry/base/error.hpp"
#include "mesher/command/command.hpp"
#include "mesher/io/limits_reader.hpp"

namespace quadrille::command {

void LimitsOption::add_to(CLI::App& command) {
  option_ = command
                .add_option("--limits", file_,
                            "exit with 1 if quads fail the usual limits or, if given, those of FILE (JSON or "
                            "a HyperMesh criteria file)")
                ->expected(0, 1);
}

CriteriaLimits LimitsOption::of(const ShellMesh& mesh) const {
  if (file_.empty()) return limits_of(mesh);
  if (!read_) {  // once: the file may be a pipe
    require_readable(file_);
    read_ = read_limits(file_);
  }
  return *read_;
}

void LimitsOption::hold(const std::filesystem::path& file, const ShellMesh& mesh) const {
  if (option_->count() == 0) return;
  const CriteriaSummary criteria = check_criteria(mesh, of(mesh));
  if (criteria.failing == 0) return;
  throw failure(file.string(), fmt::format("{}: {} of {} quads are outside the limits", file.string(),
                                           criteria.failing, criteria.quads));
}

}  // namespace quadrille::command
