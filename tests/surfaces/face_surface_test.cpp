/// The surfaces of faces, by formulas and seen from above.

#include "geometry/surfaces/face_surface.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "geometry/cad/cad_model.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "tests/support/ids.hpp"
#include "tests/support/sample_models.hpp"

namespace quadrille {
namespace {

TEST(FaceSurface, IsTheSameSeenFromAbove) {
  const CadModel model = CadModel::read(sample_model("bezier_patch").path());
  const CadFace& face = model.shape().faces[face_id(1)];
  const FaceSurface own(face);
  std::vector<Vector3> loop;
  const Vector2 low(face.u_min, face.v_min), span(face.u_max - face.u_min, face.v_max - face.v_min);
  for (const Vector2& corner : {Vector2(0, 0), Vector2(1, 0), Vector2(1, 1), Vector2(0, 1)})
    loop.push_back(own.point(low + corner.cwiseProduct(span)));
  const FaceSurface view = FaceSurface::seen_from_above(face, loop);
  EXPECT_TRUE(view.is_view());
  const double size = (loop[2] - loop[0]).norm();
  for (int i = 0; i < 100; ++i) {
    const int column = i % 10, row = i / 10;
    const Vector2 uv = low + Vector2(0.05 + column / 11.0, 0.05 + row / 11.0).cwiseProduct(span);
    const Vector3 point = own.point(uv);
    const Vector2 seen = view.seen_at(point);
    const SurfacePoint at = view.evaluate(seen);
    EXPECT_LT((at.point - point).norm(), 1e-6 * size);
    EXPECT_GT(view.normal(seen).dot(own.normal(uv)), 1 - 1e-6);
    const double step = 1e-5 * size;
    EXPECT_LT((view.point(seen + Vector2(step, 0)) - at.point - step * at.du).norm(), 1e-3 * step);
    EXPECT_LT((view.point(seen + Vector2(0, step)) - at.point - step * at.dv).norm(), 1e-3 * step);
    Vector2 moved = seen;
    EXPECT_LT((view.project(moved, point + 0.01 * size * view.normal(seen)).point - point).norm(),
              0.02 * size);
  }
}

TEST(FaceSurface, AgreesWithItsDerivativesAndItsInverse) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(0.05, 0.95);
  int faces = 0;
  for (const SampleModel& sample : sample_models()) {
    SCOPED_TRACE(sample.name);
    const CadModel model = CadModel::read(sample.path());
    for (const CadFace& face : model.shape().faces) {
      const FaceSurface surface(face);
      ++faces;
      for (int i = 0; i < 20; ++i) {
        const Vector2 extent(face.u_max - face.u_min, face.v_max - face.v_min);
        const Vector2 uv(face.u_min + unit(random) * extent.x(), face.v_min + unit(random) * extent.y());
        const SurfacePoint at = surface.evaluate(uv);
        const double h = 1e-6;
        const Vector3 du =
            (surface.point(uv + Vector2(h * extent.x(), 0)) - surface.point(uv - Vector2(h * extent.x(), 0)));
        EXPECT_LT((du / (2 * h * extent.x()) - at.du).norm(),
                  1e-4 * (at.du.norm() + model.diagonal() / extent.x()));
        const Vector3 n = surface.normal(uv);
        EXPECT_NEAR(n.norm(), 1, 1e-9);
        EXPECT_NEAR(n.dot(at.du.normalized()), 0, 1e-9);
        // A point lifted off the surface comes back to it.
        const double lift = 1e-3 * model.diagonal();
        Vector2 found = uv + 0.01 * extent;
        EXPECT_LT((surface.project(found, at.point + lift * n).point - at.point).norm(),
                  1e-5 * model.diagonal());
      }
    }
  }
  EXPECT_GT(faces, 20);
}

}  // namespace
}  // namespace quadrille
