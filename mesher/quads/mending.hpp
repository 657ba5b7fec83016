#pragma once
/// Quads outside the limits of industry are mended by other quads in their place; not part of the public
/// interface.

#include <vector>

#include "mesher/quads/improve.hpp"

namespace quadrille {

/// Quads above this objective lie outside the criteria of industry; at `folded_objective` they are not
/// convex.
constexpr double outside_objective = 1, folded_objective = 999;

/// Fills small patches round poor quads anew, where the quads there, and those next to them, then come nearer
/// to the criteria of industry once their nodes have moved (measure_objective()). For meshes whose nodes lie
/// well already: what is gained is gained by other connections.
///
/// \param poor quads of a larger objective are mended
/// \param changed out: (points) 1 = of quads that changed or moved
/// \return the number of patches that were filled anew. Time: some 120 us for each poor quad.
int mend_quads(SurfaceMesh& mesh, const SmoothingSurface& surface, double poor, std::vector<char>& changed,
               const ExecutionContext& context);

}  // namespace quadrille
