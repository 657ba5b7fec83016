/// Units of files, and wires that touch themselves, made as STEP files in the tests.

#include "geometry/cad/cad_model.hpp"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRep_Builder.hxx>
#include <Geom_Curve.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <gp_Pln.hxx>
#include <memory>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "tests/support/ids.hpp"
#include "tests/support/process.hpp"

namespace quadrille {
namespace {

/// A box of 25.4 by 50.8 by 101.6 mm in a file whose lengths are in `unit`.
void write_step(const std::filesystem::path& file, const char* unit) {
  STEPControl_Controller::Init();
  ASSERT_TRUE(Interface_Static::SetCVal("write.step.unit", unit));
  STEPControl_Writer writer;
  writer.Transfer(BRepPrimAPI_MakeBox(25.4, 50.8, 101.6).Shape(), STEPControl_AsIs);
  ASSERT_EQ(writer.Write(file.c_str()), IFSelect_RetDone);
}

void write_iges(const std::filesystem::path& file, const char* unit) {
  IGESControl_Controller::Init();
  IGESControl_Writer writer(unit, 1);
  writer.AddShape(BRepPrimAPI_MakeBox(25.4, 50.8, 101.6).Shape());
  writer.ComputeModel();
  ASSERT_TRUE(writer.Write(file.c_str()));
}

/// The largest x of the points in space in a STEP file, in the file's unit. OpenCASCADE 7.8 writes the unit
/// asked for with unscaled numbers.
double largest_x(const std::string& text) {
  static const std::regex point(R"(CARTESIAN_POINT\('',\(([^,()]+),[^,()]+,[^,()]+\))");
  double largest = 0;
  for (auto it = std::sregex_iterator(text.begin(), text.end(), point); it != std::sregex_iterator(); ++it)
    largest = std::max(largest, std::stod((*it)[1]));
  return largest;
}

TEST(CadModel, LengthsAreMillimetersWhateverTheFilesUnit) {
  const test::TemporaryFolder folder;
  write_step(folder / "mm.step", "MM");
  write_step(folder / "inch.step", "INCH");
  write_step(folder / "meter.step", "M");
  write_iges(folder / "mm.igs", "MM");
  write_iges(folder / "inch.igs", "INCH");
  write_iges(folder / "meter.igs", "M");
  // The files do differ: an inch is an inch.
  EXPECT_NE(test::file_text(folder / "inch.step").find("INCH"), std::string::npos);
  EXPECT_EQ(test::file_text(folder / "mm.step").find("INCH"), std::string::npos);
  const auto by_step = [&](const char* name, double unit) {
    return unit * largest_x(test::file_text(folder / name));
  };
  const std::pair<const char*, double> files[] = {{"mm.step", by_step("mm.step", 1)},
                                                  {"inch.step", by_step("inch.step", 25.4)},
                                                  {"meter.step", by_step("meter.step", 1000)},
                                                  {"mm.igs", 25.4},
                                                  {"inch.igs", 25.4},
                                                  {"meter.igs", 25.4}};
  for (const auto& [name, width] : files) {
    SCOPED_TRACE(name);
    const CadModel model = CadModel::read(folder / name);
    const Vector3 extent = model.box_max() - model.box_min();
    EXPECT_GE(width, 25.4 * (1 - 1e-9));
    EXPECT_NEAR(extent.x(), width, 1e-5);
    EXPECT_NEAR(extent.y(), 2 * width, 1e-5);
    EXPECT_NEAR(extent.z(), 4 * width, 1e-5);
    EXPECT_EQ(model.face_count(), 6);
  }
}

/// A plane face with one wire: from corner A of a quadrangle along a slit to B, round a hole that touches the
/// quadrangle's corner C, back along the slit, and round the quadrangle.
TopoDS_Face face_whose_wire_touches_itself() {
  std::vector<TopoDS_Vertex> corners;
  for (const gp_Pnt& p : {gp_Pnt(0, 0, 0), gp_Pnt(8, 0, 0), gp_Pnt(14, 3, 0), gp_Pnt(20, 0, 0),
                          gp_Pnt(14, -3, 0), gp_Pnt(10, -10, 0), gp_Pnt(10, 10, 0)})
    corners.push_back(BRepBuilderAPI_MakeVertex(p).Vertex());
  const auto edge = [&](int from, int to) {
    return BRepBuilderAPI_MakeEdge(corners[from], corners[to]).Edge();
  };
  enum { a, b, g, c, h, e, d };
  const TopoDS_Edge slit = edge(a, b);
  const BRep_Builder builder;
  TopoDS_Wire wire;
  builder.MakeWire(wire);
  for (const TopoDS_Edge& next :
       {slit, edge(b, g), edge(g, c), edge(c, h), edge(h, b), TopoDS::Edge(slit.Reversed()), edge(a, e),
        edge(e, c), edge(c, d), edge(d, a)})
    builder.Add(wire, next);
  wire.Closed(Standard_True);
  return BRepBuilderAPI_MakeFace(gp_Pln(), wire).Face();
}

/// Starts of edges by their numbers, and the edges of all wires in their order.
std::vector<Vector3> order_of_edges(const CadModel& model) {
  std::vector<Vector3> result;
  for (const CadEdge& edge : model.shape().edges) result.push_back(model.shape().vertices[edge.first_vertex]);
  for (const CadWire& wire : model.shape().faces[face_id(1)].wires) {
    for (const Coedge& coedge : wire.coedges)
      result.emplace_back(coedge.edge.number(), coedge.forward, wire.ordered);
  }
  return result;
}

void expect_the_same_in_each_reading(const std::filesystem::path& file) {
  const std::vector<Vector3> first = order_of_edges(CadModel::read(file));
  EXPECT_EQ(first.size(), 9U + 10U);
  std::vector<std::unique_ptr<char[]>> used;  // so that what is read next lies elsewhere
  for (int i = 1; i <= 24; ++i) {
    used.push_back(std::make_unique<char[]>(16 + 48 * i));
    EXPECT_EQ(order_of_edges(CadModel::read(file)), first) << "reading " << i;
  }
}

TEST(CadModel, WiresThatTouchThemselvesAreReadTheSameWhereverTheyLieInMemory) {
  const test::TemporaryFolder folder;
  STEPControl_Controller::Init();
  STEPControl_Writer writer;
  writer.Transfer(face_whose_wire_touches_itself(), STEPControl_AsIs);
  ASSERT_EQ(writer.Write((folder / "slit.step").c_str()), IFSelect_RetDone);
  expect_the_same_in_each_reading(folder / "slit.step");
  // OpenCASCADE's own file of settings asks for all healing.
  std::ofstream(folder / "STEP") << "FromSTEP.exec.op : FixShape\nFromSTEP.FixShape.FixLoopWiresMode : -1\n";
  ::setenv("CSF_STEPDefaults", (folder / ".").c_str(), 1);
  expect_the_same_in_each_reading(folder / "slit.step");
  ::unsetenv("CSF_STEPDefaults");
}

/// A square of 4 by 4 whose first edge has no curve in space.
TopoDS_Face without_spatial_curve(bool marked) {
  const TopoDS_Face face = BRepBuilderAPI_MakeFace(gp_Pln(gp::XOY()), 0, 4, 0, 4).Face();
  const TopoDS_Edge edge = TopoDS::Edge(TopExp_Explorer(face, TopAbs_EDGE).Current());
  const BRep_Builder builder;
  builder.UpdateEdge(edge, Handle(Geom_Curve)(), 1e-7);
  builder.Degenerated(edge, marked);
  return face;
}

TEST(CadModel, EdgesWithoutCurvesInSpaceGetThem) {
  for (const bool marked : {false, true}) {
    const CadModel model(std::make_shared<CadShape>(without_spatial_curve(marked), "square"));
    double length = 0;
    for (const CadEdge& edge : model.shape().edges) {
      EXPECT_FALSE(edge.degenerate);
      length += edge.length;
    }
    EXPECT_NEAR(length, 16, 1e-9) << (marked ? "marked as a point" : "");
    ASSERT_EQ(model.shape().problems.size(), 1U);
    EXPECT_NE(model.shape().problems[0].find("Face1 lacked spatial curves"), std::string::npos);
  }
}

}  // namespace
}  // namespace quadrille
