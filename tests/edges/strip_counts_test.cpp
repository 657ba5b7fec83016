/// Counts along faces narrower than the size.

#include "mesher/edges/strip_counts.hpp"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <GC_MakeArcOfCircle.hxx>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "mesher/quadrille.hpp"
#include "mesher/shell/validate.hpp"
#include "tests/support/sheet.hpp"

namespace quadrille {
namespace {

ShellMesh mesh_of_plate(double thickness, double size) {
  const CadModel plate(std::make_shared<CadShape>(BRepPrimAPI_MakeBox(60, 40, thickness).Shape(), "plate"));
  MeshOptions options;
  options.sizing.size = size;
  options.sizing.growth = 2;  // sizes near the short edges do not reach far
  ExecutionContext context(1);
  return mesh(plate, options, context);
}

TEST(StripCounts, KeepsTheQuadsOfAThinRimWithinTheLimits) {
  for (const double thickness : {0.9, 0.7, 0.5}) {
    const ShellMesh mesh = mesh_of_plate(thickness, 5);
    EXPECT_EQ(validate(mesh, true), std::vector<std::string>{});
    // A few beside irregular vertices of the large faces may fail; where rims keep the size, dozens do.
    EXPECT_LE(check_criteria(mesh).failing, 3) << thickness;
  }
}

/// A sheet with a bend of 90 degrees between two flanges, `length` long.
CadModel bent_sheet(double radius, double flange, double length) {
  const double c = radius * (1 - std::sqrt(0.5));
  BRepBuilderAPI_MakeWire profile;
  profile.Add(BRepBuilderAPI_MakeEdge(gp_Pnt(0, 0, radius + flange), gp_Pnt(0, 0, radius)));
  profile.Add(BRepBuilderAPI_MakeEdge(
      GC_MakeArcOfCircle(gp_Pnt(0, 0, radius), gp_Pnt(c, 0, c), gp_Pnt(radius, 0, 0)).Value()));
  profile.Add(BRepBuilderAPI_MakeEdge(gp_Pnt(radius, 0, 0), gp_Pnt(radius + flange, 0, 0)));
  return CadModel(std::make_shared<CadShape>(
      BRepPrimAPI_MakePrism(profile.Wire(), gp_Vec(0, length, 0)).Shape(), "sheet"));
}

double largest_aspect(const ShellMesh& mesh) {
  double largest = 0;
  for (const auto& quad : mesh.quads) {
    std::array<double, 4> sides{};
    for (int k = 0; k < 4; ++k) sides[k] = (mesh.points[quad[(k + 1) % 4]] - mesh.points[quad[k]]).norm();
    const auto [low, high] = std::minmax_element(sides.begin(), sides.end());
    largest = std::max(largest, *high / *low);
  }
  return largest;
}

/// A bend has the rows that its curvature asks for, and quads as long as the size: the sheet has about as
/// many quads as its area over the square of the size. With an aspect of 1 the bend takes squares of its own.
TEST(StripCounts, BendsHaveRowsOfLongQuads) {
  constexpr double radius = 5.5, flange = 60, length = 200, size = 8;
  const CadModel sheet = bent_sheet(radius, flange, length);
  const double area = length * (2 * flange + 0.5 * M_PI * radius);
  MeshOptions options;
  options.sizing.size = size;
  ExecutionContext context(1);
  const ShellMesh mesh = quadrille::mesh(sheet, options, context);
  EXPECT_EQ(validate(mesh, false), std::vector<std::string>{});
  EXPECT_LT(mesh.quads.size(), 1.3 * area / (size * size));
  EXPECT_LE(largest_aspect(mesh), 5);
  const auto in_bend = std::count_if(mesh.quads.begin(), mesh.quads.end(), [&](const auto& quad) {
    return (mesh.points[quad[0]] + mesh.points[quad[2]]).x() < 2 * radius - 1e-6 &&
           (mesh.points[quad[0]] + mesh.points[quad[2]]).z() < 2 * radius - 1e-6;
  });
  EXPECT_EQ(in_bend % 25, 0);  // rows over the whole length
  EXPECT_GE(in_bend, 3 * 25);  // a quarter of the twelve elements on a circle
  options.sizing.aspect = 1;
  EXPECT_GT(quadrille::mesh(sheet, options, context).quads.size(), 1.5 * area / (size * size));
}

/// A bend whose arc has room for one segment and a half of the least size gets one row.
TEST(StripCounts, RowsOfABendAreNotBelowTheLeastSize) {
  for (const double radius : {2.2, 2.5, 3.2, 4.5}) {
    MeshOptions options;
    options.sizing.size = 8;
    options.sizing.size_min = 2;
    ExecutionContext context(1);
    const ShellMesh mesh = quadrille::mesh(bent_sheet(radius, 40, 120), options, context);
    for (const auto& quad : mesh.quads)
      for (int k = 0; k < 4; ++k)
        EXPECT_GE((mesh.points[quad[(k + 1) % 4]] - mesh.points[quad[k]]).norm(), 0.95 * 2) << radius;
  }
}

/// One half of a flat bar that gets narrower in a quarter arc.
CadModel bar_with_shoulder(double radius) {
  const double x = 60, y = 20, c = radius * (1 - std::sqrt(0.5));
  BRepBuilderAPI_MakeWire outline;
  const auto line = [&](const gp_Pnt& from, const gp_Pnt& to) {
    outline.Add(BRepBuilderAPI_MakeEdge(from, to));
  };
  outline.Add(BRepBuilderAPI_MakeEdge(
      GC_MakeArcOfCircle(gp_Pnt(x, y + radius, 0), gp_Pnt(x + c, y + c, 0), gp_Pnt(x + radius, y, 0))
          .Value()));
  line({x + radius, y, 0}, {2 * x, y, 0});
  line({2 * x, y, 0}, {2 * x, 0, 0});
  line({2 * x, 0, 0}, {0, 0, 0});
  line({0, 0, 0}, {0, y + 5, 0});
  line({0, y + 5, 0}, {x, y + 5, 0});
  line({x, y + 5, 0}, {x, y + radius, 0});
  return CadModel(std::make_shared<CadShape>(BRepBuilderAPI_MakeFace(outline.Wire()).Shape(), "bar"));
}

/// The stress on an arc depends on its segments: a quarter turn with room for three of the default least size
/// gets four of them, but two if users give that size.
TEST(StripCounts, OnlyALeastSizeOfUsersTakesSegmentsFromArcs) {
  MeshOptions options;
  options.sizing.size = 8;
  const auto segments_on_arc = [&] {
    ExecutionContext context(1);
    const ShellMesh mesh = quadrille::mesh(bar_with_shoulder(2), options, context);
    return std::count_if(mesh.segments.begin(), mesh.segments.end(), [&](const ShellMesh::Segment& segment) {
      const Vector3 middle = 0.5 * (mesh.points[segment.nodes[0]] + mesh.points[segment.nodes[1]]);
      return middle.x() > 60 && middle.x() < 62 && middle.y() > 20 && middle.y() < 22;
    });
  };
  EXPECT_EQ(segments_on_arc(), 4);
  options.sizing.size_min = 1;
  EXPECT_EQ(segments_on_arc(), 2);
}

/// However narrow a strip is, as long as it is not below the reach.
TEST(StripCounts, NoQuadOfAStripIsTooLong) {
  for (const double width : {0.6, 0.8, 1.3, 2.1, 3.4, 5.5}) {
    const CadModel sheet =
        testing::sheet({{{0, 0}, {60, 0}, {60, width}, {0, width}}, {{0, 0}, {60, 0}, {60, -30}, {0, -30}}});
    MeshOptions options;
    options.sizing.size = 5;
    ExecutionContext context(1);
    const ShellMesh mesh = quadrille::mesh(sheet, options, context);
    EXPECT_LE(largest_aspect(mesh), 5) << width;
  }
}

/// A strip may be narrower in the middle than at its ends: there its rows are.
TEST(StripCounts, NoQuadOfAWaistIsTooLong) {
  for (const double width : {1.0, 1.5, 2.0}) {
    const double waist = 0.6 * width;
    const CadModel sheet = testing::sheet(
        {{{0, 0}, {30, waist}, {60, 0}, {60, 2 * width}, {30, 0.8 * width + waist}, {0, 2 * width}},
         {{0, 0}, {30, waist}, {60, 0}, {60, -30}, {0, -30}}});
    MeshOptions options;
    options.sizing.size = 5;
    ExecutionContext context(1);
    EXPECT_LE(largest_aspect(quadrille::mesh(sheet, options, context)), 5) << width;
  }
}

TEST(StripCounts, RaisesATableWhereItIsLow) {
  CountTable table{{0, 1, 2}, {0, 4, 5}, {0, 10, 20}, 0};
  table.raise_to(0.3);
  EXPECT_DOUBLE_EQ(table.counts[1], 4);
  EXPECT_DOUBLE_EQ(table.total(), 7);
}

}  // namespace
}  // namespace quadrille
