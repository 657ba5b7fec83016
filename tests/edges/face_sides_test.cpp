/// Outlines of plane polygons and sample models: their kind, corners, facing sides, and the edges left.

#include "mesher/edges/face_sides.hpp"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Wire.hxx>
#include <gp.hxx>
#include <gp_Ax2.hxx>
#include <gp_Circ.hxx>
#include <gp_Pln.hxx>
#include <gp_Pnt.hxx>

#include <memory>
#include <set>
#include <vector>

#include "mesher/edges/edge_sampling.hpp"
#include "tests/support/ids.hpp"
#include "tests/support/sample_models.hpp"
#include "tests/support/sheet.hpp"

namespace quadrille {
namespace {

FaceOutlines outlines_of(const CadModel& model, double size, const FaceFlags& used) {
  const CadShape& shape = model.shape();
  IdVector<EdgeId, double> wanted(shape.edges.size());
  for (const EdgeId edge : wanted.ids()) wanted[edge] = shape.edges[edge].length / size;
  return find_face_sides(shape, used, SamplingPlan(shape).tiny, wanted);
}

FaceOutlines outlines_of(const CadModel& model, double size) {
  return outlines_of(model, size, FaceFlags(model.face_count(), 1));
}

FaceSides outline_of(const testing::Polygon& polygon) {
  return outlines_of(testing::sheet({polygon}), 1)[face_id(1)];
}

/// A disc of radius `outer` with a round hole of radius `inner`, whose center is `off` away from the disc's.
CadModel annulus(double outer, double inner, double off) {
  const auto circle = [](double x, double radius) {
    const gp_Circ curve(gp_Ax2(gp_Pnt(x, 0, 0), gp::DZ()), radius);
    return BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(curve).Edge()).Wire();
  };
  BRepBuilderAPI_MakeFace face(gp_Pln(gp::Origin(), gp::DZ()), circle(0, outer));
  face.Add(TopoDS::Wire(circle(off, inner).Reversed()));
  return CadModel(std::make_shared<CadShape>(face.Face(), "annulus"));
}

double length_of(const CadShape& shape, const FaceSide& side) {
  double sum = 0;
  for (const SideEdge& edge : side) sum += shape.edges[edge.edge].length;
  return sum;
}

TEST(FaceSides, KnowsPolygonsByTheirCorners) {
  const FaceSides four = outline_of({{0, 0}, {10, 0}, {10, 6}, {0, 6}});
  EXPECT_EQ(four.kind, GridKind::four);
  EXPECT_EQ(four.starts.size(), 4U);
  EXPECT_EQ(four.facing.size(), 2U);
  EXPECT_TRUE(four.rest.empty());
  const FaceSides three = outline_of({{0, 0}, {10, 0}, {5, 8}});
  EXPECT_EQ(three.kind, GridKind::other);
  EXPECT_TRUE(three.may_be_odd);
  EXPECT_EQ(three.rest.size(), 3U);
  const FaceSides steps = outline_of({{0, 0}, {20, 0}, {20, 8}, {9, 8}, {9, 15}, {0, 15}});
  EXPECT_EQ(steps.kind, GridKind::other);
  EXPECT_EQ(steps.rest.size(), 6U);
  EXPECT_FALSE(steps.may_be_odd);
}

TEST(FaceSides, KnowsRingsHolesAndRoundFaces) {
  for (const double inner : {6.0, 9.0}) {
    const FaceSides ring = outlines_of(annulus(10, inner, 0), 1)[face_id(1)];
    EXPECT_EQ(ring.kind, GridKind::ring) << inner;
    ASSERT_EQ(ring.facing.size(), 1U);
    EXPECT_TRUE(ring.rest.empty());
  }
  const FaceSides crooked = outlines_of(annulus(10, 4, 5), 1)[face_id(1)];
  EXPECT_EQ(crooked.kind, GridKind::other);
  EXPECT_EQ(crooked.rest.size(), 2U);
  const FaceSides holed = outlines_of(CadModel::read(sample_model("plate_with_holes").path()), 3)[face_id(1)];
  EXPECT_EQ(holed.kind, GridKind::holed);
  const CadModel disc = CadModel::read(sample_model("disc").path());
  const FaceSides round = outlines_of(disc, 2)[face_id(1)];
  EXPECT_EQ(round.kind, GridKind::other);
  EXPECT_EQ(round.rest.size(), 1U);
}

/// Facing sides of a rectangle are equally long; where vertices divide one, so does the pair.
TEST(FaceSides, PairsOppositeSides) {
  const CadModel model = testing::sheet({{{0, 0}, {10, 0}, {10, 6}, {0, 6}},
                                         {{0, 6}, {4, 6}, {4, 11}, {0, 11}},
                                         {{4, 6}, {10, 6}, {10, 11}, {4, 11}}});
  const CadShape& shape = model.shape();
  const FaceOutlines sides = outlines_of(model, 1);
  for (const FaceSides& face : sides) {
    EXPECT_EQ(face.kind, GridKind::four);
    EXPECT_EQ(face.facing.size(), 2U);
    for (const FacingPair& pair : face.facing)
      EXPECT_NEAR(length_of(shape, pair.first), length_of(shape, pair.second), 1e-9);
  }
  std::multiset<std::size_t> edges;
  for (const FacingPair& pair : sides[face_id(1)].facing)
    for (const FaceSide* side : {&pair.first, &pair.second}) edges.insert(side->size());
  EXPECT_EQ(edges, (std::multiset<std::size_t>{1, 1, 1, 2}));
}

/// An edge that one face uses twice changes no parity.
bool is_seam(const CadEdge& edge) {
  return edge.faces.size() == 2 && edge.faces[0] == edge.faces[1];
}

/// Each edge of a face is in a pair or among the rest, and no other edge is.
TEST(FaceSides, ForgetsNoEdge) {
  for (const SampleModel& sample : sample_models()) {
    const CadModel model = CadModel::read(sample.path());
    const CadShape& shape = model.shape();
    const FaceOutlines sides = outlines_of(model, model.diagonal() / 30);
    for (const FaceId id : shape.faces.ids()) {
      std::set<EdgeId> edges, told(sides[id].rest.begin(), sides[id].rest.end());
      for (const CadWire& wire : shape.faces[id].wires)
        for (const Coedge& coedge : wire.coedges)
          if (!shape.edges[coedge.edge].degenerate) edges.insert(coedge.edge);
      for (const FacingPair& pair : sides[id].facing)
        for (const FaceSide* side : {&pair.first, &pair.second})
          for (const SideEdge& edge : *side) told.insert(edge.edge);
      for (const EdgeId edge : told)
        EXPECT_TRUE(edges.contains(edge) || shape.edges[edge].degenerate)
            << sample.name << " Edge" << edge.number();
      for (const EdgeId edge : edges)
        EXPECT_TRUE(told.contains(edge) || is_seam(shape.edges[edge]))
            << sample.name << " Face" << id.number() << " Edge" << edge.number();
    }
  }
}

TEST(FaceSides, LeavesUnusedFacesOut) {
  const CadModel box = CadModel::read(sample_model("box").path());
  FaceFlags used(box.face_count(), 1);
  used[face_id(3)] = 0;
  const FaceOutlines sides = outlines_of(box, 2, used);
  for (const FaceId face : sides.ids()) {
    EXPECT_EQ(sides[face].kind, used[face] ? GridKind::four : GridKind::other);
    EXPECT_EQ(sides[face].facing.empty(), !used[face]);
  }
}

}  // namespace
}  // namespace quadrille
