/// A bounding volume hierarchy of OpenCASCADE, whose nodes are left out where the line misses them.

#include "geometry/midsurface/box_tree.hpp"

#include <BVH_Tools.hxx>
#include <BVH_Traverse.hxx>
#include <algorithm>

namespace quadrille {

namespace {

BVH_Vec3d vector_of(const gp_XYZ& of) {
  return BVH_Vec3d(of.X(), of.Y(), of.Z());
}

/// Collects the boxes that a stretch of a line meets.
class Met : public BVH_Traverse<double, 3, BVH_BoxSet<double, 3, std::size_t>> {
 public:
  Met(const gp_Lin& line, double from, double to)
      : start_(vector_of(line.Location().XYZ() + from * line.Direction().XYZ())),
        along_(vector_of((to - from) * line.Direction().XYZ())) {}

  Standard_Boolean RejectNode(const BVH_Vec3d& low, const BVH_Vec3d& high, double& enter) const override {
    double leave = 0;
    return !BVH_Tools<double, 3>::RayBoxIntersection(start_, along_, low, high, enter, leave) || enter > 1;
  }
  Standard_Boolean Accept(const Standard_Integer index, const double&) override {
    const BVH_Box<double, 3> box = myBVHSet->Box(index);
    double enter = 0;
    if (RejectNode(box.CornerMin(), box.CornerMax(), enter)) return Standard_False;
    found.push_back(myBVHSet->Element(index));
    return Standard_True;
  }

  std::vector<std::size_t> found;

 private:
  BVH_Vec3d start_, along_;
};

}  // namespace

BoxTree::BoxTree(const std::vector<Bnd_Box>& boxes) : boxes_(std::make_shared<Boxes>()) {
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const gp_Pnt low = boxes[i].CornerMin(), high = boxes[i].CornerMax();
    boxes_->Add(i, BVH_Box<double, 3>(vector_of(low.XYZ()), vector_of(high.XYZ())));
  }
  boxes_->Build();
}

std::vector<std::size_t> BoxTree::met(const gp_Lin& line, double from, double to) const {
  Met met(line, from, to);
  met.SetBVHSet(boxes_.get());
  if (boxes_->Size() > 0) met.Select();
  std::sort(met.found.begin(), met.found.end());
  return std::move(met.found);
}

}  // namespace quadrille
