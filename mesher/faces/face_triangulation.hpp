#pragma once
/// Triangles over a face's boundary and placed points. Internal.

#include <array>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/faces/face_boundary.hpp"
#include "mesher/faces/point_placement.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// The triangulation of one face. Boundary points come first (`boundary_count` of them).
struct FaceTriangulation {
  TriangleMesh mesh;             ///< counter-clockwise in the parameter plane
  std::vector<Vector2> uv;       ///< (n)
  std::vector<Vector3> normals;  ///< (n) unit, du x dv
  std::vector<char> pole;        ///< (n) 1 = singular point of the parametrization, its uv is one of many
  std::vector<int> nodes;        ///< (boundary_count) index into BoundaryNodes::points
  std::vector<double>
      angles;  ///< (boundary_count) as in FaceBoundary, the face's side of the curves; 0 = not known
  std::vector<FaceBoundary::Segment> segments;  ///< those with a length, a and b renumbered
  int boundary_count = 0;
};

/// Triangulates in the parameter plane scaled by the mean metric (constrained Delaunay, in bulk), then flips
/// sides in space to the Delaunay criterion. Along cracks each side of the face has points of its own. Placed
/// points on boundary segments are left out. Throws FaceProblem when boundary segments cross or meet where
/// they should not, which crossing_problem() tells before.
FaceTriangulation triangulate_face(int face, FaceBoundary boundary, PlacedPoints placed,
                                   const FaceSurface& surface, const ExecutionContext& context = {});

}  // namespace quadrille
