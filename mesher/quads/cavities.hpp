#pragma once
/// Large patches of quads filled anew with few irregular nodes; not part of the public interface.

#include "mesher/quads/improve.hpp"

namespace quadrille {

/// Grows patches round irregular nodes, each time by the nearest one outside, until a patch has two to six
/// corners and fewer irregular nodes would do for these (polygon_filling.hpp); where that fails, by those
/// that bring it nearer to four corners. It is filled anew then, if that brings its quads nearer to the
/// criteria of industry in the mean, or takes them away by little for each irregular node that is saved. What
/// lies round it stays: each node of its outline keeps its quads, but those of the boundary that have all of
/// theirs inside, which get as many as their angle asks for.
///
/// Time: linear in the irregular nodes; a patch has at most 150 quads. Based on: Verma & Tautges, Jaal:
/// engineering a high quality all-quadrilateral mesh generator (2011), for convex patches round irregular
/// nodes.
///
/// \return how many patches were filled anew.
int remesh_cavities(SurfaceMesh& mesh, const SmoothingSurface& surface, const ExecutionContext& context);

}  // namespace quadrille
