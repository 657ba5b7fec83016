/// Triangles on faces: close to them, turned outwards, tied to faces and edges, and small where wanted.

#include "geometry/surfaces/surface_triangles.hpp"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "geometry/cad/cad_shape.hpp"
#include "geometry/surfaces/face_surface.hpp"

namespace quadrille {
namespace {

constexpr double radius = 5, height = 8, deflection = 0.02;

/// Away from the origin, so that each face counts in the volume.
CadShape cylinder() {
  const gp_Ax2 axes(gp_Pnt(20, 30, -40), gp::DZ());
  return CadShape(BRepPrimAPI_MakeCylinder(axes, radius, height).Shape(), "cylinder");
}

SurfaceTriangles triangles_of(const CadShape& shape, const FaceFlags& used) {
  return triangulate_surface(shape, deflection, 0.5, used, ExecutionContext(1));
}

double volume(const SurfaceTriangles& surface) {
  double six = 0;
  for (const auto& [a, b, c] : surface.triangles)
    six += surface.points[a].dot(surface.points[b].cross(surface.points[c]));
  return six / 6;
}

/// How often each side of each face is run, one direction against the other; conforming faces leave only
/// their boundary, which has as many sides as lines.
std::size_t open_sides(const SurfaceTriangles& surface) {
  std::map<std::pair<int, int>, int> sides;
  for (const auto& triangle : surface.triangles)
    for (int k = 0; k < 3; ++k) {
      const auto [a, b] = std::pair(triangle[k], triangle[(k + 1) % 3]);
      sides[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  return std::count_if(sides.begin(), sides.end(), [](const auto& side) { return side.second != 0; });
}

/// As coplanar faces have that were joined.
TEST(SurfaceTriangles, FacesMayBeOutlinedByEdgesOfOthers) {
  CadShape shape = cylinder();
  FaceFlags used(shape.faces.size(), 0);
  const FaceId side = FaceId::from_number(1);
  used[side] = 1;
  const std::size_t lines = triangles_of(shape, used).lines.size();
  const TopoDS_Edge other = BRepBuilderAPI_MakeEdge(gp_Pnt(0, 0, 0), gp_Pnt(1, 0, 0)).Edge();
  Coedge added = shape.faces[side].wires.front().coedges.front();
  added.source = other;
  shape.faces[side].wires.front().coedges.push_back(added);
  const SurfaceTriangles surface = triangles_of(shape, used);
  EXPECT_TRUE(surface.missing.empty());
  EXPECT_EQ(surface.lines.size(), lines);
}

TEST(SurfaceTriangles, LieOnTheirFacesAndLookOutwards) {
  const CadShape shape = cylinder();
  const SurfaceTriangles surface = triangles_of(shape, FaceFlags(shape.faces.size(), 1));
  EXPECT_NEAR(volume(surface), std::numbers::pi * radius * radius * height,
              2 * std::numbers::pi * radius * height * deflection);
  EXPECT_TRUE(surface.missing.empty());
  EXPECT_TRUE(std::is_sorted(surface.faces.begin(), surface.faces.end()));
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    const FaceSurface face(shape.faces[surface.point_faces[i]]);
    EXPECT_LT((face.point(surface.uv[i]) - surface.points[i]).norm(), 1e-6);
  }
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (const int point : surface.triangles[t]) EXPECT_EQ(surface.point_faces[point], surface.faces[t]);
  EXPECT_EQ(open_sides(surface), surface.lines.size());
  std::map<int, double> lengths;
  for (const auto& line : surface.lines)
    lengths[line.edge] += (surface.points[line.points[1]] - surface.points[line.points[0]]).norm();
  for (const CadEdge& edge : shape.edges)
    EXPECT_NEAR(lengths[edge.number], 2 * edge.length, 0.02 * edge.length);
}

TEST(SurfaceTriangles, AreMadeOfTheUsedFacesOnly) {
  const CadShape shape = cylinder();
  for (const FaceId face : shape.faces.ids()) {
    FaceFlags used(shape.faces.size(), 0);
    used[face] = 1;
    const SurfaceTriangles surface = triangles_of(shape, used);
    EXPECT_FALSE(surface.triangles.empty());
    for (const FaceId of : surface.faces) EXPECT_EQ(of, face);
  }
}

TEST(SurfaceTriangles, AreDividedUntilNoSideIsTooLong) {
  const CadShape shape = cylinder();
  const SurfaceTriangles coarse = triangles_of(shape, FaceFlags(shape.faces.size(), 1));
  const auto wanted = [](FaceId, const Vector3& p) { return 0.3 + 0.1 * (p.z() + 40); };
  SurfaceTriangles fine = coarse;
  divide_sides(fine, wanted, 1000000, ExecutionContext(1));
  for (std::size_t t = 0; t < fine.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const Vector3 &a = fine.points[fine.triangles[t][k]], &b = fine.points[fine.triangles[t][(k + 1) % 3]];
      EXPECT_LE((a - b).norm(), wanted(fine.faces[t], 0.5 * (a + b)));
    }
  EXPECT_EQ(open_sides(fine), fine.lines.size());
  EXPECT_NEAR(volume(fine), volume(coarse), 1e-6);
  SurfaceTriangles few = coarse;
  divide_sides(
      few, [](FaceId, const Vector3&) { return 0.0; }, 2000, ExecutionContext(1));
  EXPECT_GE(few.triangles.size(), 2000U);
  EXPECT_LT(few.triangles.size(), 12000U);
}

}  // namespace
}  // namespace quadrille
