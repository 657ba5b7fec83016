/// The faces' meshes become one mesh with numbers by vertex, edge and face.

#include "mesher/shell/assembly.hpp"

#include <gtest/gtest.h>

#include <BRepPrimAPI_MakeCylinder.hxx>

#include <algorithm>
#include <set>

#include "geometry/base/error.hpp"
#include "geometry/surfaces/edge_curve.hpp"
#include "mesher/shell/validate.hpp"
#include "tests/support/ids.hpp"
#include "tests/support/meshed_model.hpp"
#include "tests/support/sample_models.hpp"

namespace quadrille {
namespace {

using testing::MeshedModel;

MeshedModel cylinder() {
  return {CadModel(std::make_shared<CadShape>(BRepPrimAPI_MakeCylinder(5, 8).Shape(), "cylinder")), 2};
}

ShellMesh shell_of(const MeshedModel& parts, int order = 1, int threads = 1) {
  ExecutionContext context(threads);
  return assemble(parts.geometry, parts.nodes, parts.faces, order, context);
}

TEST(Assembly, JoinsTheFacesToOneConformingMesh) {
  const MeshedModel parts = cylinder();
  const ShellMesh mesh = shell_of(parts);
  EXPECT_EQ(validate(mesh, true), std::vector<std::string>{});
  std::size_t quad = 0;
  for (const FaceId face : parts.faces.ids()) {
    for (const auto& own : parts.faces[face]->quads) {
      ASSERT_LT(quad, mesh.quads.size());
      EXPECT_EQ(mesh.quad_faces[quad], face.number());
      for (int k = 0; k < 4; ++k)
        EXPECT_EQ(mesh.points[mesh.quads[quad][k]], parts.faces[face]->points[own[k]]);
      ++quad;
    }
  }
  EXPECT_EQ(quad, mesh.quads.size());
  const CadShape& shape = parts.model.shape();
  std::size_t segment = 0;
  for (const EdgeId edge : shape.edges.ids()) {
    const auto& parameters = parts.nodes.edges[edge].parameters;
    for (int k = 0; k < parts.nodes.edges[edge].segments(); ++k, ++segment) {
      ASSERT_LT(segment, mesh.segments.size());
      EXPECT_EQ(mesh.segments[segment].edge, edge.number());
      for (const int end : {0, 1}) {
        const Vector3 place = EdgeCurve(shape.edges[edge]).point(parameters[k + end]);
        EXPECT_LT((mesh.points[mesh.segments[segment].nodes[end]] - place).norm(), 1e-6);
      }
    }
  }
  EXPECT_EQ(segment, mesh.segments.size());
  EXPECT_EQ(mesh.corners.size(), shape.vertices.size());
  for (const auto& corner : mesh.corners)
    EXPECT_LT((mesh.points[corner.node] - shape.vertices[vertex_id(corner.vertex)]).norm(), 1e-9);
}

TEST(Assembly, LeavesOutWhatNoQuadUses) {
  MeshedModel parts = cylinder();
  const std::size_t whole = shell_of(parts).points.size();
  for (const FaceId left : parts.faces.ids()) {
    FaceMeshes faces(parts.faces.size());
    faces[left] = parts.faces[left];
    ExecutionContext context(1);
    const ShellMesh mesh = assemble(parts.geometry, parts.nodes, faces, 1, context);
    EXPECT_EQ(validate(mesh), std::vector<std::string>{});
    EXPECT_LT(mesh.points.size(), whole);
    std::set<int> used;
    for (const auto& quad : mesh.quads) used.insert(quad.begin(), quad.end());
    EXPECT_EQ(used.size(), mesh.points.size());
  }
}

TEST(Assembly, IsTheSameOnAnyNumberOfThreads) {
  const MeshedModel parts = cylinder();
  for (const int order : {1, 2}) {
    const ShellMesh one = shell_of(parts, order, 1), four = shell_of(parts, order, 4);
    EXPECT_EQ(one.points, four.points);
    EXPECT_EQ(one.quads, four.quads);
    EXPECT_EQ(one.midsides, four.midsides);
  }
}

TEST(Assembly, NotesNodesOffTheGeometryOnTheirFaces) {
  MeshedModel parts = cylinder();
  const FaceId face = face_id(2);
  FaceMesh& mesh = *parts.faces[face];
  mesh.off.assign(mesh.points.size(), 0);
  mesh.off.back() = 0.25;
  ShellMesh shell = shell_of(parts);
  ASSERT_EQ(shell.off_geometry.size(), 1U);
  EXPECT_EQ(shell.points[shell.off_geometry[0].node], mesh.points.back());
  for (const FaceId id : parts.faces.ids()) shell.faces.emplace_back().face = id.number();
  note_off_geometry(shell);
  for (const ShellMesh::Face& entry : shell.faces) {
    EXPECT_EQ(entry.off_geometry, entry.face == face.number() ? 1 : 0);
    EXPECT_EQ(entry.off_geometry_max, entry.face == face.number() ? 0.25 : 0);
    EXPECT_EQ(entry.note.empty(), entry.face != face.number());
  }
}

TEST(Assembly, NamesTheFaceThatNoStraightSideMends) {
  MeshedModel parts(CadModel::read(sample_model("box").path()), 3);
  EXPECT_NO_THROW(shell_of(parts, 2));
  std::vector<Vector3>& points = parts.faces[face_id(3)]->points;
  points.back() += 3 * (points.front() - points.back());  // the last node, far across its neighbors
  try {
    shell_of(parts, 2);
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), Error::Kind::failure);
    EXPECT_EQ(error.subject(), "Face3");
  }
}

}  // namespace
}  // namespace quadrille
