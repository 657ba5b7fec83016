/// The last optimization, on every sample model: what it must keep, and what it must reach.

#include "mesher/shell/node_sliding.hpp"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <gp_Pnt.hxx>

#include "geometry/base/threads.hpp"
#include "geometry/surfaces/edge_curve.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/faces/face_chart.hpp"
#include "mesher/quadrille.hpp"
#include "mesher/quads/criteria_patch.hpp"
#include "mesher/shell/face_mesher.hpp"
#include "tests/support/ids.hpp"
#include "tests/support/sample_models.hpp"

namespace quadrille {
namespace {

CadModel plane_polygon(const std::vector<gp_Pnt>& corners) {
  BRepBuilderAPI_MakePolygon wire;
  for (const gp_Pnt& corner : corners) wire.Add(corner);
  wire.Close();
  const TopoDS_Shape face = BRepBuilderAPI_MakeFace(wire.Wire()).Face();
  return CadModel(std::make_shared<CadShape>(face, "polygon"));
}

/// A model's faces, meshed but not yet put together.
struct MeshedFaces {
  CadModel model;
  MeshOptions options;
  BoundaryNodes nodes;
  FaceMeshes faces;

  MeshedFaces(const SampleModel& sample, double divisions, Strategy strategy)
      : model(CadModel::read(sample.path())) {
    options.sizing.size = model.diagonal() / divisions;
    options.strategy = strategy;
    mesh_all(SamplingPlan(shape()));
  }

  /// \param rows segments of the edges shorter than `size`
  MeshedFaces(const CadModel& source, double size, int rows) : model(source) {
    options.sizing.size = size;
    SamplingPlan plan(shape());
    for (const CadEdge& edge : shape().edges) {
      std::optional<PrescribedEdge> prescribed;
      if (edge.length < size) prescribed = PrescribedEdge{.segments = rows, .shares = {}};
      plan.prescribed.push_back(std::move(prescribed));
    }
    mesh_all(plan);
  }

  void mesh_all(const SamplingPlan& plan) {
    ExecutionContext context(1);
    const SizingField field = SizingField::build(model, options.sizing, context);
    const FaceFlags used(shape().faces.size(), 1);
    nodes = sample_edges(shape(), field, stride(options.strategy), used, plan, context);
    for (const FaceId face : shape().faces.ids()) faces.push_back(mesh_of(face, field));
  }

  /// With finer points where the usual ones give no mesh, as on the cone.
  FaceMesh mesh_of(FaceId face, const SizingField& field) const {
    ExecutionContext context(1);
    const FaceChart chart = make_chart(shape(), face, nodes, ChartKind::own);
    try {
      return mesh_face(shape(), face, chart, nodes, field, options, {}, context);
    } catch (const Error&) {
      return mesh_face(shape(), face, chart, nodes, field, options, {.fineness = 2}, context);
    }
  }

  const CadShape& shape() const { return model.shape(); }

  void slide(int threads = 1) {
    ExecutionContext context(threads);
    const EdgeFlags kept(shape().edges.size(), 1);
    on_threads(threads, [&] { slide_nodes(shape(), nodes, faces, kept, options.improve, context); });
  }

  struct Measures {
    double objective = 0, least_sine = 1;
    double worst = 0;
    double turned = 0;  ///< the sum of the largest deviations from right angles, as shares of one
  };

  Measures measure() const {
    Measures result;
    for (const auto& face : faces) {
      for (const auto& [a, b, c, d] : face->quads) {
        const auto& p = face->points;
        const QuadObjective quad = measure_objective(p[a], p[b], p[c], p[d]);
        result.objective += quad.value;
        result.worst = std::max(result.worst, quad.value);
        result.turned += 1 - quad_q(p[a], p[b], p[c], p[d]);
        result.least_sine = std::min(result.least_sine, quad.least_sine);
      }
    }
    return result;
  }
};

template <class Visit>
void for_each_case(Visit&& visit) {
  for (const SampleModel& sample : sample_models()) {
    for (const Strategy strategy : {Strategy::direct, Strategy::subdivide}) {
      for (const double divisions : {12.0, 41.0}) {
        SCOPED_TRACE(sample.name + " at 1/" + std::to_string(divisions));
        MeshedFaces faces(sample, divisions, strategy);
        visit(faces);
      }
    }
  }
}

TEST(NodeSliding, KeepsNodesOnTheirCurvesInOrder) {
  int moved = 0;
  for_each_case([&](MeshedFaces& faces) {
    const BoundaryNodes before = faces.nodes;
    faces.slide();
    for (const int node : before.vertex_nodes) {
      if (node < 0) continue;
      EXPECT_EQ(faces.nodes.points[node], before.points[node]);
    }
    for (const EdgeId i : before.edges.ids()) {
      const auto& edge = faces.nodes.edges[i];
      EXPECT_EQ(edge.nodes, before.edges[i].nodes);
      moved += edge.parameters != before.edges[i].parameters;
      if (faces.shape().edges[i].degenerate || edge.nodes.empty()) continue;
      const EdgeCurve curve(faces.shape().edges[i]);
      for (std::size_t k = 1; k < edge.parameters.size(); ++k) {
        const double sampled = before.edges[i].parameters[k] - before.edges[i].parameters[k - 1];
        const double interval = edge.parameters[k] - edge.parameters[k - 1];
        EXPECT_GT(interval, 0);
        EXPECT_NEAR(interval / sampled, 1, 0.5 + 1e-9);
        if (edge.parameters[k] == before.edges[i].parameters[k]) continue;
        EXPECT_EQ(curve.point(edge.parameters[k]), faces.nodes.points[edge.nodes[k]]);
      }
    }
  });
  EXPECT_GT(moved, 20);
}

TEST(NodeSliding, KeepsNodesOnTheirSurfaces) {
  int moved_inside = 0, moved_on_boundary = 0, mended = 0;
  for_each_case([&](MeshedFaces& faces) {
    const auto before = faces.faces;
    faces.slide();
    const double near = 1e-7 * faces.model.diagonal();
    for (const FaceId i : before.ids()) {
      const FaceMesh& face = *faces.faces[i];
      mended += face.quads != before[i]->quads;
      EXPECT_TRUE(!face.grid || face.quads == before[i]->quads);
      ASSERT_EQ(face.nodes, before[i]->nodes);
      ASSERT_EQ(face.pole.size(), face.points.size());
      const FaceSurface surface(faces.shape().faces[i]);
      for (std::size_t k = 0; k < face.points.size(); ++k) {
        const bool on_boundary = k < face.nodes.size();
        if (on_boundary) {
          EXPECT_EQ(face.points[k], faces.nodes.points[face.nodes[k]]);
        }
        if (k < before[i]->points.size() && face.points[k] == before[i]->points[k]) {
          EXPECT_EQ(face.uv[k], before[i]->uv[k]);
          continue;
        }
        ++(on_boundary ? moved_on_boundary : moved_inside);
        EXPECT_LT((surface.point(face.uv[k]) - face.points[k]).norm(), near);
      }
    }
  });
  EXPECT_GT(moved_inside, 1000);
  EXPECT_GT(moved_on_boundary, 20);
  EXPECT_GT(mended, 0);
}

TEST(NodeSliding, KeepsTheQuadsWithoutCleanUp) {
  for_each_case([&](MeshedFaces& faces) {
    const auto before = faces.faces;
    faces.options.improve.clean_up = false;
    faces.slide();
    for (const FaceId i : before.ids()) EXPECT_EQ(faces.faces[i]->quads, before[i]->quads);
  });
}

TEST(NodeSliding, LowersTheObjectiveAndBreaksNoFloor) {
  constexpr double floor = 0.3;
  for_each_case([&](MeshedFaces& faces) {
    const auto before = faces.measure();
    faces.slide();
    const auto after = faces.measure();
    EXPECT_LE(after.objective, before.objective);
    EXPECT_GE(after.least_sine, std::min(before.least_sine, floor) - 1e-12);
  });
}

/// Corners 10 to 20 degrees off are far inside the limits, and yet are turned.
TEST(NodeSliding, TurnsCornersTowardsRightAngles) {
  double before = 0, after = 0;
  for_each_case([&](MeshedFaces& faces) {
    before += faces.measure().turned;
    faces.slide();
    after += faces.measure().turned;
  });
  EXPECT_LT(after, 0.9 * before) << after / before;
}

TEST(NodeSliding, DoesNotDependOnTheThreads) {
  for (const char* name : {"bracket", "wing"}) {
    const auto& all = sample_models();
    const auto sample = std::find_if(all.begin(), all.end(), [&](const auto& m) { return m.name == name; });
    MeshedFaces one(*sample, 41, Strategy::subdivide), four(*sample, 41, Strategy::subdivide);
    one.slide(1);
    four.slide(4);
    EXPECT_EQ(one.nodes.points, four.nodes.points);
    for (const FaceId i : one.faces.ids()) {
      EXPECT_EQ(one.faces[i]->points, four.faces[i]->points);
      EXPECT_EQ(one.faces[i]->quads, four.faces[i]->quads);
    }
  }
}

TEST(NodeSliding, CanBeTurnedOff) {
  MeshedFaces faces(sample_models().front(), 41, Strategy::subdivide);
  const auto before = faces.nodes.points;
  faces.options.improve.sliding_sweeps = 0;
  faces.slide();
  EXPECT_EQ(faces.nodes.points, before);
}

/// The quad in a corner below 40 degrees is outside the limits whatever its other nodes do. Of those next to
/// it at most two are.
TEST(NodeSliding, LosesThreeQuadsAtMostInASharpCorner) {
  for (const double degrees : {15.0, 25.0, 30.0, 36.0}) {
    const double half = degrees * M_PI / 360;
    const gp_Pnt low(20 * std::cos(half), -20 * std::sin(half), 0), high(low.X(), -low.Y(), 0);
    const CadModel wedge = plane_polygon({{0, 0, 0}, low, high});
    MeshOptions options;
    options.sizing.size = 1;
    ExecutionContext context(1);
    const int failing = check_criteria(mesh(wedge, options, context)).failing;
    EXPECT_TRUE(failing >= 1 && failing <= 3) << degrees << ": " << failing;
  }
}

/// A grid of rectangles, over three times as long as its two rows are wide in the mean.
TEST(NodeSliding, EvensRowsOfWhichSomeAreTooNarrow) {
  MeshedFaces faces(plane_polygon({{0, 0, 0}, {40, 0, 0}, {40, 2, 0}, {0, 2, 0}}), 4, 2);
  FaceMesh& face = *faces.faces[face_id(1)];
  ASSERT_TRUE(face.grid);
  const FaceSurface surface(faces.shape().faces[face_id(1)]);
  for (std::size_t i = face.nodes.size(); i < face.points.size(); ++i) {
    face.points[i].y() = 0.55 + 0.005 * std::abs(face.points[i].x() - 20);
    surface.project(face.uv[i], face.points[i]);
  }
  const auto before = faces.measure();
  EXPECT_GT(before.worst, 1);
  faces.slide();
  EXPECT_LT(faces.measure().worst, 0.6 * before.worst);
}

/// A chamfer whose two sides are spaced differently: what faces meshed one by one cannot mend.
TEST(NodeSliding, StraightensRowsBetweenFacingEdges) {
  const SampleModel& bracket = sample_models().front();
  const CadModel model = CadModel::read(bracket.path());
  std::array<CriteriaSummary, 2> summaries;
  for (const int k : {0, 1}) {
    MeshOptions options;
    options.sizing.size = model.diagonal() / 60;
    if (k == 0) options.improve.sliding_sweeps = 0;
    ExecutionContext context(1);
    const ShellMesh result = mesh(model, options, context);
    EXPECT_TRUE(validate(result, true).empty());
    summaries[k] = check_criteria(result);
  }
  EXPECT_GT(summaries[0].outside, 0);
  EXPECT_LT(summaries[1].outside, 0.5 * summaries[0].outside);
}

}  // namespace
}  // namespace quadrille
