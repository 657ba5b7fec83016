#pragma once
/// The option --limits [FILE], shared by the commands that have it.

#include <filesystem>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "mesher/mesh/criteria.hpp"

namespace quadrille::command {

class LimitsOption {
 public:
  /// Call it once. Keeps a pointer to the option: the command must outlive this object.
  void add_to(CLI::App& command);

  /// The file of limits; empty = none.
  std::filesystem::path file() const { return file_; }

  /// Throws Error (failure) if the file of limits cannot be read or makes no sense.
  void check() const { of({}); }

  /// The limits in the file; if none is given those of limits_of(). Throws as check().
  CriteriaLimits of(const ShellMesh& mesh) const;

  /// Throws Error (failure) if the option is given and quads of the mesh fail. \param file of the mesh
  void hold(const std::filesystem::path& file, const ShellMesh& mesh) const;

 private:
  std::string file_;
  const CLI::Option* option_ = nullptr;
  mutable std::optional<CriteriaLimits> read_;  // from the file
};

}  // namespace quadrille::command
