/// Edges whose division users prescribe: they get it, their chords too, and the mesh stays all-quad.

#include "geometry/sizing/edge_spacing.hpp"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "geometry/cad/cad_shape.hpp"
#include "geometry/surfaces/edge_curve.hpp"
#include "mesher/quadrille.hpp"
#include "tests/models/trouble_models.hpp"
#include "tests/support/ids.hpp"
#include "tests/support/sample_models.hpp"

namespace quadrille {
namespace {

CadModel sample(const std::string& name) {
  return CadModel::read(sample_model(name).path());
}

/// Lengths of the segments on each CAD edge (from 1), in the edge's direction.
std::map<int, std::vector<double>> segments_of(const CadModel& model, const ShellMesh& mesh) {
  std::map<int, std::vector<double>> result;
  for (int edge = 1; edge <= model.edge_count(); ++edge) {
    const EdgeCurve curve(model.shape().edges[edge_id(edge)]);
    const Vector3 start = curve.point(model.shape().edges[edge_id(edge)].first);
    std::vector<Vector3> chain;
    for (const auto& segment : mesh.segments) {
      if (segment.edge != edge) continue;
      for (const int node : {segment.nodes[0], segment.nodes[1]}) {
        const Vector3& p = mesh.points[node];
        if (std::find(chain.begin(), chain.end(), p) == chain.end()) chain.push_back(p);
      }
    }
    std::sort(chain.begin(), chain.end(),
              [&](const Vector3& a, const Vector3& b) { return (a - start).norm() < (b - start).norm(); });
    for (std::size_t i = 0; i + 1 < chain.size(); ++i)
      result[edge].push_back((chain[i + 1] - chain[i]).norm());
  }
  return result;
}

ShellMesh mesh_with(const CadModel& model, const std::map<int, EdgeSpacing>& spacings,
                    Strategy strategy = Strategy::subdivide) {
  MeshOptions options;
  options.sizing.size = 2;
  options.sizing.spacings = spacings;
  options.strategy = strategy;
  ExecutionContext context(1);
  return mesh(model, options, context);
}

TEST(EdgeSpacing, NumbersAreKeptByEdgesAndTheirChords) {
  const CadModel box = sample("box");
  for (const Strategy strategy : {Strategy::subdivide, Strategy::direct}) {
    for (const int n : {4, 7, 20, 31}) {
      SCOPED_TRACE(n);
      const ShellMesh mesh = mesh_with(box, {{4, {n, 1, 1}}}, strategy);
      const auto segments = segments_of(box, mesh);
      EXPECT_EQ(segments.at(4).size(), n);
      const double length = box.shape().edges[edge_id(4)].length;
      int alike = 0;
      for (int edge = 1; edge <= 12; ++edge)
        alike += std::abs(box.shape().edges[edge_id(edge)].length - length) < 1e-6 &&
                 segments.at(edge).size() == static_cast<std::size_t>(n);
      EXPECT_EQ(alike, 4);
    }
  }
}

TEST(EdgeSpacing, SegmentsFollowEachOtherByTheirBias) {
  const CadModel box = sample("box");
  const auto segments = segments_of(box, mesh_with(box, {{4, {12, 1.25, 1}}, {1, {0, 1, 1.5}}}));
  const auto& one = segments.at(4);
  ASSERT_EQ(one.size(), 12u);
  for (std::size_t i = 0; i + 1 < one.size(); ++i) EXPECT_NEAR(one[i + 1] / one[i], 1.25, 1e-6);
  int alike = 0;  // the edges that run along it, in whichever direction
  for (const auto& [edge, lengths] : segments) {
    if (std::abs(box.shape().edges[edge_id(edge)].length - box.shape().edges[edge_id(4)].length) > 1e-6)
      continue;
    ASSERT_EQ(lengths.size(), 12u);
    EXPECT_NEAR(std::max(lengths[1] / lengths[0], lengths[0] / lengths[1]), 1.25, 1e-6);
    ++alike;
  }
  EXPECT_EQ(alike, 4);
  const auto& both = segments.at(1);
  ASSERT_GE(both.size(), 4u);
  for (std::size_t i = 0; 2 * (i + 1) < both.size(); ++i) {
    EXPECT_NEAR(both[i + 1] / both[i], 1.5, 1e-6);
    EXPECT_NEAR(both[i], both[both.size() - 1 - i], 1e-6);
  }
}

/// A face of a square of 10 by 10, whose edges are 1 to 4 along its wire.
CadModel square() {
  const auto corner = [](double x, double y) { return gp_Pnt(x, y, 0); };
  BRepBuilderAPI_MakePolygon sides(corner(0, 0), corner(10, 0), corner(10, 10), corner(0, 10), true);
  return CadModel(std::make_shared<CadShape>(BRepBuilderAPI_MakeFace(sides.Wire(), true).Shape(), "square"));
}

/// Opposite edges have equal numbers, odd or even, and each keeps its own ratio: lines of a grid join them.
TEST(EdgeSpacing, OppositeBiasedEdgesMakeAGrid) {
  const CadModel model = square();
  const auto& wire = model.shape().faces[face_id(1)].wires[0].coedges;
  const int one = wire[0].edge.number(), facing = wire[2].edge.number(), across = wire[1].edge.number();
  for (const Strategy strategy : {Strategy::subdivide, Strategy::direct}) {
    for (const int n : {7, 8, 9}) {
      SCOPED_TRACE(n);
      const ShellMesh mesh =
          mesh_with(model, {{one, {n, 1.3, 1}}, {facing, {0, 1, 1.2}}, {across, {0, 1.1, 1}}}, strategy);
      const auto segments = segments_of(model, mesh);
      ASSERT_EQ(segments.at(one).size(), n);
      ASSERT_EQ(segments.at(facing).size(), n);
      EXPECT_EQ(mesh.quads.size(), n * segments.at(across).size());
      EXPECT_EQ(quality(mesh).irregular_percent, 0);
      EXPECT_NEAR(segments.at(one)[1] / segments.at(one)[0], 1.3, 1e-6);
      EXPECT_NEAR(segments.at(across)[1] / segments.at(across)[0], 1.1, 1e-6);
      const auto& both = segments.at(facing);
      EXPECT_NEAR(both[1] / both[0], 1.2, 1e-6);
      EXPECT_NEAR(both[n - 2] / both[n - 1], 1.2, 1e-6);
    }
  }
}

/// Edges elsewhere take what keeps all faces even; every number asked for is kept.
TEST(EdgeSpacing, AnyNumbersGiveAnAllQuadMesh) {
  const CadModel bracket = sample("bracket");
  int kept = 0;
  for (int edge = 1; edge <= bracket.edge_count(); edge += 3) {
    if (bracket.shape().edges[edge_id(edge)].degenerate) continue;
    const ShellMesh mesh = mesh_with(bracket, {{edge, {12, 1, 1}}});
    EXPECT_TRUE(mesh.triangles.empty());
    const auto segments = segments_of(bracket, mesh);
    int count = 0;
    for (const auto& segment : mesh.segments) count += segment.edge == edge;
    EXPECT_EQ(count, 12) << edge;
    ++kept;
  }
  EXPECT_GT(kept, 10);
}

TEST(EdgeSpacing, ContradictionsAreRefusedByName) {
  // A disc: one loop of one edge.
  const CadModel cylinder = sample("cylinder");
  int circle = 0;
  for (const CadEdge& edge : cylinder.shape().edges) {
    if (edge.closed()) circle = edge.number;
  }
  const auto refused = [&](const CadModel& model, const std::map<int, EdgeSpacing>& spacings,
                           Strategy strategy, const std::string& part) {
    try {
      mesh_with(model, spacings, strategy);
      ADD_FAILURE() << "no error that says " << part;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), Error::Kind::usage) << error.what();
      EXPECT_EQ(error.subject(), "segments");
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  const std::string name = "Edge" + std::to_string(circle);
  refused(cylinder, {{circle, {2, 1, 1}}}, Strategy::direct, name);
  refused(cylinder, {{circle, {13, 1, 1}}}, Strategy::subdivide, name);
  refused(cylinder, {{circle, {13, 1, 1}}}, Strategy::direct, name);
  // All four sides of a face of the box, which then has an odd boundary.
  const CadModel box = sample("box");
  std::map<int, EdgeSpacing> all;
  int n = 10;
  for (const Coedge& coedge : box.shape().faces[face_id(1)].wires[0].coedges)
    all[coedge.edge.number()] = {n++, 1, 1};
  all.begin()->second.segments += 1;
  refused(box, all, Strategy::direct, "Face1");
}

TEST(EdgeSpacing, PiecesOfAnEdgeShareItsNumber) {
  PrescribedEdge even{4, {}};
  EXPECT_DOUBLE_EQ(even.size_at(0.9, 8), 2);
  PrescribedEdge biased{2, {0, 0.25, 1}};
  EXPECT_DOUBLE_EQ(biased.size_at(0.1, 8), 2);
  EXPECT_DOUBLE_EQ(biased.size_at(0.5, 8), 6);
  EXPECT_DOUBLE_EQ(biased.size_at(1, 8), 6);
}

/// The pieces of an edge that a seam divides have ids that no user knows.
TEST(EdgeSpacing, APieceIsNamedAsItsEdge) {
  const auto& all = trouble_models();
  const auto side =
      std::find_if(all.begin(), all.end(), [](const auto& trouble) { return trouble.name == "no_seam"; });
  const CadModel model(std::make_shared<CadShape>(side->make(), side->name));
  try {
    mesh_with(model, {{2, {15, 1, 1}}}, Strategy::direct);
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("on one of Edge2"), std::string::npos) << error.what();
    EXPECT_EQ(std::string(error.what()).find(','), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace quadrille
