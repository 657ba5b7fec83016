#pragma once
/// The boundary of one face in its parameter plane, made of the nodes on its edges. Internal.

#include <vector>

#include "geometry/base/trimmed_domain.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/edges/edge_sampling.hpp"

namespace quadrille {

/// Points are instances: a node on a seam has one for each side of it. All indices are into the arrays here.
struct FaceBoundary {
  struct Segment {
    int a = -1, b = -1;              ///< in the direction of the wire
    int edge = 0;                    ///< CAD edge, from 1; 0 on a degenerate one
    double from = 0, to = 0;         ///< parameters of a and b on that edge
    const Coedge* coedge = nullptr;  ///< of the face that was walked; null on a degenerate one
    int middle_node = -1;  ///< node of the final mesh between a and b (Strategy::subdivide), else -1
    Vector2 middle_uv{0, 0};
    Vector3 middle_point{0, 0, 0};
    bool internal = false;    ///< the face lies on both sides (a crack)
    bool degenerate = false;  ///< a single point in space
  };
  std::vector<Vector2> uv;
  std::vector<Vector3> points;
  std::vector<int> nodes;  ///< index into BoundaryNodes::points
  /// Angle (radians) to the left of the wire between the tangents of its curves; 0 = not known (poles).
  std::vector<double> angles;
  std::vector<Segment> segments;
  /// (wires, coedges) the first of the segments of each coedge; -1 = it has none.
  std::vector<std::vector<int>> first_segments;
  /// Segments of the final mesh to one here: 2 for faces that are subdivided, but 1 where an edge has an odd
  /// number.
  int stride = 1;

  /// Whether two segments have a node in common, on a seam too.
  bool touch(const Segment& s, const Segment& t) const {
    return nodes[s.a] == nodes[t.a] || nodes[s.a] == nodes[t.b] || nodes[s.b] == nodes[t.a] ||
           nodes[s.b] == nodes[t.b];
  }
  int size() const { return static_cast<int>(uv.size()); }
};

/// Walks the wires of a face of the shape, or of one that stands for it with other parametric curves.
/// Throws Error (failure) naming the face when a wire has no usable parametric curve.
FaceBoundary face_boundary(const CadShape& shape, int face, const CadFace& cad_face,
                           const FaceSurface& surface, const BoundaryNodes& nodes);

inline FaceBoundary face_boundary(const CadShape& shape, int face, const FaceSurface& surface,
                                  const BoundaryNodes& nodes) {
  return face_boundary(shape, face, shape.faces[face], surface, nodes);
}

/// The same boundary with two segments for each one: for elements of the final size. Those of a stride of 1
/// it leaves as they are.
FaceBoundary halved(FaceBoundary boundary);

/// The domain in the parameter plane that the boundary encloses.
TrimmedDomain enclosed_domain(const FaceBoundary& boundary);

}  // namespace quadrille
