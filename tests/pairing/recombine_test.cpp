/// Recombination: no triangle is left where their number is even, one where it is odd, and the boundary
/// stays.

#include "mesher/pairing/recombine.hpp"

#include <gtest/gtest.h>

#include <random>

#include "geometry/base/error.hpp"
#include "mesher/mesh/quality.hpp"
#include "tests/support/triangulations.hpp"

namespace quadrille {
namespace {

using namespace testing;

QuadMesh recombined(const TriangleMesh& mesh, Method method = Method::quality, std::uint64_t seed = 1) {
  RecombineOptions options;
  options.method = method;
  options.seed = seed;
  ExecutionContext context;
  return recombine(mesh, options, context);
}

/// Both modes must give a faultless mesh; a case that does not is made small before it is shown.
void expect_faultless(const TriangleMesh& mesh, const std::string& name) {
  for (const Method method : {Method::quality, Method::paper}) {
    const auto fault = [method](const TriangleMesh& m) { return faults(m, recombined(m, method)); };
    const std::string what = fault(mesh);
    if (what.empty()) continue;
    const TriangleMesh small = shrink(mesh, [&](const TriangleMesh& m) { return !fault(m).empty(); });
    ADD_FAILURE() << name << (method == Method::paper ? " (paper mode): " : ": ") << what << "; shrunk to "
                  << small.triangles.size() << " triangles: " << fault(small) << ": " << describe(small);
  }
}

TEST(Shrink, MakesAFailingCaseSmall) {
  // What fails where a point has seven triangles needs seven.
  const auto fails = [](const TriangleMesh& mesh) {
    std::vector<int> count(mesh.points.size(), 0);
    for (const auto& triangle : mesh.triangles) {
      for (int v : triangle) ++count[v];
    }
    return std::any_of(count.begin(), count.end(), [](int n) { return n >= 7; });
  };
  const TriangleMesh mesh = random_square(300, 2);
  ASSERT_TRUE(fails(mesh));
  const TriangleMesh small = shrink(mesh, fails);
  EXPECT_TRUE(fails(small));
  EXPECT_EQ(small.triangles.size(), 7U) << describe(small);
}

TEST(Recombine, TakesTheSmallestInputs) {
  const QuadMesh nothing = recombined({});
  EXPECT_TRUE(nothing.quads.empty());
  EXPECT_TRUE(nothing.triangles.empty());
  expect_faultless(strip(1), "one triangle");
  expect_faultless(strip(2), "two triangles");
  expect_faultless(with_ears(strip(1)), "a triangle with three ears");
  EXPECT_EQ(recombined(strip(2)).quads.size(), 1U);
  EXPECT_EQ(recombined(with_ears(strip(1))).quads.size(), 2U);
}

TEST(Recombine, PairsRightAngledTrianglesIntoSquares) {
  const QuadMesh quads = recombined(grid(20, 10));
  ASSERT_EQ(quads.quads.size(), 200U);
  for (const auto& [a, b, c, d] : quads.quads) {
    EXPECT_NEAR(quad_q(quads.points[a], quads.points[b], quads.points[c], quads.points[d]), 1, 1e-12);
  }
}

TEST(Recombine, StripsBandsAndFans) {
  for (int n = 1; n < 40; ++n) {
    expect_faultless(strip(n), fmt::format("strip of {}", n));
    expect_faultless(fan(n, false), fmt::format("fan of {}", n));
    if (n >= 3) expect_faultless(fan(n, true), fmt::format("closed fan of {}", n));
    if (n >= 3) expect_faultless(band(n), fmt::format("band of {}", n));
  }
}

TEST(Recombine, EarsInARow) {
  for (int n = 1; n < 40; ++n) {
    expect_faultless(with_ears(strip(n)), fmt::format("strip of {} with ears", n));
    expect_faultless(with_ears(fan(n, false)), fmt::format("fan of {} with ears", n));
    if (n >= 3) expect_faultless(with_ears(band(n)), fmt::format("band of {} with ears", n));
    expect_faultless(with_ears(with_ears(strip(n))), fmt::format("strip of {} with ears on ears", n));
  }
}

TEST(Recombine, RandomPlanarWithHoles) {
  for (unsigned seed = 1; seed <= 150; ++seed) {
    const int count = 4 + static_cast<int>(seed * seed % 700);
    expect_faultless(random_square(count, seed), fmt::format("square {}", seed));
    expect_faultless(random_with_holes(count, 6, seed), fmt::format("holes {}", seed));
    expect_faultless(perforated(random_square(count, seed), 0.05 + 0.4 * (seed % 10) / 10, seed),
                     fmt::format("perforated {}", seed));
  }
}

TEST(Recombine, ClosedSurfaces) {
  for (int level = 0; level <= 4; ++level)
    expect_faultless(icosphere(level), fmt::format("icosphere {}", level));
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const int n = 3 + static_cast<int>(seed);
    expect_faultless(torus(n, 3 + n / 2, seed), fmt::format("torus {}", seed));
    expect_faultless(double_torus(n, 3 + n / 2, seed), fmt::format("double torus {}", seed));
  }
  TriangleMesh tetrahedron;
  tetrahedron.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  tetrahedron.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  expect_faultless(tetrahedron, "tetrahedron");
}

TEST(Recombine, TagsAreBoundaries) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    TriangleMesh mesh = random_square(300, seed);
    for (const auto& [a, b, c] : mesh.triangles) {
      const double x = (mesh.points[a] + mesh.points[b] + mesh.points[c]).x();
      mesh.tags.push_back(x < 1 ? 7 : x < 2 ? -3 : 12);
    }
    expect_faultless(mesh, fmt::format("tags {}", seed));
  }
}

TEST(Recombine, SeveralPiecesThatTouchInPoints) {
  TriangleMesh bow_tie;
  bow_tie.points = {{0, 0, 0}, {1, 1, 0}, {1, -1, 0}, {-1, -1, 0}, {-1, 1, 0}, {2, 0, 0}};
  bow_tie.triangles = {{0, 2, 1}, {0, 4, 3}, {1, 2, 5}};
  expect_faultless(bow_tie, "bow tie");
}

TEST(Recombine, AMillionTriangles) {
  TriangleMesh mesh = random_square(500'000, 3);
  const QuadMesh quads = recombined(mesh);
  EXPECT_EQ(faults(mesh, quads), "");
  mesh.triangles.pop_back();
  EXPECT_EQ(faults(mesh, recombined(mesh, Method::paper)), "");
}

TEST(Recombine, IsDeterministicForAnyThreadCount) {
  // Large enough to be worked on in several blocks.
  const TriangleMesh mesh = grid(400, 300, 9);
  ExecutionContext one(1), four(4);
  EXPECT_EQ(recombine(mesh, {}, one).quads, recombine(mesh, {}, four).quads);
}

TEST(Recombine, PaperModeFollowsItsSeed) {
  const TriangleMesh mesh = random_square(500, 4);
  EXPECT_EQ(recombined(mesh, Method::paper, 5).quads, recombined(mesh, Method::paper, 5).quads);
  EXPECT_NE(recombined(mesh, Method::paper, 5).quads, recombined(mesh, Method::paper, 6).quads);
}

TEST(Recombine, CanBeCancelled) {
  ExecutionContext context;
  context.cancel();
  try {
    recombine(grid(4, 4), {}, context);
    FAIL() << "not cancelled";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), Error::Kind::cancelled);
  }
}

/// The message of the Error that recombine throws.
std::string complaint(const TriangleMesh& mesh) {
  try {
    recombined(mesh);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), Error::Kind::failure);
    return error.what();
  }
  return "none";
}

TEST(Recombine, RefusesBadTriangulationsByName) {
  TriangleMesh mesh = strip(3);
  mesh.triangles[1] = {1, 3, 2};
  EXPECT_EQ(complaint(mesh), "triangle 1 runs along its side 2-1 the same way as triangle 0");
  mesh = strip(2);
  mesh.points.emplace_back(0, 0, 1);
  mesh.triangles.push_back({1, 2, 4});
  EXPECT_EQ(complaint(mesh), "triangle 2 is the third on the side 1-2");
  mesh = strip(2);
  mesh.triangles[1][2] = 9;
  EXPECT_EQ(complaint(mesh), "triangle 1 refers to point 9, which does not exist");
  mesh.triangles[1] = {3, 3, 1};
  EXPECT_EQ(complaint(mesh), "triangle 1 has the same point twice");
  // Sides that come twice the same way, whichever way their points are numbered, alone or with others.
  for (const bool mirrored : {false, true}) {
    mesh = strip(2);
    if (mirrored) {
      for (auto& triangle : mesh.triangles) std::swap(triangle[0], triangle[1]);
    }
    const std::array<int, 3> first = mesh.triangles[0];
    mesh.points.emplace_back(3, 3, 0);
    mesh.triangles = {first, {first[0], first[1], 4}};
    EXPECT_NE(complaint(mesh).find("the same way as triangle 0"), std::string::npos) << complaint(mesh);
    mesh.points.emplace_back(4, 4, 0);
    mesh.triangles.push_back({first[1], first[0], 5});
    EXPECT_NE(complaint(mesh).find("the same way as triangle 0"), std::string::npos) << complaint(mesh);
    mesh.points.emplace_back(5, 4, 0);
    mesh.triangles.push_back({first[1], first[0], 6});
    EXPECT_NE(complaint(mesh).find("the same way as triangle 0"), std::string::npos) << complaint(mesh);
    std::swap(mesh.triangles[1], mesh.triangles[2]);
    EXPECT_NE(complaint(mesh).find("is the third on the side"), std::string::npos) << complaint(mesh);
  }
  mesh = strip(2);
  mesh.tags = {1};
  EXPECT_EQ(complaint(mesh), "1 tags were given for 2 triangles");
}

}  // namespace
}  // namespace quadrille
