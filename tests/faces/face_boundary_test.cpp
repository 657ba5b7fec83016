/// Boundaries of all faces of the sample models in their parameter planes.

#include "mesher/faces/face_boundary.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/support/sampled_faces.hpp"

namespace quadrille {
namespace {

TEST(FaceBoundary, LiesOnTheEdgesAndCloses) {
  for_each_face([](SampledModel& sampled, FaceId, const FaceSurface& surface, const FaceBoundary& boundary) {
    std::vector<int> leaving(boundary.size(), 0), arriving(boundary.size(), 0);
    for (const auto& segment : boundary.segments) {
      ++leaving[segment.a];
      ++arriving[segment.b];
    }
    for (int i = 0; i < boundary.size(); ++i) {
      EXPECT_EQ(leaving[i], arriving[i]);
      const double off = (surface.point(boundary.uv[i]) - boundary.points[i]).norm();
      EXPECT_LT(off, 1e-5 * sampled.model.diagonal());
    }
    const auto with_length = std::count_if(boundary.segments.begin(), boundary.segments.end(),
                                           [](const FaceBoundary::Segment& s) { return !s.degenerate; });
    EXPECT_EQ(with_length % 2, 0);
  });
}

TEST(FaceBoundary, IsHalvedAtTheNodesBetween) {
  for_each_face([](SampledModel& sampled, FaceId, const FaceSurface&, const FaceBoundary& boundary) {
    const FaceBoundary half = halved(boundary);
    if (boundary.stride == 1) {
      EXPECT_EQ(half.size(), boundary.size());
      return;
    }
    const auto with_length = [](const FaceBoundary& of) {
      return std::count_if(of.segments.begin(), of.segments.end(),
                           [](const FaceBoundary::Segment& s) { return !s.degenerate; });
    };
    EXPECT_EQ(half.stride, 1);
    EXPECT_EQ(with_length(half), 2 * with_length(boundary));
    EXPECT_EQ(half.size(), boundary.size() + with_length(boundary));
    std::vector<int> leaving(half.size(), 0), arriving(half.size(), 0);
    for (const auto& segment : half.segments) {
      EXPECT_EQ(segment.middle_node, -1);
      ++leaving[segment.a];
      ++arriving[segment.b];
    }
    EXPECT_EQ(leaving, arriving);
    for (int i = 0; i < half.size(); ++i) EXPECT_EQ(half.points[i], sampled.nodes.points[half.nodes[i]]);
    for (std::size_t wire = 0; wire < half.first_segments.size(); ++wire) {
      for (std::size_t k = 0; k < half.first_segments[wire].size(); ++k) {
        const int first = boundary.first_segments[wire][k], now = half.first_segments[wire][k];
        ASSERT_EQ(first < 0, now < 0);
        if (first >= 0) {
          EXPECT_EQ(half.segments[now].a, boundary.segments[first].a);
        }
      }
    }
  });
}

}  // namespace
}  // namespace quadrille
