#pragma once
/// Midpoint subdivision of a face's quads. Internal.

#include "geometry/base/execution_context.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/faces/face_triangulation.hpp"
#include "mesher/quads/improve.hpp"

namespace quadrille {

/// A quad mesh of one face with what ties it to its boundary.
struct FaceQuads {
  SurfaceMesh surface_mesh;  ///< fixed points first
  std::vector<char> pole;    ///< (n) 1 = uv is one of many
  std::vector<int> nodes;    ///< (fixed points) index into BoundaryNodes::points; those of HoleRings::inside

  /// \return the index of the new point.
  int add(const Vector3& point, const Vector2& uv, const Vector3& normal, bool fixed, bool is_pole);
};

/// Cuts those quads into two triangles whose four parts would be worse than the six parts of the triangles:
/// quads with a corner that is almost straight or more, which no smoothing mends where the boundary makes it.
/// Parts have the edges' own nodes on boundary sides. \param normals (points) unit normals of the surface.
/// \param segments as for subdivide().
void cut_flat_quads(QuadMesh& mesh, const std::vector<Vector3>& normals,
                    const std::vector<FaceBoundary::Segment>& segments, const ExecutionContext& context = {});

/// Ties triangles that make quads across a gap, from one boundary segment to another that is nearer than
/// widest_gap segments, by tags of their own: other pairs there are sheared, or bent round a boundary node.
/// Not where the parts of the quad would be poor. \param normals,
/// segments as for cut_flat_quads().
void tie_across_gaps(TriangleMesh& mesh, const std::vector<Vector3>& normals,
                     const std::vector<FaceBoundary::Segment>& segments);

/// Splits each quad into four and each triangle into three quads. New points on boundary sides are the edges'
/// own nodes, others are put on the surface. \param segments the boundary sides, which carry the nodes in
/// their middle.
FaceQuads subdivide(const FaceQuads& coarse, const std::vector<FaceBoundary::Segment>& segments,
                    const FaceSurface& surface, const ExecutionContext& context = {});

}  // namespace quadrille
