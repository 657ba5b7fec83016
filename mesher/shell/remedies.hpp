#pragma once
/// The table of causes and remedies: what to change if a face could not be meshed, and where. Internal.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/edges/edge_sampling.hpp"
#include "mesher/faces/face_problem.hpp"
#include "mesher/shell/face_mesher.hpp"

namespace quadrille {

/// The record of one face over all its meshings.
struct FaceRecord {
  static constexpr int most_attempts = 12;  ///< no remedy is tried after this many meshings
  /// All meshings together may take most_work times the work of the first, or little_work if that is more.
  static constexpr int most_work = 6;
  static constexpr std::int64_t little_work = 20000;
  static constexpr int most_looks = 3;  ///< limit on `looks_at_gaps`

  /// The work allowed, in the unit of ExecutionContext::work().
  std::int64_t share() const { return std::max(little_work, most_work * first_work); }

  FaceRecipe recipe;                      ///< how the face is meshed next
  int looks_at_gaps = 0;                  ///< times that narrow gaps were found; most_looks = look no more
  int charts = 0;                         ///< number of charts that were made, or failed
  int attempts = 0;                       ///< number of meshings
  double seconds = 0;                     ///< time that all meshings took
  std::int64_t first_work = 0, work = 0;  ///< work of the first meshing of its kind, and of all
  bool given_up = false;                  ///< no remedy is left
  std::vector<int> tried;                 ///< (rows of the table) how often the remedy was applied
  std::vector<std::string> history;       ///< "cause: remedy" for each remedy applied, in order
  std::optional<FaceProblem> problem;     ///< why the face has no mesh
  std::optional<FaceProblem> before;      ///< the problem that was treated last
};

/// The length of a face's longest edge.
double longest_edge(const CadShape& shape, FaceId face);

/// Applies the next remedy in the table that fits the problem of a face and changes something.
/// \param plan how edges are sampled. \return false if no remedy is left.
bool apply_remedy(const CadShape& shape, const FaceProblem& problem, FaceRecord& record, SamplingPlan& plan);

}  // namespace quadrille
