#pragma once
/// Dividing edges of a shape without changing the shape behind it. At slivers: 8 % fewer quads outside the
/// limits on real parts (decision 75). Internal.

#include <vector>

#include "geometry/cad/cad_shape.hpp"

namespace quadrille {

/// Divides an edge, in all faces that use it. Its first piece keeps its id and all pieces its number; the
/// other pieces come after all edges, and the new vertices after all vertices. \param parameters where to
/// divide, ascending, inside the edge. \return the new vertices, one for each parameter; a closed edge
/// without vertices gets one more, where it begins.
std::vector<VertexId> divide_edge(CadShape& shape, EdgeId edge, const std::vector<double>& parameters);

}  // namespace quadrille
