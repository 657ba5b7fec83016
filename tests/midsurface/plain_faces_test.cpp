/// Faces that are flat become planes, and nothing else about a solid changes.

#include "geometry/midsurface/plain_faces.hpp"

#include <gtest/gtest.h>

#include <BRepAdaptor_Surface.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <GProp_GProps.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>

namespace quadrille {
namespace {

double volume(const TopoDS_Shape& shape) {
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shape, properties);
  return properties.Mass();
}

int planes(const TopoDS_Shape& shape) {
  int count = 0;
  for (TopExp_Explorer face(shape, TopAbs_FACE); face.More(); face.Next())
    count += BRepAdaptor_Surface(TopoDS::Face(face.Current())).GetType() == GeomAbs_Plane;
  return count;
}

TEST(PlainFaces, BecomePlanesWithTheirNormals) {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(gp_Pnt(5, 6, 7), 10, 20, 3).Shape();
  const TopoDS_Shape splines = BRepBuilderAPI_NurbsConvert(box, true).Shape();
  ASSERT_EQ(planes(splines), 0);
  const TopoDS_Shape plain = with_plain_faces(splines);
  EXPECT_EQ(planes(plain), 6);
  EXPECT_NEAR(volume(plain), 600, 1e-9) << "normals that were turned would take volume away";
  EXPECT_TRUE(BRepCheck_Analyzer(plain).IsValid());
}

TEST(PlainFaces, CurvedFacesStay) {
  const TopoDS_Shape can = BRepBuilderAPI_NurbsConvert(BRepPrimAPI_MakeCylinder(5, 8).Shape(), true).Shape();
  const TopoDS_Shape plain = with_plain_faces(can);
  EXPECT_EQ(planes(plain), 2);
  EXPECT_NEAR(volume(plain), volume(can), 0.01 * volume(can));  // as exact as its integrals over splines
}

}  // namespace
}  // namespace quadrille
