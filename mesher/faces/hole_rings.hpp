#pragma once
/// Rings of quads around the holes of a face, and rows of given heights along its loops. Internal.

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "geometry/base/trimmed_domain.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/faces/face_boundary.hpp"

namespace quadrille {

/// A face boundary with rings or rows set aside along its loops.
struct HoleRings {
  struct Node {
    Vector2 uv{0, 0};
    Vector3 point{0, 0, 0};
  };
  struct Hole {
    int first = 0;             ///< number of the first node of `outer` among those of all holes
    std::vector<int> nodes;    ///< (n) the loop in the final mesh, indices into BoundaryNodes::points
    std::vector<Node> points;  ///< the loop, then all others; of rings line by line outward
    std::vector<int> outer;    ///< the line that bounds the rest of the face, indices into `points`
    std::vector<std::array<int, 4>> quads;  ///< indices into `points`; all turn the same way
  };

  /// The boundary of the face without its rings: the loop of each hole is the hole's outermost line. Node j
  /// of the outer line of hole i has the index node(holes[i].first + j) there, which is negative.
  FaceBoundary inside;
  std::vector<Hole> holes;
  bool has_rows = false;  ///< some have heights that were asked for
  EdgeId unfit;           ///< an edge along which rows do not fit; then nothing else counts

  static int node(int number) { return -2 - number; }  ///< index of a node from its number among all holes
  static int number(int node) { return -2 - node; }    ///< the inverse of node()
};

/// Places rings around holes whose loops have no corners. A ring is at most 0.8 times as wide as the loop's
/// segments are long, and narrower where other boundaries are close. If it would be narrower than 0.45 of a
/// segment, there are fewer rings or none. \param domain enclosed by the boundary \param rings largest number
/// per hole, in rows of the final mesh. Time: O(n log n) in the boundary's points if these are spread out.
///
/// Loops with heights get rows of just these heights instead, with or without corners: where a loop turns
/// away from the face by more than 72 degrees, one or two blocks of as many quads each way fill the corner.
/// \param heights of the rows along an edge; empty = none. The loop gets them if all its edges have the same.
HoleRings place_rings(
    const FaceBoundary& boundary, const FaceSurface& surface, const TrimmedDomain& domain, int rings,
    const std::function<std::vector<double>(EdgeId)>& heights = [](EdgeId) { return std::vector<double>(); });

}  // namespace quadrille
