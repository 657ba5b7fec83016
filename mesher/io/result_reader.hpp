#pragma once
/// Reads results of solvers: CalculiX's .frd files as text, and .vtu files.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/base/vector.hpp"

namespace quadrille {

/// The mesh that a solver used, and its displacements in the last step.
struct SolverResult {
  /// A brick. Its nodes are in the order of .frd files: corners of the bottom and of the top, then the
  /// midside nodes of the bottom, of the upright sides and of the top.
  struct Element {
    static constexpr int eight_nodes = 1, twenty_nodes = 4;  ///< types of the .frd format
    int number = 0;                                          ///< as in the file
    int type = 0;            ///< one of these two, or another type of the format; 0 = not a brick
    std::vector<int> nodes;  ///< indices of `points`
  };
  std::vector<Vector3> points;
  std::vector<Vector3> displacements;  ///< (points)
  std::vector<Element> elements;       ///< ascending by number
};

/// Reads a result: .vtu with bricks and one of the point arrays U, DISP, Displacement and displacement; all
/// other files as .frd. Throws Error (failure) with one sentence that names the line at fault, or says what
/// the file lacks.
SolverResult read_result(const std::filesystem::path& path);

/// Parses a .frd file. \param name used in error messages. Throws Error as read_result().
SolverResult read_frd(std::string_view bytes, const std::string& name);

}  // namespace quadrille
