#pragma once
/// Segment counts along strips narrower than the size. Internal.

#include <array>
#include <optional>
#include <span>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/edges/count_table.hpp"
#include "mesher/edges/edge_counts.hpp"

namespace quadrille {

/// Segments along four-sided faces whose rows are narrower than the segments are long.
class StripRefiner {
 public:
  /// \param aspect how many times as long as the rows are wide quads may be \param shortest (edges) no
  /// shorter segments are asked for
  StripRefiner(const CadShape& shape, double aspect, IdVector<EdgeId, double> shortest)
      : shape_(shape), aspect_(aspect), shortest_(std::move(shortest)), waists_(shape.faces.size()) {}

  /// Raises the wanted counts of edges of four-sided faces and of the rest of their chords until quads are at
  /// most `aspect` times as long as the rows are wide. The width of the rows is known once counts are chosen.
  /// Rows that users divide are as flat as these ask for. \param sides as choose_counts() left them; the
  /// facing sides of a face are the same in all calls \return whether anything was raised, so that counts
  /// must be chosen again.
  bool refine(const FaceOutlines& sides, const EdgeCounts& chosen, const PlannedSpacing& spacing,
              IdVector<EdgeId, CountTable>& tables, CountTargets& targets);

 private:
  /// How much narrower a face is between its ends than at them: the smallest and the mean ratio, at most 1.
  struct Waist {
    double narrowest = 1, mean = 1;
  };
  Waist waist_between(std::span<const FacingPair> along) const;

  const CadShape& shape_;
  double aspect_;
  IdVector<EdgeId, double> shortest_;
  IdVector<FaceId, std::array<std::optional<Waist>, 2>> waists_;  // across and along the first sides
};

}  // namespace quadrille
