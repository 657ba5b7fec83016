#pragma once
/// Rings of quads round the holes of a face. Internal.

#include <vector>

#include "geometry/base/trimmed_domain.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/faces/face_boundary.hpp"

namespace quadrille {

/// A face with rings set aside round its holes.
struct HoleRings {
  struct Node {
    Vector2 uv{0, 0};
    Vector3 point{0, 0, 0};
  };
  struct Hole {
    int first = 0;                         ///< number of the first of its nodes among those of all holes
    std::vector<int> nodes;                ///< (n) of the loop in the final mesh, in BoundaryNodes::points
    std::vector<std::vector<Node>> lines;  ///< (rings + 1, n) the loop, then the lines round it, outward
  };

  /// The face without its rings: the loop of each hole is the outermost of its lines. Node j of hole i there
  /// has the number node(holes[i].first + j), which is negative.
  FaceBoundary inside;
  std::vector<Hole> holes;

  static int node(int number) { return -2 - number; }
  static int number(int node) { return -2 - node; }
};

/// Places rings round holes whose loops have no corners. They are about as wide as the loop's segments are
/// long, narrower where other boundaries leave no more room, and fewer or none where they would be less than
/// half of that. \param domain that the boundary encloses. \param rings at most so many, counted in the final
/// mesh. Time: n log n in the boundary's points where they are spread out.
HoleRings place_rings(const FaceBoundary& boundary, const FaceSurface& surface, const TrimmedDomain& domain,
                      int rings);

}  // namespace quadrille
