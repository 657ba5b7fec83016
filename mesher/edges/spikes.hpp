#pragma once
/// Narrow corners of faces, which are left out of the mesh: an eighth fewer quads outside the limits on real
/// parts (decision 67). Internal.

#include <set>
#include <utility>
#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/edges/slivers.hpp"

namespace quadrille {

/// Ends of edges; true = the last vertex.
using EdgeEnds = std::set<std::pair<EdgeId, bool>>;

/// The spikes of a face: parts between two edges that meet, of one wire or of two that touch, as long as
/// these stay closer than `width`, over more than 2.5 times their distance. Cusps, and ends of fillets that
/// run out. Edges shorter than the width are passed over, and corners between edges of this face alone.
/// \param used 1 = the face is meshed \param width model units; 0 = none is found \param taken ends of edges
/// at spikes of other faces, which none of this one has; those found are added \param cuts gets the places
/// that have to be divided first, so that a spike lies between two whole edges
std::vector<Sliver> find_spikes(const CadShape& shape, const FaceFlags& used, FaceId face, double width,
                                EdgeEnds& taken, std::vector<EdgeCut>& cuts);

}  // namespace quadrille
