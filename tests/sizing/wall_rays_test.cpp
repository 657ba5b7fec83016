/// Sizes by the thickness of walls.

#include "geometry/sizing/wall_rays.hpp"

#include <gtest/gtest.h>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeWedge.hxx>
#include <algorithm>
#include <cmath>
#include <memory>

#include "geometry/cad/cad_model.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "geometry/surfaces/face_surface.hpp"

namespace quadrille {
namespace {

CadModel model_of(const TopoDS_Shape& shape) {
  return CadModel(std::make_shared<CadShape>(shape, "made"));
}

/// A tray of walls 1 thick.
TopoDS_Shape housing() {
  return BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(60, 40, 30).Shape(),
                         BRepPrimAPI_MakeBox(gp_Pnt(1, 1, 1), gp_Pnt(59, 39, 31)).Shape())
      .Shape();
}

TopoDS_Shape tube(double inner, double outer) {
  return BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(outer, 40).Shape(),
                         BRepPrimAPI_MakeCylinder(inner, 40).Shape())
      .Shape();
}

/// Looks at a grid of points of each face that lie in it: visit(face, point, inward).
template <class Visit>
void look(const CadModel& model, Visit&& visit) {
  const CadShape& shape = model.shape();
  for (const FaceId id : shape.faces.ids()) {
    const CadFace& face = shape.faces[id];
    const FaceSurface surface(face);
    constexpr int n = 11;
    for (int k = 0; k < n * n; ++k) {
      const int column = k % n, row = k / n;
      const Vector2 uv(face.u_min + (column + 0.5) / n * (face.u_max - face.u_min),
                       face.v_min + (row + 0.5) / n * (face.v_max - face.v_min));
      visit(id, surface.point(uv), Vector3((face.reversed ? 1 : -1) * surface.normal(uv)));
    }
  }
}

/// Whether a point lies on an outer or inner skin of the housing, away from rims and corners.
bool on_wall(const Vector3& p) {
  int far = 0, near = 0;
  const Vector3 high(60, 40, 30);
  for (int axis = 0; axis < 3; ++axis) {
    const double depth = axis == 2 ? p.z() : std::min(p[axis], high[axis] - p[axis]);
    near += depth < 1.001;
    far += depth > 2 && (axis != 2 || p.z() < 29);
  }
  return near == 1 && far == 2;
}

TEST(WallRays, TellTheThicknessOfFlatWalls) {
  for (const bool inside_out : {false, true}) {
    const TopoDS_Shape shape = housing();
    const CadModel model = model_of(inside_out ? shape.Reversed() : shape);
    const WallRays rays(model.shape(), 0.5, {});
    int walls = 0;
    look(model, [&](FaceId, const Vector3& p, const Vector3& inward) {
      if (!on_wall(p)) return;
      const auto thickness = rays.thickness(p, inward, 8);
      ASSERT_TRUE(thickness) << p.transpose();
      EXPECT_NEAR(*thickness, 1, 1e-9) << p.transpose();
      EXPECT_FALSE(rays.thickness(p, inward, 0.9));
      ++walls;
    });
    EXPECT_GT(walls, 500);
  }
}

TEST(WallRays, TellTheThicknessOfCurvedWalls) {
  for (const double thickness : {0.3, 1.0, 4.0}) {
    const CadModel model = model_of(tube(10 - thickness, 10));
    const WallRays rays(model.shape(), thickness, {});
    int walls = 0;
    look(model, [&](FaceId face, const Vector3& p, const Vector3& inward) {
      if (std::abs(inward.z()) > 0.5) return;  // the rims
      const auto found = rays.thickness(p, inward, 8);
      ASSERT_TRUE(found) << face.number() << ": " << p.transpose();
      EXPECT_NEAR(*found, thickness, 0.1 * thickness);
      ++walls;
    });
    EXPECT_GT(walls, 200);
  }
}

TEST(WallRays, KnowNoWallsWhereThereAreNone) {
  // Skins at 60 degrees to each other.
  const CadModel wedge = model_of(BRepPrimAPI_MakeWedge(10, 10 * std::sqrt(0.75), 10, 5, 0, 5, 10).Shape());
  const WallRays in_wedge(wedge.shape(), 1, {});
  int slanted = 0;
  look(wedge, [&](FaceId, const Vector3& p, const Vector3& inward) {
    if (std::abs(inward.z()) > 0.5) return;
    EXPECT_FALSE(in_wedge.thickness(p, inward, 8)) << p.transpose();
    ++slanted;
  });
  EXPECT_GT(slanted, 100);
  const CadModel block = model_of(BRepPrimAPI_MakeBox(30, 20, 10).Shape());
  const WallRays in_block(block.shape(), 1, {});
  look(block, [&](FaceId, const Vector3& p, const Vector3& inward) {
    EXPECT_FALSE(in_block.thickness(p, inward, 9.9)) << p.transpose();
  });
}

TEST(WallRays, SizesAreTheThicknessOverTheElements) {
  const CadModel model = model_of(housing());
  ExecutionContext context;
  SizingOptions options;
  options.size = 4;
  options.size_min = 0.1;
  for (const Gradation gradation : {Gradation::surface, Gradation::space}) {
    options.gradation = gradation;
    for (const double elements : {0.5, 2.0}) {
      options.proximity_walls = elements;
      const SizingField field = SizingField::build(model, options, context);
      int walls = 0;
      look(model, [&](FaceId face, const Vector3& p, const Vector3&) {
        if (!on_wall(p)) return;
        SizingField::Sampler size_at(field, face);
        // Samples are up to 1.5 sizes apart: between them sizes grow a little.
        EXPECT_LE(size_at(p), 1.2 / elements) << p.transpose();
        EXPECT_GE(size_at(p), 0.99 / elements) << p.transpose();
        ++walls;
      });
      EXPECT_GT(walls, 500);
    }
  }
}

}  // namespace
}  // namespace quadrille
