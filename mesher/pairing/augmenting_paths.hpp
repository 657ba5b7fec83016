#pragma once
/// Alternating paths between free triangles, with contraction of odd cycles. Internal.
/// Based on: Edmonds, Paths, trees, and flowers (1965); bases of contracted cycles by union and find (Gabow
/// 1976).

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <memory>
#include <new>
#include <utility>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "mesher/mesh/mesh_types.hpp"
#include "mesher/mesh/side_twins.hpp"

namespace quadrille {

/// First in, first out: the partner that is found is the nearest.
class NearestFirst {
 public:
  void start(int) { queue_.clear(), head_ = 0; }
  void push(int t) { queue_.push_back(t); }
  int pop() { return head_ < queue_.size() ? queue_[head_++] : -1; }
  int pushed() const { return static_cast<int>(queue_.size()); }

 private:
  std::vector<int> queue_;
  std::size_t head_ = 0;
};

/// Heads for a triangle: the next one of a list after the one that a search starts from. Where it is not to
/// be had soon, the nearest first after that.
class StraightToNext {
 public:
  StraightToNext(const TriangleMesh& mesh, const std::vector<int>& list) : mesh_(mesh), list_(list) {}

  /// \param k place in the list of where the search starts.
  void start(int k) {
    heap_.clear();
    patience_ = 5000;
    nearest_.start(k);
    aim_ = place_of(list_[static_cast<std::size_t>(k) + 1 < list_.size() ? k + 1 : 0]);
  }
  void push(int t) {
    nearest_.push(t);
    if (patience_ == 0) return;
    heap_.emplace_back(static_cast<float>((place_of(t) - aim_).squaredNorm()), t);
    std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
  }
  int pop() {
    // What was looked at already comes once more then, which costs little.
    if (patience_ == 0) return nearest_.pop();
    if (heap_.empty()) return -1;
    --patience_;
    std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
    const int t = heap_.back().second;
    heap_.pop_back();
    return t;
  }
  int pushed() const { return nearest_.pushed(); }

 private:
  const Vector3& place_of(int t) const { return mesh_.points[mesh_.triangles[t][0]]; }

  const TriangleMesh& mesh_;
  const std::vector<int>& list_;
  Vector3 aim_ = Vector3::Zero();
  std::vector<std::pair<float, int>> heap_;
  NearestFirst nearest_;
  int patience_ = 0;  // how many more to look at on the straight way
};

/// Searches paths from one free triangle at a time.
/// \tparam Pairs has size() triangles, twin_of(side), free(t), mate_of(t) (-1 = free) and pair(side), as
/// TriangleGraph. \tparam Order decides which triangle is looked at next.
template <class Pairs, class Order>
class PathFinder {
 public:
  PathFinder(Pairs& pairs, Order order)
      : pairs_(pairs),
        order_(std::move(order)),
        nodes_(static_cast<Node*>(std::calloc(static_cast<std::size_t>(pairs.size()) + 1, sizeof(Node)))) {
    if (!nodes_) throw std::bad_alloc();
  }

  /// Pairs a free triangle, and another that a path leads to, by exchange along the path. Gives up after
  /// `reach` triangles. \param k its place in the list of those to pair. \return whether there is a path.
  bool augment(int root, int k, int reach) {
    order_.start(k);
    first_stamp_ = ++stamp_;
    open(root);
    for (int from = order_.pop(); from >= 0 && order_.pushed() < reach; from = order_.pop()) {
      for (int i = 0; i < 3; ++i) {
        const Side side = make_side(from, i), across = pairs_.twin_of(side);
        if (across < 0) continue;
        const int t = triangle_of(across);
        if (t == pairs_.mate_of(from)) continue;
        if (!reached(t)) {
          nodes_[t] = {first_stamp_, 0, across, t, false};
          if (pairs_.free(t)) {
            exchange(t);
            return true;
          }
          open(pairs_.mate_of(t));
        } else if (nodes_[t].outer && base_of(t) != base_of(from)) {
          contract(side);
        }
      }
    }
    return false;
  }

 private:
  /// What the search knows of a triangle; zero where it was never reached.
  struct Node {
    int search;  // the stamp of the search that reached it
    int seen;    // the stamp of the search for a common base that passed
    Side via;    // its side across which its path to the root leaves, where that is not the one to its mate
    int parent;  // towards the base of the contracted cycle that it is in
    bool outer;  // at an even distance on some path
  };
  struct Free {
    void operator()(Node* memory) const { std::free(memory); }
  };

  bool reached(int t) const { return nodes_[t].search == first_stamp_; }

  void open(int t) {
    nodes_[t] = {first_stamp_, 0, -1, t, true};
    order_.push(t);
  }

  int base_of(int t) const {
    Node* const nodes = nodes_.get();
    while (nodes[t].parent != t) t = nodes[t].parent = nodes[nodes[t].parent].parent;
    return t;
  }

  /// The triangle two steps nearer to the root, from one at an even distance.
  int step(int t) const { return triangle_of(pairs_.twin_of(nodes_[pairs_.mate_of(t)].via)); }

  int common_base(int one, int two) {
    ++stamp_;
    one = base_of(one);
    two = base_of(two);
    for (;;) {
      if (one >= 0) {
        if (nodes_[one].seen == stamp_) return one;
        nodes_[one].seen = stamp_;
        one = pairs_.free(one) ? -1 : base_of(step(one));
      }
      std::swap(one, two);
    }
  }

  /// Makes one of the odd cycle that a side closes: whatever leads out of it can be gone on from.
  void contract(Side side) {
    const Side other = pairs_.twin_of(side);
    const int base = common_base(triangle_of(side), triangle_of(other));
    absorbed_.clear();
    redirect(side, base);
    redirect(other, base);
    for (int t : absorbed_) nodes_[t].parent = base;
  }

  /// Lets the paths of the triangles from that of a side down to a base lead over the side.
  void redirect(Side side, int base) {
    for (int t = triangle_of(side); base_of(t) != base;) {
      const int mate = pairs_.mate_of(t);
      absorbed_.push_back(base_of(t));
      absorbed_.push_back(base_of(mate));
      nodes_[t].via = side;
      if (!nodes_[mate].outer) {
        nodes_[mate].outer = true;
        order_.push(mate);
      }
      side = pairs_.twin_of(nodes_[mate].via);
      // From the triangle that this comes to, the path leads back here.
      t = triangle_of(side);
    }
  }

  void exchange(int t) {
    while (t >= 0) {
      const Side side = nodes_[t].via;
      t = pairs_.mate_of(triangle_of(pairs_.twin_of(side)));
      pairs_.pair(side);
    }
  }

  Pairs& pairs_;
  Order order_;
  std::unique_ptr<Node[], Free> nodes_;  // by triangle; mostly pages never touched
  std::vector<int> absorbed_;
  int stamp_ = 0, first_stamp_ = 0;
};

/// Pairs free triangles along alternating paths, as long as there are any within reach.
/// \param list the free triangles. \return how many of them are still free.
template <class Pairs, class Order>
int augment_pairs(Pairs& pairs, const std::vector<int>& list, Order order, int reach,
                  const ExecutionContext& context = {}) {
  if (list.empty()) return 0;
  PathFinder<Pairs, Order> finder(pairs, std::move(order));
  int left = 0;
  SparseCheck check(context, 16);
  for (std::size_t k = 0; k < list.size(); ++k) {
    check();
    if (pairs.free(list[k])) left += finder.augment(list[k], static_cast<int>(k), reach) ? 0 : 1;
  }
  if (left == 0) return 0;
  // Those that failed early may have been taken as the end of a later path.
  return static_cast<int>(std::count_if(list.begin(), list.end(), [&](int t) { return pairs.free(t); }));
}

}  // namespace quadrille
