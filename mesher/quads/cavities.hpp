#pragma once
/// Refills large patches of quads with fewer irregular nodes; not part of the public interface.

#include "mesher/quads/improve.hpp"

namespace quadrille {

/// Grows patches around irregular nodes. A patch takes in the nearest irregular node outside, again and
/// again, until it has two to six corners and a filling with fewer irregular nodes exists for these
/// (polygon_filling.hpp). Where that fails, a second attempt takes in only nodes that bring the patch nearer
/// to four corners. The patch is refilled if its quads then lie nearer to the industry criteria on average,
/// or only a little farther away for each irregular node saved. The mesh around the patch stays: each node of
/// the outline keeps its number of quads. Only boundary nodes whose quads are all inside the patch get as
/// many quads as their angle requires.
///
/// Time: linear in the irregular nodes; a patch has at most 150 quads. Based on: Verma & Tautges, Jaal:
/// engineering a high quality all-quadrilateral mesh generator (2011), for convex patches around irregular
/// nodes.
///
/// \return the number of refilled patches.
int remesh_cavities(SurfaceMesh& mesh, const MeshSurface& surface, const ExecutionContext& context);

}  // namespace quadrille
