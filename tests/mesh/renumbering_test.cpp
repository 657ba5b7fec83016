/// Large meshes in another order are the same meshes.

#include "mesher/mesh/renumbering.hpp"

#include <gtest/gtest.h>

#include "geometry/base/error.hpp"
#include "geometry/base/execution_context.hpp"
#include "mesher/pairing/recombine.hpp"
#include "tests/support/triangulations.hpp"

namespace quadrille {
namespace {

using namespace testing;

/// Points and triangles in random order.
TriangleMesh shuffled(const TriangleMesh& mesh, unsigned seed) {
  std::mt19937 generator(seed);
  std::vector<int> to(mesh.points.size());
  for (std::size_t v = 0; v < to.size(); ++v) to[v] = static_cast<int>(v);
  std::shuffle(to.begin(), to.end(), generator);
  TriangleMesh result = mesh;
  for (std::size_t v = 0; v < to.size(); ++v) result.points[to[v]] = mesh.points[v];
  std::shuffle(result.triangles.begin(), result.triangles.end(), generator);
  for (auto& triangle : result.triangles) {
    for (int& v : triangle) v = to[v];
  }
  return result;
}

TEST(Renumbering, OnlyLargeScatteredMeshesNeedIt) {
  EXPECT_FALSE(is_scattered(shuffled(grid(100, 100), 1)));
  EXPECT_FALSE(is_scattered(grid(500, 400, 1)));
  EXPECT_TRUE(is_scattered(shuffled(grid(500, 400, 1), 1)));
}

TEST(Renumbering, KeepsEveryTriangleAndBringsNeighborsTogether) {
  TriangleMesh mesh = shuffled(grid(500, 400, 1), 2);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) mesh.tags.push_back(static_cast<int>(t));
  mesh.points.emplace_back(-1, -1, 0);  // no triangle uses it
  const RenumberedMesh ordered = order_by_place(mesh);
  ASSERT_EQ(ordered.mesh.triangles.size(), mesh.triangles.size());
  EXPECT_EQ(ordered.mesh.points.size() + 1, mesh.points.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<int, 3> back = ordered.mesh.triangles[t];
    for (int& v : back) {
      ASSERT_EQ(ordered.mesh.points[v], mesh.points[ordered.old_point[v]]);
      v = ordered.old_point[v];
    }
    ASSERT_EQ(back, mesh.triangles[ordered.mesh.tags[t]]);
  }
  EXPECT_FALSE(is_scattered(ordered.mesh));
}

TEST(Renumbering, QuadsOfAScatteredMeshAreFaultless) {
  const TriangleMesh mesh = shuffled(grid(500, 400, 1), 3);
  for (const Method method : {Method::quality, Method::paper}) {
    RecombineOptions options;
    options.method = method;
    ExecutionContext context;
    EXPECT_EQ(faults(mesh, recombine(mesh, options, context)), "");
  }
}

TEST(Renumbering, ErrorsNameTheTriangleByItsOwnNumber) {
  TriangleMesh mesh = shuffled(grid(500, 400, 1), 4);
  std::swap(mesh.triangles[77][0], mesh.triangles[77][1]);
  ExecutionContext context;
  try {
    recombine(mesh, {}, context);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("triangle 77"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace quadrille
