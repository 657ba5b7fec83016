/// The surfaces of faces, by formulas and seen from above.

#include "geometry/surfaces/face_surface.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "geometry/cad/cad_model.hpp"
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

/// Derivatives are those of the points, and moving a point of the surface returns its parameters.
TEST(FaceSurface, AgreesWithItself) {
  for (const SampleModel& sample : sample_models()) {
    const CadModel model = CadModel::read(sample.path());
    for (const CadFace& face : model.shape().faces) {
      const FaceSurface surface(face);
      const Vector2 low(face.u_min, face.v_min), span(face.u_max - face.u_min, face.v_max - face.v_min);
      const double size = (surface.mean_scale().cwiseProduct(span)).norm();
      for (int i = 0; i < 36; ++i) {
        const Vector2 uv = low + Vector2(0.1 + i % 6 * 0.16, 0.1 + i / 6 * 0.16).cwiseProduct(span);
        const SurfacePoint at = surface.evaluate(uv);
        const Vector2 step = 1e-6 * span;
        const Vector3 along_u = surface.point(uv + Vector2(step.x(), 0)) - at.point,
                      along_v = surface.point(uv + Vector2(0, step.y())) - at.point;
        EXPECT_LT((along_u - step.x() * at.du).norm(), 1e-9 * size) << sample.name;
        EXPECT_LT((along_v - step.y() * at.dv).norm(), 1e-9 * size) << sample.name;
        Vector2 moved = uv + 0.01 * span;
        EXPECT_LT((surface.project(moved, at.point).point - at.point).norm(), 1e-6 * size) << sample.name;
      }
    }
  }
}

}  // namespace
}  // namespace quadrille
