/// Rings of quads round holes.

#include "mesher/faces/hole_rings.hpp"

#include <gtest/gtest.h>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <TopoDS.hxx>
#include <gp_Ax2.hxx>
#include <gp_Circ.hxx>
#include <gp_Pln.hxx>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/quadrille.hpp"
#include "mesher/settings.hpp"
#include "mesher/shell/validate.hpp"
#include "tests/support/ids.hpp"

namespace quadrille {
namespace {

struct Circle {
  double x, y, radius;
};

CadModel model_of(const TopoDS_Shape& shape) {
  return CadModel(std::make_shared<CadShape>(shape, "part"));
}

/// A plane face of `width` by `height` with round holes.
TopoDS_Shape plate(double width, double height, const std::vector<Circle>& holes) {
  BRepBuilderAPI_MakeFace face(gp_Pln(), 0, width, 0, height);
  for (const Circle& hole : holes) {
    const gp_Ax2 axes(gp_Pnt(hole.x, hole.y, 0), gp_Dir(0, 0, -1));
    face.Add(BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(gp_Circ(axes, hole.radius))).Wire());
  }
  return face.Face();
}

/// A cylinder, bored through across its axis.
TopoDS_Shape bored_cylinder() {
  const TopoDS_Shape bore =
      BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(-30, 0, 30), gp_Dir(1, 0, 0), gp_Dir(0, 0.6, 0.8)), 6, 60)
          .Shape();
  const gp_Ax2 axes(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1), gp_Dir(0, 1, 0));
  return BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(axes, 20, 60).Shape(), bore).Shape();
}

ShellMesh mesh_of(const TopoDS_Shape& shape, double size, int rings,
                  Strategy strategy = Strategy::subdivide) {
  MeshOptions options;
  options.sizing.size = size;
  options.rings = rings;
  options.strategy = strategy;
  ExecutionContext context(1);
  ShellMesh result = mesh(model_of(shape), options, context);
  EXPECT_EQ(validate(result, false), std::vector<std::string>{});
  EXPECT_GT(quality(result).sj_min, 0);
  return result;
}

/// The quads of one face by their sides.
class FaceQuadsBySide {
 public:
  FaceQuadsBySide(const ShellMesh& mesh, int face) : mesh_(mesh) {
    for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
      if (mesh.quad_faces[i] != face) continue;
      for (int k = 0; k < 4; ++k) {
        const int a = mesh.quads[i][k], b = mesh.quads[i][(k + 1) % 4];
        by_side_[std::minmax(a, b)].push_back(static_cast<int>(i));
        ++valence_[a];
      }
    }
  }

  /// Rings of quads between a closed line of nodes and the next such lines, the first with two quads of the
  /// face at each node.
  int rings_round(std::vector<int> line) const {
    for (const int node : line) {
      if (valence_.at(node) != 2) return 0;
    }
    std::set<int> used;
    for (int rings = 0;; ++rings) {
      std::vector<int> next;
      for (std::size_t i = 0; i < line.size(); ++i) {
        const auto across = opposite(line[i], line[(i + 1) % line.size()], used);
        if (!across || (!next.empty() && next.back() != across->first)) return rings;
        if (next.empty()) next.push_back(across->first);
        next.push_back(across->second);
      }
      if (next.front() != next.back()) return rings;
      next.pop_back();
      if (std::set<int>(next.begin(), next.end()).size() != next.size()) return rings;
      line = next;
    }
  }

 private:
  /// Of the quad on a side that was not used yet: the ends of its other side, first that of a.
  std::optional<std::pair<int, int>> opposite(int a, int b, std::set<int>& used) const {
    const auto it = by_side_.find(std::minmax(a, b));
    if (it == by_side_.end()) return std::nullopt;
    for (const int quad : it->second) {
      if (!used.insert(quad).second) continue;
      const auto& q = mesh_.quads[quad];
      for (int k = 0; k < 4; ++k) {
        if (q[k] == a && q[(k + 1) % 4] == b) return std::pair(q[(k + 3) % 4], q[(k + 2) % 4]);
        if (q[k] == b && q[(k + 1) % 4] == a) return std::pair(q[(k + 2) % 4], q[(k + 3) % 4]);
      }
    }
    return std::nullopt;
  }

  const ShellMesh& mesh_;
  std::map<std::pair<int, int>, std::vector<int>> by_side_;
  std::map<int, int> valence_;
};

/// Rings round each hole (wire after the first) of a face that is one closed edge.
std::vector<int> rings_at_holes(const TopoDS_Shape& shape, const ShellMesh& mesh, int face) {
  const FaceQuadsBySide quads(mesh, face);
  const CadModel model = model_of(shape);
  std::vector<int> rings;
  for (const CadWire& wire : model.shape().faces[face_id(face)].wires) {
    if (wire.coedges.size() != 1) continue;
    std::vector<int> line;
    for (const auto& segment : mesh.segments) {
      if (segment.edge == model.shape().edges[wire.coedges[0].edge].number) line.push_back(segment.nodes[0]);
    }
    rings.push_back(quads.rings_round(line));
  }
  return rings;
}

const std::vector<Circle> four_holes{{25, 20, 6}, {75, 20, 6}, {25, 60, 6}, {75, 60, 6}};

TEST(HoleRings, GoRoundEachHoleOfAPlate) {
  const TopoDS_Shape part = plate(100, 80, four_holes);
  for (const Strategy strategy : {Strategy::subdivide, Strategy::direct}) {
    for (const double size : {3.0, 1.3}) {
      const ShellMesh mesh = mesh_of(part, size, 1, strategy);
      const std::vector<int> rings = rings_at_holes(part, mesh, 1);
      ASSERT_EQ(rings.size(), 4U);
      for (const int count : rings) EXPECT_GE(count, 1) << size;
    }
  }
}

TEST(HoleRings, AreAsManyAsAskedFor) {
  const TopoDS_Shape part = plate(100, 80, four_holes);
  for (const int wanted : {2, 3}) {
    for (const int count : rings_at_holes(part, mesh_of(part, 1.3, wanted), 1)) EXPECT_GE(count, wanted);
  }
}

TEST(HoleRings, GoRoundHolesInCurvedFaces) {
  for (const bool splines : {false, true}) {
    const TopoDS_Shape part =
        splines ? BRepBuilderAPI_NurbsConvert(bored_cylinder()).Shape() : bored_cylinder();
    const ShellMesh mesh = mesh_of(part, 3, 1);
    const CadModel model = model_of(part);
    int holes = 0;
    for (int face = 1; face <= model.face_count(); ++face) {
      if (model.shape().faces[face_id(face)].wires.size() != 3)
        continue;  // the wall: its outline and two holes
      for (const int count : rings_at_holes(part, mesh, face)) {
        EXPECT_GE(count, 1) << splines;
        ++holes;
      }
    }
    EXPECT_EQ(holes, 2) << splines;
  }
}

/// The plate of the title picture: rows along its sides, and irregular vertices nowhere but at the corners of
/// the blocks that give way to the holes.
TEST(HoleRings, LieInAGridWhereTheOutlineHasFourCorners) {
  const TopoDS_Shape part = plate(100, 80, four_holes);
  const ShellMesh mesh = mesh_of(part, 3, 1);
  EXPECT_EQ(mesh.faces[0].note, "grid");
  const QualitySummary summary = quality(mesh);
  EXPECT_GT(summary.q_mean, 0.94);
  EXPECT_GT(summary.q_min, 0.7);
  std::map<int, int> valence;
  for (const auto& quad : mesh.quads) {
    for (const int node : quad) ++valence[node];
  }
  for (const auto& segment : mesh.segments) {
    for (const int node : segment.nodes) valence.erase(node);
  }
  std::map<int, int> count;
  for (const auto& [node, quads] : valence) ++count[quads];
  EXPECT_EQ(count.size(), 2U);
  EXPECT_EQ(count[5], 16);
  for (const int rings : rings_at_holes(part, mesh, 1)) EXPECT_GE(rings, 1);
  // The plate is its own mirror image, and the mesh nearly.
  const auto distance_to_mesh = [&](const Vector3& p) {
    double nearest = 1e9;
    for (const Vector3& q : mesh.points) nearest = std::min(nearest, (p - q).norm());
    return nearest;
  };
  for (const Vector3& p : mesh.points) {
    EXPECT_LT(distance_to_mesh({100 - p.x(), p.y(), 0}), 0.5);
    EXPECT_LT(distance_to_mesh({p.x(), 80 - p.y(), 0}), 0.5);
  }
}

TEST(HoleRings, LieInTheGridOfAWall) {
  const TopoDS_Shape part = bored_cylinder();
  const ShellMesh mesh = mesh_of(part, 2, 1);
  int grids = 0;
  for (const auto& face : mesh.faces) {
    if (model_of(part).shape().faces[face_id(face.face)].wires.size() == 3) grids += face.note == "grid";
  }
  EXPECT_EQ(grids, 1);
}

/// Points on a square and on a circle inside it.
FaceBoundary boundary_of(double half_width, const Circle& hole, int segments) {
  FaceBoundary boundary;
  boundary.stride = 1;
  const auto add_loop = [&](const std::vector<Vector2>& loop, double angle) {
    const int first = boundary.size(), n = static_cast<int>(loop.size());
    for (int i = 0; i < n; ++i) {
      boundary.uv.push_back(loop[i]);
      boundary.points.push_back({loop[i].x(), loop[i].y(), 0});
      boundary.nodes.push_back(first + i);
      boundary.angles.push_back(angle);
      FaceBoundary::Segment segment;
      segment.a = first + i;
      segment.b = first + (i + 1) % n;
      boundary.segments.push_back(segment);
    }
  };
  const double w = half_width;
  add_loop({{-w, -w}, {w, -w}, {w, w}, {-w, w}}, M_PI / 2);
  std::vector<Vector2> circle;
  for (int i = 0; i < segments; ++i) {
    const double t = -2 * M_PI * i / segments;
    circle.emplace_back(hole.x + hole.radius * std::cos(t), hole.y + hole.radius * std::sin(t));
  }
  add_loop(circle, M_PI);
  return boundary;
}

HoleRings rings_in_square(double half_width, const Circle& hole, int rings) {
  const TopoDS_Shape face = BRepBuilderAPI_MakeFace(gp_Pln(), -50, 50, -50, 50).Face();
  const FaceSurface surface(model_of(face).shape().faces[face_id(1)]);
  const FaceBoundary boundary = boundary_of(half_width, hole, 12);
  return place_rings(boundary, surface, enclosed_domain(boundary), rings);
}

TEST(HoleRings, LeaveTwoRowsOfEachGap) {
  // The segments are 1.035 long, their rings 0.83 wide where there is room.
  const auto width = [](const HoleRings& rings, int i) {
    return (rings.holes[0].points[12 + i].point - rings.holes[0].points[i].point).norm();
  };
  const HoleRings roomy = rings_in_square(20, {0, 0, 2}, 1);
  ASSERT_EQ(roomy.holes.size(), 1U);
  for (int i = 0; i < 12; ++i) EXPECT_NEAR(width(roomy, i), 0.8 * 4 * std::sin(M_PI / 12), 1e-9);
  const HoleRings near = rings_in_square(4, {0.3, 0, 2}, 1);  // gaps of 1.7 and more
  ASSERT_EQ(near.holes.size(), 1U);
  EXPECT_NEAR(width(near, 0), 1.7 / 3, 1e-9);
  EXPECT_GT(width(near, 6), 0.7);
  EXPECT_TRUE(rings_in_square(3, {0, 0, 2}, 1).holes.empty());
  EXPECT_EQ(rings_in_square(20, {0, 0, 2}, 3).holes[0].points.size(), 48U);
  EXPECT_EQ(rings_in_square(4, {0, 0, 2}, 3).holes[0].points.size(), 36U);
}

TEST(HoleRings, KeepTheCountAndTheNumbersOfTheLoop) {
  const HoleRings rings = rings_in_square(20, {0, 0, 2}, 2);
  ASSERT_EQ(rings.holes.size(), 1U);
  ASSERT_EQ(rings.inside.size(), 16);
  for (int i = 0; i < 12; ++i) {
    EXPECT_EQ(rings.holes[0].nodes[i], 4 + i);
    EXPECT_EQ(rings.inside.nodes[4 + i], HoleRings::node(i));
    EXPECT_EQ(rings.inside.points[4 + i], rings.holes[0].points[24 + i].point);
  }
  for (int i = 0; i < 4; ++i) EXPECT_EQ(rings.inside.nodes[i], i);
}

}  // namespace
}  // namespace quadrille
