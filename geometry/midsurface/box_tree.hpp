#pragma once
/// A tree of boxes that a line is intersected with. Internal.

#include <gp_Lin.hxx>
#include <gp_XYZ.hxx>
#include <vector>

namespace quadrille {

/// A box with sides along the axes.
struct AxisBox {
  gp_XYZ low, high;
};

/// Boxes, halved again and again along their longest extent.
class BoxTree {
 public:
  explicit BoxTree(std::vector<AxisBox> boxes);
  /// Indices, ascending, of the boxes that a line meets between two parameters, which may be infinite. Time:
  /// logarithmic in the boxes.
  std::vector<std::size_t> met(const gp_Lin& line, double from, double to) const;

 private:
  /// A box around some of the boxes; its first half follows it in the list, unless it is a leaf.
  struct Node {
    AxisBox box;
    std::size_t first = 0, last = 0;  ///< positions in order_
    std::size_t second_half = 0;      ///< index of its node; 0 = a leaf
  };
  void add(std::size_t first, std::size_t last);

  std::vector<AxisBox> boxes_;
  std::vector<std::size_t> order_;
  std::vector<Node> nodes_;  ///< the root first
};

}  // namespace quadrille
