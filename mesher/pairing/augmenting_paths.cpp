/// Based on: Edmonds, Paths, trees, and flowers (1965); bases of contracted cycles by union-find (Gabow
/// 1976).

#include "mesher/pairing/augmenting_paths.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "mesher/pairing/zeroed_pages.hpp"

namespace quadrille {

namespace {

/// Decides which triangle a search looks at next. The search heads for the triangle of a list that follows
/// its start: the triangle nearest to that comes first. If this does not succeed soon, or no mesh is given,
/// the order is first in, first out, so that the search finds the nearest partner.
class SearchOrder {
 public:
  SearchOrder(const TriangleMesh* mesh, const std::vector<int>& list) : mesh_(mesh), list_(list) {}

  /// \param k index of the start in the list.
  void start(std::size_t k) {
    queue_.clear();
    heap_.clear();
    head_ = 0;
    patience_ = mesh_ ? 5000 : 0;
    if (mesh_) aim_ = place_of(list_[k + 1 < list_.size() ? k + 1 : 0]);
  }
  void push(int t) {
    queue_.push_back(t);
    if (patience_ == 0) return;
    heap_.emplace_back(static_cast<float>((place_of(t) - aim_).squaredNorm()), t);
    std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
  }
  int pop() {
    // Without patience, triangles that were looked at already come once more, which costs little.
    if (patience_ == 0) return head_ < queue_.size() ? queue_[head_++] : -1;
    if (heap_.empty()) return -1;
    --patience_;
    std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
    const int t = heap_.back().second;
    heap_.pop_back();
    return t;
  }
  int pushed() const { return static_cast<int>(queue_.size()); }

 private:
  const Vector3& place_of(int t) const { return mesh_->points[mesh_->triangles[t][0]]; }

  const TriangleMesh* mesh_;
  const std::vector<int>& list_;
  Vector3 aim_ = Vector3::Zero();
  std::vector<int> queue_;
  std::size_t head_ = 0;
  std::vector<std::pair<float, int>> heap_;
  int patience_ = 0;  // triangles that may still be looked at on the direct way
};

/// Searches for paths from one free triangle at a time.
class PathFinder {
 public:
  PathFinder(EdgeColoring& pairs, const std::vector<int>& free, const PathOptions& options)
      : pairs_(pairs), reach_(options.reach), order_(options.heading, free), nodes_(pairs.size()) {}

  /// Pairs a free triangle and another one, by exchange along a path between them. \param k index of the
  /// first in the list of free triangles. \return whether there is a path within reach.
  bool augment(int root, std::size_t k) {
    order_.start(k);
    first_stamp_ = ++stamp_;
    open(root);
    for (int from = order_.pop(); from >= 0 && order_.pushed() < reach_; from = order_.pop()) {
      for (int i = 0; i < 3; ++i) {
        const Side side = make_side(from, i), across = pairs_.twin(side);
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
  /// The state of the search at a triangle; zero where it was never reached.
  struct Node {
    int search;  // stamp of the search that reached it
    int seen;    // stamp of the search for a common base that passed it
    Side via;    // its side across which its path to the root leaves, unless that is the one to its mate
    int parent;  // towards the base of the contracted cycle that holds it
    bool outer;  // at an even distance from the root on some path
  };

  bool reached(int t) const { return nodes_[t].search == first_stamp_; }

  void open(int t) {
    nodes_[t] = {first_stamp_, 0, -1, t, true};
    order_.push(t);
  }

  int base_of(int t) const {
    while (nodes_[t].parent != t) t = nodes_[t].parent = nodes_[nodes_[t].parent].parent;
    return t;
  }

  /// The triangle two steps nearer to the root, from one at an even distance.
  int step(int t) const { return triangle_of(pairs_.twin(nodes_[pairs_.mate_of(t)].via)); }

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

  /// Contracts the odd cycle that a side closes, so that the search can continue from each of its triangles.
  void contract(Side side) {
    const Side other = pairs_.twin(side);
    const int base = common_base(triangle_of(side), triangle_of(other));
    absorbed_.clear();
    redirect(side, base);
    redirect(other, base);
    for (int t : absorbed_) nodes_[t].parent = base;
  }

  /// Makes the paths of the triangles from that of a side down to a base lead across the side.
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
      side = pairs_.twin(nodes_[mate].via);
      // From the next triangle, the path leads back here.
      t = triangle_of(side);
    }
  }

  void exchange(int t) {
    while (t >= 0) {
      const Side side = nodes_[t].via;
      t = pairs_.mate_of(triangle_of(pairs_.twin(side)));
      pairs_.pair(side);
    }
  }

  EdgeColoring& pairs_;
  int reach_;
  SearchOrder order_;
  ZeroedPages<Node> nodes_;  // by triangle; mostly never touched
  std::vector<int> absorbed_;
  int stamp_ = 0, first_stamp_ = 0;
};

}  // namespace

std::vector<int> free_triangles(const EdgeColoring& coloring) {
  std::vector<int> free;
  for (int t = 0; t < coloring.size(); ++t) {
    if (coloring.free(t)) free.push_back(t);
  }
  return free;
}

int augment(EdgeColoring& coloring, const std::vector<int>& free, const PathOptions& options,
            const ExecutionContext& context) {
  if (free.empty()) return 0;
  PathFinder finder(coloring, free, options);
  SparseCheck check(context, 16);
  for (std::size_t k = 0; k < free.size(); ++k) {
    check();
    if (coloring.free(free[k])) finder.augment(free[k], k);
  }
  return static_cast<int>(std::count_if(free.begin(), free.end(), [&](int t) { return coloring.free(t); }));
}

}  // namespace quadrille
