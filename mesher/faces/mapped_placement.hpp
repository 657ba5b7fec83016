#pragma once
/// Points of four-sided faces by transfinite interpolation. Internal.

#include <optional>

#include "geometry/base/execution_context.hpp"
#include "geometry/base/trimmed_domain.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/faces/face_boundary.hpp"
#include "mesher/faces/point_placement.hpp"

namespace quadrille {

/// The inner points of a regular grid over a face whose boundary is one loop with four corners and as many
/// segments on opposite sides; nothing where the face is not such, where the grid would fold or leave the
/// face, or where it would miss the sizing field. Time: linear in the points. \param scale times the sizing
/// field: 2 for Strategy::subdivide.
std::optional<PlacedPoints> place_mapped(const FaceBoundary& boundary, const FaceSurface& surface,
                                         const TrimmedDomain& domain, SizingField::Sampler& size_at,
                                         double scale, const ExecutionContext& context = {});

}  // namespace quadrille
