#pragma once
/// Where the boundary of a face crosses itself in the parameter plane, and why. Internal.

#include <optional>
#include <utility>
#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/faces/face_boundary.hpp"
#include "mesher/faces/face_problem.hpp"

namespace quadrille {

/// The pairs (i < j, ascending) of segments that meet anywhere but at common ends; segments that lie on each
/// other from end to end are the two sides of a slit, and no crossing. Exact. Time: n log n and the pairs,
/// for boundaries that are not all in one place.
std::vector<std::pair<int, int>> crossing_segments(const FaceBoundary& boundary);

/// Why the boundary crosses itself: what follows from looking at the curves between the nodes of the pairs.
/// \param face CAD face, from 1. \return nothing if the boundary is a simple one.
std::optional<FaceProblem> crossing_problem(int face, const CadShape& shape, const FaceBoundary& boundary,
                                            const FaceSurface& surface);

/// Where curves of a boundary that does not cross itself come nearer to each other than they leave their
/// segments, as rims of holes that nearly touch do: nodes in their middle have no room then, however the
/// segments are joined by triangles. With the segments that would do. \return nothing where there is no such
/// place, finer segments do not help, or all nodes are ends of segments (Strategy::direct).
std::optional<FaceProblem> crowding_problem(int face, const FaceBoundary& boundary,
                                            const FaceSurface& surface);

/// How far, at most, a node of the boundary is from where the surface has it, over the length of the segments
/// there.
double largest_stray(const FaceBoundary& boundary, const FaceSurface& surface);

}  // namespace quadrille
