#pragma once
/// Face outlines that suit grids: which edges face each other. Internal.

#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/edges/tiny_features.hpp"

namespace quadrille {

struct SideEdge {
  EdgeId edge;
  bool forward;  ///< the side runs along the edge's parameter
};

/// Consecutive edges.
using FaceSide = std::vector<SideEdge>;

/// The sum of a value over the edges of a side.
template <class Value>
Value sum_over(const FaceSide& side, const IdVector<EdgeId, Value>& values) {
  Value sum = 0;
  for (const SideEdge& edge : side) sum += values[edge.edge];
  return sum;
}

/// Two sides that face each other across a face, both listed in the same direction.
struct FacingPair {
  FaceSide first, second;
  FaceSide edges() const;  ///< of both
  /// Whether a side has several edges, whose counts have a sum.
  bool has_sum() const { return first.size() + second.size() > 2; }
};

/// The outlines that grids fill. Only this module, which decides, and face_grid.cpp, which makes the grids,
/// look at it; all others read what follows from it, in FaceSides and FacePlan.
enum class GridKind {
  other,
  four,  ///< one loop with four corners
  ring,  ///< two loops without corners
  holed  ///< one loop with four corners, and holes without corners
};

/// The outline of a face and the conditions that the counts around it must satisfy.
struct FaceSides {
  GridKind kind = GridKind::other;
  /// Pairs of sides whose counts must be equal.
  std::vector<FacingPair> facing;
  /// (four) index of the first pair whose sides run across those of the first one
  std::size_t across = 0;
  std::vector<EdgeId> rest;  ///< edges whose counts must have an even sum
  /// Three or five corners: the sum may be odd where the triangle that then remains is subdivided. One more
  /// node on a side of a small triangle would make elements far shorter than they are wide.
  bool may_be_odd = false;
  int outer = 0;  ///< index of the wire with the corners
  /// (four, holed) index of the first coedge of each side in that wire
  std::vector<int> starts;

  /// Whether a grid fills the face: its nodes face each other, its sides need no room between them, and rows
  /// run from end to end, or all the way around.
  bool is_filled() const { return kind != GridKind::other && kind != GridKind::holed; }
  /// Whether the face has four sides, which may be cut into parts with counts of their own.
  bool has_four_sides() const { return kind == GridKind::four; }
  /// Whether holes take the place of cells of its grid.
  bool has_holes() const { return kind == GridKind::holed; }

  std::vector<EdgeId> facing_edges() const;  ///< of all pairs
  /// Reduces the conditions to an even sum over all edges.
  void drop_facing();
};

using FaceOutlines = IdVector<FaceId, FaceSides>;

/// The outlines of the faces used. A corner is a vertex where the boundary turns by about a right angle to
/// the left. A side may have several edges. Opposite sides are cut into several pairs where their vertices
/// face each other, so that each part keeps its own count. \param wanted number of segments
FaceOutlines find_face_sides(const CadShape& shape, const FaceFlags& used, const TinyFeatures& tiny,
                             const IdVector<EdgeId, double>& wanted);

}  // namespace quadrille
