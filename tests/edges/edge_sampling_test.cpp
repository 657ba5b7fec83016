/// The number of segments on edges.

#include "mesher/edges/edge_sampling.hpp"

#include <gtest/gtest.h>

#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRep_Builder.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>

#include <cmath>
#include <map>
#include <memory>
#include <string>

#include "geometry/base/error.hpp"
#include "mesher/quadrille.hpp"

namespace quadrille {
namespace {

/// A block of 40 by 30 by 20 with one edge rounded by a radius of 4.
CadModel block_with_fillet() {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(40, 30, 20).Shape();
  BRepFilletAPI_MakeFillet fillet(box);
  fillet.Add(4, TopoDS::Edge(TopExp_Explorer(box, TopAbs_EDGE).Current()));
  return CadModel(std::make_shared<CadShape>(fillet.Shape(), "block"));
}

TEST(EdgeSampling, GivesArcsTheSegmentsThatTheirSizesAskForAtLeast) {
  const CadModel model = block_with_fillet();
  std::map<int, double> arcs;  // edge -> angle
  for (const CadEdge& edge : model.shape().edges) {
    if (BRepAdaptor_Curve(edge.edge).GetType() == GeomAbs_Circle) arcs[edge.number] = edge.length / 4;
  }
  ASSERT_EQ(arcs.size(), 2U);
  for (const double size : {2.0, 2.5, 3.0, 3.5, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0}) {
    for (const double per_circle : {8.0, 12.0, 16.0, 24.0}) {
      MeshOptions options;
      options.sizing.size = size;
      options.sizing.elements_per_circle = per_circle;
      ExecutionContext context(1);
      const ShellMesh mesh = quadrille::mesh(model, options, context);
      std::map<int, int> segments;
      for (const auto& segment : mesh.segments) ++segments[segment.edge];
      // Quads are cut in four, so half a segment more or less cannot be told.
      for (const auto& [edge, angle] : arcs)
        EXPECT_GE(segments[edge], per_circle * angle / (2 * M_PI) - 0.5) << size << " " << per_circle;
    }
  }
}

/// The number of segments on an edge with a bias follows the sizes beside it, so that the ratios of lengths
/// may multiply to any number.
TEST(EdgeSampling, RefusesBiasesThatLeaveSegmentsNoLength) {
  const CadModel model(std::make_shared<CadShape>(BRepPrimAPI_MakeBox(40, 30, 20).Shape(), "block"));
  MeshOptions options;
  options.sizing.size = 1.5;
  options.sizing.spacings[1].bias_both = 10;
  ExecutionContext context(1);
  EXPECT_NO_THROW(quadrille::mesh(model, options, context));
  for (const FaceId face : model.shape().edges[EdgeId::from_number(1)].faces)
    options.sizing.face_sizes[face.number()] = 0.7;
  try {
    quadrille::mesh(model, options, context);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), Error::Kind::usage);
    EXPECT_EQ(error.subject(), "bias_both");
    EXPECT_NE(std::string(error.what()).find("Edge1"), std::string::npos) << error.what();
  }
}

/// A size below the least one that a user gives to a vertex of one part changes nothing on another part,
/// whose edges have room for two segments of the least size, and a half.
TEST(EdgeSampling, SmallNamedSizesActWhereTheyAre) {
  TopoDS_Compound both;
  const BRep_Builder builder;
  builder.MakeCompound(both);
  builder.Add(both, BRepPrimAPI_MakeBox(13, 13, 13).Shape());
  builder.Add(both, BRepPrimAPI_MakeBox(gp_Pnt(200, 0, 0), 20, 20, 20).Shape());
  const CadModel model(std::make_shared<CadShape>(both, "both"));
  MeshOptions options;
  options.sizing.size = options.sizing.size_min = 5;
  options.strategy = Strategy::direct;
  ExecutionContext context(1);
  const ShellMesh before = mesh(model, options, context);
  constexpr int last_vertex = 16;
  options.sizing.vertex_sizes[last_vertex] = 0.1;
  const ShellMesh after = mesh(model, options, context);
  EXPECT_GT(after.quads.size(), before.quads.size());
  for (int face = 0; face < 6; ++face) EXPECT_EQ(after.faces[face].quads, before.faces[face].quads) << face;
}

}  // namespace
}  // namespace quadrille
