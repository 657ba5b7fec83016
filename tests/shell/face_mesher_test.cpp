/// Whole faces, by the candidates for their quads.

#include "mesher/shell/face_mesher.hpp"

#include <gtest/gtest.h>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <gp_Pnt.hxx>

#include <memory>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/quadrille.hpp"

namespace quadrille {
namespace {

/// Cut into four, elements of twice the size leave 23 quads of this wedge outside the limits.
TEST(FaceMesher, TakesElementsOfTheFinalSizeWherePartsOfLargerOnesArePoor) {
  const TopoDS_Shape wedge =
      BRepBuilderAPI_MakeFace(
          BRepBuilderAPI_MakePolygon(gp_Pnt(0, 0, 0), gp_Pnt(40, 0, 0), gp_Pnt(40, 8, 0), true).Wire())
          .Face();
  MeshOptions options;
  options.sizing.size = 4;
  ExecutionContext context(1);
  const ShellMesh shell = mesh(CadModel(std::make_shared<CadShape>(wedge, "wedge")), options, context);
  EXPECT_TRUE(validate(shell).empty());
  EXPECT_LE(check_criteria(shell).failing, 6);
}

}  // namespace
}  // namespace quadrille
