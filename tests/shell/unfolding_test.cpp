/// Second-order meshes however coarse: no element folds, and what that costs is told.

#include "mesher/shell/midsides.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include "mesher/quadrille.hpp"
#include "tests/models/trouble_models.hpp"
#include "tests/support/ids.hpp"
#include "tests/support/process.hpp"
#include "tests/support/sample_models.hpp"

namespace quadrille {
namespace {

/// (dx/dxi) x (dx/deta) of an eight-node quad, from the derivatives of its shape functions.
Vector3 jacobian(const ShellMesh& mesh, std::size_t quad, double xi, double eta) {
  constexpr std::array<double, 8> s{-1, 1, 1, -1, 0, 1, 0, -1}, t{-1, -1, 1, 1, -1, 0, 1, 0};
  Vector3 along = Vector3::Zero(), across = Vector3::Zero();
  for (int k = 0; k < 8; ++k) {
    const Vector3& x = mesh.points[k < 4 ? mesh.quads[quad][k] : mesh.midsides[quad][k - 4]];
    const double u = 1 + xi * s[k], v = 1 + eta * t[k];
    if (k < 4) {  // u v (u + v - 3) / 4
      along += 0.25 * s[k] * v * (2 * u + v - 3) * x;
      across += 0.25 * t[k] * u * (u + 2 * v - 3) * x;
    } else if (s[k] == 0) {  // (1 - xi^2) v / 2
      along += -xi * v * x;
      across += 0.5 * (1 - xi * xi) * t[k] * x;
    } else {
      along += 0.5 * s[k] * (1 - eta * eta) * x;
      across += -eta * u * x;
    }
  }
  return along.cross(across);
}

/// Whether the Jacobian is positive at the 3 x 3 Gauss points and at the corners, along the normal of the
/// corners' quad, that of the center, and that of the element's vector area.
bool is_sound(const ShellMesh& mesh, std::size_t quad) {
  std::vector<Vector3> jacobians;
  const double g = std::sqrt(0.6), h = std::sqrt(1.0 / 3);
  for (const double xi : {-1.0, -g, 0.0, g, 1.0}) {
    for (const double eta : {-1.0, -g, 0.0, g, 1.0}) {
      if ((std::abs(xi) == 1) == (std::abs(eta) == 1)) jacobians.push_back(jacobian(mesh, quad, xi, eta));
    }
  }
  const auto& q = mesh.quads[quad];
  const auto& p = mesh.points;
  const Vector3 corners = (p[q[2]] - p[q[0]]).cross(p[q[3]] - p[q[1]]), center = jacobian(mesh, quad, 0, 0),
                mean = jacobian(mesh, quad, -h, -h) + jacobian(mesh, quad, h, -h) +
                       jacobian(mesh, quad, h, h) + jacobian(mesh, quad, -h, h);
  return std::all_of(jacobians.begin(), jacobians.end(), [&](const Vector3& j) {
    return j.dot(corners) > 0 && j.dot(center) > 0 && j.dot(mean) > 0;
  });
}

struct Setting {
  double divisions, elements_per_circle;
  Strategy strategy;
  bool keep_features = false;
};

std::vector<Setting> settings(const std::vector<double>& divisions, const std::vector<double>& curvatures) {
  std::vector<Setting> result;
  for (const double n : divisions) {
    for (const double curvature : curvatures) {
      for (const Strategy strategy : {Strategy::subdivide, Strategy::direct})
        result.push_back({n, curvature, strategy, false});
    }
  }
  return result;
}

ShellMesh second_order_mesh(const CadModel& model, const Setting& setting, int threads = 1) {
  MeshOptions options;
  options.order = 2;
  options.sizing.elements_per_diagonal = setting.divisions;
  options.sizing.elements_per_circle = setting.elements_per_circle;
  options.strategy = setting.strategy;
  options.keep_features = setting.keep_features;
  ExecutionContext context(threads);
  return mesh(model, options, context);
}

/// Every element is sound at every setting, or the face that cannot be meshed is named.
/// \return meshes made.
int expect_sound(const CadModel& model, const std::vector<Setting>& all) {
  int made = 0;
  for (const Setting& setting : all) {
    SCOPED_TRACE(fmt::format("1/{}, {} elements a circle, {}", setting.divisions, setting.elements_per_circle,
                             setting.strategy == Strategy::direct ? "direct" : "subdivide"));
    try {
      const ShellMesh mesh = second_order_mesh(model, setting);
      ++made;
      for (std::size_t quad = 0; quad < mesh.quads.size(); ++quad)
        EXPECT_TRUE(is_sound(mesh, quad)) << "quad " << quad << " of Face" << mesh.quad_faces[quad];
      EXPECT_EQ(quality(mesh).inverted, 0);
      EXPECT_GT(quality(mesh).jacobian_min, 0);
    } catch (const Error& error) {
      EXPECT_EQ(error.subject().substr(0, 4), "Face") << error.what();
    }
  }
  return made;
}

TEST(Unfolding, NoElementOfASampleFoldsHoweverCoarse) {
  const std::vector<Setting> all = settings({1, 3, 5, 10, 20}, {0, 2, 12});
  for (const SampleModel& sample : sample_models()) {
    SCOPED_TRACE(sample.name);
    EXPECT_EQ(expect_sound(CadModel::read(sample.path()), all), static_cast<int>(all.size()));
  }
}

TEST(Unfolding, NoElementOfATroublesomeModelFolds) {
  const std::vector<Setting> all = settings({3, 10}, {0, 12});
  int made = 0;
  for (const TroubleModel& trouble : trouble_models()) {
    SCOPED_TRACE(trouble.name);
    made += expect_sound(CadModel(std::make_shared<CadShape>(trouble.make(), trouble.name)), all);
  }
  // What fails, fails at first order, too.
  EXPECT_GE(made, static_cast<int>(trouble_models().size() * all.size()) - 4);
}

double distance_to(const TopoDS_Shape& shape, const Vector3& p) {
  return BRepExtrema_DistShapeShape(BRepBuilderAPI_MakeVertex(gp_Pnt(p.x(), p.y(), p.z())), shape).Value();
}

/// Midside nodes are on the geometry, but for those that are listed with their distance.
void expect_told(const CadModel& model, const ShellMesh& mesh) {
  ASSERT_FALSE(mesh.off_geometry.empty());
  const double tolerance = 1e-6 * model.diagonal();
  std::vector<double> distance(mesh.points.size(), 0);
  for (const auto& off : mesh.off_geometry) distance[off.node] = off.distance;
  std::vector<std::set<int>> of_faces(mesh.faces.size());
  for (std::size_t quad = 0; quad < mesh.quads.size(); ++quad) {
    const int face = mesh.quad_faces[quad];
    for (const int node : mesh.midsides[quad]) {
      const double found = distance_to(model.shape().faces[face_id(face)].face, mesh.points[node]);
      EXPECT_LE(found, distance[node] + tolerance) << "node " << node;
      if (distance[node] > 0) of_faces[face - 1].insert(node);
    }
  }
  for (const auto& segment : mesh.segments) {
    const double found =
        distance_to(model.shape().edges[edge_id(segment.edge)].edge, mesh.points[segment.middle]);
    EXPECT_NEAR(found, distance[segment.middle], 0.1 * distance[segment.middle] + tolerance);
  }
  for (std::size_t face = 0; face < of_faces.size(); ++face) {
    EXPECT_EQ(mesh.faces[face].off_geometry, static_cast<int>(of_faces[face].size()));
    double largest = 0;
    for (const int node : of_faces[face]) largest = std::max(largest, distance[node]);
    EXPECT_EQ(mesh.faces[face].off_geometry_max, largest);
    EXPECT_EQ(mesh.faces[face].note.find("off the geometry") != std::string::npos, !of_faces[face].empty());
  }
}

TEST(Unfolding, TellsWhichNodesLeaveTheGeometry) {
  const CadModel model = CadModel::read(sample_model("wing").path());
  const ShellMesh mesh = second_order_mesh(model, {1, 0, Strategy::direct, true});
  expect_told(model, mesh);
  const auto is_off = [&](int node) {
    return std::any_of(mesh.off_geometry.begin(), mesh.off_geometry.end(),
                       [&](const auto& off) { return off.node == node; });
  };
  EXPECT_TRUE(std::any_of(mesh.segments.begin(), mesh.segments.end(),
                          [&](const auto& segment) { return is_off(segment.middle); }));
}

TEST(Unfolding, KeepsNodesOfUsualMeshesOnTheGeometry) {
  for (const SampleModel& sample : sample_models()) {
    SCOPED_TRACE(sample.name);
    const CadModel model = CadModel::read(sample.path());
    EXPECT_TRUE(second_order_mesh(model, {40, 12, Strategy::subdivide, false}).off_geometry.empty());
  }
}

TEST(Unfolding, IsTheSameOnAnyNumberOfThreads) {
  const CadModel model = CadModel::read(sample_model("torus").path());
  const ShellMesh one = second_order_mesh(model, {3, 2, Strategy::subdivide, false}, 1),
                  four = second_order_mesh(model, {3, 2, Strategy::subdivide, false}, 4);
  EXPECT_EQ(one.points, four.points);
  EXPECT_EQ(one.off_geometry.size(), four.off_geometry.size());
}

/// CalculiX's input for a plate of the mesh's shape, held at a node and loaded at another.
std::string deck(const ShellMesh& mesh, const std::string& file) {
  return fmt::format(
      "*INCLUDE, INPUT={}\n*MATERIAL, NAME=Steel\n*ELASTIC\n210000, 0.3\n*ELSET, ELSET=All, GENERATE\n1, {}\n"
      "*SHELL SECTION, ELSET=All, MATERIAL=Steel\n0.05\n*BOUNDARY\n1, 1, 6\n*STEP\n*STATIC\n*CLOAD\n2, 1, 1\n"
      "*END STEP\n",
      file, mesh.quads.size());
}

TEST(Unfolding, CalculixTakesCoarseMeshes) {
  if (!test::has_program("ccx")) GTEST_SKIP() << "CalculiX (ccx) is not installed";
  // CalculiX refuses all of these where midside nodes stay on the geometry.
  const test::TemporaryFolder folder;
  const CadModel torus = CadModel::read(sample_model("torus").path());
  for (const double divisions : {1.0, 3.0}) {
    SCOPED_TRACE(divisions);
    const ShellMesh mesh = second_order_mesh(torus, {divisions, 2, Strategy::subdivide});
    write_mesh(mesh, folder / "mesh.inp");
    test::write_text(folder / "job.inp", deck(mesh, "mesh.inp"));
    const test::ProcessResult result =
        test::run("cd '" + folder.path().string() + "' && OMP_NUM_THREADS=1 timeout 120 ccx job 2>&1");
    EXPECT_EQ(result.out.find("nonpositive jacobian"), std::string::npos);
    EXPECT_NE(result.out.find("Job finished"), std::string::npos) << result.out;
  }
}

}  // namespace
}  // namespace quadrille
