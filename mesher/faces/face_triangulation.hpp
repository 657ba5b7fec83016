#pragma once
/// Triangulates the boundary points and placed points of a face. Internal.

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
  std::vector<Vector3> normals;  ///< (n) unit vectors along du x dv
  std::vector<char> pole;      ///< (n) 1 = singular point of the parametrization, uv is one of several places
  std::vector<int> nodes;      ///< (boundary_count) indices into BoundaryNodes::points
  std::vector<double> angles;  ///< (boundary_count) between curves, on the face's side; 0 = not known
  std::vector<FaceBoundary::Segment> segments;  ///< without degenerate ones; a and b renumbered
  int boundary_count = 0;
};

/// Triangulates in the parameter plane scaled by the mean metric (constrained Delaunay, in bulk), then flips
/// sides by the Delaunay criterion in space. Along cracks, each side of the crack has its own points. Placed
/// points on boundary segments are left out. Throws FaceProblem if there are no
/// triangles, or if boundary segments cross or meet where they should not, which crossing_problem() finds
/// beforehand.
FaceTriangulation triangulate_face(FaceId face, FaceBoundary boundary, PlacedPoints placed,
                                   const FaceSurface& surface, const ExecutionContext& context = {});

/// Neighbors across the sides of triangles. Entry 3 t + k belongs to the side of triangle t from corner k to
/// corner k + 1: it is the same side as seen from the other triangle, 3 t' + k', or -1 if there is none.
/// \param triangles at most two at each side \param points number of points. Time: linear, but sorts the
/// sides at each point.
std::vector<int> triangle_neighbors(const std::vector<std::array<int, 3>>& triangles, int points,
                                    const ExecutionContext& context);

/// Flips sides until they satisfy the Delaunay criterion in space. Based on: Lawson (1977).
/// \param across neighbors in the form of triangle_neighbors(). They must stem from the triangles before the
/// points of each pole were merged, since merging may leave two sides between the same two points.
void flip_in_space(FaceTriangulation& face, std::vector<int> across, const ExecutionContext& context);

}  // namespace quadrille
