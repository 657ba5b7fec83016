/// Fills around one irregular node, or cuts by a row of nodes into two such parts, the cheapest first.

#include "mesher/quads/polygon_filling.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

namespace quadrille {
namespace {

using Quad = std::array<int, 4>;
using Chain = std::vector<int>;  ///< the nodes of a side, both ends included

int segments_of(const Chain& chain) {
  return static_cast<int>(chain.size()) - 1;
}

std::vector<int> segments_of(const std::vector<Chain>& sides) {
  std::vector<int> result;
  result.reserve(sides.size());
  for (const Chain& side : sides) result.push_back(segments_of(side));
  return result;
}

/// How three or five sides are filled around a point. A row leads from there to each side; `before` has the
/// number of segments from the first corner of the side to the row.
struct Spokes {
  std::array<int, 5> before{};
  int least = 0;  ///< least of `before`; below 1 if there is no such filling

  /// \param sides numbers of segments. An alternating sum over every second side gives twice `before`.
  explicit Spokes(std::span<const int> sides) {
    const int n = static_cast<int>(sides.size());
    for (int i = 0; i < n; ++i) {
      int sum = 0;
      for (int k = 0; k < n; ++k) sum += (k % 2 == 0 ? 1 : -1) * sides[(i + 2 * k) % n];
      before[i] = sum % 2 == 0 ? sum / 2 : 0;
    }
    least = *std::min_element(before.begin(), before.begin() + n);
  }

  int quads(std::span<const int> sides) const {
    int sum = 0;
    for (std::size_t i = 0, last = sides.size() - 1; i < sides.size(); last = i++)
      sum += before[i] * (sides[last] - before[last]);
    return sum;
  }
};

bool is_grid(std::span<const int> sides) {
  return sides.size() == 4 && sides[0] == sides[2] && sides[1] == sides[3];
}

/// Fills polygons that share sides with quads.
class Filler {
 public:
  explicit Filler(std::vector<Vector3> outline) { filling_.places = std::move(outline); }

  /// A straight row of nodes.
  Chain row(int from, int to, int segments) {
    Chain result{from};
    for (int k = 1; k < segments; ++k)
      result.push_back(add(at(from) + (at(to) - at(from)) * (static_cast<double>(k) / segments)));
    result.push_back(to);
    return result;
  }

  /// Fills four sides that a grid fits, or three or five that Spokes allow.
  /// \param sides in order, each ends where the next one begins
  void fill(const std::vector<Chain>& sides) {
    const int n = static_cast<int>(sides.size());
    if (n == 4) return grid(sides[0], sides[1], sides[2], sides[3]);
    ++filling_.irregular;
    const std::array<int, 5> before = Spokes(segments_of(sides)).before;
    Chain feet;
    Vector3 middle = Vector3::Zero();
    for (int i = 0; i < n; ++i) {
      feet.push_back(sides[i][before[i]]);
      middle += at(feet.back()) / n;
    }
    const int center = add(middle);
    std::vector<Chain> rows;
    rows.reserve(n);
    for (int i = 0; i < n; ++i) rows.push_back(row(feet[i], center, before[(i + 1) % n]));
    for (int i = 0, last = n - 1; i < n; last = i++)
      grid(Chain(sides[i].begin(), sides[i].begin() + before[i] + 1), rows[i],
           Chain(rows[last].rbegin(), rows[last].rend()),
           Chain(sides[last].begin() + before[last], sides[last].end()));
  }

  PolygonFilling take() { return std::move(filling_); }

 private:
  const Vector3& at(int node) const { return filling_.places[node]; }
  int add(const Vector3& place) {
    filling_.places.push_back(place);
    return static_cast<int>(filling_.places.size()) - 1;
  }

  /// A grid with inner nodes placed by transfinite interpolation.
  void grid(const Chain& south, const Chain& east, const Chain& north, const Chain& west) {
    const int columns = segments_of(south), rows = segments_of(east);
    std::vector<Chain> nodes{south};
    for (int j = 1; j < rows; ++j) {
      const double t = static_cast<double>(j) / rows;
      Chain& row = nodes.emplace_back();
      row.push_back(west[rows - j]);
      for (int i = 1; i < columns; ++i) {
        const double s = static_cast<double>(i) / columns;
        row.push_back(add((1 - t) * at(south[i]) + t * at(north[columns - i]) + (1 - s) * at(west[rows - j]) +
                          s * at(east[j]) - (1 - s) * (1 - t) * at(south[0]) -
                          s * (1 - t) * at(south[columns]) - s * t * at(north[0]) -
                          (1 - s) * t * at(north[columns])));
      }
      row.push_back(east[j]);
    }
    nodes.emplace_back(north.rbegin(), north.rend());
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < columns; ++i)
        filling_.quads.push_back({nodes[j][i], nodes[j][i + 1], nodes[j + 1][i + 1], nodes[j + 1][i]});
  }

  PolygonFilling filling_;
};

/// A row across a polygon, from a node of one side to a node of another. The parts to its left and right are
/// filled around one irregular node each.
struct Cut {
  int first, from, second, to, segments;
  int quads;  ///< quads on both sides of it
  double cost;
};

class PolygonCutter {
 public:
  PolygonCutter(const std::vector<Vector3>& places, const std::vector<Chain>& sides)
      : places_(places), sides_(sides), count_(static_cast<int>(sides.size())), lengths_(segments_of(sides)) {
    const std::size_t n = places_.size();
    for (std::size_t i = 0; i < n; ++i)
      mean_ += (places_[i] - places_[(i + 1) % n]).norm() / static_cast<double>(n);
  }

  /// All cuts, the cheapest first. Of parallel rows between the same two irregular nodes, only the one next
  /// to the first of these is among them.
  std::vector<Cut> cuts() const {
    std::vector<Cut> result;
    const int apart = count_ == 6 ? 3 : 1;
    // With two or six corners both parts are alike: half of the cuts equal the others, seen from the far end.
    const int firsts = count_ == 4 ? 4 : count_ / 2;
    for (int first = 0; first < firsts; ++first) {
      const int second = (first + apart) % count_;
      for (int from = 1; from < lengths_[first]; ++from)
        for (int to = 1; to < lengths_[second]; ++to) add_cut(first, from, second, to, result);
    }
    std::stable_sort(result.begin(), result.end(),
                     [](const Cut& a, const Cut& b) { return a.cost < b.cost; });
    return result;
  }

  PolygonFilling fill(const Cut& cut) const {
    Filler filler(places_);
    const Chain forth = filler.row(sides_[cut.first][cut.from], sides_[cut.second][cut.to], cut.segments);
    const auto fill = [&](int first, int from, int second, int to, Chain back) {
      const Chain &a = sides_[first], &b = sides_[second];
      std::vector<Chain> part{Chain(a.begin() + from, a.end())};
      for (int i = (first + 1) % count_; i != second; i = (i + 1) % count_) part.push_back(sides_[i]);
      part.emplace_back(b.begin(), b.begin() + to + 1);
      part.push_back(std::move(back));
      filler.fill(part);
    };
    fill(cut.first, cut.from, cut.second, cut.to, Chain(forth.rbegin(), forth.rend()));
    fill(cut.second, cut.to, cut.first, cut.from, forth);
    return filler.take();
  }

 private:
  /// Segments of the sides of one part; the cut comes last.
  struct Part {
    std::array<int, 5> sides;
    int count = 0;

    void add(int segments) { sides[count++] = segments; }
    std::span<const int> span() const { return {sides.data(), static_cast<std::size_t>(count)}; }
    /// Whether its irregular node is a corner of the quads whose midpoint subdivision this is.
    bool on_corners(const Spokes& spokes) const {
      return spokes.before[1] % 2 == 0 && (sides[0] - spokes.before[0]) % 2 == 0;
    }
  };

  /// The part between two nodes, without the cut.
  Part part(int first, int from, int second, int to) const {
    Part result;
    result.add(lengths_[first] - from);
    for (int i = (first + 1) % count_; i != second; i = (i + 1) % count_) result.add(lengths_[i]);
    result.add(to);
    return result;
  }

  void add_cut(int first, int from, int second, int to, std::vector<Cut>& cuts) const {
    Part left = part(first, from, second, to), right = part(second, to, first, from);
    // This number puts one segment between the cut and the irregular node to its left.
    const auto& s = left.sides;
    const int segments = left.count == 2 ? s[0] + s[1] - 2 : 2 - s[0] + s[1] + s[2] - s[3];
    if (segments < 1) return;
    left.add(segments);
    right.add(segments);
    const Spokes to_left(left.span()), to_right(right.span());
    if (to_left.least < 1 || to_right.least < 1) return;
    if (!left.on_corners(to_left) || !right.on_corners(to_right)) return;
    const double distance = (places_[sides_[first][from]] - places_[sides_[second][to]]).norm();
    const double stretch = std::log(distance / (segments * mean_));
    const int least = std::min(to_left.least, to_right.least);
    cuts.push_back({first, from, second, to, segments,
                    to_left.quads(left.span()) + to_right.quads(right.span()),
                    stretch * stretch + crowding / least});
  }

  /// Cost of an irregular node next to a side.
  static constexpr double crowding = 0.3;

  const std::vector<Vector3>& places_;
  const std::vector<Chain>& sides_;
  int count_;
  std::vector<int> lengths_;
  double mean_ = 0;
};

/// Undoes a midpoint subdivision; finds nothing if the quads are not one. Every other node of the outline is
/// a corner of the coarse quads, starting with the first.
class Coarsening {
 public:
  Coarsening(const PolygonFilling& fine, int outline)
      : fine_(fine), kinds_(fine.places.size(), Kind::unknown) {
    for (int i = 0; i < outline; ++i) kinds_[i] = i % 2 == 0 ? Kind::corner : Kind::middle;
  }

  std::optional<PolygonFilling> run() {
    if (!find_kinds()) return std::nullopt;
    PolygonFilling result;
    result.irregular = fine_.irregular;
    std::vector<int> number(kinds_.size(), -1);
    for (std::size_t i = 0; i < kinds_.size(); ++i) {
      if (kinds_[i] != Kind::corner) continue;
      number[i] = static_cast<int>(result.places.size());
      result.places.push_back(fine_.places[i]);
    }
    // For each fine quad: the center, and the coarse corner with the middles of the sides before and after.
    struct Quarter {
      int center, before, corner, after;
    };
    std::vector<Quarter> quarters;
    for (const Quad& quad : fine_.quads)
      for (int k = 0; k < 4; ++k)
        if (kinds_[quad[k]] == Kind::center)
          quarters.push_back({quad[k], quad[(k + 1) & 3], quad[(k + 2) & 3], quad[(k + 3) & 3]});
    std::stable_sort(quarters.begin(), quarters.end(),
                     [](const Quarter& a, const Quarter& b) { return a.center < b.center; });
    if (quarters.size() % 4 != 0) return std::nullopt;
    for (std::size_t first = 0; first < quarters.size(); first += 4) {
      if (quarters[first].center != quarters[first + 3].center) return std::nullopt;
      Quad quad{};
      int at = quarters[first].before;
      for (int& corner : quad) {
        std::size_t i = first;
        while (i < first + 4 && quarters[i].before != at) ++i;
        if (i == first + 4) return std::nullopt;
        corner = number[quarters[i].corner];
        at = quarters[i].after;
      }
      result.quads.push_back(quad);
    }
    return result;
  }

 private:
  enum class Kind : char { unknown, corner, middle, center };

  static Kind opposite(Kind kind) {
    return kind == Kind::corner ? Kind::center : kind == Kind::center ? Kind::corner : kind;
  }

  /// Spreads the kinds from quad to quad. False if a node would be of two kinds.
  bool find_kinds() {
    for (bool any = true; any;) {
      any = false;
      for (const Quad& quad : fine_.quads)
        for (int k = 0; k < 4; ++k) {
          const Kind a = kinds_[quad[k]], b = kinds_[quad[(k + 1) & 3]];
          if (a == Kind::unknown || b == Kind::unknown) continue;
          if ((a == Kind::middle) == (b == Kind::middle)) return false;
          for (const auto& [node, kind] :
               {std::pair(quad[(k + 2) & 3], opposite(a)), std::pair(quad[(k + 3) & 3], opposite(b))}) {
            if (kinds_[node] != Kind::unknown && kinds_[node] != kind) return false;
            any |= kinds_[node] == Kind::unknown;
            kinds_[node] = kind;
          }
        }
    }
    return true;
  }

  const PolygonFilling& fine_;
  std::vector<Kind> kinds_;
};

void relax(PolygonFilling& filling, std::size_t outline) {
  constexpr int smoothing_sweeps = 20;
  std::vector<Vector3> sum(filling.places.size());
  std::vector<int> count(filling.places.size());
  for (int sweep = 0; sweep < smoothing_sweeps; ++sweep) {
    std::fill(sum.begin(), sum.end(), Vector3::Zero());
    std::fill(count.begin(), count.end(), 0);
    for (const Quad& quad : filling.quads)
      for (int k = 0; k < 4; ++k) {
        sum[quad[k]] += filling.places[quad[(k + 1) & 3]] + filling.places[quad[(k + 3) & 3]];
        count[quad[k]] += 2;
      }
    for (std::size_t i = outline; i < filling.places.size(); ++i)
      if (count[i] > 0) filling.places[i] = sum[i] / count[i];
  }
}

/// The sides between corners, on an outline that has `times` nodes for each node of the given one.
std::vector<Chain> sides_between(const std::vector<int>& corners, int outline, int times) {
  std::vector<Chain> sides;
  const int nodes = times * outline;
  if (nodes == 0) return sides;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const int last = i + 1 < corners.size() ? corners[i + 1] : corners[0] + outline;
    Chain& side = sides.emplace_back();
    for (int k = times * corners[i]; k <= times * last; ++k) side.push_back(k % nodes);
  }
  return sides;
}

}  // namespace

bool fill_polygon(const std::vector<Vector3>& outline, const std::vector<int>& corners,
                  const FillingLimits& limits, const std::function<bool(const PolygonFilling&)>& accept) {
  const int n = static_cast<int>(corners.size()), nodes = static_cast<int>(outline.size());
  if (n < 2 || n > 6) return false;
  const std::vector<Chain> sides = sides_between(corners, nodes, 1);
  const std::vector<int> lengths = segments_of(sides);
  const auto allowed = [&](int quads) { return quads >= limits.least_quads && quads <= limits.most_quads; };
  const auto offer = [&](PolygonFilling filling) {
    relax(filling, outline.size());
    return accept(filling);
  };
  if (is_grid(lengths) || (n % 2 == 1 && limits.most_irregular >= 1 && Spokes(lengths).least >= 1)) {
    if (!allowed(n == 4 ? lengths[0] * lengths[1] : Spokes(lengths).quads(lengths))) return false;
    Filler filler(outline);
    filler.fill(sides);
    return offer(filler.take());
  }
  if (n % 2 == 1 || limits.most_irregular < 2) return false;
  // Neighboring irregular nodes have no row of nodes between them, but their midpoint subdivision has one. So
  // the finer polygon is cut.
  std::vector<Vector3> finer;
  for (int i = 0; i < nodes; ++i) {
    finer.push_back(outline[i]);
    finer.push_back(0.5 * (outline[i] + outline[(i + 1) % nodes]));
  }
  const std::vector<Chain> finer_sides = sides_between(corners, nodes, 2);
  const PolygonCutter cutter(finer, finer_sides);
  int left = 4;
  for (const Cut& cut : cutter.cuts()) {
    if (!allowed(cut.quads / 4)) continue;
    auto filling = Coarsening(cutter.fill(cut), 2 * nodes).run();
    if (!filling) continue;
    if (offer(std::move(*filling))) return true;
    if (--left == 0) return false;
  }
  return false;
}

}  // namespace quadrille
