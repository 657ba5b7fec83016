#pragma once
/// Repairs inverted quads by moving their nodes off the surface. Not part of the public interface.

#include <vector>

#include "geometry/base/execution_context.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// Moves the free nodes of inverted quads in space, where no place on the surface makes them valid: to the
/// mean of their neighbors, to where a quad becomes a parallelogram, then by a compass search, always to the
/// place where the worst quad around the node is best.
/// \param fixed (n) 1 = stays where it is
/// \param reach the largest distance that a node moves
/// \return (n) 1 = was moved. Quads may stay inverted if too many of their nodes are fixed. Linear in the
/// mesh for each of at most 20 rounds.
std::vector<char> unfold_in_space(QuadMesh& mesh, const std::vector<char>& fixed, double reach,
                                  const ExecutionContext& context);

}  // namespace quadrille
