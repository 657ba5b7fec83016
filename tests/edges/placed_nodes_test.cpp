/// Nodes at places that users choose: exactly there on edges, faces and vertices, whatever the mesh is like.

#include "mesher/edges/placed_nodes.hpp"

#include <gtest/gtest.h>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include "geometry/base/error.hpp"
#include "geometry/surfaces/edge_curve.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/quadrille.hpp"
#include "tests/support/ids.hpp"
#include "tests/support/process.hpp"
#include "tests/support/sample_models.hpp"

namespace quadrille {
namespace {

CadModel plate_with_hole() {
  const TopoDS_Shape plate = BRepPrimAPI_MakeBox(60, 40, 10).Shape();
  const TopoDS_Shape drill = BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(20, 20, -5), gp::DZ()), 8, 20).Shape();
  return CadModel(std::make_shared<CadShape>(BRepAlgoAPI_Cut(plate, drill).Shape(), "plate"));
}

ShellMesh mesh_with(const CadModel& model, const std::vector<NodePlace>& nodes, MeshOptions options = {},
                    int threads = 1) {
  options.sizing.nodes = nodes;
  ExecutionContext context(threads);
  return mesh(model, options, context);
}

std::string joined(const std::vector<std::string>& lines) {
  std::string result;
  for (const auto& line : lines) result += line + "\n";
  return result;
}

/// The point of the mesh that a placed node got.
Vector3 point_of(const ShellMesh& mesh, const std::string& name) {
  for (const auto& node : mesh.placed_nodes) {
    if (node.name != name) continue;
    for (const auto& corner : mesh.corners)
      if (corner.vertex == node.vertex) return mesh.points[corner.node];
  }
  ADD_FAILURE() << name << " has no node";
  return Vector3::Constant(1e9);
}

/// The places whose distance from their nodes is not a rounding error.
void expect_nodes_at(const ShellMesh& mesh, const std::vector<NodePlace>& places, double diagonal) {
  std::set<int> used;
  for (const auto& quad : mesh.quads) used.insert(quad.begin(), quad.end());
  ASSERT_EQ(mesh.placed_nodes.size(), places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    SCOPED_TRACE(mesh.placed_nodes[i].name);
    EXPECT_LT((point_of(mesh, mesh.placed_nodes[i].name) - places[i].point).norm(), 1e-9 * diagonal);
  }
  for (const auto& corner : mesh.corners) EXPECT_TRUE(used.contains(corner.node));
}

/// A place on each face, edge and vertex, as far as there are no more than so many of a kind.
std::vector<NodePlace> places_all_over(const CadModel& model, const ShellMesh& coarse, std::size_t most) {
  const CadShape& shape = model.shape();
  std::vector<NodePlace> places;
  std::map<int, int> on_face;  // quads met
  for (std::size_t quad = 0; quad < coarse.quads.size() && on_face.size() < most; ++quad) {
    const int face = coarse.quad_faces[quad];
    if (++on_face[face] != 2) continue;
    Vector3 middle = Vector3::Zero(), normal;
    for (const int node : coarse.quads[quad]) middle += 0.25 * coarse.points[node];
    const FaceSurface surface(shape.faces[face_id(face)]);
    const CadFace& cad = shape.faces[face_id(face)];
    Vector2 best(0.5 * (cad.u_min + cad.u_max), 0.5 * (cad.v_min + cad.v_max));
    for (int k = 0; k < 400; ++k) {  // the nearest of many is near enough to start from
      const int row = k / 20;
      const Vector2 uv(cad.u_min + (cad.u_max - cad.u_min) * (k % 20) / 19.0,
                       cad.v_min + (cad.v_max - cad.v_min) * row / 19.0);
      if ((surface.point(uv) - middle).norm() < (surface.point(best) - middle).norm()) best = uv;
    }
    places.push_back({"", surface.nearest(best, middle)});
  }
  std::size_t edges = 0;
  for (const CadEdge& edge : shape.edges) {
    if (edge.degenerate || edge.faces.empty() || ++edges > most) continue;
    places.push_back({"", EdgeCurve(edge).point(edge.first + 0.37 * (edge.last - edge.first))});
  }
  for (std::size_t i = 0; i < std::min(most, shape.vertices.size()); ++i)
    places.push_back({"", shape.vertices[VertexId::from_index(i)]});
  return places;
}

TEST(PlacedNodes, AreExactlyThereOnEverySample) {
  for (const SampleModel& sample : sample_models()) {
    const CadModel model = CadModel::read(sample.path());
    MeshOptions options;
    options.sizing.size = model.diagonal() / 12;
    const auto places = places_all_over(model, mesh_with(model, {}, options), 6);
    for (const Strategy strategy : {Strategy::subdivide, Strategy::direct}) {
      for (const int order : {1, 2}) {
        SCOPED_TRACE(sample.name + " " + std::to_string(order) +
                     (strategy == Strategy::direct ? " direct" : ""));
        options.strategy = strategy;
        options.order = order;
        const ShellMesh mesh = mesh_with(model, places, options);
        EXPECT_EQ(joined(validate(mesh, sample.closed)), "");
        expect_nodes_at(mesh, places, model.diagonal());
      }
    }
  }
}

TEST(PlacedNodes, LieOnFacesEdgesAndVerticesOfAPlate) {
  const CadModel model = plate_with_hole();
  const std::vector<NodePlace> places = {
      {"Top", {41.3, 17.7, 10}}, {"", {33, 0, 10}},       {"Corner", {0, 0, 0}},      {"", {20, 28.5, 10}},
      {"Rim", {20, 28, 10}},     {"Wall", {12, 20, 4.4}}, {"Again", {41.3, 17.7, 10}}};
  MeshOptions options;
  options.sizing.size = 4;
  options.order = 2;
  const ShellMesh mesh = mesh_with(model, places, options);
  EXPECT_EQ(joined(validate(mesh, true)), "");
  expect_nodes_at(mesh, places, model.diagonal());
  EXPECT_EQ(mesh.placed_nodes[1].name, "Node1");
  EXPECT_EQ(mesh.placed_nodes[3].name, "Node2");
  EXPECT_EQ(mesh.placed_nodes[6].vertex, mesh.placed_nodes[0].vertex);
  EXPECT_FALSE(mesh.placed_nodes[2].added);
  EXPECT_TRUE(mesh.placed_nodes[0].added);
  // Nothing else has changed: each of the model's vertices has its corner, and each edge its segments.
  std::set<int> edges;
  for (const auto& segment : mesh.segments) edges.insert(segment.edge);
  for (const auto& crossed : mesh.crossed_edges) edges.insert(crossed.edge);
  EXPECT_EQ(static_cast<int>(edges.size()), model.edge_count());
  EXPECT_EQ(static_cast<int>(mesh.corners.size()), model.vertex_count() + 5);

  // All around the hole, at all distances: where rings of quads are otherwise.
  for (int k = 0; k < 24; ++k) {
    SCOPED_TRACE(k);
    const double angle = 0.4 + k, distance = 8.2 + 0.3 * k;
    const std::vector<NodePlace> one = {
        {"", {20 + distance * std::cos(angle), 20 + distance * std::sin(angle), 10}}};
    options.strategy = k % 2 == 0 ? Strategy::subdivide : Strategy::direct;
    const ShellMesh near = mesh_with(model, one, options);
    EXPECT_EQ(joined(validate(near, true)), "");
    expect_nodes_at(near, one, model.diagonal());
  }

  options.strategy = Strategy::subdivide;
  const ShellMesh again = mesh_with(model, places, options, 3);
  EXPECT_EQ(again.points, mesh.points);
  EXPECT_EQ(again.quads, mesh.quads);
}

TEST(PlacedNodes, AreThereBesideFeaturesThatAreSuppressed) {
  // A slit 0.3 wide, far below the least size, is suppressed; its edge with the node is not.
  const TopoDS_Shape block = BRepPrimAPI_MakeBox(60, 40, 10).Shape();
  const TopoDS_Shape step = BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 9.7), 60, 20, 5).Shape();
  const CadModel model(std::make_shared<CadShape>(BRepAlgoAPI_Cut(block, step).Shape(), "step"));
  MeshOptions options;
  options.sizing.size = 5;
  options.sizing.size_min = 2;
  EXPECT_FALSE(mesh_with(model, {}, options).suppressed_features.empty());
  const std::vector<NodePlace> places = {{"", {31, 20, 10}}, {"", {0, 20, 9.7}}};
  const ShellMesh mesh = mesh_with(model, places, options);
  EXPECT_EQ(joined(validate(mesh, true)), "");
  expect_nodes_at(mesh, places, model.diagonal());
}

std::string refusal(const CadModel& model, const NodePlace& place, MeshOptions options = {}) {
  try {
    mesh_with(model, {place}, std::move(options));
  } catch (const Error& error) {
    EXPECT_EQ(error.subject(), "nodes_at");
    EXPECT_EQ(error.kind(), Error::Kind::usage);
    return error.what();
  }
  return "accepted";
}

TEST(PlacedNodes, OffTheModelAreRefusedWithTheirDistance) {
  const CadModel model = plate_with_hole();
  MeshOptions options;
  options.sizing.size = 4;
  int top = 0;
  for (const FaceId face : model.shape().faces.ids()) {
    const FaceSurface surface(model.shape().faces[face]);
    if (surface.planar() && std::abs(surface.distance_at_least({40, 20, 10})) < 1e-9) top = face.number();
  }
  const std::string text = refusal(model, {"Tip", {40, 20, 10.5}}, options);
  EXPECT_NE(text.find("Tip at (40, 20, 10.5) lies 0.5 mm from Face" + std::to_string(top)), std::string::npos)
      << text;
  EXPECT_NE(refusal(model, {"", {20, 20, 10}}, options).find("Node1 at (20, 20, 10) lies 8 mm from"),
            std::string::npos);
  // A thousandth of the size is the limit, and the node lies on the model.
  EXPECT_NE(refusal(model, {"", {40, 20, 10.0041}}, options), "accepted");
  const ShellMesh near = mesh_with(model, {{"", {40, 20, 10.0039}}}, options);
  EXPECT_LT((point_of(near, "Node1") - Vector3(40, 20, 10)).norm(), 1e-9);

  options.sizing.spacings[1].segments = 5;
  const CadEdge& edge = model.shape().edges[edge_id(1)];
  const Vector3 middle = EdgeCurve(edge).point(0.5 * (edge.first + edge.last));
  EXPECT_NE(refusal(model, {"", middle}, options).find("lies inside Edge1"), std::string::npos);
  options.sizing.spacings.clear();
  options.faces = {top == 1 ? 2 : 1};
  EXPECT_NE(refusal(model, {"", {40, 20, 10}}, options), "accepted");
}

TEST(PlacedNodes, HaveGroupsInFiles) {
  const CadModel model = plate_with_hole();
  MeshOptions options;
  options.sizing.size = 5;
  const ShellMesh mesh = mesh_with(model, {{"Load", {41.3, 17.7, 10}}, {"", {0, 0, 0}}}, options);
  const test::TemporaryFolder folder;
  write_mesh(mesh, folder / "a.inp", {});
  const std::string text = test::file_text(folder / "a.inp");
  for (const char* name : {"Load", "Node1"}) {
    const std::size_t at = text.find(std::string("*NSET, NSET=") + name + "\n");
    ASSERT_NE(at, std::string::npos) << name;
    std::istringstream lines(text.substr(at));
    std::string line;
    std::getline(lines, line);
    std::getline(lines, line);
    const int number = std::stoi(line);
    const std::size_t node = text.find("\n" + std::to_string(number) + ", ");
    ASSERT_NE(node, std::string::npos);
    const Vector3 p = point_of(mesh, name);
    double x = 0, y = 0, z = 0;
    ASSERT_EQ(std::sscanf(text.c_str() + node, "%*d, %lf, %lf, %lf", &x, &y, &z), 3);
    EXPECT_LT((Vector3(x, y, z) - p).norm(), 1e-9);
  }
  EXPECT_EQ(text.find("Vertex" + std::to_string(model.vertex_count() + 1)), std::string::npos);
  for (const char* ending : {".msh", ".unv", ".bdf", ".vtk"}) {
    const auto path = folder / (std::string("a") + ending);
    write_mesh(mesh, path, {});
    if (std::string(ending) != ".bdf") {
      EXPECT_NE(test::file_text(path).find("Load"), std::string::npos) << ending;
    }
  }
}

}  // namespace
}  // namespace quadrille
