#pragma once
/// Shapes with vertices that cannot be trusted: their tolerance holds a whole edge, as translators make them
/// of bad topology, or they lie far from where their edges end.

#include <TopoDS_Shape.hxx>

namespace quadrille {

/// A square of 12 bounded by one closed curve that begins at one corner; its vertex is at the opposite one.
TopoDS_Shape square_with_far_vertex();

/// A square of 12, one of whose vertices lies two million kilometers away.
TopoDS_Shape square_with_thrown_vertex();

/// A square of 12 with a fifth edge, 1 long, that begins and ends at the same vertex.
TopoDS_Shape square_with_collapsed_edge();

/// A tetrahedron with three edges of 12 at right angles. One of these was cut in two at 1 from the corner;
/// the short piece begins and ends at one vertex, and one of the two faces there has lost it.
TopoDS_Shape tetrahedron_with_collapsed_piece();

}  // namespace quadrille
