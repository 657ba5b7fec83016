#pragma once
/// Vertices that stand for more than a point, replaced by what their curves say. Internal.

#include "geometry/cad/cad_shape.hpp"

namespace quadrille {

/// Where an edge that begins and ends at one vertex lies within that vertex's tolerance as a whole, and its
/// curve begins or ends elsewhere, or where all curves of a vertex end farther from it than its tolerance and
/// the shortest of them, the file's topology says less than its geometry: translators make such
/// vertices of edges without length, of dangling ones, and of vertices far from their curve's ends. There the
/// ends of the curves, joined where they meet within the edges' own tolerance, become vertices: one of them
/// keeps the number, others come after the model's own. Edges that then dangle leave their wires, and wires
/// that then are open get the edge between. Each is a sentence in `shape.problems`. Linear in the edges, and
/// in the edges at such a vertex squared.
void trust_curve_ends(CadShape& shape);

}  // namespace quadrille
