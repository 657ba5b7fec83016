#pragma once
/// Planes in which a CAD model is its own mirror image. Internal.

#include <string>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/base/vector.hpp"
#include "geometry/cad/cad_shape.hpp"

namespace quadrille {

/// One plane, and what lies where in its mirror. Indices from 0.
struct MirrorPlane {
  Vector3 normal{1, 0, 0};    ///< of unit length
  double offset = 0;          ///< from the origin along the normal
  std::vector<int> faces;     ///< (faces) the image of each
  std::vector<char> turned;   ///< (faces) 1 = the image's outer side is not the mirror image of the face's
  std::vector<int> edges;     ///< (edges) the image of each; -1 = none: a seam's place is arbitrary
  std::vector<int> vertices;  ///< (vertices) the same; -1 = none: one on a closed edge alone

  double distance(const Vector3& point) const { return normal.dot(point) - offset; }  ///< signed
  Vector3 mirrored(const Vector3& point) const { return point - 2 * distance(point) * normal; }

  /// "x = 12.5", or "normal (0.6, 0.8, 0), through (1, 2, 3)".
  std::string name() const;
};

/// Up to three planes at right angles to each other in which all faces, edges and vertices but those of seams
/// have mirror images in the model, within 1e-7 of its diagonal or its own tolerances. Tried are the planes
/// through the middle of all edges along their principal axes, and where those are not unique, along the
/// coordinate axes and between edges of one length. Time: that of sampling edges and faces, for each plane.
std::vector<MirrorPlane> mirror_planes(const CadShape& shape, const ExecutionContext& context);

}  // namespace quadrille
