#pragma once
/// Places points inside a face, on the surface, along a cross field at the wanted size. Internal.

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
  double scale = 1;       ///< factor on the sizing field: 2 for Strategy::subdivide
  double refusal = 0.72;  ///< least distance over size, in the L-infinity norm of the cross field's frame
};

/// Places points with a queue that starts with the boundary. Each point proposes four neighbors along the
/// cross field, one size away on the surface. The field starts with the boundary's tangents and is carried
/// from point to point. Distances are tested in space, so the parametrization does not matter. Time: linear
/// in the points.
PlacedPoints place_points(const FaceBoundary& boundary, const FaceSurface& surface,
                          const TrimmedDomain& domain, SizingField::Sampler& size_at,
                          const PlacementOptions& options, ExecutionContext& context);

}  // namespace quadrille
