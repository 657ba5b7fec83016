/// Features below the least size that the mesh does without.

#include "mesher/edges/suppressed_features.hpp"

#include <gtest/gtest.h>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <Bnd_Box.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <ShapeFix_ShapeTolerance.hxx>
#include <gp_Ax2.hxx>
#include <gp_Vec.hxx>

#include <algorithm>
#include <array>
#include <memory>
#include <set>
#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/quadrille.hpp"
#include "mesher/shell/validate.hpp"
#include "tests/support/ids.hpp"

namespace quadrille {
namespace {

/// A prism over a polygon in the plane z = 0.
CadModel prism(const std::vector<std::array<double, 2>>& polygon, double height) {
  BRepBuilderAPI_MakePolygon wire;
  for (const auto& [x, y] : polygon) wire.Add(gp_Pnt(x, y, 0));
  wire.Close();
  const TopoDS_Shape solid =
      BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire.Wire()).Face(), gp_Vec(0, 0, height)).Shape();
  return CadModel(std::make_shared<CadShape>(solid, "prism"));
}

/// A block with one edge beveled, `width` from it on both sides.
CadModel beveled_block(double width) {
  return prism({{0, 0}, {60, 0}, {60, 40 - width}, {60 - width, 40}, {0, 40}}, 20);
}

ShellMesh mesh_of(const CadModel& model, double size, bool keep) {
  MeshOptions options;
  options.sizing.size = size;
  options.keep_features = keep;
  ExecutionContext context(1);
  return mesh(model, options, context);
}

int merged_faces(const ShellMesh& mesh) {
  return static_cast<int>(std::count_if(mesh.faces.begin(), mesh.faces.end(),
                                        [](const auto& face) { return face.status == FaceStatus::merged; }));
}

TEST(SuppressedFeatures, GivesABevelBelowTheLeastSizeToItsNeighbors) {
  const CadModel block = beveled_block(0.1);
  const ShellMesh kept = mesh_of(block, 5, true), mesh = mesh_of(block, 5, false);
  EXPECT_EQ(merged_faces(kept), 0);
  EXPECT_TRUE(kept.suppressed_features.empty());
  EXPECT_GT(check_criteria(kept).failing, 0);
  EXPECT_EQ(validate(mesh, true), std::vector<std::string>{});
  EXPECT_EQ(merged_faces(mesh), 1);
  EXPECT_EQ(check_criteria(mesh).failing, 0);
  EXPECT_LT(mesh.quads.size(), kept.quads.size());
  // Both ends of the bevel, one of its sides, a vertex at each end.
  using Kind = ShellMesh::SuppressedFeature::Kind;
  std::vector<std::pair<Kind, Kind>> kinds;
  for (const auto& feature : mesh.suppressed_features) kinds.push_back({feature.kind, feature.to_kind});
  std::sort(kinds.begin(), kinds.end());
  EXPECT_EQ(kinds, (std::vector<std::pair<Kind, Kind>>{{Kind::edge, Kind::edge},
                                                       {Kind::edge, Kind::vertex},
                                                       {Kind::edge, Kind::vertex},
                                                       {Kind::vertex, Kind::vertex},
                                                       {Kind::vertex, Kind::vertex}}));
}

TEST(SuppressedFeatures, KeepsWhatElementsCanShow) {
  EXPECT_EQ(merged_faces(mesh_of(beveled_block(1), 5, false)), 0);
  EXPECT_EQ(merged_faces(mesh_of(beveled_block(0.1), 0.4, false)), 0);
}

/// The floor of a narrow slot, or the rim of a blade, becomes an edge; both walls stay.
TEST(SuppressedFeatures, TapersSlotsAndBlades) {
  constexpr double width = 0.1;
  for (const double depth : {15.0, -15.0}) {
    SCOPED_TRACE(depth);
    const CadModel part = prism({{0, 0},
                                 {60, 0},
                                 {60, 20},
                                 {60 - depth, 20},
                                 {60 - depth, 20 + width},
                                 {60, 20 + width},
                                 {60, 40},
                                 {0, 40}},
                                20);
    const ShellMesh mesh = mesh_of(part, 5, false);
    EXPECT_EQ(validate(mesh, true), std::vector<std::string>{});
    EXPECT_EQ(merged_faces(mesh), 1);
    EXPECT_LT(check_criteria(mesh).failing, check_criteria(mesh_of(part, 5, true)).failing);
  }
}

CadModel model_of(const TopoDS_Shape& shape) {
  return CadModel(std::make_shared<CadShape>(shape, "part"));
}

/// Holes and pins far thinner than elements vanish with their rims; the face goes on over them.
TEST(SuppressedFeatures, ClosesHolesAndPinsThinnerThanElements) {
  const TopoDS_Shape block = BRepPrimAPI_MakeBox(60, 40, 20).Shape();
  const TopoDS_Shape rod = BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(30, 20, -10), gp::DZ()), 0.1, 50).Shape();
  const CadModel drilled = model_of(BRepAlgoAPI_Cut(block, rod).Shape()),
                 pinned = model_of(BRepAlgoAPI_Fuse(block, rod).Shape());
  const std::size_t plain = mesh_of(model_of(block), 5, false).quads.size();
  for (const CadModel* part : {&drilled, &pinned}) {
    const ShellMesh mesh = mesh_of(*part, 5, false);
    EXPECT_EQ(validate(mesh, true), std::vector<std::string>{});
    EXPECT_EQ(merged_faces(mesh), part->face_count() - 6);
    EXPECT_NEAR(static_cast<double>(mesh.quads.size()), static_cast<double>(plain), 0.2 * plain);
    EXPECT_EQ(check_criteria(mesh).failing, 0);
  }
  // A rod by itself is a part.
  const ShellMesh alone = mesh_of(model_of(rod), 5, false);
  EXPECT_EQ(merged_faces(alone), 0);
  EXPECT_EQ(validate(alone, true), std::vector<std::string>{});
}

/// A rib or groove with the same face on both sides leaves an edge inside that face, or nothing.
TEST(SuppressedFeatures, ClosesTheFaceUnderARib) {
  const TopoDS_Shape block = BRepPrimAPI_MakeBox(60, 40, 20).Shape();
  for (const double start : {10.0, -10.0}) {
    SCOPED_TRACE(start);
    const TopoDS_Shape bar = BRepPrimAPI_MakeBox(gp_Pnt(start, 20, 19.9), 30, 0.2, 0.2).Shape();
    for (const TopoDS_Shape& shape :
         {BRepAlgoAPI_Cut(block, bar).Shape(), BRepAlgoAPI_Fuse(block, bar).Shape()}) {
      const CadModel part = model_of(shape);
      if (start < 0 && part.face_count() > 10) continue;  // the bar stands out at the side
      const ShellMesh mesh = mesh_of(part, 5, false);
      for (const auto& kept : mesh.kept) ADD_FAILURE() << kept.number << ": " << kept.why;
      EXPECT_EQ(validate(mesh, true), std::vector<std::string>{});
      EXPECT_EQ(merged_faces(mesh), part.face_count() - 6);
      EXPECT_EQ(check_criteria(mesh).failing, 0);
    }
  }
}

/// A sliver with nothing beside it is the whole part.
/// Both sides of the groove get the same nodes, however far off their own curves the tolerances allow.
TEST(SuppressedFeatures, ClosesAGrooveBetweenTwoHoles) {
  constexpr double width = 0.05;
  TopoDS_Shape part = BRepPrimAPI_MakeBox(40, 30, 10).Shape();
  for (const double x : {12.0, 28.0})
    part = BRepAlgoAPI_Cut(part, BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(x, 15, -1), gp::DZ()), 3, 12).Shape())
               .Shape();
  const gp_Pnt low(12, 15, 10 - width), high(28, 15 + width, 11);
  part = BRepAlgoAPI_Cut(part, BRepPrimAPI_MakeBox(low, high).Shape()).Shape();
  for (const double tolerance : {1e-7, 0.1 * width}) {
    ShapeFix_ShapeTolerance().SetTolerance(part, tolerance);
    const ShellMesh mesh = mesh_of(CadModel(std::make_shared<CadShape>(part, "grooved")), 1.2, false);
    EXPECT_EQ(validate(mesh, true), std::vector<std::string>{});
    EXPECT_EQ(merged_faces(mesh), 3);
    EXPECT_TRUE(mesh.kept.empty());
    EXPECT_LE(check_criteria(mesh).failing, 6);  // beside irregular nodes between the holes
  }
}

TEST(SuppressedFeatures, KeepsAFaceThatStandsAlone) {
  BRepBuilderAPI_MakePolygon wire(gp_Pnt(0, 0, 0), gp_Pnt(60, 0, 0), gp_Pnt(60, 0.1, 0), gp_Pnt(0, 0.1, 0),
                                  true);
  const CadModel band(std::make_shared<CadShape>(BRepBuilderAPI_MakeFace(wire.Wire()).Face(), "band"));
  EXPECT_EQ(merged_faces(mesh_of(band, 5, false)), 0);
}

/// Two half circles that sliver faces join are left as a whole circle: a loop of two edges, but no lens.
TEST(SuppressedFeatures, LeavesACircleOfTwoHalves) {
  constexpr double radius = 3, off = 0.0015;
  const auto half = [&](double y, int side) {
    const gp_Pnt start(side * radius, y, 0), middle(0, y + side * radius, 0), end(-side * radius, y, 0);
    return BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(start, middle, end).Value()).Edge();
  };
  const auto line = [&](double x, double from, double to) {
    return BRepBuilderAPI_MakeEdge(gp_Pnt(x, from, 0), gp_Pnt(x, to, 0)).Edge();
  };
  BRepBuilderAPI_MakeWire wire(half(off, 1), line(-radius, off, 0), half(0, -1), line(radius, 0, off));
  const TopoDS_Shape solid =
      BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire.Wire()).Face(), gp_Vec(0, 0, 1)).Shape();
  const CadModel model(std::make_shared<CadShape>(solid, "halves"));
  ASSERT_EQ(model.face_count(), 6);
  const ShellMesh mesh = mesh_of(model, 1, false);
  EXPECT_EQ(validate(mesh, true), std::vector<std::string>{});
  EXPECT_EQ(merged_faces(mesh), 2);
}

/// A small size by name keeps features where it reaches, and no others.
TEST(SuppressedFeatures, KeepsFeaturesWhereSmallSizesAreNamed) {
  const CadModel block = beveled_block(0.1);
  MeshOptions options;
  options.sizing.size = 5;
  const auto merged_with = [&](int face) {
    options.sizing.face_sizes = {{face, 0.4}};
    ExecutionContext context(1);
    return merged_faces(mesh(block, options, context));
  };
  const ShellMesh mesh = mesh_of(block, 5, false);
  int bevel = 0, far = 0;
  double farthest = 0;
  for (int face = 1; face <= block.face_count(); ++face) {
    if (mesh.faces[face - 1].status == FaceStatus::merged) bevel = face;
  }
  ASSERT_GT(bevel, 0);
  Bnd_Box at;
  BRepBndLib::Add(block.shape().faces[face_id(bevel)].face, at);
  for (int face = 1; face <= block.face_count(); ++face) {
    Bnd_Box box;
    BRepBndLib::Add(block.shape().faces[face_id(face)].face, box);
    if (box.Distance(at) <= farthest) continue;
    farthest = box.Distance(at);
    far = face;
  }
  ASSERT_GT(farthest, 10);
  EXPECT_EQ(merged_with(bevel), 0);
  EXPECT_EQ(merged_with(far), 1);
}

/// What is kept on request is kept with all that hangs together with it.
/// Whichever of the two sides of a bevel is named has nodes of its own, and both if both are named.
TEST(SuppressedFeatures, NamedEdgesBesideOthersKeepTheirNodes) {
  const CadModel block = beveled_block(0.1);
  std::set<int> sides;
  for (const auto& feature : mesh_of(block, 5, false).suppressed_features) {
    using Kind = ShellMesh::SuppressedFeature::Kind;
    if (feature.kind == Kind::edge && feature.to_kind == Kind::edge) sides = {feature.number, feature.to};
  }
  ASSERT_EQ(sides.size(), 2);
  const auto with_nodes = [&](const std::set<int>& kept) {
    MeshOptions options;
    options.sizing.size = 5;
    options.sizing.kept_edges = kept;
    ExecutionContext context(1);
    const ShellMesh found = mesh(block, options, context);
    EXPECT_EQ(validate(found, true), std::vector<std::string>{});
    std::set<int> result;
    for (const auto& segment : found.segments)
      if (sides.contains(segment.edge)) result.insert(segment.edge);
    return result;
  };
  for (const int side : sides) EXPECT_EQ(with_nodes({side}), std::set{side});
  EXPECT_EQ(with_nodes(sides), sides);
}

TEST(SuppressedFeatures, KeepsAroundAFaceOnRequest) {
  const CadModel block = beveled_block(0.1);
  const CadShape& shape = block.shape();
  const FaceFlags used(block.face_count(), 1);
  const EdgeFlags none(shape.edges.size());
  SuppressedFeatures found(shape, used, 0.5, none);
  const TinyFeatures tiny = found.find(0);
  const auto faces = tiny.merged_faces.ids();
  const auto bevel =
      std::find_if(faces.begin(), faces.end(), [&](FaceId face) { return tiny.merged_faces[face] != 0; });
  ASSERT_NE(bevel, faces.end());
  EXPECT_TRUE(found.keep_around(*bevel, {}, tiny));
  const TinyFeatures after = found.find(0);
  EXPECT_EQ(std::count(after.merged_faces.begin(), after.merged_faces.end(), 1), 0);
  EXPECT_EQ(std::count(after.collapsed_edges.begin(), after.collapsed_edges.end(), 1), 0);
  EXPECT_FALSE(found.keep_around(face_id(1), {}, after));
}

}  // namespace
}  // namespace quadrille
