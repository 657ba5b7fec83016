#pragma once
/// The option --limits [FILE], the same for each command that has it.

#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

#include "mesher/mesh/criteria.hpp"

namespace quadrille::command {

class LimitsOption {
 public:
  /// To be called once. Keeps a pointer to the option, whose command must outlive this.
  void add_to(CLI::App& command);

  bool given() const { return option_->count() > 0; }

  /// Those of the file, else the usual ones. Throws Error: usage where the file cannot be read, failure where
  /// it makes no sense.
  CriteriaLimits limits() const;

  /// Throws Error (failure) where the option is given and quads of the mesh fail. \param mesh its file.
  void hold(const std::filesystem::path& mesh, const CriteriaSummary& criteria) const;

 private:
  std::string file_;
  const CLI::Option* option_ = nullptr;
};

}  // namespace quadrille::command
