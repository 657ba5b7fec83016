/// Rounds of sampling: what a remedy in one face makes anew elsewhere.

#include <gtest/gtest.h>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRep_Builder.hxx>
#include <TopoDS_Compound.hxx>

#include <algorithm>
#include <memory>

#include "mesher/stages/stages.hpp"

namespace quadrille {
namespace {

/// A plate through which a hole goes 0.05 from its rim, first, and cylinders and boxes beside it.
CadModel plate_among_others(int others) {
  TopoDS_Compound all;
  const BRep_Builder builder;
  builder.MakeCompound(all);
  const gp_Ax2 axis({20, 14.95, -1}, gp::DZ());
  builder.Add(all, BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(40, 25, 5).Shape(),
                                   BRepPrimAPI_MakeCylinder(axis, 10, 7).Shape())
                       .Shape());
  for (int i = 0; i < others; ++i) {
    const gp_Pnt corner(30.0 * i, 60, 0);
    builder.Add(all, i % 2 == 0 ? BRepPrimAPI_MakeBox(corner, 20, 15, 10).Shape()
                                : BRepPrimAPI_MakeCylinder({corner, gp::DZ()}, 8, 15).Shape());
  }
  return CadModel(std::make_shared<CadShape>(all, "plate_among_others"));
}

/// What the rounds of sampling leave.
struct Settled {
  explicit Settled(const CadModel& model)
      : prepared(model, options()), field(sizes_for(prepared, context)), boundary(prepared), faces(prepared) {
    EXPECT_TRUE(settle({prepared, field, context}, boundary, faces, false));
  }

  static MeshOptions options() {
    MeshOptions result;
    result.sizing.size = 6;
    result.sizing.short_edges = false;
    result.sizing.elements_per_circle = 0;
    return result;
  }

  ExecutionContext context{1};
  const Prepared prepared;
  const SizingField field;
  Boundary boundary;
  Faces faces;
};

/// The faces of solids apart from the plate are charted in the first round, and never again.
TEST(Boundary, ChartsAnewOnlyFacesWhoseBoundaryChanged) {
  const Settled settled(plate_among_others(12));
  EXPECT_GT(settled.boundary.rounds, 1);
  constexpr int of_plate = 7;
  for (const FaceId face : settled.faces.records.ids()) {
    const int charts = settled.faces.records[face].charts;
    if (face.number() > of_plate)
      EXPECT_EQ(charts, 1) << "Face" << face.number();
    else
      EXPECT_GE(charts, 1) << "Face" << face.number();
  }
}

/// Charts that were kept are those that would be made from the last nodes.
TEST(Boundary, KeepsChartsThatAreAsIfMadeAnew) {
  const Settled settled(plate_among_others(4));
  EXPECT_GT(settled.boundary.rounds, 1);
  for (const FaceId face : settled.faces.records.ids()) {
    const auto& chart = settled.boundary.charts[face];
    ASSERT_TRUE(chart) << "Face" << face.number();
    const FaceBoundary anew =
        make_chart(settled.prepared.shape, face, settled.boundary.nodes, chart->kind).boundary;
    EXPECT_EQ(chart->boundary.uv, anew.uv);
    EXPECT_EQ(chart->boundary.points, anew.points);
    EXPECT_EQ(chart->boundary.nodes, anew.nodes);
    EXPECT_TRUE(std::equal(anew.segments.begin(), anew.segments.end(), chart->boundary.segments.begin(),
                           chart->boundary.segments.end(),
                           [](const FaceBoundary::Segment& a, const FaceBoundary::Segment& b) {
                             return a.a == b.a && a.b == b.b && a.from == b.from && a.to == b.to &&
                                    a.middle_node == b.middle_node && a.middle_point == b.middle_point;
                           }));
  }
}

}  // namespace
}  // namespace quadrille
