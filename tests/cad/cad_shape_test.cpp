/// The outline of a face in its parameter plane, by sixteen chords for each edge.

#include "geometry/cad/cad_shape.hpp"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRep_Builder.hxx>
#include <TopoDS_Wire.hxx>
#include <gp_Circ.hxx>
#include <gp_Pln.hxx>

#include <numbers>

#include "tests/support/ids.hpp"

namespace quadrille {
namespace {

/// A plate of 20 by 10 with a round hole of radius 3 around (5, 5), and a crack from (12, 2) to (12, 8).
TopoDS_Face cracked_plate() {
  BRepBuilderAPI_MakeFace face(gp_Pln(), 0, 20, 0, 10);
  const gp_Ax2 axes(gp_Pnt(5, 5, 0), gp_Dir(0, 0, -1));
  face.Add(BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(gp_Circ(axes, 3))).Wire());
  TopoDS_Face plate = face.Face();
  const BRep_Builder builder;
  TopoDS_Wire crack;
  builder.MakeWire(crack);
  builder.Add(crack,
              BRepBuilderAPI_MakeEdge(gp_Pnt(12, 2, 0), gp_Pnt(12, 8, 0)).Edge().Oriented(TopAbs_INTERNAL));
  builder.Add(plate, crack);
  return plate;
}

TEST(CoarseDomain, LeavesOutHolesButNotWhatLiesBehindACrack) {
  const CadShape shape(cracked_plate(), "plate");
  int cracks = 0;
  for (const CadWire& wire : shape.faces[face_id(1)].wires)
    for (const Coedge& coedge : wire.coedges) cracks += coedge.internal;
  ASSERT_GT(cracks, 0);
  const TrimmedDomain domain = coarse_domain(shape, shape.faces[face_id(1)]);
  EXPECT_LT((domain.low() - Vector2(0, 0)).norm() + (domain.high() - Vector2(20, 10)).norm(), 1e-9);
  const double chords =
      3 * std::cos(std::numbers::pi / 16);  // the circle's chords are no nearer to its center
  int inside = 0, in_hole = 0;
  for (double x = -0.95; x < 21; x += 0.1) {
    for (double y = -0.95; y < 11; y += 0.1) {
      const double radius = std::hypot(x - 5, y - 5);
      if (radius > chords && radius < 3) continue;
      const bool in_plate = x > 0 && x < 20 && y > 0 && y < 10;
      ASSERT_EQ(domain.inside({x, y}), in_plate && radius >= 3) << x << ' ' << y;
      inside += domain.inside({x, y});
      in_hole += radius < chords;
    }
  }
  EXPECT_GT(inside, 10000);
  EXPECT_GT(in_hole, 1000);
}

TEST(CoarseDomain, HasBothSidesOfASeam) {
  const CadShape shape(BRepPrimAPI_MakeCylinder(4, 10).Shape(), "cylinder");
  for (const CadFace& face : shape.faces) {
    if (face.wires[0].coedges.size() != 4) continue;
    const TrimmedDomain domain = coarse_domain(shape, face);
    for (const double u : {0.01, 3.0, 6.27}) EXPECT_TRUE(domain.inside({u, 5})) << u;
    for (const double u : {-0.01, 6.29}) EXPECT_FALSE(domain.inside({u, 5})) << u;
    return;
  }
  FAIL() << "no face has a seam";
}

}  // namespace
}  // namespace quadrille
