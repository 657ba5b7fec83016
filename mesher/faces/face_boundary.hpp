#pragma once
/// The boundary of one face in its parameter plane, built from the nodes on its edges. Internal.

#include <vector>

#include "geometry/base/trimmed_domain.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/edges/edge_sampling.hpp"

namespace quadrille {

/// Points are instances of nodes: a node on a seam has one for each side of the seam. All indices are into
/// the arrays here.
struct FaceBoundary {
  struct Segment {
    int a = -1, b = -1;              ///< ends, in the direction of the wire
    EdgeId edge;                     ///< CAD edge; none if degenerate
    double from = 0, to = 0;         ///< parameters of a and b on that edge
    const Coedge* coedge = nullptr;  ///< the coedge of the face that was walked; null if degenerate
    int middle_node = -1;  ///< node of the final mesh between a and b (Strategy::subdivide), else -1
    Vector2 middle_uv{0, 0};
    Vector3 middle_point{0, 0, 0};
    bool internal = false;    ///< the face lies on both sides (a crack)
    bool degenerate = false;  ///< a single point in space
  };
  std::vector<Vector2> uv;
  std::vector<Vector3> points;
  std::vector<int> nodes;  ///< indices into BoundaryNodes::points
  /// Angle (radians) between the curves at the point, on the left of the wire; 0 = not known, as at poles.
  std::vector<double> angles;
  std::vector<Segment> segments;
  /// (wires, coedges) index of the first segment of each coedge; -1 = the coedge has no segments.
  std::vector<std::vector<int>> first_segments;
  int stride = 1;  ///< segments of the final mesh for each segment here, see FacePlan

  /// Whether two segments share a node, even as different points on a seam.
  bool touch(const Segment& s, const Segment& t) const {
    return nodes[s.a] == nodes[t.a] || nodes[s.a] == nodes[t.b] || nodes[s.b] == nodes[t.a] ||
           nodes[s.b] == nodes[t.b];
  }
  int size() const { return static_cast<int>(uv.size()); }
  /// \return the index of the new point.
  int add(const Vector2& place, const Vector3& point, int node, double angle = 0) {
    uv.push_back(place);
    points.push_back(point);
    nodes.push_back(node);
    angles.push_back(angle);
    return size() - 1;
  }
};

/// Walks the wires of a face. \param cad_face the face, or a copy with other parametric
/// curves. Throws Error (failure) naming the face if its boundary is not usable or runs to infinity.
FaceBoundary face_boundary(const CadShape& shape, FaceId face, const CadFace& cad_face,
                           const FaceSurface& surface, const BoundaryNodes& nodes);

/// The same boundary with each segment cut in two at its middle node, for elements of the final size. Returns
/// a boundary with stride 1 unchanged.
FaceBoundary halved(FaceBoundary boundary);

/// Visits the number of each point's node, and of each middle node.
template <class Visit>
void for_each_node(FaceBoundary& boundary, Visit&& visit) {
  for (int& node : boundary.nodes) visit(node);
  for (FaceBoundary::Segment& segment : boundary.segments)
    if (segment.middle_node >= 0) visit(segment.middle_node);
}

/// The domain in the parameter plane that the boundary encloses.
TrimmedDomain enclosed_domain(const FaceBoundary& boundary);

}  // namespace quadrille
