/// Gaps between opposite parts of a face's boundary.

#include "geometry/sizing/face_gaps.hpp"

#include <gtest/gtest.h>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepTools.hxx>
#include <gp_Pln.hxx>

#include <sstream>

#include "geometry/cad/cad_model.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "tests/support/ids.hpp"
#include "tests/support/sample_models.hpp"

namespace quadrille {
namespace {

TEST(FaceGaps, FindsHolesByTheirRims) {
  const CadModel model = CadModel::read(sample_model("bracket").path());
  ExecutionContext context;
  int found = 0;
  for (const FaceId face : model.shape().faces.ids()) {
    if (!FaceSurface(model.shape().faces[face]).planar()) continue;
    for (const FaceGap& gap : face_gaps(model.shape(), face, 12, 0.1, context)) {
      ++found;
      EXPECT_LE(gap.width(), 12);
      // Across the face, not through the hole: the middle lies in the plane and in the domain.
      const FaceSurface surface(model.shape().faces[face]);
      EXPECT_LT(surface.distance_at_least(0.5 * (gap.from + gap.to)), 1e-6);
    }
  }
  EXPECT_GT(found, 50);
}

TEST(FaceGaps, CornersOfABoxAreNone) {
  const CadModel model = CadModel::read(sample_model("box").path());
  ExecutionContext context;
  for (const FaceId face : model.shape().faces.ids())
    EXPECT_TRUE(face_gaps(model.shape(), face, 9, 0.1, context).empty());
  EXPECT_FALSE(face_gaps(model.shape(), face_id(1), 30, 0.1, context).empty());
}

/// A wedge narrows to nothing: no gap there is too narrow to look for the next one.
TEST(FaceGaps, EndWhereAWedgeDoes) {
  BRepBuilderAPI_MakePolygon wire(gp_Pnt(100, 0, 0), gp_Pnt(110, 0, 0), gp_Pnt(110, 3, 0), true);
  std::ostringstream text;
  BRepTools::Write(BRepBuilderAPI_MakeFace(gp_Pln(gp::XOY()), wire.Wire()).Face(), text);
  const CadModel model = CadModel::from_brep(text.str(), "wedge");
  ExecutionContext context;
  const auto gaps = face_gaps(model.shape(), face_id(1), 5, 1e-15, context);
  EXPECT_GT(gaps.size(), 10U);
  EXPECT_LT(gaps.size(), 10000U);
}

}  // namespace
}  // namespace quadrille
