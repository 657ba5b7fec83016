#pragma once
/// Midpoint subdivision of a face's quads. Internal.

#include "geometry/base/execution_context.hpp"
#include "geometry/surfaces/mesh_surface.hpp"
#include "mesher/faces/face_triangulation.hpp"
#include "mesher/quads/improve.hpp"

namespace quadrille {

/// A quad mesh of one face, tied to the nodes of its boundary.
struct FaceQuads {
  SurfaceMesh surface_mesh;  ///< fixed points first
  std::vector<char> pole;    ///< (n) 1 = a pole of the surface: uv is one of many
  std::vector<int> nodes;    ///< (fixed points) index into BoundaryNodes::points, or a HoleRings::node()

  /// \return the index of the new point.
  int add(const SurfacePlace& place, bool fixed, bool is_pole);
};

/// Largest width of a gap that a single row of quads spans, in lengths of the segments on its sides.
constexpr double widest_gap = 0.7;

/// Gives two triangles that make a quad across a gap a tag of their own, so that they are paired. The gap
/// lies between two boundary segments that are nearer to each other than widest_gap segments. Other pairs
/// there would be sheared, or bent around a boundary node. Quads whose parts would be poor are left out.
/// \param normals (points) unit normals of the surface. \param segments as for subdivide().
void tie_across_gaps(TriangleMesh& mesh, const std::vector<Vector3>& normals,
                     const std::vector<FaceBoundary::Segment>& segments);

/// Splits each quad into four and each triangle into three quads. New points on boundary sides are the edges'
/// own nodes; the others are put on the surface. \param segments the boundary sides and their middle nodes.
FaceQuads subdivide(const FaceQuads& coarse, const std::vector<FaceBoundary::Segment>& segments,
                    const MeshSurface& surface, const ExecutionContext& context = {});

}  // namespace quadrille
