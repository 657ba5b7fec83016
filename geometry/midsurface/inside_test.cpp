/// Classifies with one wire at a time, of the holes only where the parameters are in their box.

#include "geometry/midsurface/inside_test.hpp"

#include <BRepAdaptor_Surface.hxx>
#include <BRepClass_FaceClassifier.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <Precision.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Iterator.hxx>
#include <cmath>

namespace quadrille {

bool has_many_holes(const TopoDS_Face& face) {
  constexpr int many = 64;
  return face.NbChildren() > many && BRepAdaptor_Surface(face, Standard_False).GetType() == GeomAbs_Plane;
}

TopAbs_State InsideTest::Part::at(const gp_Pnt2d& uv, double near) const {
  const TopAbs_State state = inside->Perform(uv, Standard_True);
  if (state != TopAbs_ON) return state;
  // OpenCASCADE replaces the boundary by a polygon, and takes points within the error of the polygon to lie
  // on it. For a face with curved sides that error may be a hundredth of its size.
  BRepClass_FaceClassifier exact;
  exact.Perform(face, uv, near);
  return exact.State();
}

InsideTest::Part InsideTest::part_of(const TopoDS_Face& face) {
  return {face, std::make_unique<BRepTopAdaptor_FClass2d>(face, Precision::PConfusion()), {}};
}

InsideTest::InsideTest(const TopoDS_Face& face) {
  if (!has_many_holes(face)) {
    outside_ = part_of(face);
    return;
  }
  const TopoDS_Face forward = TopoDS::Face(face.Oriented(TopAbs_FORWARD));
  const TopoDS_Wire outer = BRepTools::OuterWire(forward);
  const BRep_Builder builder;
  for (TopoDS_Iterator it(forward); it.More(); it.Next()) {
    if (it.Value().ShapeType() != TopAbs_WIRE) continue;
    TopoDS_Shape one = forward.EmptyCopied();
    builder.Add(one, it.Value());
    Part& part = it.Value().IsSame(outer) ? outside_ : holes_.emplace_back();
    part = part_of(TopoDS::Face(one));
    BRepTools::AddUVBounds(forward, TopoDS::Wire(it.Value()), part.box);
    part.box.Enlarge(0.01 * std::sqrt(part.box.SquareExtent()));  // for points on the border
  }
}

TopAbs_State InsideTest::at(const gp_Pnt2d& uv, double near) const {
  TopAbs_State result = outside_.at(uv, near);
  for (auto hole = holes_.begin(); hole != holes_.end() && result == TopAbs_IN; ++hole)
    if (!hole->box.IsOut(uv)) result = hole->at(uv, near);
  return result;
}

}  // namespace quadrille
