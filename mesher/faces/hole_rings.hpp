#pragma once
/// Rings of quads around the holes of a face. Internal.

#include <array>
#include <vector>

#include "geometry/base/trimmed_domain.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/faces/face_boundary.hpp"

namespace quadrille {

/// A face boundary with rings set aside along its loops.
struct HoleRings {
  struct Node {
    Vector2 uv{0, 0};
    Vector3 point{0, 0, 0};
  };
  struct Hole {
    int first = 0;           ///< number of the first node of the outermost line among those of all holes
    std::vector<int> nodes;  ///< of the loop in the final mesh: indices into BoundaryNodes::points
    /// Of `nodes`, then line by line outward; the outermost line bounds the rest of the face.
    std::vector<Node> points;
    std::vector<std::array<int, 4>> quads;  ///< indices into `points`; all turn the same way

    /// The index of a node of the outermost line in `points`.
    std::size_t outer(std::size_t k) const { return points.size() - nodes.size() + k; }
  };

  /// The boundary of the face without its rings: in place of a hole's nodes it has the hole's outermost line.
  /// Node j of that line of hole i has the index node(holes[i].first + j) there, which is negative.
  FaceBoundary inside;
  std::vector<Hole> holes;

  static int node(int number) { return -2 - number; }  ///< index of a node from its number among all holes
  static int number(int node) { return -2 - node; }    ///< the inverse of node()
};

/// Places rings around holes whose loops have no corners. A ring is at most 0.8 times as wide as the loop's
/// segments are long, and narrower where other boundaries are close. If it would be narrower than 0.45 of a
/// segment, there are fewer rings or none. \param domain enclosed by the boundary \param rings largest number
/// per hole, in rows of the final mesh. Time: O(n log n) in the boundary's points if these are spread out.
HoleRings place_rings(const FaceBoundary& boundary, const FaceSurface& surface, const TrimmedDomain& domain,
                      int rings);

}  // namespace quadrille
