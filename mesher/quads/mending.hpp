#pragma once
/// Replaces quads outside the industry limits by other quads; not part of the public interface.

#include <vector>

#include "mesher/quads/improve.hpp"

namespace quadrille {

/// Quads above `outside_objective` lie outside the industry criteria; those above `folded_objective` are not
/// convex.
constexpr double outside_objective = 1, folded_objective = 999;

/// Refills small patches around poor quads where that brings the quads there, and those next to them, nearer
/// to the industry criteria once their nodes have moved (measure_objective()). For meshes whose nodes are
/// well placed already, so that the gain comes from new connections.
///
/// \param poor quads with a larger objective are mended
/// \param changed out: (points) 1 = the point belongs to a new quad or to one next to a refilled patch
/// \return the number of refilled patches. Time: about 120 us for each poor quad.
int mend_quads(SurfaceMesh& mesh, const MeshSurface& surface, double poor, std::vector<char>& changed,
               const ExecutionContext& context);

}  // namespace quadrille
