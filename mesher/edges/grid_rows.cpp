/// Follows prescribed divisions from edge to opposite edge, and stacks layers at the ends of edges.

#include "mesher/edges/grid_rows.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "geometry/base/whole_number.hpp"
#include "geometry/surfaces/edge_curve.hpp"
#include "mesher/edges/count_table.hpp"
#include "mesher/edges/row_lines.hpp"

namespace quadrille {

namespace {

/// Largest ratio, either way, between the wanted count of a member of a chord and the count that it gets.
constexpr double largest_row_ratio = 4;
/// Largest share of a side that layers may take.
constexpr double most_of_side = 0.9;

/// Row heights along an edge: layers from both ends, and sizes between that grow from the layers.
class StackedEdge {
 public:
  StackedEdge(double length, const EdgeHeads& layers, double size, double growth)
      : length_(length), layers_(layers), inner_(length - sum_of(layers.first) - sum_of(layers.last)) {
    const double from = layers.first.empty() ? size : layers.first.back(),
                 to = layers.last.empty() ? size : layers.last.back();
    counts_.push_back(0);
    for (int i = 0; i < samples; ++i) {
      const double x = inner_ * (i + 0.5) / samples;
      const double here = std::min({size, from + growth * x, to + growth * (inner_ - x)});
      counts_.push_back(counts_.back() + inner_ / samples / here);
    }
  }

  bool has_room() const { return length_ - inner_ <= most_of_side * length_; }
  /// An even number, so that it suits faces that are not grids too.
  int segments() const {
    const int wanted = layers_.segments() + std::max(1, round_to_int(counts_.back()));
    return wanted + wanted % 2;
  }
  /// None if there is no room for a segment between the layers.
  std::vector<double> shares(int segments) const {
    return layers_.shares(length_, segments, [&](int k, int between) {
      const auto [cell, part] = place_in(counts_, counts_.back() * k / between);
      return sum_of(layers_.first) + inner_ * (static_cast<double>(cell) + part) / samples;
    });
  }

 private:
  static constexpr int samples = 256;
  double length_;
  EdgeHeads layers_;
  double inner_;                // length between the layers
  std::vector<double> counts_;  // number of segments up to each sample
};

class RowFinder {
 public:
  RowFinder(const CadShape& shape, const FaceOutlines& sides, PrescribedEdges prescribed,
            const SizingOptions& options, double size)
      : shape_(shape), sides_(sides), options_(options), size_(size) {
    rows_.prescribed = std::move(prescribed);
    rows_.prescribed.resize(shape.edges.size());
    rows_.divided.resize(shape.edges.size());
    rows_.layered.resize(shape.edges.size());
  }

  GridRows run() {
    std::map<EdgeId, EdgeHeads> stacks;
    std::vector<std::pair<EdgeId, std::vector<EdgeId>>> layered;
    for (const EdgeId edge : shape_.edges.ids()) {
      const auto found = options_.layers.edges.find(shape_.edges[edge].number);
      if (found == options_.layers.edges.end()) continue;
      if (auto beside = stack(edge, found->second, stacks)) layered.emplace_back(edge, std::move(*beside));
    }
    std::map<EdgeId, PrescribedEdge> of_layers;
    for (const auto& [edge, own] : stacks) divide(edge, stacks, of_layers);
    for (const auto& [edge, beside] : layered) {
      const bool all = std::all_of(beside.begin(), beside.end(), [&](EdgeId side) {
        const auto it = of_layers.find(side);
        return it != of_layers.end() && is_in_grids(side, it->second, of_layers);
      });
      if (!all) continue;
      rows_.layered[edge] = 1;
      for (const EdgeId side : beside) rows_.prescribed[side] = of_layers.at(side);
    }
    for (const EdgeId edge : rows_.prescribed.ids()) {
      if (const auto& own = rows_.prescribed[edge]) rows_.divided[edge] = is_in_grids(edge, *own, of_layers);
    }
    return std::move(rows_);
  }

 private:
  /// Records the layers of an edge on the edges that run away from it. \return those edges; nothing if a face
  /// is not four-sided, or if one of those sides has several edges or a prescribed division.
  std::optional<std::vector<EdgeId>> stack(EdgeId id, const SizeLayers& layers,
                                           std::map<EdgeId, EdgeHeads>& stacks) const {
    const CadEdge& edge = shape_.edges[id];
    std::vector<EdgeId> beside;
    std::vector<std::pair<EdgeId, bool>> found;  // edge, whether the layers start at its first vertex
    for (const FaceId face : edge.faces) {
      const FaceSides& sides = sides_[face];
      if (!sides.is_rectangle()) return std::nullopt;
      const bool in_first = holds(sides.facing[0], id);
      const FacingPair& across = sides.facing[in_first ? 1 : 0];
      if (across.first.size() != 1 || across.second.size() != 1) return std::nullopt;
      for (const EdgeId side : {across.first[0].edge, across.second[0].edge}) {
        const CadEdge& away = shape_.edges[side];
        const auto touches = [&](VertexId vertex) {
          return vertex.exists() && (vertex == edge.first_vertex || vertex == edge.last_vertex);
        };
        if (touches(away.first_vertex) == touches(away.last_vertex)) return std::nullopt;
        found.emplace_back(side, touches(away.first_vertex));
        if (rows_.prescribed[side]) return std::nullopt;
      }
    }
    for (const auto& [side, at_first] : found) {
      std::vector<double> lengths = heights_of(layers);
      const double sine = sine_between(edge, shape_.edges[side], at_first);
      for (double& length : lengths) length /= sine;
      (at_first ? stacks[side].first : stacks[side].last) = std::move(lengths);
      beside.push_back(side);
    }
    return beside;
  }

  /// The sine of the angle between an edge and one that runs away from it. Layers on slanted sides are as
  /// high as asked for, measured across the edge.
  static double sine_between(const CadEdge& edge, const CadEdge& away, bool at_first) {
    constexpr double least = 0.3;  // sharper corners get lower layers
    const VertexId vertex = at_first ? away.first_vertex : away.last_vertex;
    const Vector3 along =
        EdgeCurve(edge).derivative(vertex == edge.first_vertex ? edge.first : edge.last).normalized();
    const Vector3 across = EdgeCurve(away).derivative(at_first ? away.first : away.last).normalized();
    return std::clamp(along.cross(across).norm(), least, 1.0);
  }

  static bool holds(const FacingPair& pair, EdgeId edge) {
    const auto is = [&](const SideEdge& side) { return side.edge == edge; };
    return std::any_of(pair.first.begin(), pair.first.end(), is) ||
           std::any_of(pair.second.begin(), pair.second.end(), is);
  }

  double size_on(EdgeId edge) const {
    return std::min(size_, value_or(options_.edge_sizes, shape_.edges[edge].number, size_));
  }

  StackedEdge stacked(EdgeId edge, const EdgeHeads& stacks) const {
    return {shape_.edges[edge].length, stacks, size_on(edge), options_.growth};
  }

  /// Divides an edge with layers. It gets as many segments as the edge with layers in its chord that needs
  /// most, unless one of them has no room.
  void divide(EdgeId edge, const std::map<EdgeId, EdgeHeads>& stacks,
              std::map<EdgeId, PrescribedEdge>& divided) const {
    int segments = 0;
    for (const EdgeId member : chord_of(edge)) {
      const auto own = stacks.find(member);
      if (own == stacks.end()) continue;
      const StackedEdge stack = stacked(member, own->second);
      if (!stack.has_room()) return;
      segments = std::max(segments, stack.segments());
    }
    std::vector<double> shares = stacked(edge, stacks.at(edge)).shares(segments);
    if (!shares.empty()) divided[edge] = {segments, std::move(shares)};
  }

  /// The edge opposite another one across a four-sided face or ring; none if there is no single such edge.
  EdgeId opposite(FaceId face, EdgeId edge) const {
    const FaceSides& sides = sides_[face];
    if (!sides.is_filled()) return {};
    for (const FacingPair& pair : sides.facing) {
      if (pair.first.size() != 1 || pair.second.size() != 1) continue;
      if (pair.first[0].edge == edge) return pair.second[0].edge;
      if (pair.second[0].edge == edge) return pair.first[0].edge;
    }
    return {};
  }

  /// All edges connected to an edge through opposite(); includes none if some face has no opposite edge.
  std::set<EdgeId> chord_of(EdgeId edge) const {
    std::set<EdgeId> chord{edge};
    std::vector<EdgeId> open{edge};
    while (!open.empty()) {
      const EdgeId here = open.back();
      open.pop_back();
      for (const FaceId face : shape_.edges[here].faces) {
        const EdgeId next = opposite(face, here);
        if (chord.insert(next).second && next.exists()) open.push_back(next);
      }
    }
    return chord;
  }

  /// The number of segments that an edge has in any case; 0 = none.
  int fixed_number(EdgeId edge, const std::map<EdgeId, PrescribedEdge>& of_layers) const {
    if (const auto& own = rows_.prescribed[edge]; own && own->is_fixed()) return own->segments;
    const auto it = of_layers.find(edge);
    return it == of_layers.end() ? 0 : it->second.segments;
  }

  bool is_in_grids(EdgeId edge, const PrescribedEdge& own,
                   const std::map<EdgeId, PrescribedEdge>& of_layers) const {
    const std::set<EdgeId> chord = chord_of(edge);
    if (!std::all_of(chord.begin(), chord.end(), [](EdgeId member) { return member.exists(); })) return false;
    int segments = own.segments;
    for (const EdgeId member : chord) {
      const int number = own.is_fixed() ? 0 : fixed_number(member, of_layers);
      if (number > 0) segments = number;
    }
    return std::all_of(chord.begin(), chord.end(), [&](EdgeId member) {
      if (const int number = fixed_number(member, of_layers)) return number == segments;
      const double wanted = std::max(1.0, shape_.edges[member].length / size_on(member));
      return segments <= largest_row_ratio * wanted && wanted <= largest_row_ratio * segments;
    });
  }

  const CadShape& shape_;
  const FaceOutlines& sides_;
  const SizingOptions& options_;
  double size_;
  GridRows rows_;
};

}  // namespace

GridRows find_grid_rows(const CadShape& shape, const FaceOutlines& sides, PrescribedEdges prescribed,
                        const SizingOptions& options, double size) {
  return RowFinder(shape, sides, std::move(prescribed), options, size).run();
}

}  // namespace quadrille
