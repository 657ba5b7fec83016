#pragma once
/// Replaces vertices that contradict the ends of their curves. Internal.

#include "geometry/cad/cad_shape.hpp"

namespace quadrille {

/// Corrects vertices that contradict their curves, in two cases. First: an edge begins and ends at a vertex
/// and lies within the vertex's tolerance as a whole, but its curve begins or ends elsewhere. Second: all
/// curves of a vertex end farther from it than its tolerance and than the shortest of them is long. CAD
/// translators create such vertices from edges without length, dangling edges, and vertices far from the ends
/// of their curves. The ends of the curves, joined where they nearly coincide, become the vertices: one keeps
/// the number, the others come after the model's own. Edges that then dangle leave their wires; an open wire
/// gets the edge that closes it. Each change adds a sentence to `shape.problems`. Linear in the edges for
/// each wrong vertex, quadratic in its own edges.
void trust_curve_ends(CadShape& shape);

}  // namespace quadrille
