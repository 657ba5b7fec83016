/// Points placed on faces of sample models: spacing against the size, gaps, the domain, the surface.

#include "mesher/faces/point_placement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "mesher/quadrille.hpp"
#include "mesher/shell/face_mesher.hpp"
#include "tests/support/sample_models.hpp"
#include "tests/support/sampled_faces.hpp"

namespace quadrille {
namespace {

/// The first face of a model with a boundary of one size, and points on it.
struct Placed {
  Placed(const std::string& name, double wanted, const PlacementOptions& how = {})
      : model(CadModel::read(sample_model(name).path())), size(wanted * how.scale), options(how) {
    MeshOptions mesh_options;
    mesh_options.strategy = how.scale > 1 ? Strategy::subdivide : Strategy::direct;
    mesh_options.sizing.size = wanted;
    mesh_options.sizing.size_min = wanted;  // the same everywhere
    const CadShape& shape = model.shape();
    const FaceId face = FaceId::from_index(0);
    ExecutionContext context(1);
    const SizingField field = SizingField::build(model, mesh_options.sizing, context);
    const BoundaryNodes nodes = sample_edges(shape, field, stride(mesh_options.strategy),
                                             FaceFlags(shape.faces.size(), 1), SamplingPlan(shape), context);
    const FaceSurface surface(shape.faces[face]);
    boundary = face_boundary(shape, face, shape.faces[face], surface, nodes);
    domain = enclosed_domain(boundary);
    SizingField::Sampler size_at(field, face);
    placed = place_points(boundary, surface, domain, size_at, options, context);
    for (std::size_t i = 0; i < placed.uv.size(); ++i)
      off_surface = std::max(off_surface, (surface.point(placed.uv[i]) - placed.points[i]).norm());
  }

  /// The distance from a placed point to the nearest other point; boundary points count too.
  double nearest(std::size_t i, bool with_boundary) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < placed.points.size(); ++k)
      if (k != i) least = std::min(least, (placed.points[k] - placed.points[i]).norm());
    if (with_boundary)
      for (const Vector3& point : boundary.points) least = std::min(least, (point - placed.points[i]).norm());
    return least;
  }

  CadModel model;
  double size;
  PlacementOptions options;
  FaceBoundary boundary;
  TrimmedDomain domain;
  PlacedPoints placed;
  double off_surface = 0;
};

const std::vector<std::pair<const char*, double>>& cases() {
  static const std::vector<std::pair<const char*, double>> list{
      {"disc", 1.1}, {"plate_with_holes", 3}, {"bezier_patch", 2.3}, {"cylinder", 1.7}};
  return list;
}

TEST(PointPlacement, LiesInsideAndOnTheSurface) {
  for (const auto& [name, size] : cases()) {
    const Placed on(name, size);
    ASSERT_EQ(on.placed.uv.size(), on.placed.points.size());
    ASSERT_GT(on.placed.points.size(), 50U) << name;
    for (const Vector2& uv : on.placed.uv)
      EXPECT_TRUE(on.domain.inside(uv)) << name << ": " << uv.transpose();
    EXPECT_LT(on.off_surface, 1e-9 * on.model.diagonal()) << name;
  }
}

/// Not nearer to each other or to the boundary than the options say, nor farther apart than the size by much.
TEST(PointPlacement, KeepsTheSize) {
  for (const auto& [name, size] : cases()) {
    for (const double refusal : {0.6, PlacementOptions().refusal}) {
      const Placed on(name, size, {.refusal = refusal});
      double sum = 0;
      for (std::size_t i = 0; i < on.placed.points.size(); ++i) {
        const double nearest = on.nearest(i, true);
        EXPECT_GT(nearest, 0.99 * refusal * on.size) << name;
        EXPECT_LT(nearest, 1.3 * on.size) << name;
        sum += nearest / on.size;
      }
      const double mean = sum / static_cast<double>(on.placed.points.size());
      EXPECT_GT(mean, 0.75) << name;
      EXPECT_LT(mean, 1.05) << name;
    }
  }
}

/// No place in the domain is far from all points.
TEST(PointPlacement, LeavesNoGaps) {
  for (const auto& [name, size] : cases()) {
    const Placed on(name, size);
    const FaceSurface surface(on.model.shape().faces[FaceId::from_index(0)]);
    constexpr int steps = 60;
    int inside = 0;
    for (int i = 0; i < steps * steps; ++i) {
      const int column = i % steps, row = i / steps;
      const Vector2 share((column + 0.5) / steps, (row + 0.5) / steps);
      const Vector2 uv = on.domain.low() + share.cwiseProduct(on.domain.high() - on.domain.low());
      if (!on.domain.inside(uv)) continue;
      ++inside;
      double nearest = std::numeric_limits<double>::infinity();
      const Vector3 place = surface.point(uv);
      for (const auto* points : {&on.placed.points, &on.boundary.points})
        for (const Vector3& point : *points) nearest = std::min(nearest, (point - place).norm());
      EXPECT_LT(nearest, 1.1 * on.size) << name << ": " << place.transpose();
    }
    EXPECT_GT(inside, steps * steps / 4) << name;
  }
}

TEST(PointPlacement, PlacesAQuarterAtTwiceTheSize) {
  const Placed fine("plate_with_holes", 1.2), coarse("plate_with_holes", 1.2, {.scale = 2});
  const double ratio =
      static_cast<double>(fine.placed.points.size()) / static_cast<double>(coarse.placed.points.size());
  EXPECT_GT(ratio, 3);
  EXPECT_LT(ratio, 6);
}

TEST(PointPlacement, GivesTheSameTwice) {
  for (const auto& [name, size] : cases()) {
    const Placed first(name, size), second(name, size);
    EXPECT_EQ(first.placed.points, second.placed.points) << name;
    EXPECT_EQ(first.placed.uv, second.placed.uv) << name;
  }
}

TEST(Placement, KeepsItsDistanceAndStaysInside) {
  for_each_face([](SampledModel& sampled, FaceId, const FaceSurface& surface, const FaceBoundary& boundary) {
    const TrimmedDomain domain = enclosed_domain(boundary);
    const PlacedPoints placed = place(sampled, surface, boundary);
    SizingField::Sampler size_at(sampled.field);
    // Points come as near to each other as the nodes of the boundary, down to 0.4 times the size.
    double least = 1;
    for (const auto& segment : boundary.segments) {
      const double length = (boundary.points[segment.b] - boundary.points[segment.a]).norm();
      for (const int end : {segment.a, segment.b})
        least = std::min(least, length / (sampled.nodes.stride * size_at(boundary.points[end])));
    }
    least = std::max(least, 0.4);
    for (std::size_t i = 0; i < placed.uv.size(); ++i) {
      EXPECT_TRUE(domain.inside(placed.uv[i]));
      EXPECT_LT((surface.point(placed.uv[i]) - placed.points[i]).norm(), 1e-9 * sampled.model.diagonal());
      const double limit = 0.5 * least * sampled.nodes.stride * size_at(placed.points[i]);
      for (std::size_t j = i + 1; j < std::min(placed.uv.size(), i + 50); ++j) {
        EXPECT_GT((placed.points[i] - placed.points[j]).norm(), limit);
      }
    }
  });
}

}  // namespace
}  // namespace quadrille
