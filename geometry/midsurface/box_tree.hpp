#pragma once
/// A tree of boxes that a line is intersected with. Internal.

#include <BVH_BoxSet.hxx>
#include <Bnd_Box.hxx>
#include <gp_Lin.hxx>
#include <memory>
#include <vector>

namespace quadrille {

class BoxTree {
 public:
  explicit BoxTree(const std::vector<Bnd_Box>& boxes = {});
  /// Indices, ascending, of the boxes that a line meets between two parameters. Time: logarithmic in the
  /// boxes.
  std::vector<std::size_t> met(const gp_Lin& line, double from, double to) const;

 private:
  using Boxes = BVH_BoxSet<double, 3, std::size_t>;
  std::shared_ptr<Boxes> boxes_;  ///< with its tree
};

}  // namespace quadrille
