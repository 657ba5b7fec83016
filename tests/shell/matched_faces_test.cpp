/// A face gets the mesh of another one, moved, and each node knows its partner.

#include "mesher/shell/matched_faces.hpp"

#include <gtest/gtest.h>

#include <BRepPrimAPI_MakeBox.hxx>

#include <algorithm>
#include <set>

#include "geometry/base/error.hpp"
#include "mesher/mesh/quad_geometry.hpp"
#include "mesher/shell/assembly.hpp"
#include "mesher/shell/validate.hpp"
#include "tests/support/meshed_model.hpp"

namespace quadrille {
namespace {

/// The first face of a box and the one across, which OpenCASCADE numbers next.
testing::MeshedModel box() {
  return {CadModel(std::make_shared<CadShape>(BRepPrimAPI_MakeBox(6, 4, 5).Shape(), "box")), 1, {{2, 1, 2}}};
}

TEST(MatchedFaces, GetTheMeshOfTheOtherMoved) {
  testing::MeshedModel parts = box();
  const MatchedFace& pair = parts.matches.faces.front();
  EXPECT_TRUE(pair.flips);
  parts.faces[pair.to]->quads.clear();  // whatever was there
  copy_faces(parts.model.shape(), parts.matches, parts.nodes, parts.faces);
  const FaceMesh &from = *parts.faces[pair.from], &to = *parts.faces[pair.to];
  ASSERT_EQ(to.quads.size(), from.quads.size());
  ASSERT_EQ(to.points.size(), from.points.size());
  for (std::size_t i = 0; i < to.points.size(); ++i)
    EXPECT_LT((to.points[i] - pair.motion(from.points[i])).norm(), 1e-9);
  const auto& edges = parts.nodes.edges;
  std::set<int> own;
  for (const MatchedEdge& edge : pair.edges)
    own.insert(edges[edge.to].nodes.begin(), edges[edge.to].nodes.end());
  EXPECT_EQ(std::set<int>(to.nodes.begin(), to.nodes.end()), own);
  Vector3 before = Vector3::Zero(), after = Vector3::Zero();
  for (const auto& quad : from.quads) before += quad_area_vector(from.points, quad);
  for (const auto& quad : to.quads) after += quad_area_vector(to.points, quad);
  EXPECT_LT((before + after).norm(), 1e-9 * before.norm()) << "both look out of the box";
  Vector2 uv = to.uv.back();
  Vector3 normal;
  EXPECT_LT((to.surface->move(uv, to.points.back(), normal) - to.points.back()).norm(), 1e-9);
  EXPECT_GT(std::abs(normal.dot(after)), 0.999 * after.norm());
  EXPECT_EQ(normal.dot(after) < 0, parts.model.shape().faces[pair.to].reversed);
}

TEST(MatchedFaces, ListTheirPairsAtEachOrder) {
  for (const int order : {1, 2}) {
    testing::MeshedModel parts = box();
    copy_faces(parts.model.shape(), parts.matches, parts.nodes, parts.faces);
    ExecutionContext context(1);
    ShellNumbering numbering;
    ShellMesh mesh = assemble(parts.geometry, parts.nodes, parts.faces, order, context, &numbering);
    list_matches(parts.matches, parts.nodes, numbering, mesh);
    EXPECT_EQ(validate(mesh, true), std::vector<std::string>{});
    ASSERT_EQ(mesh.matches.size(), 1U);
    std::set<int> first, second, on_face;
    for (const auto& [a, b] : mesh.matches[0].nodes) {
      EXPECT_TRUE(first.insert(a).second && second.insert(b).second);
      EXPECT_LT((mesh.matches[0].motion(mesh.points[a]) - mesh.points[b]).norm(), 1e-9);
    }
    for (std::size_t quad = 0; quad < mesh.quads.size(); ++quad) {
      if (mesh.quad_faces[quad] != 2) continue;
      on_face.insert(mesh.quads[quad].begin(), mesh.quads[quad].end());
      if (order == 2) on_face.insert(mesh.midsides[quad].begin(), mesh.midsides[quad].end());
    }
    EXPECT_EQ(second, on_face);
    mesh.points[*second.begin()].x() += 0.01;
    mesh.matches.clear();
    EXPECT_THROW(list_matches(parts.matches, parts.nodes, numbering, mesh), Error);
  }
}

TEST(MatchedFaces, AreRefusedWhereANodeHasNoCounterpart) {
  testing::MeshedModel parts = box();
  auto& nodes = parts.nodes.edges[parts.matches.faces.front().edges.front().to].nodes;
  nodes.erase(nodes.begin() + 1);
  try {
    copy_faces(parts.model.shape(), parts.matches, parts.nodes, parts.faces);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.subject(), "match");
    EXPECT_EQ(error.kind(), Error::Kind::failure);
  }
}

}  // namespace
}  // namespace quadrille
