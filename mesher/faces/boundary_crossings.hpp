#pragma once
/// Finds where the boundary of a face crosses itself in the parameter plane, and why. Internal.

#include <optional>

#include "geometry/cad/cad_shape.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/faces/face_boundary.hpp"
#include "mesher/faces/face_problem.hpp"

namespace quadrille {

/// Why the boundary crosses itself, found from the curves between the nodes of the crossing segments.
/// \return nothing if the boundary does not cross itself.
std::optional<FaceProblem> crossing_problem(FaceId face, const CadShape& shape, const FaceBoundary& boundary,
                                            const FaceSurface& surface);

/// Where a boundary that does not cross itself has gaps narrower than its curves bulge from their segments,
/// as between holes that nearly touch. Nodes in the middle of these segments have no room then, however
/// triangles join the segments. The problem's stretches hold numbers of segments that suffice.
/// \return nothing if there are no such gaps, if finer segments do not help, or if all nodes are ends of
/// segments (Strategy::direct).
std::optional<FaceProblem> crowding_problem(FaceId face, const FaceBoundary& boundary,
                                            const FaceSurface& surface);

/// The largest distance between a boundary node and the surface point at its parameters, over the length of a
/// segment at the node.
double largest_stray(const FaceBoundary& boundary, const FaceSurface& surface);

}  // namespace quadrille
