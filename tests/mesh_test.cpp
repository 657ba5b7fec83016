/// The whole way from CAD to quads, on every sample model.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRep_Tool.hxx>
#include <GeomAPI_ProjectPointOnSurf.hxx>
#include <Geom_Surface.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/quadrille.hpp"
#include "tests/support/ids.hpp"
#include "tests/support/sample_models.hpp"

namespace quadrille {
namespace {

MeshOptions options_for(const CadModel& model, double divisions) {
  MeshOptions options;
  options.sizing.size = model.diagonal() / divisions;
  return options;
}

ShellMesh mesh_of(const CadModel& model, const MeshOptions& options, int threads = 1) {
  ExecutionContext context(threads);
  return mesh(model, options, context);
}

double mesh_area(const ShellMesh& mesh) {
  double sum = 0;
  for (const auto& quad : mesh.quads) {
    const auto& p = mesh.points;
    sum += 0.5 * (p[quad[2]] - p[quad[0]]).cross(p[quad[3]] - p[quad[1]]).norm();
  }
  return sum;
}

double distance_to(const TopoDS_Shape& shape, const Vector3& p) {
  const BRepExtrema_DistShapeShape distance(BRepBuilderAPI_MakeVertex(gp_Pnt(p.x(), p.y(), p.z())), shape);
  return distance.Value();
}

std::string joined(const std::vector<std::string>& lines) {
  std::string result;
  for (const auto& line : lines) result += line + "\n";
  return result;
}

class EverySample : public testing::TestWithParam<std::tuple<SampleModel, Strategy, int>> {};

TEST_P(EverySample, IsValidAtSeveralSizes) {
  const auto& [sample, strategy, order] = GetParam();
  const CadModel model = CadModel::read(sample.path());
  for (const double divisions : {8.0, 20.0, 45.0}) {
    SCOPED_TRACE(divisions);
    MeshOptions options = options_for(model, divisions);
    options.strategy = strategy;
    options.order = order;
    const ShellMesh mesh = mesh_of(model, options);
    EXPECT_EQ(joined(validate(mesh, sample.closed)), "");
    EXPECT_TRUE(mesh.triangles.empty());
    const std::set<int> faces(mesh.quad_faces.begin(), mesh.quad_faces.end());
    EXPECT_EQ(static_cast<int>(faces.size()), sample.faces);
    EXPECT_EQ(static_cast<int>(mesh.corners.size()), sample.vertices);
    EXPECT_NEAR(mesh_area(mesh) / sample.area, 1, divisions > 10 ? 0.02 : 0.075);
  }
}

std::string sample_name(const testing::TestParamInfo<EverySample::ParamType>& info) {
  const auto& [sample, strategy, order] = info.param;
  return sample.name + (strategy == Strategy::direct ? "_direct" : "_subdivide") + "_order" +
         std::to_string(order);
}

INSTANTIATE_TEST_SUITE_P(Mesh, EverySample,
                         testing::Combine(testing::ValuesIn(sample_models()),
                                          testing::Values(Strategy::direct, Strategy::subdivide),
                                          testing::Values(1, 2)),
                         sample_name);

TEST(Mesh, NodesLieOnTheGeometry) {
  for (const SampleModel& sample : sample_models()) {
    SCOPED_TRACE(sample.name);
    const CadModel model = CadModel::read(sample.path());
    MeshOptions options = options_for(model, 15);
    options.order = 2;
    const ShellMesh mesh = mesh_of(model, options);
    const double tolerance = 2e-7 * model.diagonal();
    const std::size_t stride = mesh.quads.size() / 40 + 1;
    for (std::size_t i = 0; i < mesh.quads.size(); i += stride) {
      // Where quads cross smooth edges, nodes lie on one of the faces that are taken as one.
      std::set<int> faces{mesh.quad_faces[i]};
      for (std::size_t before = 0; before != faces.size();) {
        before = faces.size();
        for (const auto& edge : mesh.crossed_edges) {
          if (faces.contains(edge.faces[0]) || faces.contains(edge.faces[1]))
            faces.insert(edge.faces.begin(), edge.faces.end());
        }
      }
      const auto distance = [&](const Vector3& point) {
        double least = std::numeric_limits<double>::infinity();
        for (const int face : faces)
          least = std::min(least, distance_to(model.shape().faces[face_id(face)].face, point));
        return least;
      };
      for (int k = 0; k < 4; ++k) {
        EXPECT_LT(distance(mesh.points[mesh.quads[i][k]]), tolerance);
        EXPECT_LT(distance(mesh.points[mesh.midsides[i][k]]), tolerance);
      }
    }
    for (const auto& segment : mesh.segments) {
      const auto& edge = model.shape().edges[edge_id(segment.edge)].edge;
      EXPECT_LT(distance_to(edge, mesh.points[segment.middle]), tolerance);
    }
    for (const auto& corner : mesh.corners) {
      EXPECT_LT((mesh.points[corner.node] - model.shape().vertices[vertex_id(corner.vertex)]).norm(),
                tolerance);
    }
  }
}

TEST(Mesh, NormalsFollowTheFaces) {
  // Outward on every solid: the enclosed volume, by the divergence theorem, is positive.
  const auto solids = sample_models_where([](const SampleModel& m) { return m.closed && m.solids == 1; });
  ASSERT_FALSE(solids.empty());
  for (const SampleModel& sample : solids) {
    SCOPED_TRACE(sample.name);
    const CadModel model = CadModel::read(sample.path());
    const ShellMesh mesh = mesh_of(model, options_for(model, 20));
    double volume = 0;
    for (const auto& q : mesh.quads) {
      const auto& p = mesh.points;
      volume += p[q[0]].dot(p[q[1]].cross(p[q[2]])) / 6 + p[q[0]].dot(p[q[2]].cross(p[q[3]])) / 6;
    }
    EXPECT_GT(volume, 0);
  }
}

/// The normal of a face, as the model uses it, at the point of its surface next to `p`.
Vector3 face_normal(const TopoDS_Face& face, const Vector3& p) {
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  GeomAPI_ProjectPointOnSurf projection(gp_Pnt(p.x(), p.y(), p.z()), surface);
  double u = 0, v = 0;
  projection.LowerDistanceParameters(u, v);
  gp_Pnt point;
  gp_Vec du, dv;
  surface->D1(u, v, point, du, dv);
  const gp_Vec normal = du.Crossed(dv) * (face.Orientation() == TopAbs_REVERSED ? -1 : 1);
  return {normal.X(), normal.Y(), normal.Z()};
}

TEST(Mesh, EveryQuadLooksAsItsFaceDoes) {
  for (const SampleModel& sample : sample_models()) {
    SCOPED_TRACE(sample.name);
    const CadModel model = CadModel::read(sample.path());
    TopTools_IndexedMapOfShape faces;
    TopExp::MapShapes(model.shape().shape, TopAbs_FACE, faces);
    const ShellMesh mesh = mesh_of(model, options_for(model, 20));
    const auto& p = mesh.points;
    for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
      const auto& q = mesh.quads[i];
      const Vector3 normal = (p[q[2]] - p[q[0]]).cross(p[q[3]] - p[q[1]]),
                    center = 0.25 * (p[q[0]] + p[q[1]] + p[q[2]] + p[q[3]]);
      EXPECT_GT(normal.dot(face_normal(TopoDS::Face(faces(mesh.quad_faces[i])), center)), 0)
          << "quad " << i << " of Face" << mesh.quad_faces[i];
    }
  }
}

/// The one midside node of every segment of every CAD edge: on the edge, as far from both ends, and the same
/// in all elements there.
TEST(Mesh, MidsideNodesLieHalfwayOnEveryEdge) {
  for (const SampleModel& sample : sample_models()) {
    SCOPED_TRACE(sample.name);
    const CadModel model = CadModel::read(sample.path());
    MeshOptions options = options_for(model, 12);
    options.order = 2;
    const ShellMesh mesh = mesh_of(model, options);
    std::map<std::pair<int, int>, std::set<int>> middles;
    for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
      for (int k = 0; k < 4; ++k)
        middles[std::minmax({mesh.quads[i][k], mesh.quads[i][(k + 1) % 4]})].insert(mesh.midsides[i][k]);
    }
    std::set<int> edges;
    for (const auto& segment : mesh.segments) {
      SCOPED_TRACE(fmt::format("Edge{}, node {}", segment.edge, segment.middle));
      edges.insert(segment.edge);
      const Vector3 &a = mesh.points[segment.nodes[0]], &b = mesh.points[segment.nodes[1]],
                    &middle = mesh.points[segment.middle];
      EXPECT_EQ(middles.at(std::minmax({segment.nodes[0], segment.nodes[1]})), std::set<int>{segment.middle});
      EXPECT_LT(distance_to(model.shape().edges[edge_id(segment.edge)].edge, middle),
                2e-7 * model.diagonal());
      EXPECT_NEAR((middle - a).norm(), (middle - b).norm(), 1e-6 * (b - a).norm());
      // On this piece of the edge: another one as far from both ends is further away.
      EXPECT_LT((middle - a).norm(), 0.8 * (b - a).norm());
    }
    EXPECT_GE(static_cast<int>(edges.size()), 1);
    for (const auto& [side, nodes] : middles) EXPECT_EQ(nodes.size(), 1u);
  }
}

/// Floors under what README says of the meshes, on the project's own models.
TEST(Mesh, IsAsGoodAsItWas) {
  double q = 0, irregular = 0, quads = 0;
  std::vector<double> worst;
  for (const SampleModel& sample : sample_models()) {
    SCOPED_TRACE(sample.name);
    const CadModel model = CadModel::read(sample.path());
    const ShellMesh mesh = mesh_of(model, options_for(model, 60));
    const QualitySummary summary = quality(mesh);
    double least = 1;
    for (const ShellMesh::Face& face : mesh.faces)
      if (face.quads > 0) least = std::min(least, face.q_min);
    EXPECT_EQ(least, summary.q_min);
    q += summary.q_mean * summary.quads;
    irregular += summary.irregular_percent * summary.quads;
    quads += summary.quads;
    worst.push_back(summary.q_min);
    EXPECT_GT(summary.q_min, 0.15);
  }
  std::sort(worst.begin(), worst.end());
  RecordProperty("figures",
                 fmt::format("q {:.4f}, irregular {:.3f} %, median of the worst {:.3f}, worst {:.3f}",
                             q / quads, irregular / quads, worst[worst.size() / 2], worst[0]));
  EXPECT_GT(q / quads, 0.94);
  EXPECT_LT(irregular / quads, 1.4);
  EXPECT_GT(worst[worst.size() / 2], 0.55);
}

TEST(Mesh, IsTheSameForAnyThreadCount) {
  const CadModel model = CadModel::read(sample_model("bracket").path());
  const MeshOptions options = options_for(model, 60);
  const ShellMesh one = mesh_of(model, options, 1);
  for (const int threads : {1, 2, 8}) {
    const ShellMesh other = mesh_of(model, options, threads);
    EXPECT_EQ(one.quads, other.quads);
    EXPECT_EQ(one.points, other.points);
  }
}

TEST(Mesh, FollowsTheSizeAskedFor) {
  for (const char* name : {"box", "plate_with_holes", "bracket"}) {
    SCOPED_TRACE(name);
    const CadModel model = CadModel::read(sample_model(name).path());
    MeshOptions options = options_for(model, 100);
    options.sizing.elements_per_circle = 0;
    const ShellMesh mesh = mesh_of(model, options);
    std::vector<double> ratios;
    for (const auto& quad : mesh.quads) {
      for (int k = 0; k < 4; ++k) {
        ratios.push_back((mesh.points[quad[k]] - mesh.points[quad[(k + 1) % 4]]).norm() /
                         options.sizing.size);
      }
    }
    std::sort(ratios.begin(), ratios.end());
    EXPECT_GT(ratios[ratios.size() / 2], 0.85);
    EXPECT_LT(ratios[ratios.size() / 2], 1.15);
    const auto inside =
        std::count_if(ratios.begin(), ratios.end(), [](double r) { return r > 0.5 && r < 1.6; });
    EXPECT_GT(static_cast<double>(inside) / static_cast<double>(ratios.size()), 0.95);
  }
}

TEST(Mesh, RefinesOnTheEntitiesNamed) {
  const CadModel model = CadModel::read(sample_model("box").path());
  MeshOptions options = options_for(model, 10);
  const auto quads_on = [](const ShellMesh& mesh, int face) {
    return std::count(mesh.quad_faces.begin(), mesh.quad_faces.end(), face);
  };
  const ShellMesh plain = mesh_of(model, options);
  options.sizing.face_sizes[3] = options.sizing.size / 4;
  const ShellMesh fine = mesh_of(model, options);
  EXPECT_GT(quads_on(fine, 3), 8 * quads_on(plain, 3));
  options.sizing.face_sizes.clear();
  options.sizing.vertex_sizes[1] = options.sizing.size / 5;
  EXPECT_GT(mesh_of(model, options).quads.size(), plain.quads.size() + 15);
  options.sizing.vertex_sizes.clear();
  options.sizing.edge_sizes[1] = options.sizing.size / 5;
  EXPECT_GT(mesh_of(model, options).quads.size(), plain.quads.size() + 40);
}

TEST(Mesh, MeshesSomeFacesAlone) {
  const CadModel model = CadModel::read(sample_model("box").path());
  MeshOptions options = options_for(model, 10);
  options.faces = {2, 5};
  const ShellMesh mesh = mesh_of(model, options);
  EXPECT_EQ(joined(validate(mesh)), "");
  const std::set<int> faces(mesh.quad_faces.begin(), mesh.quad_faces.end());
  EXPECT_EQ(faces, (std::set<int>{2, 5}));
  EXPECT_EQ(mesh.faces[0].status, FaceStatus::skipped);
  EXPECT_EQ(mesh.faces[1].status, FaceStatus::meshed);
}

/// Cleaning up the cone's mesh at this size meets a node at which two fans of quads touch.
TEST(Mesh, KeepsNodesThatTwoFansOfQuadsShare) {
  const CadModel model = CadModel::read(sample_model("cone").path());
  MeshOptions options;
  options.sizing.elements_per_diagonal = 40;
  EXPECT_EQ(joined(validate(mesh_of(model, options), true)), "");
}

TEST(Mesh, SharedFacesAreMeshedOnce) {
  const CadModel model = CadModel::read(sample_model("two_solids").path());
  const ShellMesh mesh = mesh_of(model, options_for(model, 20));
  std::map<std::pair<int, int>, int> elements;
  for (const auto& quad : mesh.quads) {
    for (int k = 0; k < 4; ++k) ++elements[std::minmax(quad[k], quad[(k + 1) % 4])];
  }
  int three = 0;
  for (const auto& [side, count] : elements) {
    EXPECT_GE(count, 2);
    EXPECT_LE(count, 3);
    three += count == 3;
  }
  EXPECT_GT(three, 0);
}

TEST(Mesh, RefusesWhatMakesNoSense) {
  const CadModel model = CadModel::read(sample_model("box").path());
  const auto expect_usage = [&](const MeshOptions& options, const std::string& subject) {
    try {
      mesh_of(model, options);
      ADD_FAILURE() << "no error for " << subject;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), Error::Kind::usage) << error.what();
      EXPECT_EQ(error.subject(), subject) << error.what();
    }
  };
  MeshOptions good = options_for(model, 10);
  for (const double size : {-1.0, std::nan(""), 1e9, 1e-5}) {
    MeshOptions options = good;
    options.sizing.size = size;
    expect_usage(options, "size");
  }
  MeshOptions options = good;
  options.order = 3;
  expect_usage(options, "order");
  options = good;
  options.faces = {7};
  expect_usage(options, "faces");
  options = good;
  options.sizing.edge_sizes[99] = 1;
  expect_usage(options, "sizes");
  options = good;
  options.sizing.growth = 0;
  expect_usage(options, "growth");
}

TEST(Mesh, CanBeCancelled) {
  const CadModel model = CadModel::read(sample_model("bracket").path());
  for (const int calls : {1, 5, 20}) {
    int left = calls;
    ExecutionContext context(1, [&](std::string_view, double) { return --left > 0; });
    try {
      mesh(model, options_for(model, 60), context);
      ADD_FAILURE() << "not cancelled";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), Error::Kind::cancelled);
    }
  }
}

/// How often the context was checked in each stage that was reported, and the quads that were made.
struct Checks {
  std::map<std::string, double, std::less<>> of_stage;
  double quads = 0;
};

Checks count_checks(const CadModel& model, const MeshOptions& options) {
  Checks checks;
  ExecutionContext context(1, [&](std::string_view stage, double) {
    ++checks.of_stage[std::string(stage)];
    return true;
  });
  context.ask_every(std::chrono::milliseconds(0));
  checks.quads = static_cast<double>(mesh(model, options, context).quads.size());
  return checks;
}

/// Steps look whether to go on at least once in so many quads of the mesh, at any size: there are nearly four
/// times as many looks at half the size.
TEST(Mesh, ChecksAllTheWhile) {
  constexpr double least_growth = 2.2;
  using Step = std::pair<const char*, double>;  // quads per check, a third more than there are
  // A torus is one curved face, a grid; the disc a plane one.
  for (const std::string name : {"torus", "disc"}) {
    const CadModel model = CadModel::read(sample_model(name).path());
    for (const Strategy strategy : {Strategy::subdivide, Strategy::direct}) {
      for (const int order : {1, 2}) {
        SCOPED_TRACE(fmt::format("{}, strategy {}, order {}", name, static_cast<int>(strategy), order));
        std::vector<Step> steps{{"assemble", order == 1 ? 450 : 75}, {"slide", 210}};
        steps.push_back({"mesh", name == "torus" ? 135 : 8});
        MeshOptions options;
        options.strategy = strategy;
        options.order = order;
        options.improve.sliding_sweeps = 3;  // more would end early
        ExecutionContext measuring;
        options.sizing.size = QuadEstimate(model, measuring).size_for(2e4).size;
        const Checks few = count_checks(model, options);
        options.sizing.size *= 0.5;
        const Checks many = count_checks(model, options);
        for (const auto& [step, most_quads] : steps) {
          SCOPED_TRACE(fmt::format("{}: {} checks for {} quads, {} for {}", step, few.of_stage.at(step),
                                   few.quads, many.of_stage.at(step), many.quads));
          ASSERT_TRUE(few.of_stage.contains(step));
          EXPECT_GE(many.of_stage.at(step), least_growth * few.of_stage.at(step));
          EXPECT_LE(few.quads, most_quads * few.of_stage.at(step));
          EXPECT_LE(many.quads, most_quads * many.of_stage.at(step));
        }
      }
    }
  }
}

/// Squares cut in two along a diagonal that chance takes.
TriangleMesh cut_squares(int n) {
  TriangleMesh mesh;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) mesh.points.emplace_back(i, j, 0);
  }
  std::mt19937 random(1);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const int a = i * (n + 1) + j, b = a + n + 1, c = b + 1, d = a + 1;
      const bool first = random() % 2 == 0;
      mesh.triangles.push_back(first ? std::array{a, b, c} : std::array{a, b, d});
      mesh.triangles.push_back(first ? std::array{a, c, d} : std::array{b, c, d});
    }
  }
  return mesh;
}

/// As above, for the pairing of triangles.
TEST(Mesh, ChecksWhilePairing) {
  const auto checks = [](int n) {
    ExecutionContext context(1);
    recombine(cut_squares(n), {}, context);
    return static_cast<double>(context.work());
  };
  constexpr int n = 150;
  const double few = checks(n), many = checks(2 * n);
  EXPECT_GE(many, 2.5 * few);
  EXPECT_LE(4.0 * n * n, 95 * many);
}

/// Sizes and samples do not depend on the number of quads, but on the edges and faces.
TEST(Mesh, ChecksOnEachFaceAndEdge) {
  const CadModel model = CadModel::read(sample_model("bracket").path());
  const Checks checks = count_checks(model, options_for(model, 20));
  EXPECT_GE(checks.of_stage.at("size"), model.face_count());
  EXPECT_GE(checks.of_stage.at("sample"), model.edge_count() + model.face_count());
  EXPECT_GE(checks.of_stage.at("mesh"), model.face_count());
}

TEST(CadModel, CountsWhatFreeCadCounts) {
  for (const SampleModel& sample : sample_models()) {
    SCOPED_TRACE(sample.name);
    const CadModel model = CadModel::read(sample.path());
    EXPECT_EQ(model.face_count(), sample.faces);
    EXPECT_EQ(model.edge_count(), sample.edges);
    EXPECT_EQ(model.vertex_count(), sample.vertices);
    EXPECT_EQ(model.solid_count(), sample.solids);
    EXPECT_NEAR(model.area(), sample.area, 1e-3 * sample.area);
  }
}

/// The sentence and the subject of the error that reading gives.
template <class Read>
std::pair<std::string, std::string> refusal_of(Read&& read) {
  try {
    read();
  } catch (const Error& error) {
    return {error.what(), error.subject()};
  }
  return {"no error", ""};
}

TEST(CadModel, SaysWhatIsWrongWithAFile) {
  using Refusal = std::pair<std::string, std::string>;
  const std::string readme = std::string(QUADRILLE_SOURCE_DIR) + "/README.md";
  EXPECT_EQ(refusal_of([] { CadModel::read("/nowhere/part.step"); }),
            Refusal("/nowhere/part.step: cannot be read: No such file or directory", "/nowhere/part.step"));
  EXPECT_EQ(refusal_of([] { CadModel::read(QUADRILLE_SOURCE_DIR); }),
            Refusal(std::string(QUADRILLE_SOURCE_DIR) + ": cannot be read: it is a folder, not a file",
                    QUADRILLE_SOURCE_DIR));
  EXPECT_EQ(
      refusal_of([&] { CadModel::read(readme); }),
      Refusal(readme + " has an unknown ending: STEP (.step, .stp), IGES (.iges, .igs) and BREP (.brep, "
                       ".brp) can be read",
              readme));
  for (const char* text : {"not a shape", ""})
    EXPECT_EQ(refusal_of([&] { CadModel::from_brep(text, "part"); }),
              Refusal("part is not a readable BREP file", "part"));
  std::ifstream file(sample_model("box").path());
  const std::string whole((std::istreambuf_iterator<char>(file)), {});
  ASSERT_GT(whole.size(), 1000U);
  EXPECT_EQ(refusal_of([&] { CadModel::from_brep(whole.substr(0, whole.size() / 2), "half"); }),
            Refusal("half is not a readable BREP file: it is cut off or damaged", "half"));
  EXPECT_EQ(refusal_of([&] { CadModel::from_brep(whole, "whole"); }).first, "no error");
}

}  // namespace
}  // namespace quadrille
