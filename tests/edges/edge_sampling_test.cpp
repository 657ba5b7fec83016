/// The number of segments on edges.

#include "mesher/edges/edge_sampling.hpp"

#include <gtest/gtest.h>

#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>

#include <cmath>
#include <map>
#include <memory>

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

}  // namespace
}  // namespace quadrille
