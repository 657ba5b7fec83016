/// Moves free triangles over pairs to each other by the cheapest way (Dijkstra), in each connected piece.

#include "mesher/pairing/costed_coloring.hpp"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

#include "mesher/pairing/augmenting_paths.hpp"
#include "mesher/pairing/zeroed_pages.hpp"

namespace quadrille {

namespace {

/// Walks free triangles to other free ones, across pairs.
class Walker {
 public:
  /// \param piece connected piece of each triangle. \param free the triangles to walk.
  Walker(CostedColoring& coloring, const std::vector<Vector3>& points, const std::vector<int>& piece,
         const std::vector<int>& free, const ExecutionContext& context)
      : coloring_(coloring),
        points_(points),
        piece_(piece),
        free_(free),
        check_(context),
        reached_(4 * static_cast<std::size_t>(coloring.size())) {}

  /// Takes a free triangle along the cheapest way to another. \return true if the two became a quad.
  bool walk(int start) {
    int at = start;
    // A step is checked just before it is taken. If it is impossible, search again from there.
    for (int attempts = 0; attempts < 100; ++attempts) {
      if (!search(at)) return false;
      if (follow(at)) return true;
    }
    return false;
  }

 private:
  static constexpr int flip_price = 3, concave_price = 30;
  /// How many sides are looked at for the cheapest way. Targets beyond that are approached directly;
  /// otherwise the cost of a few walks would grow with the mesh.
  static constexpr int max_sides_searched = 20'000;

  /// How a side was reached; all zero if it was not.
  struct Reached {
    int distance;  // plus 1
    Side from;     // plus 1: the side crossed before, 0 at the root
  };

  static bool contains(const std::vector<int>& list, int t) {
    return std::find(list.begin(), list.end(), t) != list.end();
  }

  /// Whether the free triangle beyond `entry`, a side of a pair, can move over the pair and leave by `exit`
  /// without a point occurring twice in the quad.
  bool can_step(Side entry, Side exit) const {
    const int u = triangle_of(entry);
    const int apex = coloring_.apex_of(coloring_.twin(entry));
    if (triangle_of(exit) != u) return coloring_.apex_of(entry) != apex;
    // After the flip, the triangle at the entry has the far corner of its mate.
    return coloring_.apex_of(coloring_.twin(coloring_.diagonal_of(u))) != apex;
  }

  int price(Side entry, Side exit) const {
    const int u = triangle_of(entry);
    if (triangle_of(exit) != u) return 1;
    return coloring_.cost_of(coloring_.diagonal_of(u)) < 3 ? flip_price : concave_price;
  }

  /// Finds a way to another free triangle: the cheapest if that is near, else one to the nearest in space.
  bool search(int root) {
    bool exhausted = true;
    if (search(root, nullptr, exhausted)) return true;
    if (exhausted) return false;
    const int target = nearest_free(root);
    if (target < 0) return false;
    const Vector3 aim = center_of(target);
    return search(root, &aim, exhausted);
  }

  Vector3 center_of(int t) const {
    const auto& c = coloring_.corners(t);
    return (points_[c[0]] + points_[c[1]] + points_[c[2]]) / 3;
  }

  int nearest_free(int root) const {
    const Vector3 from = center_of(root);
    int nearest = -1;
    double least = 0;
    for (int t : free_) {
      if (t == root || !coloring_.free(t) || piece_[t] != piece_[root]) continue;
      const double distance = (center_of(t) - from).squaredNorm();
      if (nearest >= 0 && distance >= least) continue;
      nearest = t;
      least = distance;
    }
    return nearest;
  }

  /// Dijkstra over the sides crossed (each seen from its far triangle), from a free triangle to another. With
  /// an aim, the sides nearest to it come first, whatever they cost.
  bool search(int root, const Vector3* aim, bool& exhausted) {
    for (Side s : touched_) reached_[s] = {};
    touched_.clear();
    queue_ = {};
    for (int i = 0; i < 3; ++i) offer(coloring_.twin(make_side(root, i)), 0, -1, aim);
    while (!queue_.empty()) {
      check_();
      const auto [key, s] = queue_.top();
      queue_.pop();
      const int distance = reached_[s].distance - 1;
      if (!aim && static_cast<int>(key) != distance) continue;
      if (!aim && static_cast<int>(touched_.size()) > max_sides_searched) {
        exhausted = false;
        return false;
      }
      const int u = triangle_of(s);
      if (coloring_.free(u)) {
        if (u == root || coloring_.apex_of(s) == coloring_.apex_of(coloring_.twin(s))) continue;
        trace(s);
        return true;
      }
      const bool first = reached_[s].from == 0;
      for (int t : {u, coloring_.mate_of(u)}) {
        for (int i = 0; i < 3; ++i) {
          const Side exit = make_side(t, i);
          if (exit == coloring_.diagonal_of(t) || exit == s || (first && !can_step(s, exit))) continue;
          offer(coloring_.twin(exit), distance + price(s, exit), s, aim);
        }
      }
    }
    return false;
  }

  void offer(Side s, int distance, Side from, const Vector3* aim) {
    if (s < 0) return;
    Reached& reached = reached_[s];
    if (reached.distance != 0 && (aim || reached.distance <= distance + 1)) return;
    if (reached.distance == 0) touched_.push_back(s);
    reached = {distance + 1, from + 1};
    queue_.emplace(aim ? (points_[coloring_.corner_at(s)] - *aim).squaredNorm() : distance, s);
  }

  void trace(Side s) {
    way_.clear();
    for (; s >= 0; s = reached_[s].from - 1) way_.push_back(s);
    std::reverse(way_.begin(), way_.end());
  }

  /// Walks the way. If it ends early, `at` is the triangle that is free then.
  bool follow(int& at) {
    recut_.clear();
    for (std::size_t k = 0; k < way_.size(); ++k) {
      const Side entry = way_[k];
      if (k + 1 == way_.size()) {
        if (coloring_.apex_of(entry) == coloring_.apex_of(coloring_.twin(entry))) return false;
        coloring_.pair(entry);
        return true;
      }
      // Pairs that this walk has recut differ from those that the search found.
      if (contains(recut_, triangle_of(entry)) || contains(recut_, triangle_of(way_[k + 1]))) return false;
      if (!step(entry, way_[k + 1], at)) return false;
    }
    return false;
  }

  bool step(Side entry, Side next, int& at) {
    const Side last = coloring_.twin(entry), exit = coloring_.twin(next);
    if (!can_step(entry, exit)) return false;
    const int u = triangle_of(entry), v = coloring_.mate_of(u);
    if (triangle_of(exit) == u) coloring_.flip(coloring_.diagonal_of(u), points_);
    at = triangle_of(coloring_.twin(next));
    coloring_.pair(last);
    recut_.insert(recut_.end(), {triangle_of(last), u, v});
    return true;
  }

  CostedColoring& coloring_;
  const std::vector<Vector3>& points_;
  const std::vector<int>& piece_;
  const std::vector<int>& free_;
  SparseCheck check_;
  ZeroedPages<Reached> reached_;  // by side; mostly never touched
  std::vector<Side> touched_;
  std::priority_queue<std::pair<double, Side>, std::vector<std::pair<double, Side>>, std::greater<>> queue_;
  std::vector<Side> way_;
  std::vector<int> recut_;
};

}  // namespace

int migrate_free_triangles(CostedColoring& coloring, const std::vector<Vector3>& points,
                           const ExecutionContext& context) {
  const std::vector<int> free = free_triangles(coloring);
  if (free.size() < 2) return static_cast<int>(free.size());
  std::vector<int> piece;
  const auto twin_of = [&](Side side) { return coloring.twin(side); };
  std::vector<int> free_in(number_pieces(coloring.size(), twin_of, piece), 0);
  for (int t : free) ++free_in[piece[t]];
  Walker walker(coloring, points, piece, free, context);
  for (int t : free) {
    if (free_in[piece[t]] < 2 || !coloring.free(t)) continue;
    if (walker.walk(t)) free_in[piece[t]] -= 2;
  }
  return static_cast<int>(free_triangles(coloring).size());
}

}  // namespace quadrille
