/// Where rows end: on the next edge, freely, or nowhere, by the angle of the face and what the edge carries.

#include "mesher/edges/row_lines.hpp"

#include <gtest/gtest.h>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <gp_Pln.hxx>

#include <cmath>
#include <map>
#include <vector>

#include "mesher/edges/edge_sampling.hpp"
#include "tests/support/ids.hpp"

namespace quadrille {
namespace {

/// A triangle-like face whose angle between Edge1, of length 100, and the edges beside it is given.
CadShape with_angles(double degrees) {
  const double up = 30 * std::sin(degrees * M_PI / 180), in = 30 * std::cos(degrees * M_PI / 180);
  BRepBuilderAPI_MakePolygon outline;
  for (const gp_Pnt& at :
       {gp_Pnt(0, 0, 0), gp_Pnt(100, 0, 0), gp_Pnt(100 - in, up, 0), gp_Pnt(50, 90, 0), gp_Pnt(in, up, 0)})
    outline.Add(at);
  outline.Close();
  return {BRepBuilderAPI_MakeFace(gp_Pln(), outline.Wire()).Face(), "face"};
}

RowLines lines_in(const CadShape& shape, const std::map<int, SizeLayers>& layers) {
  return find_row_lines(shape, FaceOutlines(shape.faces.size()), FaceFlags(shape.faces.size(), 1),
                        SamplingPlan(shape).tiny, PrescribedEdges(shape.edges.size()), {{}, layers, {}});
}

TEST(RowLines, EndByTheAngle) {
  using End = RowLine::End;
  const SizeLayers layers{0.5, 2, 3};
  for (const double angle : {35.0, 45.0, 90.0, 135.0, 145.0}) {
    SCOPED_TRACE(angle);
    const CadShape shape = with_angles(angle);
    const RowLines lines = lines_in(shape, {{1, layers}});
    EXPECT_EQ(lines.without.size(), angle < 40 ? 1U : 0U);
    EXPECT_EQ(lines.along[edge_id(1)] != 0, angle > 40);
    EXPECT_EQ(lines.steps.size(), angle > 140 ? 2U : 0U);
    EXPECT_EQ(lines.heads.size(), angle > 40 && angle < 140 ? 2U : 0U);
    for (const auto& [face, own] : lines.of_faces) {
      ASSERT_EQ(own.size(), 1U);
      EXPECT_EQ(own[0].ends[0], angle > 140 ? End::free : End::meets);
      EXPECT_EQ(own[0].heights, (std::vector<double>{0.5, 1, 2}));
    }
    for (const auto& [edge, heads] : lines.heads) {
      const std::vector<double>& head = heads.first.empty() ? heads.last : heads.first;
      ASSERT_EQ(head.size(), 3U);
      EXPECT_NEAR(head[2], 2 / std::sin(angle * M_PI / 180), 1e-9);
    }
  }
}

TEST(RowLines, AreLoopsWhereAllEdgesAreAlike) {
  const CadShape shape = with_angles(90);
  const SizeLayers layers{0.5, 2, 3}, other{0.5, 2, 2};
  std::map<int, SizeLayers> all;
  for (int edge = 1; edge <= 5; ++edge) all[edge] = layers;
  const RowLines loop = lines_in(shape, all);
  ASSERT_EQ(loop.of_faces.size(), 1U);
  EXPECT_TRUE(loop.of_faces.begin()->second.front().is_closed());
  EXPECT_TRUE(loop.heads.empty());
  all[3] = other;
  EXPECT_EQ(lines_in(shape, all).without.size(), 5U);
  all.erase(3);
  const RowLines chain = lines_in(shape, all);
  ASSERT_EQ(chain.of_faces.size(), 1U);
  EXPECT_EQ(chain.of_faces.begin()->second.front().edges.size(), 4U);
}

}  // namespace
}  // namespace quadrille
