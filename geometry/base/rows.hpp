#pragma once
/// Lists in compressed rows: the items that belong to each node, cell or other index. Internal.

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace quadrille {

/// Lists by index, in one array. Each list keeps the order in which its items were added.
template <class Item = int>
class Rows {
 public:
  Rows() = default;
  /// Linear time and memory. \param count number of lists. \param visit calls its argument with (index,
  /// item) for each item; it is called twice, first to count.
  template <class Visit>
  Rows(std::size_t count, Visit&& visit) : first_(count + 1, 0) {
    visit([this](int row, const Item&) { ++first_[row + 1]; });
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    items_.resize(first_.back());
    std::vector<int> place(first_.begin(), first_.end() - 1);
    visit([&](int row, const Item& item) { items_[place[row]++] = item; });
  }

  std::span<const Item> operator[](std::size_t row) const {
    return {items_.data() + first_[row], items_.data() + first_[row + 1]};
  }
  std::span<Item> operator[](std::size_t row) {
    return {items_.data() + first_[row], items_.data() + first_[row + 1]};
  }
  std::size_t size() const { return first_.empty() ? 0 : first_.size() - 1; }  ///< number of lists
  /// All items, one list after the other. Leaves the lists without them.
  std::vector<Item> take_items() { return std::move(items_); }

 private:
  std::vector<int> first_;
  std::vector<Item> items_;
};

}  // namespace quadrille
