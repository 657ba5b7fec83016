/// Splits boxes at the median of their centers, and walks down where the line meets a node.

#include "geometry/midsurface/box_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace quadrille {

namespace {

bool meets(const AxisBox& box, const gp_Lin& line, double from, double to) {
  for (int axis = 1; axis <= 3; ++axis) {
    const double start = line.Location().Coord(axis), along = line.Direction().Coord(axis);
    const double low = box.low.Coord(axis) - start, high = box.high.Coord(axis) - start;
    if (std::abs(along) < 1e-12) {  // a face is shorter than 1e12 times the width of its box
      if (low > 0 || high < 0) return false;
      continue;
    }
    from = std::max(from, std::min(low / along, high / along));
    to = std::min(to, std::max(low / along, high / along));
  }
  return from <= to;
}

}  // namespace

BoxTree::BoxTree(std::vector<AxisBox> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  if (!boxes_.empty()) add(0, boxes_.size());
}

void BoxTree::add(std::size_t first, std::size_t last) {
  constexpr std::size_t leaf = 8;
  const std::size_t index = nodes_.size();
  Node node{boxes_[order_[first]], first, last};
  for (std::size_t i = first; i < last; ++i) {
    const AxisBox& box = boxes_[order_[i]];
    for (int axis = 1; axis <= 3; ++axis) {
      node.box.low.SetCoord(axis, std::min(node.box.low.Coord(axis), box.low.Coord(axis)));
      node.box.high.SetCoord(axis, std::max(node.box.high.Coord(axis), box.high.Coord(axis)));
    }
  }
  nodes_.push_back(node);
  if (last - first <= leaf) return;
  const gp_XYZ size = node.box.high - node.box.low;
  int longest = 1;
  for (const int axis : {2, 3}) longest = size.Coord(axis) > size.Coord(longest) ? axis : longest;
  const std::size_t half = (first + last) / 2;
  const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  const auto center = [&](std::size_t i) {
    return boxes_[i].low.Coord(longest) + boxes_[i].high.Coord(longest);
  };
  std::nth_element(at(first), at(half), at(last), [&](std::size_t a, std::size_t b) {
    return std::pair(center(a), a) < std::pair(center(b), b);
  });
  add(first, half);
  nodes_[index].second_half = nodes_.size();
  add(half, last);
}

std::vector<std::size_t> BoxTree::met(const gp_Lin& line, double from, double to) const {
  std::vector<std::size_t> result, open;
  if (!nodes_.empty()) open.push_back(0);
  while (!open.empty()) {
    const std::size_t index = open.back();
    open.pop_back();
    const Node& node = nodes_[index];
    if (!meets(node.box, line, from, to)) continue;
    if (node.second_half > 0) {
      open.push_back(node.second_half);
      open.push_back(index + 1);
      continue;
    }
    for (std::size_t i = node.first; i < node.last; ++i)
      if (meets(boxes_[order_[i]], line, from, to)) result.push_back(order_[i]);
  }
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace quadrille
