#pragma once
/// The option --limits [FILE], shared by the commands that have it.

#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

#include "mesher/mesh/criteria.hpp"

namespace quadrille::command {

class LimitsOption {
 public:
  /// Call it once. Keeps a pointer to the option: the command must outlive this object.
  void add_to(CLI::App& command);

  bool given() const { return option_->count() > 0; }

  /// The limits in the file, or the usual ones if no file is given. Throws Error (failure) if the file cannot
  /// be read or makes no sense.
  CriteriaLimits limits() const;

  /// Throws Error (failure) if the option is given and quads of the mesh fail. \param mesh file of the mesh.
  void hold(const std::filesystem::path& mesh, const CriteriaSummary& criteria) const;

 private:
  std::string file_;
  const CLI::Option* option_ = nullptr;
};

}  // namespace quadrille::command
