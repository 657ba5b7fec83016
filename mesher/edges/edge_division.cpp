/// Replaces an edge by pieces with the same curve, and its uses in wires by uses of the pieces.

#include "mesher/edges/edge_division.hpp"

#include <GCPnts_AbscissaPoint.hxx>

#include <algorithm>

#include "geometry/surfaces/edge_curve.hpp"

namespace quadrille {

namespace {

void measure(CadEdge& edge) {
  edge.length = GCPnts_AbscissaPoint::Length(BRepAdaptor_Curve(edge.edge), edge.first, edge.last);
}

VertexId add_vertex(CadShape& shape, const CadEdge& edge, double parameter) {
  shape.vertex_tolerances.push_back(edge.tolerance);
  return shape.vertices.push_back(EdgeCurve(edge).point(parameter));
}

void replace(CadWire& wire, EdgeId id, const std::vector<EdgeId>& pieces) {
  for (std::size_t i = 0; i < wire.coedges.size(); ++i) {
    if (wire.coedges[i].edge != id) continue;
    std::vector<Coedge> parts(pieces.size(), wire.coedges[i]);
    for (std::size_t k = 0; k < pieces.size(); ++k) parts[k].edge = pieces[k];
    if (!parts.front().forward) std::ranges::reverse(parts);
    wire.coedges.erase(wire.coedges.begin() + static_cast<long>(i));
    wire.coedges.insert(wire.coedges.begin() + static_cast<long>(i), parts.begin(), parts.end());
    i += pieces.size() - 1;
  }
}

}  // namespace

std::vector<VertexId> divide_edge(CadShape& shape, EdgeId id, const std::vector<double>& parameters) {
  CadEdge& whole = shape.edges[id];
  if (!whole.first_vertex.exists() && !whole.last_vertex.exists())
    whole.first_vertex = whole.last_vertex = add_vertex(shape, whole, whole.first);
  std::vector<VertexId> vertices;
  std::vector<EdgeId> pieces{id};
  for (const double parameter : parameters) {
    CadEdge rest = shape.edges[pieces.back()];
    vertices.push_back(add_vertex(shape, rest, parameter));
    CadEdge& before = shape.edges[pieces.back()];
    before.last = rest.first = parameter;
    before.last_vertex = rest.first_vertex = vertices.back();
    measure(before);
    measure(rest);
    pieces.push_back(shape.edges.push_back(rest));
  }
  for (CadFace& face : shape.faces) {
    for (CadWire& wire : face.wires) replace(wire, id, pieces);
  }
  return vertices;
}

}  // namespace quadrille
