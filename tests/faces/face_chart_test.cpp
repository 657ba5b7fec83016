/// The boundary of a face in each kind of plane, and what is said where there is none.

#include "mesher/faces/face_chart.hpp"

#include <gtest/gtest.h>

#include <BRepPrimAPI_MakeCylinder.hxx>

#include "tests/support/meshed_model.hpp"

namespace quadrille {
namespace {

class FaceChartTest : public ::testing::Test {
 protected:
  const testing::MeshedModel parts_{
      CadModel(std::make_shared<CadShape>(BRepPrimAPI_MakeCylinder(5, 8).Shape(), "cylinder")), 2};

  FaceChart chart(FaceId face, ChartKind kind) const {
    return make_chart(parts_.model.shape(), face, parts_.nodes, kind);
  }
  /// Whether the face is the one around the axis.
  bool is_side(FaceId face) const { return !FaceSurface(parts_.model.shape().faces[face]).planar(); }
};

TEST_F(FaceChartTest, HasTheNodesOnItsSurface) {
  for (const FaceId face : parts_.faces.ids()) {
    for (const ChartKind kind : {ChartKind::own, ChartKind::new_curves, ChartKind::view}) {
      if (kind == ChartKind::view && is_side(face)) continue;
      const FaceChart made = chart(face, kind);
      EXPECT_EQ(made.kind, kind);
      EXPECT_EQ(made.other != nullptr, kind == ChartKind::new_curves);
      EXPECT_EQ(made.surface->is_view(), kind == ChartKind::view);
      ASSERT_GT(made.boundary.size(), 4);
      for (int i = 0; i < made.boundary.size(); ++i) {
        const Vector3& node = parts_.nodes.points[made.boundary.nodes[i]];
        EXPECT_LT((made.surface->point(made.boundary.uv[i]) - node).norm(), 1e-6);
        EXPECT_LT((made.boundary.points[i] - node).norm(), 1e-9);
      }
      EXPECT_EQ(made.boundary.size(), chart(face, ChartKind::own).boundary.size());
    }
  }
}

/// A view keeps lengths in a plane face, whatever its parameters.
TEST_F(FaceChartTest, OfAViewIsThePlaneItself) {
  for (const FaceId face : parts_.faces.ids()) {
    if (is_side(face)) continue;
    const FaceBoundary boundary = chart(face, ChartKind::view).boundary;
    double area = 0;
    for (const auto& s : boundary.segments) {
      const Vector2 &a = boundary.uv[s.a], &b = boundary.uv[s.b];
      EXPECT_NEAR((a - b).norm(), (boundary.points[s.a] - boundary.points[s.b]).norm(), 1e-9);
      area += 0.5 * (a.x() * b.y() - a.y() * b.x());
    }
    EXPECT_GT(area, 70) << "counter-clockwise, nearly the circle's 78.5";
  }
}

TEST_F(FaceChartTest, IsRefusedWhereTheSurfaceTurnsAway) {
  for (const FaceId face : parts_.faces.ids()) {
    if (!is_side(face)) continue;
    try {
      chart(face, ChartKind::view);
      ADD_FAILURE() << "no error";
    } catch (const FaceProblem& problem) {
      EXPECT_EQ(problem.cause(), Cause::unusable_boundary);
      EXPECT_EQ(problem.face(), face);
    }
  }
}

}  // namespace
}  // namespace quadrille
