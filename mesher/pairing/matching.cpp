/// Based on: Karp & Sipser, Maximum matching in sparse random graphs (1981), for forced pairs; Remacle et
/// al., Blossom-Quad (2012), for the aim; Lin & Kernighan (1973) for the exchange along cycles whose partial
/// gains stay positive.

#include "mesher/pairing/matching.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <new>
#include <numeric>
#include <queue>
#include <unordered_map>
#include <utility>

#include "geometry/base/threads.hpp"
#include "mesher/pairing/augmenting_paths.hpp"

namespace quadrille {

namespace {

constexpr float never = 1e8F;  // pair_cost of what must not be paired is above this

int free_neighbours(const TriangleGraph& graph, int t) {
  int count = 0;
  for (Side s : graph.triangles[t].twin) count += s >= 0 && graph.free(triangle_of(s));
  return count;
}

/// Pairs triangles with one choice left until none has; a pairing takes choices from its neighbours.
class ForcedPairs {
 public:
  explicit ForcedPairs(TriangleGraph& graph) : graph_(graph) {}

  void start(int t) {
    if (graph_.free(t) && free_neighbours(graph_, t) == 1) stack_.push_back(t);
    settle();
  }

  void pair(Side s) {
    const int a = triangle_of(s), b = triangle_of(graph_.twin_of(s));
    graph_.pair(s);
    look_around(a);
    look_around(b);
  }

  void settle() {
    while (!stack_.empty()) {
      const int t = stack_.back();
      stack_.pop_back();
      if (!graph_.free(t)) continue;
      for (int i = 0; i < 3; ++i) {
        const Side s = graph_.triangles[t].twin[i];
        if (s < 0 || !graph_.free(triangle_of(s))) continue;
        pair(s);
        break;
      }
    }
  }

 private:
  void look_around(int t) {
    for (Side s : graph_.triangles[t].twin) {
      if (s < 0) continue;
      const int n = triangle_of(s);
      if (graph_.free(n) && free_neighbours(graph_, n) == 1) stack_.push_back(n);
    }
  }

  TriangleGraph& graph_;
  std::vector<int> stack_;
};

/// The inner sides in order of cost, equal ones (to 1/256) in the order of the mesh.
std::vector<Side> sides_by_cost(const TriangleGraph& graph, SparseCheck& check) {
  constexpr int buckets = 1024;
  // A cost that is no number (points too far away for products of their distances) comes last.
  const auto bucket = [](float cost) {
    return cost < 0.f ? 0 : cost * 256 < buckets ? static_cast<int>(cost * 256) : buckets - 1;
  };
  const auto for_each_inner_side = [&](auto&& visit) {
    for (int t = 0; t < graph.size(); ++t) {
      check();
      for (int i = 0; i < 3; ++i) {
        if (graph.triangles[t].twin[i] > make_side(t, i))
          visit(make_side(t, i), bucket(graph.triangles[t].cost[i]));
      }
    }
  };
  std::array<int, buckets + 1> start{};
  for_each_inner_side([&](Side, int b) { ++start[b + 1]; });
  for (int b = 0; b < buckets; ++b) start[b + 1] += start[b];
  std::vector<Side> order(start[buckets]);
  for_each_inner_side([&](Side s, int b) { order[start[b]++] = s; });
  return order;
}

}  // namespace

void pair_greedily(TriangleGraph& graph, const ExecutionContext& context) {
  SparseCheck check(context);
  ForcedPairs forced(graph);
  for (int t = 0; t < graph.size(); ++t) {
    const auto& twin = graph.triangles[t].twin;
    if ((twin[0] < 0) + (twin[1] < 0) + (twin[2] < 0) == 2) forced.start(t);
  }
  for (Side s : sides_by_cost(graph, check)) {
    check();
    if (!graph.free(triangle_of(s)) || !graph.free(triangle_of(graph.twin_of(s)))) continue;
    forced.pair(s);
    forced.settle();
  }
}

int augment(TriangleGraph& graph, int reach, const ExecutionContext& context) {
  std::vector<int> free;
  for (int t = 0; t < graph.size(); ++t) {
    if (graph.free(t)) free.push_back(t);
  }
  return augment_pairs(graph, free, NearestFirst(), reach, context);
}

namespace {

/// Walks free triangles to others, over pairs.
class Walker {
 public:
  /// \param piece of each triangle. \param free the triangles to walk.
  Walker(TriangleGraph& graph, const std::vector<Vector3>& points, const std::vector<int>& piece,
         const std::vector<int>& free, const ExecutionContext& context)
      : graph_(graph),
        points_(points),
        piece_(piece),
        free_(free),
        check_(context),
        reached_(static_cast<Reached*>(std::calloc(4 * graph.triangles.size(), sizeof(Reached)))) {
    if (!reached_) throw std::bad_alloc();
  }

  /// Takes a free triangle along the cheapest way to another. \return true if the two became a quad.
  bool walk(int start) {
    int at = start;
    // A step is checked just before it is taken; where it fails the way is searched anew from there.
    for (int attempts = 0; attempts < 100; ++attempts) {
      if (!search(at)) return false;
      if (follow(at)) return true;
    }
    return false;
  }

 private:
  static constexpr int flip_price = 3, concave_price = 30;
  /// Sides that are looked at for the cheapest way; what is farther is headed for straight, or the cost of a
  /// few walks would grow with the mesh.
  static constexpr int far = 20'000;

  /// How a side was reached; all zero where it was not.
  struct Reached {
    int distance;  // plus 1
    Side from;     // plus 1: the side crossed before, 0 at the root
  };
  struct Free {
    void operator()(Reached* memory) const { std::free(memory); }
  };

  static bool contains(const std::vector<int>& list, int t) {
    return std::find(list.begin(), list.end(), t) != list.end();
  }

  /// Whether the free triangle beyond `entry`, a side of a pair, can move over the pair and leave by `exit`
  /// without a point coming twice in the quad.
  bool can_step(Side entry, Side exit) const {
    const int u = triangle_of(entry);
    const int apex = graph_.apex_of(graph_.twin_of(entry));
    if (triangle_of(exit) != u) return graph_.apex_of(entry) != apex;
    // After the flip, the triangle at the entry has the far corner of its mate.
    return graph_.apex_of(graph_.twin_of(make_side(u, graph_.triangles[u].mate))) != apex;
  }

  int price(Side entry, Side exit) const {
    const int u = triangle_of(entry);
    if (triangle_of(exit) != u) return 1;
    return graph_.cost_of(make_side(u, graph_.triangles[u].mate)) < 3 ? flip_price : concave_price;
  }

  /// The way from a free triangle to another: the cheapest if that is near, else one to the nearest in space.
  bool search(int root) {
    bool exhausted = true;
    if (search(root, nullptr, exhausted)) return true;
    if (exhausted) return false;
    const int target = nearest_free(root);
    if (target < 0) return false;
    const Vector3 aim = centre_of(target);
    return search(root, &aim, exhausted);
  }

  Vector3 centre_of(int t) const {
    const auto& c = graph_.triangles[t].corner;
    return (points_[c[0]] + points_[c[1]] + points_[c[2]]) / 3;
  }

  int nearest_free(int root) const {
    const Vector3 from = centre_of(root);
    int nearest = -1;
    double least = 0;
    for (int t : free_) {
      if (t == root || !graph_.free(t) || piece_[t] != piece_[root]) continue;
      const double distance = (centre_of(t) - from).squaredNorm();
      if (nearest >= 0 && distance >= least) continue;
      nearest = t;
      least = distance;
    }
    return nearest;
  }

  /// Dijkstra over the sides crossed (each seen from its far triangle), from a free triangle to another; with
  /// an aim, the sides nearest to that come first, whatever they cost.
  bool search(int root, const Vector3* aim, bool& exhausted) {
    for (Side s : touched_) reached_[s] = {};
    touched_.clear();
    queue_ = {};
    for (Side s : graph_.triangles[root].twin) offer(s, 0, -1, aim);
    while (!queue_.empty()) {
      check_();
      const auto [key, s] = queue_.top();
      queue_.pop();
      const int distance = reached_[s].distance - 1;
      if (!aim && static_cast<int>(key) != distance) continue;
      if (!aim && static_cast<int>(touched_.size()) > far) {
        exhausted = false;
        return false;
      }
      const int u = triangle_of(s);
      if (graph_.free(u)) {
        if (u == root || graph_.apex_of(s) == graph_.apex_of(graph_.twin_of(s))) continue;
        trace(s);
        return true;
      }
      const bool first = reached_[s].from == 0;
      for (int t : {u, graph_.mate_of(u)}) {
        for (int i = 0; i < 3; ++i) {
          const Side exit = make_side(t, i);
          if (i == graph_.triangles[t].mate || exit == s || (first && !can_step(s, exit))) continue;
          offer(graph_.triangles[t].twin[i], distance + price(s, exit), s, aim);
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
    queue_.emplace(aim ? (points_[graph_.corner_at(s)] - *aim).squaredNorm() : distance, s);
  }

  void trace(Side s) {
    way_.clear();
    for (; s >= 0; s = reached_[s].from - 1) way_.push_back(s);
    std::reverse(way_.begin(), way_.end());
  }

  /// Walks the way; `at` becomes the free triangle where it ended early.
  bool follow(int& at) {
    recut_.clear();
    for (std::size_t k = 0; k < way_.size(); ++k) {
      const Side entry = way_[k];
      if (k + 1 == way_.size()) {
        if (graph_.apex_of(entry) == graph_.apex_of(graph_.twin_of(entry))) return false;
        graph_.pair(entry);
        return true;
      }
      // Sides of pairs that the walk has recut already are not what the search saw.
      if (contains(recut_, triangle_of(entry)) || contains(recut_, triangle_of(way_[k + 1]))) return false;
      if (!step(entry, way_[k + 1], at)) return false;
    }
    return false;
  }

  bool step(Side entry, Side next, int& at) {
    const Side last = graph_.twin_of(entry), exit = graph_.twin_of(next);
    if (!can_step(entry, exit)) return false;
    const int u = triangle_of(entry), v = graph_.mate_of(u);
    if (triangle_of(exit) == u) graph_.flip(make_side(u, graph_.triangles[u].mate), points_);
    at = triangle_of(graph_.twin_of(next));
    graph_.pair(last);
    graph_.triangles[at].mate = -1;
    recut_.insert(recut_.end(), {triangle_of(last), u, v});
    return true;
  }

  TriangleGraph& graph_;
  const std::vector<Vector3>& points_;
  const std::vector<int>& piece_;
  const std::vector<int>& free_;
  SparseCheck check_;
  std::unique_ptr<Reached[], Free> reached_;  // by side; mostly pages never touched
  std::vector<Side> touched_;
  std::priority_queue<std::pair<double, Side>, std::vector<std::pair<double, Side>>, std::greater<>> queue_;
  std::vector<Side> way_;
  std::vector<int> recut_;
};

/// The connected piece of each triangle, as its lowest triangle: by union and find in the order of the mesh.
std::vector<int> label_pieces(const TriangleGraph& graph, const ExecutionContext& context) {
  SparseCheck check(context);
  std::vector<int> piece(graph.size());
  const auto root = [&](int t) {
    while (piece[t] != t) t = piece[t] = piece[piece[t]];
    return t;
  };
  for (int t = 0; t < graph.size(); ++t) {
    check();
    piece[t] = t;
    for (Side s : graph.triangles[t].twin) {
      if (s < 0 || triangle_of(s) > t) continue;
      const int one = root(t), two = root(triangle_of(s));
      piece[std::max(one, two)] = std::min(one, two);
    }
  }
  for (int t = 0; t < graph.size(); ++t) piece[t] = piece[piece[t]];
  return piece;
}

}  // namespace

int walk(TriangleGraph& graph, const std::vector<Vector3>& points, const ExecutionContext& context) {
  std::vector<int> free;
  for (int t = 0; t < graph.size(); ++t) {
    if (graph.free(t)) free.push_back(t);
  }
  if (free.size() < 2) return static_cast<int>(free.size());
  const std::vector<int> piece = label_pieces(graph, context);
  std::unordered_map<int, int> free_in;
  for (int t : free) ++free_in[piece[t]];
  Walker walker(graph, points, piece, free, context);
  for (int t : free) {
    if (free_in[piece[t]] < 2 || !graph.free(t)) continue;
    if (walker.walk(t)) free_in[piece[t]] -= 2;
  }
  return static_cast<int>(std::count_if(graph.triangles.begin(), graph.triangles.end(),
                                        [](const GraphTriangle& t) { return t.mate < 0; }));
}

void move_free(TriangleGraph& graph, const ExecutionContext& context) {
  SparseCheck check(context);
  constexpr std::size_t reach = 1000;
  constexpr float least_gain = 1e-3F;
  // A way to a triangle that is set free: the mate it had is paired across `across` with the one before.
  struct Step {
    int triangle;
    float gain;
    int before;
    Side across;
  };
  std::vector<Step> steps;
  std::vector<int> reached_in(graph.size(), -1);
  for (int start = 0; start < graph.size(); ++start) {
    check();
    if (graph.triangles[start].mate >= 0) continue;
    steps.assign(1, {start, 0, -1, -1});
    reached_in[start] = start;
    std::size_t best = 0;
    for (std::size_t k = 0; k < steps.size() && steps.size() < reach; ++k) {
      for (int i = 0; i < 3; ++i) {
        const Side side = make_side(steps[k].triangle, i);
        if (graph.twin_of(side) < 0) continue;
        const int taken = triangle_of(graph.twin_of(side));
        const int freed = graph.mate_of(taken);
        if (freed < 0 || reached_in[taken] == start || reached_in[freed] == start) continue;
        reached_in[taken] = reached_in[freed] = start;
        const float opened = graph.cost_of(make_side(taken, graph.triangles[taken].mate));
        const float gain = steps[k].gain + opened - graph.cost_of(side);
        if (gain > steps[best].gain + least_gain) best = steps.size();
        steps.push_back({freed, gain, static_cast<int>(k), side});
      }
    }
    if (best == 0) continue;
    const int freed = steps[best].triangle;
    for (int k = static_cast<int>(best); steps[k].before >= 0; k = steps[k].before)
      graph.pair(steps[k].across);
    graph.triangles[freed].mate = -1;
  }
}

namespace {

/// How far the number of quads at each point is from the ideal, and what that costs.
class Valences {
 public:
  Valences(const TriangleGraph& graph, const std::vector<Vector3>& points)
      : weight_(graph.objective == Objective::shape ? shape_weight : regular_weight),
        deviation_(points.size(), 0) {
    std::vector<char> boundary(points.size(), 0);
    for (int t = 0; t < graph.size(); ++t) {
      for (int i = 0; i < 3; ++i) {
        const GraphTriangle& triangle = graph.triangles[t];
        ++deviation_[triangle.corner[i]];
        if (triangle.twin[i] < 0) boundary[triangle.corner[i]] = boundary[triangle.corner[next_index(i)]] = 1;
        // A diagonal makes one quad of two triangles at its ends; each side of it counts for its own start.
        if (triangle.mate == i) --deviation_[triangle.corner[i]];
      }
    }
    std::vector<float> angle(points.size(), 0);
    for (const GraphTriangle& t : graph.triangles) {
      if (!boundary[t.corner[0]] && !boundary[t.corner[1]] && !boundary[t.corner[2]]) continue;
      for (int i = 0; i < 3; ++i) {
        if (boundary[t.corner[i]]) angle[t.corner[i]] += angle_at(t, i, points);
      }
    }
    for (std::size_t v = 0; v < points.size(); ++v) {
      deviation_[v] -= boundary[v] ? std::max(1, static_cast<int>(std::lround(angle[v] / 1.57079633F))) : 4;
    }
  }

  /// Change of cost when a quad more (less) meets at each end of a side that stops being (becomes) a
  /// diagonal.
  float more(int a, int b) { return change(a, 1) + change(b, 1); }
  float fewer(int a, int b) { return change(a, -1) + change(b, -1); }

  /// About the same, without making the change: for a step of a longer exchange.
  float if_more(int a, int b) const {
    return 2 * weight_ * (caution + static_cast<float>(deviation_[a] + deviation_[b]));
  }
  float if_fewer(int a, int b) const {
    return 2 * weight_ * (caution - static_cast<float>(deviation_[a] + deviation_[b]));
  }

 private:
  static constexpr float regular_weight = 0.4F, shape_weight = 0.02F;
  /// Against the second order of a change alone, which most further steps of a cycle undo: between 0 and 1.
  static constexpr float caution = 0.25F;

  static float angle_at(const GraphTriangle& t, int i, const std::vector<Vector3>& points) {
    const Vector3& p = points[t.corner[i]];
    const Vector3 a = points[t.corner[next_index(i)]] - p, b = points[t.corner[previous_index(i)]] - p;
    return static_cast<float>(angle_between(a, b));
  }

  float change(int v, int by) {
    const int before = deviation_[v], after = before + by;
    deviation_[v] = static_cast<std::int16_t>(after);
    return weight_ * static_cast<float>(after * after - before * before);
  }

  float weight_;
  std::vector<std::int16_t> deviation_;
};

/// Searches alternating cycles from one triangle at a time.
class Exchanger {
 public:
  /// \param open triangles that may be used, one flag each; null = all. Points of the others are not touched.
  /// \param first,end all of those that may be used are from `first` to before `end`.
  Exchanger(TriangleGraph& graph, Valences& valences, const char* open, int first, int end)
      : graph_(graph), valences_(valences), open_(open), first_(first), count_(end - first) {}

  bool may_use(int t) const { return !open_ || open_[t]; }

  /// Makes the best exchange along a cycle through the pair of `t`, if there is one that gains.
  /// \return the triangles of the cycle, in pairs; empty if none.
  const std::vector<int>& improve(int t) {
    best_gain_ = least_gain;
    best_.clear();
    path_.clear();
    touched_.clear();
    if (!usable(t)) return touched_;
    root_ = graph_.mate_of(t);
    if (graph_.objective == Objective::shape) {
      search(t);
    } else {
      release(t, 0);
    }
    if (!best_.empty()) apply();
    return touched_;
  }

 private:
  /// A way of `search` to an opened pair.
  struct Label {
    int triangle;  // of the pair, in want of a mate
    float gain;
    int before;   // label
    Side across;  // the side by which the way came
  };

  static constexpr int max_labels = 400;
  static constexpr int max_pairs = 20;
  static constexpr int broad_pairs = 5;
  static constexpr float least_gain = 1e-3F;
  static constexpr float slack = -0.15F;  // the valences make gains depend on the order

  /// Whether the triangle has a mate, and both may be used. The flag comes first: what lies beyond may be
  /// changing.
  bool usable(int t) const {
    if (!may_use(t)) return false;
    const int mate = graph_.mate_of(t);
    return mate >= 0 && may_use(mate);
  }

  /// Opens the pair of `t`, which looks for a new mate across its two other sides. All ways are followed over
  /// the first pairs, then the better one alone.
  void release(int t, float gain) {
    const GraphTriangle& triangle = graph_.triangles[t];
    const int i = triangle.mate;
    const int a = triangle.corner[i], b = triangle.corner[next_index(i)];
    gain += triangle.cost[i] - valences_.more(a, b);
    const int one = next_index(i), two = previous_index(i);
    const float rest_one = rest_after(t, one, gain), rest_two = rest_after(t, two, gain);
    const int better = rest_two > rest_one ? two : one;
    const bool narrow = static_cast<int>(path_.size()) >= broad_pairs;
    join(t, better, std::max(rest_one, rest_two));
    if (!narrow) join(t, one + two - better, std::min(rest_one, rest_two));
    valences_.fewer(a, b);
  }

  /// What remains of the gain when t is paired across its side j; nothing where it cannot be.
  float rest_after(int t, int j, float gain) {
    const GraphTriangle& triangle = graph_.triangles[t];
    if (triangle.twin[j] < 0 || !usable(triangle_of(triangle.twin[j]))) return -never;
    const int a = triangle.corner[j], b = triangle.corner[next_index(j)];
    const float rest = gain - triangle.cost[j] - valences_.fewer(a, b);
    valences_.more(a, b);
    return rest;
  }

  /// Pairs t across its side j and goes on from the mate that this leaves alone.
  void join(int t, int j, float rest) {
    if (rest <= slack) return;
    const GraphTriangle& triangle = graph_.triangles[t];
    const int next = triangle_of(triangle.twin[j]);
    if (next == root_) {
      if (rest <= best_gain_) return;
      best_gain_ = rest;
      best_ = path_;
      best_.push_back(triangle.twin[j]);
      return;
    }
    if (static_cast<int>(path_.size()) + 1 >= max_pairs || on_path(next)) return;
    const int a = triangle.corner[j], b = triangle.corner[next_index(j)];
    path_.push_back(triangle.twin[j]);
    valences_.fewer(a, b);
    release(graph_.mate_of(next), rest);
    valences_.more(a, b);
    path_.pop_back();
  }

  /// Whether the pair of t has been opened already.
  bool on_path(int t) const {
    const int mate = graph_.mate_of(t);
    if (mate == root_) return true;
    for (Side s : path_) {
      if (triangle_of(s) == t || triangle_of(s) == mate) return true;
    }
    return false;
  }

  /// Searches on all ways at once, the best one to each opened pair alone being followed on: long cycles for
  /// little. What the valences charge is estimated on the way and counted where a cycle closes.
  void search(int start) {
    labels_.clear();
    ++search_number_;
    if (reached_in_.empty()) {
      reached_in_.assign(count_, 0);
      label_of_.resize(count_);
    }
    expose(start, 0, -1, -1);
    for (int k = 0; k < static_cast<int>(labels_.size()) && k < max_labels; ++k) {
      const Label label = labels_[k];
      if (label_of_[label.triangle - first_] != k) continue;  // a better way has been found since
      const GraphTriangle& triangle = graph_.triangles[label.triangle];
      for (int j : {next_index(triangle.mate), previous_index(triangle.mate)}) {
        const Side s = triangle.twin[j];
        if (s < 0 || !usable(triangle_of(s))) continue;
        const float rest = label.gain - triangle.cost[j] -
                           valences_.if_fewer(triangle.corner[j], triangle.corner[next_index(j)]);
        if (rest <= 0) continue;
        if (triangle_of(s) == root_) {
          close(k, s);
        } else if (!is_opened(k, triangle_of(s))) {
          expose(graph_.mate_of(triangle_of(s)), rest, k, s);
        }
      }
    }
  }

  /// Opens the pair of `t`, unless another way here has gained as much.
  void expose(int t, float gain, int before, Side across) {
    const GraphTriangle& triangle = graph_.triangles[t];
    const int i = triangle.mate;
    gain += triangle.cost[i] - valences_.if_more(triangle.corner[i], triangle.corner[next_index(i)]);
    // Of each cycle that gains, some start keeps all partial gains positive (Lin & Kernighan).
    if (gain <= 0) return;
    int& reached_in = reached_in_[t - first_];
    int& label = label_of_[t - first_];
    if (reached_in == search_number_ && labels_[label].gain >= gain - 1e-4F) return;
    reached_in = search_number_;
    label = static_cast<int>(labels_.size());
    labels_.push_back({t, gain, before, across});
  }

  /// Whether the pair of t has been opened on the way to a label.
  bool is_opened(int k, int t) const {
    const int mate = graph_.mate_of(t);
    if (mate == root_) return true;
    for (; k >= 0; k = labels_[k].before) {
      if (labels_[k].triangle == t || labels_[k].triangle == mate) return true;
    }
    return false;
  }

  /// Keeps the cycle that a label and a side to the root close if none found gains more.
  void close(int k, Side last) {
    path_.assign(1, last);
    for (; labels_[k].before >= 0; k = labels_[k].before) path_.push_back(labels_[k].across);
    std::reverse(path_.begin(), path_.end());
    const auto diagonal = [&](Side s) {
      return make_side(triangle_of(s), graph_.triangles[triangle_of(s)].mate);
    };
    float gain = 0;
    for (Side s : path_) {
      const Side d = diagonal(s);
      gain += graph_.cost_of(d) - valences_.more(graph_.corner_at(d), graph_.end_of(d));
    }
    for (Side s : path_) {
      gain -= graph_.cost_of(s) + valences_.fewer(graph_.corner_at(s), graph_.end_of(s));
    }
    for (Side s : path_) {
      const Side d = diagonal(s);
      valences_.more(graph_.corner_at(s), graph_.end_of(s));
      valences_.fewer(graph_.corner_at(d), graph_.end_of(d));
    }
    if (gain <= best_gain_) return;
    best_gain_ = gain;
    best_ = path_;
  }

  void apply() {
    for (Side s : best_) {
      // Counted before the mates change: every opened pair's side stops being a diagonal.
      const GraphTriangle& triangle = graph_.triangles[triangle_of(s)];
      valences_.more(triangle.corner[triangle.mate], triangle.corner[next_index(triangle.mate)]);
    }
    for (Side s : best_) {
      valences_.fewer(graph_.corner_at(s), graph_.end_of(s));
      graph_.pair(s);
      touched_.insert(touched_.end(), {triangle_of(s), triangle_of(graph_.twin_of(s))});
    }
  }

  TriangleGraph& graph_;
  Valences& valences_;
  const char* open_;
  int first_, count_;
  int root_ = -1;
  float best_gain_ = 0;
  std::vector<Side> path_, best_;
  std::vector<int> touched_;
  std::vector<Label> labels_;
  std::vector<int> reached_in_, label_of_;  // by triangle after the first: number of the search, label
  int search_number_ = 0;
};

}  // namespace

namespace {

/// Exchanges around the given triangles until nothing gains; those around an exchange are tried again.
/// \param queued scratch, one zero a triangle; zero again afterwards.
int exchange_around(TriangleGraph& graph, Exchanger& exchanger, std::vector<int> current,
                    std::vector<char>& queued, const ExecutionContext& context) {
  constexpr int max_rounds = 20;
  int exchanged = 0;
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
      const std::vector<int>& touched = exchanger.improve(current[k]);
      if (touched.empty()) continue;
      ++exchanged;
      for (int changed : touched) {
        enqueue(changed);
        for (Side s : graph.triangles[changed].twin) {
          if (s >= 0 && exchanger.may_use(triangle_of(s))) enqueue(triangle_of(s));
        }
      }
    }
    std::swap(current, next);
  }
  for (int t : current) queued[t] = 0;
  return exchanged;
}

/// Triangles of one block, by number. Large enough that few lie at a block's edge where the mesh is stored by
/// place.
constexpr int block_size = 1 << 15;

/// Marks the triangles all of whose points belong to one block only.
std::vector<char> mark_inner(const TriangleGraph& graph, std::size_t point_count) {
  constexpr int none = -1, several = -2;
  std::vector<int> block_of(point_count, none);
  for (int t = 0; t < graph.size(); ++t) {
    for (int v : graph.triangles[t].corner) {
      int& block = block_of[v];
      block = block == none || block == t / block_size ? t / block_size : several;
    }
  }
  std::vector<char> inner(graph.size());
  for (int t = 0; t < graph.size(); ++t) {
    const auto& c = graph.triangles[t].corner;
    inner[t] = block_of[c[0]] != several && block_of[c[1]] != several && block_of[c[2]] != several;
  }
  return inner;
}

}  // namespace

int exchange(TriangleGraph& graph, const std::vector<Vector3>& points, ExecutionContext& context) {
  Valences valences(graph, points);
  context.check();
  std::vector<char> queued(graph.size(), 0);
  std::vector<int> remaining;
  std::atomic<int> exchanged = 0;
  if (graph.size() < 2 * block_size) {
    remaining.resize(graph.size());
    std::iota(remaining.begin(), remaining.end(), 0);
  } else {
    // Blocks share no triangle and no point that they use: they can be worked on in any order, at once.
    const std::vector<char> inner = mark_inner(graph, points.size());
    context.check();
    const int blocks = (graph.size() + block_size - 1) / block_size;
    const auto work = [&](int block) {
      std::vector<int> members(std::min(block_size, graph.size() - block * block_size));
      std::iota(members.begin(), members.end(), block * block_size);
      const int first = members.front();
      Exchanger exchanger(graph, valences, inner.data(), first, first + static_cast<int>(members.size()));
      const int count = exchange_around(graph, exchanger, std::move(members), queued, context);
      exchanged.fetch_add(count, std::memory_order_relaxed);
    };
    on_threads(context.threads(), [&] { tbb::parallel_for(0, blocks, work); });
    for (int t = 0; t < graph.size(); ++t) {
      if (!inner[t]) remaining.push_back(t);
    }
  }
  Exchanger exchanger(graph, valences, nullptr, 0, graph.size());
  return exchanged + exchange_around(graph, exchanger, std::move(remaining), queued, context);
}

}  // namespace quadrille
