#pragma once
/// Planes in which a CAD model is its own mirror image. Internal.

#include <string>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/base/vector.hpp"
#include "geometry/cad/cad_shape.hpp"

namespace quadrille {

/// One plane, and the mirror image of each face, edge and vertex.
struct MirrorPlane {
  Vector3 normal{1, 0, 0};         ///< of unit length
  double offset = 0;               ///< from the origin along the normal
  IdVector<FaceId, FaceId> faces;  ///< the image of each
  FaceFlags turned;                ///< 1 = the image's outer side is not the mirror image of the face's
  IdVector<EdgeId, EdgeId> edges;  ///< the image of each, or none, since a seam's place is arbitrary
  IdVector<VertexId, VertexId> vertices;  ///< the same; none for those on closed edges or seams only

  double distance(const Vector3& point) const { return normal.dot(point) - offset; }  ///< signed distance
  Vector3 mirrored(const Vector3& point) const { return point - 2 * distance(point) * normal; }

  /// "x = 12.5", or "normal (0.6, 0.8, 0), through (1, 2, 3)".
  std::string name() const;
};

/// Up to three planes at right angles to each other in which all faces, edges and vertices except those of
/// seams have mirror images in the model, within 1e-7 of its diagonal or the model's own tolerances. The
/// candidates pass through the centroid of all edges. Their normals are the principal axes of the edges and,
/// where these are not unique, also the coordinate axes and directions derived from edges of equal length.
/// Time: that of sampling edges and faces, for each candidate.
std::vector<MirrorPlane> mirror_planes(const CadShape& shape, const ExecutionContext& context);

}  // namespace quadrille
