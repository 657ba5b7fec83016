#pragma once
/// Rings of quads round holes. Internal.

#include <utility>
#include <vector>

#include "geometry/base/trimmed_domain.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/faces/face_boundary.hpp"

namespace quadrille {

/// Rings round the holes of a face. The nodes of each ring face those of the hole's loop one to one.
struct HoleRings {
  /// The face without its rings: where a hole has some, the points of its loop are those of the outermost
  /// ring, and their nodes are -1 - (the point's index).
  FaceBoundary inside;
  bool any = false;  ///< whether a hole has a ring
  /// The rings between a hole's loop and the outermost one, from the hole outward: (parameters, point) by the
  /// index of the loop's point; empty where a hole has one ring or none.
  std::vector<std::vector<std::pair<Vector2, Vector3>>> between;

  static int point_of(int node) { return -1 - node; }
};

/// Places rings round holes whose loops have no corners, as far as there is room between them and other
/// boundaries. \param rings how many of the mesh that is recombined, at most
HoleRings place_rings(const FaceBoundary& boundary, const FaceSurface& surface, const TrimmedDomain& domain,
                      int rings);

}  // namespace quadrille
