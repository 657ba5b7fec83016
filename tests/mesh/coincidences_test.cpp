/// Meshes with separate, joined, doubled and collapsed elements, and what is said of them.

#include "mesher/mesh/coincidences.hpp"

#include <gtest/gtest.h>

namespace quadrille {
namespace {

/// A square of 1 at x, y, z as a face of its own with four edges.
void add_square(ShellMesh& mesh, double x, double y, double z) {
  const int base = static_cast<int>(mesh.points.size()), face = static_cast<int>(mesh.quads.size()) + 1;
  for (const auto& [u, v] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
    mesh.points.push_back({x + u, y + v, z});
  mesh.quads.push_back({base, base + 1, base + 2, base + 3});
  mesh.quad_faces.push_back(face);
  for (int k = 0; k < 4; ++k)
    mesh.segments.push_back({{base + k, base + (k + 1) % 4}, -1, 4 * (face - 1) + k + 1});
}

TEST(Coincidences, AJoinedMeshHasNone) {
  ShellMesh mesh;
  add_square(mesh, 0, 0, 0);
  add_square(mesh, 0, 0, 1);
  EXPECT_EQ(coincidences(mesh).nodes, 0);
  EXPECT_EQ(coincidences(mesh).sentence(), "");
  EXPECT_EQ(coincidences(ShellMesh()).nodes, 0);
}

TEST(Coincidences, FreeEdgesOnFreeEdgesAreForSewing) {
  ShellMesh mesh;
  add_square(mesh, 0, 0, 0);
  add_square(mesh, 1, 0, 0);
  const Coincidences found = coincidences(mesh);
  EXPECT_EQ(found.nodes, 2);
  EXPECT_EQ(found.quads, 0);
  EXPECT_EQ(found.free_edges, (std::vector<int>{2, 8}));
  EXPECT_EQ(found.faces, (std::vector<int>{1, 2}));
  EXPECT_EQ(found.remedy(), "sew");
  EXPECT_NE(found.sentence().find("`sew`"), std::string::npos);
}

TEST(Coincidences, QuadsOnQuadsAreForImprinting) {
  ShellMesh mesh;
  add_square(mesh, 0, 0, 0);
  add_square(mesh, 0, 0, 0);
  const Coincidences found = coincidences(mesh);
  EXPECT_EQ(found.nodes, 4);
  EXPECT_EQ(found.quads, 1);
  EXPECT_EQ(found.remedy(), "imprint");
  EXPECT_NE(found.sentence().find("`imprint`"), std::string::npos);
}

/// Quads that share their nodes and lie on each other: the skins of a sliver whose sides were suppressed.
TEST(Coincidences, QuadsOfTheSameNodes) {
  ShellMesh mesh;
  add_square(mesh, 0, 0, 0);
  mesh.quads.push_back({3, 2, 1, 0});
  mesh.quad_faces.push_back(2);
  EXPECT_EQ(coincidences(mesh).quads, 1);
  EXPECT_EQ(coincidences(mesh).remedy(), "keep_features");
}

/// A side that has shrunk to a point is a defect of its quad, no contact of parts.
TEST(Coincidences, ACollapsedSideIsNone) {
  ShellMesh mesh;
  add_square(mesh, 0, 0, 0);
  mesh.points[1] = mesh.points[0];
  EXPECT_EQ(coincidences(mesh).nodes, 0);
}

}  // namespace
}  // namespace quadrille
