/// Collects folds and borders of faces into chains, drops weak ones, and splits the rest at corners.

#include "mesher/remesh/feature_network.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <set>

#include <boost/pending/disjoint_sets.hpp>

#include "geometry/base/whole_number.hpp"
#include "mesher/edges/count_table.hpp"
#include "mesher/mesh/side_twins.hpp"

namespace quadrille {

namespace {

constexpr double to_radians = std::numbers::pi / 180;

/// The angle by which the polyline a, b, c turns at b, radians.
double turn(const Vector3& a, const Vector3& b, const Vector3& c) {
  return angle_between(b - a, c - b);
}

class FeatureFinder {
 public:
  FeatureFinder(const TriangleMesh& surface, const FeatureRules& rules)
      : surface_(surface), rules_(rules), twins_(surface.triangles.size(), {-1, -1, -1}) {
    TriangleMesh untagged{surface.points, surface.triangles, {}, {}};
    join_twins(untagged, [this](Side a, Side b) {
      twins_[triangle_of(a)][index_of(a)] = b;
      twins_[triangle_of(b)][index_of(b)] = a;
    });
    for (const auto& [a, b, c] : surface.triangles)
      areas_.push_back(0.5 *
                       (surface.points[b] - surface.points[a]).cross(surface.points[c] - surface.points[a]));
  }

  FeatureNetwork run() {
    mark_folds();
    number_patches();
    absorb_small_patches();
    drop_short_creases();
    trace();
    return std::move(network_);
  }

 private:
  int from(Side side) const { return surface_.triangles[triangle_of(side)][index_of(side)]; }
  int to(Side side) const { return surface_.triangles[triangle_of(side)][next_index(index_of(side))]; }
  Side twin(Side side) const { return twins_[triangle_of(side)][index_of(side)]; }
  int tag(int triangle) const { return surface_.tags.empty() ? 0 : surface_.tags[triangle]; }
  double length(Side side) const { return (surface_.points[to(side)] - surface_.points[from(side)]).norm(); }

  /// The number that FeatureRules::sides has for a side; -1 = it is not listed.
  int number_of(Side side) const {
    if (rules_.sides.empty()) return -1;
    const auto found = rules_.sides.find(std::minmax(from(side), to(side)));
    return found == rules_.sides.end() ? -1 : found->second;
  }

  template <class Visit>
  void each_side(Visit&& visit) const {  // each side once
    for (int t = 0; t < static_cast<int>(twins_.size()); ++t)
      for (int i = 0; i < 3; ++i)
        if (const Side side = make_side(t, i); twin(side) < side) visit(side);
  }

  /// Visits the sides that the shape alone makes features, each with the patches beside it.
  template <class Visit>
  void each_fold(Visit&& visit) const {
    each_side([&](Side side) {
      if (marked(side) && !given(side))
        visit(side, network_.patches[triangle_of(side)], network_.patches[triangle_of(twin(side))]);
    });
  }

  bool marked(Side side) const { return marked_[triangle_of(side)][index_of(side)] != 0; }

  void mark(Side side, char value) {
    marked_[triangle_of(side)][index_of(side)] = value;
    if (twin(side) >= 0) marked_[triangle_of(twin(side))][index_of(twin(side))] = value;
  }

  /// Whether a side is a feature regardless of the shape.
  bool given(Side side) const {
    return twin(side) < 0 || tag(triangle_of(side)) != tag(triangle_of(twin(side))) || number_of(side) >= 0;
  }

  void mark_folds() {
    marked_.assign(twins_.size(), {0, 0, 0});
    each_side([&](Side side) {
      const auto is_fold = [&] {
        return rules_.angle > 0 && angle_between(areas_[triangle_of(side)], areas_[triangle_of(twin(side))]) >
                                       rules_.angle * to_radians;
      };
      if (given(side) || is_fold()) mark(side, 1);
    });
  }

  void number_patches() {
    const auto twin_of = [&](Side side) { return marked(side) ? -1 : twin(side); };
    network_.patch_count = number_pieces(twins_.size(), twin_of, network_.patches);
  }

  void absorb_small_patches() {
    constexpr int rounds = 8;
    constexpr double share = 1.0 / 16;
    for (int round = 0; round < rounds; ++round) {
      std::vector<double> area(network_.patch_count, 0);
      for (std::size_t t = 0; t < areas_.size(); ++t) area[network_.patches[t]] += areas_[t].norm();
      const double least = share * rules_.size * rules_.size;
      std::map<int, std::map<int, double>> shared;  // small patch -> neighbor -> length of folds between them
      each_fold([&](Side side, int a, int b) {
        if (a == b) return;
        if (area[a] < least) shared[a][b] += length(side);
        if (area[b] < least) shared[b][a] += length(side);
      });
      if (shared.empty()) return;
      std::map<int, int> goes_to;
      for (const auto& [patch, neighbors] : shared)
        goes_to[patch] =
            std::ranges::max_element(neighbors, {}, [](const auto& at) { return at.second; })->first;
      const auto joined = [&](int a, int b) {
        const auto found = goes_to.find(a);
        return found != goes_to.end() && found->second == b;
      };
      each_fold([&](Side side, int a, int b) {
        if (joined(a, b) || joined(b, a)) mark(side, 0);
      });
      number_patches();
    }
  }

  /// Removes folds that have the same face on both sides and are connected over less than four elements.
  void drop_short_creases() {
    boost::disjoint_sets_with_storage<> creases(surface_.points.size());  // of points
    each_fold([&](Side side, int a, int b) {
      if (a == b) creases.union_set(from(side), to(side));
    });
    std::map<std::size_t, double> total;
    each_fold([&](Side side, int a, int b) {
      if (a == b) total[creases.find_set(from(side))] += length(side);
    });
    each_fold([&](Side side, int a, int b) {
      if (a == b && total[creases.find_set(from(side))] < 4 * rules_.size) mark(side, 0);
    });
  }

  void trace() {
    sides_at_.resize(surface_.points.size());
    each_side([&](Side side) {
      if (!marked(side)) return;
      sides_at_[from(side)].push_back(side);
      sides_at_[to(side)].push_back(side);
      sides_.push_back(side);
    });
    network_.corner.assign(surface_.points.size(), 0);
    for (std::size_t v = 0; v < sides_at_.size(); ++v) {
      const auto& own = sides_at_[v];
      const bool fixed = !rules_.fixed.empty() && rules_.fixed[v];
      if (own.empty()) continue;
      if (own.size() != 2 || fixed || number_of(own[0]) != number_of(own[1])) network_.corner[v] = 1;
    }
    for (const bool from_corners : {true, false}) {
      for (const Side side : sides_) {
        if (done_.contains(side)) continue;
        const int start = network_.corner[from(side)] ? from(side) : to(side);
        if (from_corners && !network_.corner[start]) continue;
        add_chain(start, side);
      }
    }
  }

  void add_chain(int start, Side side) {
    std::vector<int> chain{start};
    const int number = std::max(0, number_of(side));
    for (Side next = side; next >= 0;) {
      done_.insert(next);
      const int v = from(next) == chain.back() ? to(next) : from(next);
      chain.push_back(v);
      const Side before = next;
      next = -1;
      if (network_.corner[v] || v == start) break;
      for (const Side other : sides_at_[v])
        if (other != before && !done_.contains(other)) next = other;
    }
    split_at_turns(chain, number);
  }

  FeatureCurve curve_of(std::vector<int> points, int number) const {
    FeatureCurve curve;
    curve.points = std::move(points);
    curve.edge = number;
    for (const int v : curve.points) {
      const Vector3& place = surface_.points[v];
      curve.along.push_back(curve.along.empty() ? 0
                                                : curve.along.back() + (place - curve.places.back()).norm());
      curve.places.push_back(place);
    }
    return curve;
  }

  /// Adds the chain as curves, split at corners where it turns sharply. It must also turn sharply as seen
  /// from half an element away, because the rims of scans turn at every triangle.
  void split_at_turns(std::vector<int> chain, int number) {
    const FeatureCurve whole = curve_of(chain, number);
    const double least = (rules_.angle > 0 ? std::min(rules_.angle, 60.0) : 40.0) * to_radians;
    const int last = static_cast<int>(chain.size()) - 1;
    const bool ring = whole.closed() && !network_.corner[chain.front()];
    const auto turns = [&](int k) {
      const int before = k > 0 ? k - 1 : last - 1, after = k < last ? k + 1 : 1;
      const auto& p = whole.places;
      if (turn(p[before], p[k], p[after]) <= least) return false;
      const double reach = std::min(0.5 * rules_.size, 0.25 * whole.length());
      const auto at = [&](double s) {
        if (ring) s = s < 0 ? s + whole.length() : s > whole.length() ? s - whole.length() : s;
        return whole.at(s);
      };
      return turn(at(whole.along[k] - reach), p[k], at(whole.along[k] + reach)) > least;
    };
    std::vector<int> cuts;
    for (int k = ring ? 0 : 1; k < last; ++k)
      if (turns(k)) cuts.push_back(k);
    for (const int k : cuts) network_.corner[chain[k]] = 1;
    if (ring && !cuts.empty()) {
      chain.pop_back();
      std::rotate(chain.begin(), chain.begin() + cuts.front(), chain.end());
      chain.push_back(chain.front());
    }
    std::vector<int> part{chain.front()};
    for (std::size_t k = 1; k < chain.size(); ++k) {
      part.push_back(chain[k]);
      if (k + 1 < chain.size() && !network_.corner[chain[k]]) continue;
      network_.curves.push_back(curve_of(std::move(part), number));
      part = {chain[k]};
    }
  }

  const TriangleMesh& surface_;
  const FeatureRules& rules_;
  Twins twins_;
  std::vector<Vector3> areas_;
  std::vector<std::array<char, 3>> marked_;
  std::vector<Side> sides_;
  std::vector<std::vector<Side>> sides_at_;  // by point
  std::set<Side> done_;
  FeatureNetwork network_;
};

/// The length of equal segments, short enough that no two neighbors meet at a sharp angle.
double even_spacing(const FeatureCurve& curve, double target) {
  constexpr double finest = 1.0 / 8, sharp = 61 * to_radians, growth = 1.5;
  const bool closed = curve.closed();
  for (double spacing = target;; spacing /= growth) {
    const int count = std::max(closed ? 3 : 1, to_int(std::ceil(curve.length() / spacing * (1 - 1e-9))));
    const double step = curve.length() / count;
    double worst = 0;
    for (int k = closed ? 0 : 1; k < count; ++k) {
      const Vector3 before = curve.at(k > 0 ? (k - 1) * step : curve.length() - step);
      worst = std::max(worst, turn(before, curve.at(k * step), curve.at((k + 1) * step)));
    }
    // A single segment on a bent curve would hide the bend.
    if (count == 1) worst = 2 * turn(curve.at(0), curve.at(0.5 * step), curve.at(step));
    if (worst <= sharp || spacing < finest * target) return step;
  }
}

}  // namespace

Vector3 FeatureCurve::at(double length) const {
  const auto above = std::ranges::upper_bound(along, length);
  if (above == along.begin()) return places.front();
  if (above == along.end()) return places.back();
  const auto k = above - along.begin();
  const double share = (length - along[k - 1]) / (along[k] - along[k - 1]);
  return places[k - 1] + share * (places[k] - places[k - 1]);
}

FeatureNetwork find_features(const TriangleMesh& surface, const FeatureRules& rules) {
  return FeatureFinder(surface, rules).run();
}

std::vector<std::vector<double>> place_on_curves(const FeatureNetwork& network,
                                                 const std::vector<double>& targets) {
  constexpr double growth = 0.3;
  std::vector<double> spacing;
  std::map<int, double> at_corner;
  std::map<int, std::vector<std::pair<int, double>>> roads;
  for (const FeatureCurve& curve : network.curves) {
    spacing.push_back(even_spacing(curve, targets[spacing.size()]));
    const int a = curve.points.front(), b = curve.points.back();
    roads[a].emplace_back(b, curve.length());
    roads[b].emplace_back(a, curve.length());
    for (const int end : {a, b}) {
      double& least = at_corner.try_emplace(end, spacing.back()).first->second;
      least = std::min(least, spacing.back());
    }
  }
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (const auto& [corner, value] : at_corner) queue.emplace(value, corner);
  while (!queue.empty()) {
    const auto [value, corner] = queue.top();
    queue.pop();
    if (value > at_corner[corner]) continue;
    for (const auto& [other, way] : roads[corner]) {
      if (value + growth * way >= at_corner[other]) continue;
      at_corner[other] = value + growth * way;
      queue.emplace(at_corner[other], other);
    }
  }
  std::vector<std::vector<double>> result;
  for (std::size_t c = 0; c < network.curves.size(); ++c) {
    const FeatureCurve& curve = network.curves[c];
    const double from = at_corner[curve.points.front()], to = at_corner[curve.points.back()];
    // Number of steps in the integral of 1 / size.
    constexpr int most_steps = 1 << 16;
    const int steps =
        to_int(std::clamp<double>(16 * curve.length() / std::min({spacing[c], from, to}), 16, most_steps));
    std::vector<double> sum{0};
    for (int k = 0; k < steps; ++k) {
      const double s = (k + 0.5) / steps * curve.length();
      sum.push_back(sum.back() +
                    curve.length() / steps /
                        std::min({spacing[c], from + growth * s, to + growth * (curve.length() - s)}));
    }
    const int count = std::max(curve.closed() ? 3 : 1, round_to_int(sum.back()));
    std::vector<double>& nodes = result.emplace_back(1, 0.0);
    for (int n = 1; n < count; ++n) {
      const auto [step, share] = place_in(sum, sum.back() * n / count);
      nodes.push_back((static_cast<double>(step) + share) / steps * curve.length());
    }
    nodes.push_back(curve.length());
  }
  return result;
}

}  // namespace quadrille
