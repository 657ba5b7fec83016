/// Classifies with one wire at a time; a grid of cells finds the holes near by.

#include "geometry/midsurface/inside_test.hpp"

#include <BRepAdaptor_Surface.hxx>
#include <BRepClass_FaceClassifier.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <Precision.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Iterator.hxx>
#include <algorithm>
#include <array>
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
  return {face, std::make_unique<BRepTopAdaptor_FClass2d>(face, Precision::PConfusion())};
}

InsideTest::InsideTest(const TopoDS_Face& face) {
  if (!has_many_holes(face)) {
    outside_ = part_of(face);
    return;
  }
  const TopoDS_Face forward = TopoDS::Face(face.Oriented(TopAbs_FORWARD));
  const TopoDS_Wire outer = BRepTools::OuterWire(forward);
  const BRep_Builder builder;
  std::vector<std::array<double, 4>> boxes;  // of the holes
  std::array<double, 4> all{};
  BRepTools::UVBounds(forward, outer, all[0], all[1], all[2], all[3]);
  for (TopoDS_Iterator it(forward); it.More(); it.Next()) {
    if (it.Value().ShapeType() != TopAbs_WIRE) continue;
    TopoDS_Shape one = forward.EmptyCopied();
    builder.Add(one, it.Value());
    if (it.Value().IsSame(outer)) {
      outside_ = part_of(TopoDS::Face(one));
      continue;
    }
    holes_.push_back(part_of(TopoDS::Face(one)));
    auto& box = boxes.emplace_back();
    BRepTools::UVBounds(forward, TopoDS::Wire(it.Value()), box[0], box[1], box[2], box[3]);
  }
  count_ = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(holes_.size()))));
  for (int axis = 0; axis < 2; ++axis) {
    low_[axis] = all[2 * axis];
    step_[axis] = (all[2 * axis + 1] - all[2 * axis]) / static_cast<double>(count_);
  }
  cells_.resize(count_ * count_);
  for (std::size_t hole = 0; hole < boxes.size(); ++hole) {
    const auto& [u, high_u, v, high_v] = boxes[hole];
    const double wide = 0.01 * (high_u - u), high = 0.01 * (high_v - v);  // for points on the border
    for (std::size_t i = cell_of(u - wide, 0); i <= cell_of(high_u + wide, 0); ++i)
      for (std::size_t j = cell_of(v - high, 1); j <= cell_of(high_v + high, 1); ++j)
        cells_[i * count_ + j].push_back(hole);
  }
}

std::size_t InsideTest::cell_of(double value, int axis) const {
  const double cell = std::floor((value - low_[axis]) / step_[axis]);
  return static_cast<std::size_t>(std::clamp(cell, 0.0, static_cast<double>(count_ - 1)));
}

TopAbs_State InsideTest::at(const gp_Pnt2d& uv, double near) const {
  TopAbs_State result = outside_.at(uv, near);
  if (result != TopAbs_IN || holes_.empty()) return result;
  for (const std::size_t hole : cells_[cell_of(uv.X(), 0) * count_ + cell_of(uv.Y(), 1)]) {
    result = holes_[hole].at(uv, near);
    if (result != TopAbs_IN) return result;
  }
  return TopAbs_IN;
}

}  // namespace quadrille
