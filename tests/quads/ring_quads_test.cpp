/// The quads of rings and of the rest of a face become one mesh, which ends at the hole.

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <gp_Pln.hxx>

#include <algorithm>
#include <vector>

#include "geometry/surfaces/face_surface.hpp"
#include "mesher/faces/hole_rings.hpp"
#include "mesher/mesh/quad_geometry.hpp"
#include "mesher/quads/face_quads.hpp"
#include "tests/support/ids.hpp"
#include "tests/support/quad_grid.hpp"

namespace quadrille {
namespace {

using testing::euler;
using testing::open_sides;

Vector2 corner(double half, int i) {
  return {i == 0 || i == 3 ? -half : half, i < 2 ? -half : half};
}

/// A square hole of side 2 in a square of side 8, and one ring around it up to side 4. The nodes 0 to 3 are
/// the corners outside, 4 to 7 those of the hole.
class RingQuads : public ::testing::Test {
 protected:
  const CadShape shape_{BRepBuilderAPI_MakeFace(gp_Pln(), -4, 4, -4, 4).Face(), "square"};
  const FaceSurface surface_{shape_.faces[face_id(1)]};
  FaceQuads quads_;
  HoleRings rings_;

  void SetUp() override {
    HoleRings::Hole hole;
    for (const double half : {1.0, 2.0})
      for (int i = 0; i < 4; ++i) hole.points.push_back({corner(half, i), surface_.point(corner(half, i))});
    hole.nodes = {4, 5, 6, 7};
    for (int i = 0; i < 4; ++i) hole.quads.push_back({4 + i, 4 + (i + 1) % 4, (i + 1) % 4, i});
    rings_.holes.push_back(hole);
    for (const double half : {4.0, 2.0})
      for (int i = 0; i < 4; ++i) {
        quads_.add({surface_.point(corner(half, i)), {0, 0, 1}, corner(half, i)}, true, false);
        quads_.nodes.push_back(half == 4 ? i : HoleRings::node(i));
      }
    for (int i = 0; i < 4; ++i)
      quads_.surface_mesh.mesh.quads.push_back({i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i});
  }

  void expect_whole() {
    add_ring_quads(quads_, rings_, surface_);
    const SurfaceMesh& whole = quads_.surface_mesh;
    EXPECT_EQ(whole.mesh.points.size(), 12U);
    EXPECT_EQ(whole.mesh.quads.size(), 8U);
    EXPECT_EQ(open_sides(whole.mesh).size(), 8U);
    EXPECT_EQ(euler(whole.mesh), 0) << "one hole";
    double area = 0;
    for (const auto& quad : whole.mesh.quads) {
      EXPECT_GT(quad_area_vector(whole.mesh.points, quad).z(), 0);
      area += quad_area_vector(whole.mesh.points, quad).z();
    }
    EXPECT_NEAR(area, 64 - 4, 1e-9);
    ASSERT_EQ(quads_.nodes, (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7}));
    for (std::size_t i = 0; i < 12; ++i) {
      EXPECT_EQ(whole.fixed[i], i < 8);
      EXPECT_LT((surface_.point(whole.parameters[i]) - whole.mesh.points[i]).norm(), 1e-12);
      if (i >= 4 && i < 8) {
        EXPECT_LT((whole.mesh.points[i] - surface_.point(corner(1, static_cast<int>(i) - 4))).norm(), 1e-12);
      }
    }
  }
};

TEST_F(RingQuads, EndAtTheHole) {
  expect_whole();
}

TEST_F(RingQuads, AreTurnedLikeTheRest) {
  for (auto& quad : rings_.holes[0].quads) std::swap(quad[1], quad[3]);
  expect_whole();
}

TEST_F(RingQuads, LeaveAFaceWithoutRingsAlone) {
  const FaceQuads before = quads_;
  quads_.nodes = {0, 1, 2, 3, 4, 5, 6, 7};
  rings_.holes.clear();
  add_ring_quads(quads_, rings_, surface_);
  EXPECT_EQ(quads_.surface_mesh.mesh.quads, before.surface_mesh.mesh.quads);
  EXPECT_EQ(quads_.surface_mesh.mesh.points, before.surface_mesh.mesh.points);
}

}  // namespace
}  // namespace quadrille
