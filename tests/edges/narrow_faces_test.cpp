/// Nodes that face each other across narrow faces.

#include "mesher/edges/narrow_faces.hpp"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepOffsetAPI_ThruSections.hxx>
#include <gp_Circ.hxx>

#include <memory>

#include "mesher/quadrille.hpp"
#include "mesher/shell/validate.hpp"

namespace quadrille {
namespace {

/// A band between two circles, one of which is moved aside: equal shares of the two do not face each other.
CadModel make_band(double aside, double height) {
  BRepOffsetAPI_ThruSections band(Standard_False, Standard_True);
  for (const gp_Pnt& center : {gp_Pnt(0, 0, 0), gp_Pnt(aside, 0, height)}) {
    const gp_Circ circle(gp_Ax2(center, gp_Dir(0, 0, 1)), 10);
    band.AddWire(BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(circle).Edge()).Wire());
  }
  band.Build();
  return CadModel(std::make_shared<CadShape>(band.Shape(), "band"));
}

TEST(NarrowFaces, NodesFaceEachOtherAcrossAWallWithASeam) {
  const CadModel model = make_band(0.4, 0.2);
  MeshOptions options;
  options.sizing.size = 1.5;
  options.sizing.short_edges = false;  // the band is narrower than its elements are long
  options.improve.sliding_sweeps = 0;
  ExecutionContext context(1);
  const ShellMesh mesh = quadrille::mesh(model, options, context);
  EXPECT_EQ(validate(mesh), std::vector<std::string>{});
  EXPECT_TRUE(mesh.faces[0].note == "grid") << mesh.faces[0].note;
  EXPECT_GT(quality(mesh).q_min, 0.8);
}

}  // namespace
}  // namespace quadrille
