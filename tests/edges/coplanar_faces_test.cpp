/// Coplanar faces become one where the edges between them would force small or poor quads, and nothing else.

#include "mesher/edges/simplified_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/mesh/quad_geometry.hpp"
#include "mesher/quadrille.hpp"
#include "mesher/shell/area_check.hpp"
#include "mesher/shell/validate.hpp"
#include "tests/support/sheet.hpp"

namespace quadrille {
namespace {

using testing::Polygon;
using testing::sheet;

/// A rectangle of triangles around a point inside, `n` on each side.
CadModel fan(int n) {
  std::vector<std::array<double, 2>> rim;
  const std::array<std::array<double, 2>, 4> corners{{{-20, -15}, {20, -15}, {20, 15}, {-20, 15}}};
  for (int side = 0; side < 4; ++side) {
    const auto &from = corners[side], &to = corners[(side + 1) % 4];
    for (int i = 0; i < n; ++i)
      rim.push_back({from[0] + (to[0] - from[0]) * i / n, from[1] + (to[1] - from[1]) * i / n});
  }
  std::vector<Polygon> triangles;
  for (std::size_t i = 0; i < rim.size(); ++i)
    triangles.push_back({{1, 2}, rim[i], rim[(i + 1) % rim.size()]});
  return sheet(triangles);
}

Polygon rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

ShellMesh meshed(const CadModel& model, const MeshOptions& options) {
  ExecutionContext context(1);
  return mesh(model, options, context);
}

MeshOptions with_size(double size) {
  MeshOptions options;
  options.sizing.size = size;
  return options;
}

int faces_with_quads(const ShellMesh& mesh) {
  return static_cast<int>(std::count_if(mesh.faces.begin(), mesh.faces.end(),
                                        [](const ShellMesh::Face& face) { return face.quads > 0; }));
}

/// A square with a square hole of triangles, all of them sharp but for one, which ends in a corner of the
/// hole.
CadModel uneven_ring() {
  const std::array<std::array<double, 2>, 4> hole{{{0, -3}, {3, 0}, {0, 3}, {-3, 0}}};
  const std::array<std::array<double, 2>, 4> rim{{{-20, -20}, {20, -20}, {20, 20}, {-20, 20}}};
  std::vector<Polygon> triangles;
  for (int side = 1; side <= 4; ++side) {
    const int n = side < 4 ? 5 : 1;
    const auto &from = rim[side % 4], &to = rim[(side + 1) % 4], &apex = hole[side % 4];
    for (int i = 0; i < n; ++i) {
      const auto at = [&](int k) {
        return std::array{from[0] + (to[0] - from[0]) * k / n, from[1] + (to[1] - from[1]) * k / n};
      };
      triangles.push_back({apex, at(i), at(i + 1)});
    }
    triangles.push_back({apex, to, hole[(side + 1) % 4]});
  }
  return sheet(triangles);
}

/// An edge between two faces of a fan.
int spoke(const CadModel& model) {
  const auto& edges = model.shape().edges;
  return std::find_if(edges.begin(), edges.end(), [](const CadEdge& edge) { return edge.faces.size() == 2; })
      ->number;
}

TEST(CoplanarFaces, AFanOfTrianglesIsOneFace) {
  const CadModel model = fan(7);
  const ShellMesh mesh = meshed(model, with_size(2));
  EXPECT_EQ(validate(mesh), std::vector<std::string>{});
  EXPECT_TRUE(area_differences(model, mesh).empty());
  EXPECT_EQ(mesh.crossed_edges.size(), 28U);
  EXPECT_EQ(faces_with_quads(mesh), 1);
  for (const ShellMesh::Face& face : mesh.faces) {
    if (face.face == 1) continue;
    EXPECT_EQ(face.status, FaceStatus::merged);
    EXPECT_EQ(face.note, "joined with Face1: coplanar");
  }
  EXPECT_LT(mesh.quads.size(), 1.1 * 40 * 30 / (2 * 2));
  double area = 0;
  for (const auto& quad : mesh.quads) area += quad_area_vector(mesh.points, quad).z();
  EXPECT_NEAR(std::abs(area), 40 * 30, 1e-6) << "all quads look the same way";
}

TEST(CoplanarFaces, NoOutlineTouchesItself) {
  const CadModel model = uneven_ring();
  const ShellMesh mesh = meshed(model, with_size(2));
  EXPECT_EQ(validate(mesh), std::vector<std::string>{});
  EXPECT_TRUE(area_differences(model, mesh).empty());
  EXPECT_EQ(faces_with_quads(mesh), 1);
}

TEST(CoplanarFaces, WhatUsersNameStays) {
  const CadModel model = fan(7);
  const int edge = spoke(model);
  const auto is_left = [&](const MeshOptions& options) {
    const ShellMesh mesh = meshed(model, options);
    EXPECT_EQ(validate(mesh), std::vector<std::string>{});
    EXPECT_TRUE(area_differences(model, mesh).empty());
    return std::any_of(mesh.segments.begin(), mesh.segments.end(),
                       [&](const auto& segment) { return segment.edge == edge; });
  };
  EXPECT_FALSE(is_left(with_size(2)));
  MeshOptions options = with_size(2);
  options.sizing.kept_edges = {edge};
  EXPECT_TRUE(is_left(options));
  options = with_size(2);
  options.sizing.edge_sizes[edge] = 1;
  EXPECT_TRUE(is_left(options));
  options = with_size(2);
  options.sizing.face_sizes[7] = 2;
  EXPECT_EQ(faces_with_quads(meshed(model, options)), 2);
  options = with_size(2);
  options.keep_features = true;
  EXPECT_TRUE(is_left(options));
}

TEST(CoplanarFaces, APlaceInsideTheJoinedFaceGetsItsNode) {
  MeshOptions options = with_size(2);
  options.sizing.nodes = {{"Load", {1, 2, 0}}, {"Point", {5, 5, 0}}};
  const ShellMesh mesh = meshed(fan(7), options);
  EXPECT_EQ(validate(mesh), std::vector<std::string>{});
  for (const auto& place : options.sizing.nodes)
    EXPECT_TRUE(std::any_of(mesh.points.begin(), mesh.points.end(), [&](const Vector3& p) {
      return (p - place.point).norm() < 1e-6;
    })) << place.name;
}

TEST(CoplanarFaces, AFewFacesAreAPartitionThatStays) {
  const auto faces_left = [](const std::vector<Polygon>& polygons, double size) {
    return faces_with_quads(meshed(sheet(polygons), with_size(size)));
  };
  EXPECT_EQ(faces_left({rectangle(0, 0, 20, 20), rectangle(20, 0, 40, 20)}, 2), 2);
  EXPECT_EQ(faces_left({rectangle(0, 0, 20, 20), rectangle(20, 0, 21, 20), rectangle(21, 0, 41, 20)}, 2), 3);
  EXPECT_EQ(faces_left({{{0, 0}, {20, 5}, {0, 10}},
                        {{0, 0}, {0, -20}, {20, -20}, {20, 5}},
                        {{0, 10}, {20, 5}, {20, 30}, {0, 30}}},
                       1),
            3);
}

TEST(CoplanarFaces, AJoinedFaceKeepsItsHole) {
  const CadModel model = sheet({rectangle(0, 0, 20, 1), rectangle(19, 1, 20, 20), rectangle(0, 19, 19, 20),
                                rectangle(0, 1, 1, 19), rectangle(1, 1, 5, 19), rectangle(15, 1, 19, 19),
                                rectangle(5, 1, 15, 5), rectangle(5, 15, 15, 19)});
  const ShellMesh mesh = meshed(model, with_size(2));
  EXPECT_EQ(validate(mesh), std::vector<std::string>{});
  EXPECT_TRUE(area_differences(model, mesh).empty());
  double area = 0;
  for (const auto& quad : mesh.quads) area += quad_area_vector(mesh.points, quad).norm();
  EXPECT_NEAR(area, 20 * 20 - 10 * 10, 1e-6);
}

}  // namespace
}  // namespace quadrille
