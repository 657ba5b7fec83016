/// Chains of straight edges between two joined faces become one edge, except where somebody names them.

#include "mesher/edges/facet_edges.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/surfaces/edge_curve.hpp"
#include "tests/support/sheet.hpp"

namespace quadrille {
namespace {

/// Two faces with an arc of edges between them, each of which turns by this angle against the one before.
CadModel wavy_sheet(int count, double degrees) {
  std::vector<std::array<double, 2>> line{{0, 0}};
  const double turn = degrees * std::numbers::pi / 180;
  for (int i = 0; i < count; ++i) {
    const double angle = (0.5 * (count - 1) - i) * turn;
    line.push_back({line.back()[0] + 3 * std::cos(angle), line.back()[1] + 3 * std::sin(angle)});
  }
  const double end = line.back()[0];
  testing::Polygon below = line, above{{0, 50}};
  below.push_back({end, -50});
  below.push_back({0, -50});
  above.insert(above.end(), line.begin(), line.end());
  above.push_back({end, 50});
  return testing::sheet({below, above});
}

/// What joining leaves of such a sheet.
struct Joined {
  CadModel model;
  CadShape shape = model.shape();
  SimplifiedModel simplified{model};

  Joined(const CadModel& source, const SizingOptions& sizing, char flag = 1) : model(source) {
    join_edges_of_facets(shape, FaceFlags(shape.faces.size(), flag), sizing, simplified);
  }
  /// The edges that both faces still use.
  std::vector<CadEdge> between() const {
    std::vector<CadEdge> result;
    std::copy_if(shape.edges.begin(), shape.edges.end(), std::back_inserter(result),
                 [](const CadEdge& edge) { return edge.faces.size() == 2; });
    return result;
  }
};

TEST(FacetEdges, OfASmoothChainAreOnePolyline) {
  const CadModel model = wavy_sheet(7, 8);
  const Joined joined(model, {});
  ASSERT_EQ(joined.between().size(), 1U);
  EXPECT_EQ(joined.simplified.inner.size(), 6U);
  const CadEdge whole = joined.between().front();
  EXPECT_NEAR(whole.length, 21, 1e-9);
  const EdgeCurve curve(whole);
  int passed = 0;
  for (const CadEdge& edge : model.shape().edges) {
    if (edge.faces.size() != 2) continue;
    for (const VertexId vertex : {edge.first_vertex, edge.last_vertex}) {
      for (int k = 0; k <= 7; ++k)
        passed += (curve.point(whole.first + 3 * k) - model.shape().vertices[vertex]).norm() < 1e-9;
    }
  }
  EXPECT_EQ(passed, 14) << "both ends of all seven edges";
  for (const CadFace& face : joined.shape.faces) {
    const std::vector<Coedge>& coedges = face.wires[0].coedges;
    ASSERT_EQ(coedges.size(), 4U);
    const auto end_of = [&](const Coedge& coedge, bool last) {
      const CadEdge& edge = joined.shape.edges[coedge.edge];
      return parametric_point(coedge, coedge.forward == last ? edge.last : edge.first);
    };
    for (int i = 0; i < 4; ++i)  // each begins where the one before it ends
      EXPECT_LT((end_of(coedges[i], false) - end_of(coedges[(i + 3) % 4], true)).norm(), 1e-6);
  }
}

TEST(FacetEdges, StayWhereTheyTurnOrAreNamedOrNothingWasJoined) {
  const CadModel sharp = wavy_sheet(4, 20), smooth = wavy_sheet(7, 8);
  EXPECT_EQ(Joined(sharp, {}).between().size(), 4U);
  EXPECT_EQ(Joined(smooth, {}, 0).between().size(), 7U);
  const auto middle = [&](const CadEdge& edge) {
    return edge.faces.size() == 2 &&
           std::abs(smooth.shape().vertices[edge.first_vertex].x() +
                    smooth.shape().vertices[edge.last_vertex].x() - 2 * 0.5 * smooth.box_max().x()) < 1e-6;
  };
  const auto& edges = smooth.shape().edges;
  const auto named = std::find_if(edges.begin(), edges.end(), middle);
  ASSERT_NE(named, edges.end());
  SizingOptions sizing;
  sizing.kept_edges = {named->number};
  EXPECT_EQ(Joined(smooth, sizing).between().size(), 3U);  // three edges on both sides are joined
  sizing.kept_edges.clear();
  sizing.vertex_sizes[named->first_vertex.number()] = 1;
  EXPECT_EQ(Joined(smooth, sizing).between().size(), 2U);
}

}  // namespace
}  // namespace quadrille
