#pragma once
/// Rings of quads around the holes of a face, and rows of given heights along its loops. Internal.

#include <array>
#include <vector>

#include "geometry/base/trimmed_domain.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/edges/row_lines.hpp"
#include "mesher/faces/face_boundary.hpp"

namespace quadrille {

/// A face boundary with rings or rows set aside along its loops.
struct HoleRings {
  struct Node {
    Vector2 uv{0, 0};
    Vector3 point{0, 0, 0};
  };
  struct Hole {
    int first = 0;  ///< number of the first node of `outer` among those of all holes
    /// (n) the loop, or the part of it that rows cover, in the final mesh: indices into BoundaryNodes::points
    std::vector<int> nodes;
    std::vector<Node> points;  ///< of `nodes`, then all others; of rings line by line outward
    /// The line that bounds the rest of the face, indices into `points`. Beside a part of a loop, its ends
    /// are nodes of the loop.
    std::vector<int> outer;
    std::vector<std::array<int, 4>> quads;  ///< indices into `points`; all turn the same way
  };

  /// The boundary of the face without its rings: in place of a hole's nodes it has the hole's outer line.
  /// Node j of the outer line of hole i has the index node(holes[i].first + j) there, which is negative.
  FaceBoundary inside;
  std::vector<Hole> holes;
  bool has_rows = false;  ///< some have prescribed heights
  EdgeId unfit;           ///< an edge along which rows do not fit; then nothing else counts

  static int node(int number) { return -2 - number; }  ///< index of a node from its number among all holes
  static int number(int node) { return -2 - node; }    ///< the inverse of node()
};

/// Places rings around holes whose loops have no corners. A ring is at most 0.8 times as wide as the loop's
/// segments are long, and narrower where other boundaries are close. If it would be narrower than 0.45 of a
/// segment, there are fewer rings or none. \param domain enclosed by the boundary \param rings largest number
/// per hole, in rows of the final mesh. Time: O(n log n) in the boundary's points if these are spread out.
///
/// Along lines it places rows of the prescribed heights instead, with or without corners, see place_rows().
/// Chains, which are part of a loop, need a boundary with stride 1.
HoleRings place_rings(const FaceBoundary& boundary, const FaceSurface& surface, const TrimmedDomain& domain,
                      int rings, const std::vector<RowLine>& lines = {});

}  // namespace quadrille
