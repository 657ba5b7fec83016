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
/// \param poor quads with a larger objective are to be replaced
/// \param least_turn_cosine the normals at two corners of a new quad differ by no more than this, or than
/// those of the quads before; -1 = by any angle \param changed out: (points) 1 = the point belongs to a new
/// quad or to one next to a refilled patch \return the number of refilled patches. Time: about 120 us for
/// each poor quad.
int mend_quads(SurfaceMesh& mesh, const MeshSurface& surface, double poor, double least_turn_cosine,
               std::vector<char>& changed, const ExecutionContext& context);

/// The least dot product of the normals at two corners of a quad.
double turn_cosine(const std::array<int, 4>& quad, const std::vector<Vector3>& normals);

}  // namespace quadrille
