/// Bounding boxes end where bulged, turned and trimmed faces do, and hold loose edges.

#include "geometry/cad/bounding_box.hpp"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepLib.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRep_Builder.hxx>
#include <Geom2d_Line.hxx>
#include <Geom_BezierCurve.hxx>
#include <Geom_BezierSurface.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <cmath>
#include <gp_Ax1.hxx>
#include <gp_Trsf.hxx>

#include "geometry/cad/cad_shape.hpp"

namespace quadrille {
namespace {

void expect_box(const TopoDS_Shape& shape, const Vector3& low, const Vector3& high) {
  const CadShape model(shape, "part");
  const double near = 1e-5 * (high - low).norm();
  EXPECT_LT((model.box_min - low).cwiseAbs().maxCoeff(), near) << model.box_min.transpose();
  EXPECT_LT((model.box_max - high).cwiseAbs().maxCoeff(), near) << model.box_max.transpose();
}

TopoDS_Shape turned(const TopoDS_Shape& shape, double angle) {
  gp_Trsf turn;
  turn.SetRotation(gp_Ax1({0, 0, 0}, {1, 0, 0}), angle);
  return BRepBuilderAPI_Transform(shape, turn, true).Shape();
}

TopoDS_Edge bulge() {
  TColgp_Array1OfPnt poles(1, 3);
  poles(1) = {10, 0, 0};
  poles(2) = {18, 0, 15};
  poles(3) = {10, 0, 30};
  return BRepBuilderAPI_MakeEdge(new Geom_BezierCurve(poles)).Edge();
}

/// x between 10 and 14 at half the height, as a square of the height.
TEST(BoundingBox, EndsWhereABarrelDoes) {
  const TopoDS_Shape barrel = BRepPrimAPI_MakeRevol(bulge(), gp_Ax1({0, 0, 0}, {0, 0, 1})).Shape();
  expect_box(barrel, {-14, -14, 0}, {14, 14, 30});
  expect_box(BRepBuilderAPI_NurbsConvert(barrel).Shape(), {-14, -14, 0}, {14, 14, 30});
}

TEST(BoundingBox, EndsWhereAPatchDoes) {
  TColgp_Array2OfPnt poles(1, 3, 1, 3);
  for (int i = 1; i <= 3; ++i) {
    for (int j = 1; j <= 3; ++j) poles(i, j) = gp_Pnt(20 * i, 20 * j, i == 2 && j == 2 ? 100 : 0);
  }
  const TopoDS_Shape patch = BRepBuilderAPI_MakeFace(new Geom_BezierSurface(poles), 1e-7).Shape();
  expect_box(patch, {20, 20, 0}, {60, 60, 25});
}

TEST(BoundingBox, EndsWhereATurnedTorusDoes) {
  const double angle = 0.5, around = 20, tube = 6;
  const double y = around * std::cos(angle) + tube, z = around * std::sin(angle) + tube;
  expect_box(turned(BRepPrimAPI_MakeTorus(around, tube).Shape(), angle), {-26, -y, -z}, {26, y, z});
}

TEST(BoundingBox, EndsAtTheTrimmedPartOfASurface) {
  TColgp_Array2OfPnt poles(1, 3, 1, 2);
  for (int i = 1; i <= 3; ++i) {
    for (int j = 1; j <= 2; ++j) poles(i, j) = gp_Pnt(10 * (i - 1), 20 * (j - 1), i == 2 ? 10 : 0);
  }
  // An arch, of which a quarter is left.
  const Handle(Geom_BezierSurface) arch = new Geom_BezierSurface(poles);
  expect_box(BRepBuilderAPI_MakeFace(arch, 0, 0.25, 0, 1, 1e-7).Shape(), {0, 0, 0}, {5, 20, 3.75});
}

/// A corner of the face is the lowest point in its parameter plane, and its parametric curves there miss each
/// other by less than a tolerance: nothing else at that height belongs to the face.
TEST(BoundingBox, HoldsNothingBesideALowestCorner) {
  const double steep = 30;
  TColgp_Array2OfPnt poles(1, 3, 1, 3);  // rises to all sides outside the diamond in its middle
  for (int i = 1; i <= 3; ++i) {
    for (int j = 1; j <= 3; ++j) {
      const double u = 10 * (i - 2), v = 10 * (j - 2);
      poles(i, j) = gp_Pnt(u, v, i == 2 && j == 2 ? -steep : steep);
    }
  }
  const Handle(Geom_BezierSurface) surface = new Geom_BezierSurface(poles);
  const gp_Pnt2d corners[] = {{0.5, 0.25 - 1e-9}, {0.75, 0.5}, {0.5, 0.75}, {0.25, 0.5}, {0.5, 0.25}};
  const BRep_Builder builder;
  TopoDS_Wire wire;
  builder.MakeWire(wire);
  TopoDS_Vertex vertices[4];
  for (int i = 0; i < 4; ++i)
    builder.MakeVertex(vertices[i], surface->Value(corners[i].X(), corners[i].Y()), 1e-6);
  for (int i = 0; i < 4; ++i) {
    const gp_Vec2d along(corners[i], corners[i + 1]);
    TopoDS_Edge edge;
    builder.MakeEdge(edge);
    builder.UpdateEdge(edge, new Geom2d_Line(corners[i], along), surface, TopLoc_Location(), 1e-6);
    builder.Add(edge, vertices[i].Oriented(TopAbs_FORWARD));
    builder.Add(edge, vertices[(i + 1) % 4].Oriented(TopAbs_REVERSED));
    builder.Range(edge, 0, along.Magnitude());
    builder.Add(wire, edge);
  }
  TopoDS_Face face;
  builder.MakeFace(face, surface, 1e-6);
  builder.Add(face, wire);
  BRepLib::BuildCurves3d(face);
  const double rim = surface->Value(0.5, 0.25).Z();
  expect_box(face, {-5, -5, surface->Value(0.5, 0.5).Z()}, {5, 5, rim});
}

TEST(BoundingBox, EndsWhereAPlaneFaceWithACurvedRimDoes) {
  const TopoDS_Edge back = BRepBuilderAPI_MakeEdge(gp_Pnt(10, 0, 30), gp_Pnt(10, 0, 0)).Edge();
  const TopoDS_Wire rim = BRepBuilderAPI_MakeWire(bulge(), back).Wire();
  expect_box(BRepBuilderAPI_MakeFace(rim, true).Shape(), {10, 0, 0}, {14, 0, 30});
}

TEST(BoundingBox, HoldsLooseEdgesAndVertices) {
  TopoDS_Compound all;
  const BRep_Builder builder;
  builder.MakeCompound(all);
  builder.Add(all, BRepPrimAPI_MakeBox(10, 10, 10).Shape());
  builder.Add(all, BRepBuilderAPI_MakeEdge(gp_Pnt(5, 5, 5), gp_Pnt(30, 5, 5)).Edge());
  builder.Add(all, BRepBuilderAPI_MakeVertex({5, -20, 5}).Vertex());
  expect_box(all, {0, -20, 0}, {30, 10, 10});
}

}  // namespace
}  // namespace quadrille
