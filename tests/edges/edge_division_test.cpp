/// The pieces of an edge cover it, and wires stay closed.

#include "mesher/edges/edge_division.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "tests/support/sheet.hpp"

namespace quadrille {
namespace {

/// The vertices where a coedge begins and ends, as the wire runs.
std::array<VertexId, 2> ends(const CadShape& shape, const Coedge& coedge) {
  const CadEdge& edge = shape.edges[coedge.edge];
  if (coedge.forward) return {edge.first_vertex, edge.last_vertex};
  return {edge.last_vertex, edge.first_vertex};
}

TEST(EdgeDivision, KeepsLengthsAndClosedWires) {
  CadShape shape =
      testing::sheet({{{0, 0}, {10, 0}, {10, 6}, {0, 6}}, {{0, 6}, {10, 6}, {10, 9}, {0, 9}}}).shape();
  for (const EdgeId id : shape.edges.ids()) {
    if (shape.edges[id].faces.size() != 2) continue;
    const CadEdge whole = shape.edges[id];
    const std::size_t edges = shape.edges.size(), vertices = shape.vertices.size();
    const double span = whole.last - whole.first;
    const auto added = divide_edge(shape, id, {whole.first + 0.25 * span, whole.first + 0.5 * span});
    ASSERT_EQ(added.size(), 2U);
    EXPECT_EQ(shape.edges.size(), edges + 2);
    EXPECT_EQ(shape.vertices.size(), vertices + 2);
    EXPECT_EQ(shape.vertex_tolerances.size(), vertices + 2);
    EXPECT_NEAR((shape.vertices[added[1]] - Vector3(5, 6, 0)).norm(), 0, 1e-9);
    EXPECT_NEAR(shape.edges[id].length, 2.5, 1e-9);
    double length = shape.edges[id].length;
    for (std::size_t i = edges; i < shape.edges.size(); ++i) {
      const CadEdge& piece = shape.edges[EdgeId::from_index(static_cast<int>(i))];
      EXPECT_EQ(piece.number, whole.number);
      length += piece.length;
    }
    EXPECT_NEAR(length, whole.length, 1e-9);
    break;
  }
  for (const CadFace& face : shape.faces) {
    const auto& coedges = face.wires.at(0).coedges;
    EXPECT_EQ(coedges.size(), 6U);
    for (std::size_t i = 0; i < coedges.size(); ++i)
      EXPECT_EQ(ends(shape, coedges[i])[1], ends(shape, coedges[(i + 1) % coedges.size()])[0]);
  }
}

}  // namespace
}  // namespace quadrille
