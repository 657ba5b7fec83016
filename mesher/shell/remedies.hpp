#pragma once
/// The table of causes and remedies: what is changed for a face that could not be meshed, and where.
/// Internal.

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/edges/edge_sampling.hpp"
#include "mesher/edges/tiny_features.hpp"
#include "mesher/faces/face_problem.hpp"
#include "mesher/shell/face_mesher.hpp"

namespace quadrille {

/// What is known of one face over all its meshings.
struct FaceRecord {
  static constexpr int most_attempts = 12;
  /// All its meshings together may take so many times the work of the first, if that is not little.
  static constexpr int most_work = 6;
  static constexpr std::int64_t little_work = 20000;
  /// For gaps between curves that segments leave no room in.
  static constexpr int most_looks = 3;

  /// Of ExecutionContext::work().
  std::int64_t share() const { return std::max(little_work, most_work * first_work); }

  FaceRecipe recipe;
  int looks_at_gaps = 0;
  int attempts = 0;                       ///< times that it was meshed
  double seconds = 0;                     ///< that this took
  std::int64_t first_work = 0, work = 0;  ///< of the first meshing of its kind, and of all
  bool given_up = false;                  ///< no remedy is left
  std::vector<int> tried;                 ///< (rows of the table) how often
  std::vector<std::string> history;       ///< "cause: remedy", in the order in which they were found
};

/// What remedies may change beside the face's own record.
struct EdgeTreatment {
  SamplingPlan plan;
  std::vector<char> collapse;  ///< (edges) 1 = becomes a point
};

/// The longest of a face's edges. \param face from 0.
double longest_edge(const CadShape& shape, int face);

/// Applies the next remedy that the table has for the problem of a face and that changes something.
/// \param size the global target size. \return false if there is none left.
bool apply_remedy(const CadShape& shape, const FaceProblem& problem, double size, FaceRecord& record,
                  EdgeTreatment& edges);

}  // namespace quadrille
