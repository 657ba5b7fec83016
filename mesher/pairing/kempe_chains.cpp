/// Based on: Kempe, On the geographical problem of the four colors (1879), for the chains; Lin & Kernighan,
/// An effective heuristic algorithm for the traveling-salesman problem (1973), for chains whose partial gains
/// stay positive.

#include "mesher/pairing/kempe_chains.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include <boost/dynamic_bitset.hpp>

#include "geometry/base/threads.hpp"
#include "geometry/base/whole_number.hpp"
#include "mesher/pairing/augmenting_paths.hpp"

namespace quadrille {

namespace {

constexpr float least_gain = 1e-3F;

/// Exchanges a free triangle for another one where that lowers the costs.
class FreeMover {
 public:
  explicit FreeMover(CostedColoring& coloring) : coloring_(coloring), reached_in_(coloring.size(), -1) {}

  void move(int start) {
    constexpr std::size_t reach = 1000;
    steps_.assign(1, {start, 0, -1, -1});
    reached_in_[start] = start;
    best_ = 0;
    for (std::size_t k = 0; k < steps_.size() && steps_.size() < reach; ++k) {
      for (int i = 0; i < 3; ++i) take(k, make_side(steps_[k].triangle, i));
    }
    // From the start on, each pairing sets the next triangle of the way free.
    std::vector<Side> way;
    for (int k = static_cast<int>(best_); steps_[k].before >= 0; k = steps_[k].before)
      way.push_back(steps_[k].across);
    std::for_each(way.rbegin(), way.rend(), [this](Side side) { coloring_.pair(side); });
  }

 private:
  /// A triangle that is set free: its former mate is paired across `across` with the triangle before.
  struct Step {
    int triangle;
    float gain;
    int before;
    Side across;
  };

  void take(std::size_t k, Side side) {
    const Side twin = coloring_.twin(side);
    if (twin < 0) return;
    const int start = steps_[0].triangle, taken = triangle_of(twin), freed = coloring_.mate_of(taken);
    if (freed < 0 || reached_in_[taken] == start || reached_in_[freed] == start) return;
    reached_in_[taken] = reached_in_[freed] = start;
    const float gain =
        steps_[k].gain + coloring_.cost_of(coloring_.diagonal_of(taken)) - coloring_.cost_of(side);
    if (gain > steps_[best_].gain + least_gain) best_ = steps_.size();
    steps_.push_back({freed, gain, static_cast<int>(k), side});
  }

  CostedColoring& coloring_;
  std::vector<Step> steps_;
  std::vector<int> reached_in_;  // by triangle: start of the last search that reached it
  std::size_t best_ = 0;
};

}  // namespace

void move_free(CostedColoring& coloring, const ExecutionContext& context) {
  SparseCheck check(context, 1);
  FreeMover mover(coloring);
  for (int t : free_triangles(coloring)) {
    check();
    mover.move(t);
  }
}

namespace {

/// How far the number of quads at each point is from the ideal, and what that costs.
class Valences {
 public:
  Valences(const CostedColoring& coloring, const std::vector<Vector3>& points)
      : deviation_(points.size(), 0) {
    std::vector<char> boundary(points.size(), 0);
    for (int t = 0; t < coloring.size(); ++t) {
      for (int i = 0; i < 3; ++i) {
        const Side side = make_side(t, i);
        const int v = coloring.corner_at(side);
        ++deviation_[v];
        if (coloring.twin(side) < 0) boundary[v] = boundary[coloring.end_of(side)] = 1;
        // At its ends, a diagonal makes one quad of two triangles. Each side of it counts for its start.
        if (coloring.diagonal_of(t) == side) --deviation_[v];
      }
    }
    std::vector<float> angle(points.size(), 0);
    for (int t = 0; t < coloring.size(); ++t) {
      for (int i = 0; i < 3; ++i) {
        if (const int v = coloring.corners(t)[i]; boundary[v])
          angle[v] += angle_at(coloring.corners(t), i, points);
      }
    }
    for (std::size_t v = 0; v < points.size(); ++v) {
      deviation_[v] -= boundary[v] ? std::max(1, round_to_int(angle[v] / 1.57079633F)) : 4;
    }
  }

  /// Change of cost when each end of a side gets a quad more (less), since it stops being (becomes) a
  /// diagonal.
  float more(int a, int b) { return change(a, 1) + change(b, 1); }
  float fewer(int a, int b) { return change(a, -1) + change(b, -1); }

  /// Replaces the diagonals `before` by those `after` in the counts.
  void exchange(const CostedColoring& coloring, const std::vector<Side>& before,
                const std::vector<Side>& after) {
    for (const Side s : before) more(coloring.corner_at(s), coloring.end_of(s));
    for (const Side s : after) fewer(coloring.corner_at(s), coloring.end_of(s));
  }

 private:
  static constexpr float weight = 0.4F;  // of one unit of squared deviation, against a pair's cost

  static float angle_at(const std::array<int, 3>& corner, int i, const std::vector<Vector3>& points) {
    const Vector3& p = points[corner[i]];
    const Vector3 a = points[corner[next_index(i)]] - p, b = points[corner[previous_index(i)]] - p;
    return static_cast<float>(angle_between(a, b));
  }

  float change(int v, int by) {
    const int before = deviation_[v], after = before + by;
    deviation_[v] = static_cast<std::int16_t>(after);
    return weight * static_cast<float>(after * after - before * before);
  }

  std::vector<std::int16_t> deviation_;
};

/// Searches for closed chains of the removed color and a second one, from one triangle at a time. The second
/// color is not stored: a chain may use any side that does not have the removed color.
class Exchanger {
 public:
  /// \param open (triangles) 1 = may be used; null = all. Points of the others are not touched.
  Exchanger(CostedColoring& coloring, Valences& valences, const char* open)
      : coloring_(coloring), valences_(valences), open_(open) {}

  bool may_use(int t) const { return !open_ || open_[t]; }

  /// Makes the best exchange along a cycle through the pair of `t`, if one gains.
  /// \return the triangles of the cycle, in pairs; empty if none.
  const std::vector<int>& improve(int t) {
    best_gain_ = least_gain;
    best_.clear();
    path_.clear();
    touched_.clear();
    if (!usable(t)) return touched_;
    root_ = coloring_.mate_of(t);
    release(t, 0);
    if (!best_.empty()) apply();
    return touched_;
  }

 private:
  static constexpr int max_pairs = 20;
  static constexpr int broad_pairs = 5;
  static constexpr float slack = -0.15F;  // because of the valences, gains depend on the order

  /// Whether the triangle has a mate and both may be used. Checks the flag first, since other threads may be
  /// changing triangles beyond it.
  bool usable(int t) const {
    if (!may_use(t)) return false;
    const int mate = coloring_.mate_of(t);
    return mate >= 0 && may_use(mate);
  }

  /// Opens the pair of `t` and seeks a new mate for `t` across its two other sides. Follows both ways over
  /// the first pairs, then only the better one.
  void release(int t, float gain) {
    const Side diagonal = coloring_.diagonal_of(t);
    const int a = coloring_.corner_at(diagonal), b = coloring_.end_of(diagonal);
    gain += coloring_.cost_of(diagonal) - valences_.more(a, b);
    const Side one = next_side(diagonal), two = previous_side(diagonal);
    const float rest_one = rest_after(one, gain), rest_two = rest_after(two, gain);
    const bool narrow = static_cast<int>(path_.size()) >= broad_pairs;
    if (rest_two > rest_one) {
      join(two, rest_two);
      if (!narrow) join(one, rest_one);
    } else {
      join(one, rest_one);
      if (!narrow) join(two, rest_two);
    }
    valences_.fewer(a, b);
  }

  /// What remains of the gain when a pair is made across a side; far below zero if that is impossible.
  float rest_after(Side side, float gain) {
    constexpr float nothing = -1e8F;
    const Side across = coloring_.twin(side);
    if (across < 0 || !usable(triangle_of(across))) return nothing;
    const int a = coloring_.corner_at(side), b = coloring_.end_of(side);
    const float rest = gain - coloring_.cost_of(side) - valences_.fewer(a, b);
    valences_.more(a, b);
    return rest;
  }

  /// Makes a pair across a side and continues from the mate that this leaves alone.
  void join(Side side, float rest) {
    if (rest <= slack) return;
    const Side across = coloring_.twin(side);
    const int next = triangle_of(across);
    if (next == root_) {
      if (rest <= best_gain_) return;
      best_gain_ = rest;
      best_ = path_;
      best_.push_back(across);
      return;
    }
    if (static_cast<int>(path_.size()) + 1 >= max_pairs || on_path(next)) return;
    const int a = coloring_.corner_at(side), b = coloring_.end_of(side);
    path_.push_back(across);
    valences_.fewer(a, b);
    release(coloring_.mate_of(next), rest);
    valences_.more(a, b);
    path_.pop_back();
  }

  /// Whether the pair of t has been opened already.
  bool on_path(int t) const {
    const int mate = coloring_.mate_of(t);
    if (mate == root_) return true;
    for (Side s : path_) {
      if (triangle_of(s) == t || triangle_of(s) == mate) return true;
    }
    return false;
  }

  /// The sides that lose the removed color, for the sides of a chain that get it.
  const std::vector<Side>& diagonals_of(const std::vector<Side>& chain) {
    diagonals_.clear();
    for (Side s : chain) diagonals_.push_back(coloring_.diagonal_of(triangle_of(s)));
    return diagonals_;
  }

  void apply() {
    valences_.exchange(coloring_, diagonals_of(best_), best_);
    for (Side s : best_) {
      coloring_.pair(s);
      touched_.insert(touched_.end(), {triangle_of(s), triangle_of(coloring_.twin(s))});
    }
  }

  CostedColoring& coloring_;
  Valences& valences_;
  const char* open_;
  int root_ = -1;
  float best_gain_ = 0;
  std::vector<Side> path_, best_, diagonals_;
  std::vector<int> touched_;
};

/// Exchanges around the given triangles until nothing gains; triangles around an exchange are tried again.
/// \param queued scratch, a zero for each triangle, and zero again afterwards.
void exchange_around(const CostedColoring& coloring, Exchanger& exchanger, std::vector<int> current,
                     std::vector<char>& queued, const ExecutionContext& context) {
  constexpr int max_rounds = 20;
  std::vector<int> next;
  const auto enqueue = [&](int t) {
    if (queued[t]) return;
    queued[t] = 1;
    next.push_back(t);
  };
  for (int round = 0; round < max_rounds && !current.empty(); ++round) {
    next.clear();
    for (std::size_t k = 0; k < current.size(); ++k) {
      if (k % 512 == 0) context.check();
      queued[current[k]] = 0;
      for (int changed : exchanger.improve(current[k])) {
        enqueue(changed);
        for (int i = 0; i < 3; ++i) {
          const Side s = coloring.twin(make_side(changed, i));
          if (s >= 0 && exchanger.may_use(triangle_of(s))) enqueue(triangle_of(s));
        }
      }
    }
    std::swap(current, next);
  }
  for (int t : current) queued[t] = 0;
}

/// Number of consecutive triangles in a block. If the mesh is ordered by place, few of these lie at its edge.
constexpr int block_size = 1 << 15;

/// Marks the triangles whose points all belong to one block only.
std::vector<char> mark_inner(const CostedColoring& coloring, std::size_t point_count) {
  constexpr int none = -1, several = -2;
  std::vector<int> block_of(point_count, none);
  for (int t = 0; t < coloring.size(); ++t) {
    for (int v : coloring.corners(t)) {
      int& block = block_of[v];
      block = block == none || block == t / block_size ? t / block_size : several;
    }
  }
  std::vector<char> inner(coloring.size());
  for (int t = 0; t < coloring.size(); ++t) {
    const auto& c = coloring.corners(t);
    inner[t] = block_of[c[0]] != several && block_of[c[1]] != several && block_of[c[2]] != several;
  }
  return inner;
}

/// Exchanges along chains that a search finds.
void exchange_laid_chains(CostedColoring& coloring, Valences& valences, std::size_t points,
                          ExecutionContext& context) {
  std::vector<char> queued(coloring.size(), 0);
  std::vector<int> remaining;
  if (coloring.size() < 2 * block_size) {
    remaining.resize(coloring.size());
    std::iota(remaining.begin(), remaining.end(), 0);
  } else {
    // Blocks share no triangle and no point that they use: they can run in any order and in parallel.
    const std::vector<char> inner = mark_inner(coloring, points);
    context.check();
    const int blocks = (coloring.size() + block_size - 1) / block_size;
    const auto work = [&](int block) {
      std::vector<int> members(std::min(block_size, coloring.size() - block * block_size));
      std::iota(members.begin(), members.end(), block * block_size);
      Exchanger exchanger(coloring, valences, inner.data());
      exchange_around(coloring, exchanger, std::move(members), queued, context);
    };
    on_threads(context.threads(), [&] { tbb::parallel_for(0, blocks, work); });
    for (int t = 0; t < coloring.size(); ++t) {
      if (!inner[t]) remaining.push_back(t);
    }
  }
  Exchanger exchanger(coloring, valences, nullptr);
  exchange_around(coloring, exchanger, std::move(remaining), queued, context);
}

}  // namespace

void exchange_chains(CostedColoring& coloring, const std::vector<Vector3>& points,
                     ExecutionContext& context) {
  Valences valences(coloring, points);
  context.check();
  exchange_laid_chains(coloring, valences, points.size(), context);
}

}  // namespace quadrille
