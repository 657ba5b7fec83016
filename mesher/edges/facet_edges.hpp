#pragma once
/// Edges between faces that were joined from facets, as one edge each. Internal.

#include "geometry/cad/cad_shape.hpp"
#include "geometry/sizing/sizing_options.hpp"
#include "mesher/edges/simplified_model.hpp"

namespace quadrille {

/// The cosine of 15 degrees: facets of a curved surface turn by less from one to the next, and so do their
/// edges.
constexpr double facet_cosine = 0.9659258262890683;

/// Makes one edge of each chain of straight edges between the same two plane faces, one of them joined from
/// facets, that turns by little at its vertices, which belong to no other edge: a polyline through them. It
/// has the number of its first edge; the others belong to no face and are listed as edges inside. Edges and
/// vertices that the sizes name stay. \param joined 1 = joined from facets. O(n log n) in edges.
void join_edges_of_facets(CadShape& shape, const FaceFlags& joined, const SizingOptions& sizing,
                          SimplifiedModel& model);

}  // namespace quadrille
