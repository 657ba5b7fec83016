#pragma once
/// How wide a face is between opposite parts of its boundary. Internal.

#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/base/vector.hpp"
#include "geometry/cad/cad_shape.hpp"

namespace quadrille {

/// Two places of a face's boundary that face each other.
struct FaceGap {
  Vector3 from, to;
  double angle = 0;  ///< between the two parts of the boundary, radians
  double width() const { return (to - from).norm(); }
};

/// The gaps at places along a face's boundary, which are straight distances across the face to a part of the
/// boundary that faces back. Corners are not gaps: only parts that face each other within 40 degrees count. A
/// wedge with a smaller angle counts too. Neighboring places on a curve are no farther apart than half the
/// gap width. Time: the number of places times that of the boundary pieces near each. \param widest wider
/// gaps are ignored. \param narrowest narrower gaps are all alike.
std::vector<FaceGap> face_gaps(const CadShape& shape, FaceId face, double widest, double narrowest,
                               const ExecutionContext& context);

}  // namespace quadrille
