#pragma once
/// Points inside a face, placed on the surface along a cross field at the wanted size. Internal.

#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/base/trimmed_domain.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/faces/face_boundary.hpp"

namespace quadrille {

struct PlacedPoints {
  std::vector<Vector2> uv;
  std::vector<Vector3> points;
};

struct PlacementOptions {
  double scale = 1;  ///< times the sizing field: 2 for Strategy::subdivide
  double refusal =
      0.72;  ///< no two points nearer than this, times the size, in the L-infinity norm of the field's frame
};

/// Places points: a queue that starts with the boundary proposes for each point its four neighbors along the
/// field, one size away on the surface; the field is carried along from the nearest boundary's tangents. The
/// distance test runs in space, so that the parametrization does not matter. Time: linear in the points
/// placed.
PlacedPoints place_points(const FaceBoundary& boundary, const FaceSurface& surface,
                          const TrimmedDomain& domain, SizingField::Sampler& size_at,
                          const PlacementOptions& options, ExecutionContext& context);

}  // namespace quadrille
