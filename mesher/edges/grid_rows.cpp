#include "mesher/edges/grid_rows.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace quadrille {

namespace {

/// Largest ratio between the number that a member of a chord wants and the number that it gets, either way.
constexpr double largest_ratio = 4;
/// Largest share of a side that layers may take.
constexpr double most_of_side = 0.9;

/// The layers that start at the ends of an edge, in the direction of its parameter; null = none.
struct Stacks {
  const SizeLayers* first = nullptr;
  const SizeLayers* last = nullptr;
};

std::vector<double> heights_of(const SizeLayers* layers) {
  std::vector<double> heights;
  for (int i = 0; layers != nullptr && i < layers->count; ++i)
    heights.push_back(layers->first * std::pow(layers->ratio, i));
  return heights;
}

double sum_of(const std::vector<double>& heights) {
  return std::accumulate(heights.begin(), heights.end(), 0.0);
}

/// Row heights along an edge: layers from both ends, and sizes between that grow from the layers.
class StackedEdge {
 public:
  StackedEdge(double length, const Stacks& stacks, double size, double growth)
      : length_(length),
        first_(heights_of(stacks.first)),
        last_(heights_of(stacks.last)),
        inner_(length - sum_of(first_) - sum_of(last_)) {
    const double from = first_.empty() ? size : first_.back(), to = last_.empty() ? size : last_.back();
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
    const int wanted = layers() + std::max(1, static_cast<int>(std::lround(counts_.back())));
    return wanted + wanted % 2;
  }
  int layers() const { return static_cast<int>(first_.size() + last_.size()); }

  std::vector<double> shares(int segments) const {
    std::vector<double> places{0};
    for (const double height : first_) places.push_back(places.back() + height);
    const int between = segments - layers();
    int cell = 0;
    for (int k = 1; k < between; ++k) {
      const double target = counts_.back() * k / between;
      while (cell + 1 < samples && counts_[cell + 1] < target) ++cell;
      const double part = (target - counts_[cell]) / (counts_[cell + 1] - counts_[cell]);
      places.push_back(sum_of(first_) + inner_ * (cell + part) / samples);
    }
    places.push_back(length_ - sum_of(last_));
    for (auto height = last_.rbegin(); height != last_.rend(); ++height)
      places.push_back(places.back() + *height);
    for (double& place : places) place /= length_;
    places.back() = 1;
    return places;
  }

 private:
  static constexpr int samples = 256;
  double length_;
  std::vector<double> first_, last_;
  double inner_;                // length between the layers
  std::vector<double> counts_;  // number of segments up to each sample
};

class RowFinder {
 public:
  RowFinder(const CadShape& shape, const std::vector<FaceSides>& sides,
            std::vector<std::optional<PrescribedEdge>> prescribed, const SizingOptions& options, double size)
      : shape_(shape), sides_(sides), options_(options), size_(size) {
    rows_.prescribed = std::move(prescribed);
    rows_.prescribed.resize(shape.edges.size());
    rows_.divided.assign(shape.edges.size(), 0);
    rows_.layered.assign(shape.edges.size(), 0);
  }

  GridRows run() {
    std::map<int, Stacks> stacks;  // by edge
    std::vector<std::pair<int, std::vector<int>>> layered;
    for (std::size_t i = 0; i < shape_.edges.size(); ++i) {
      const auto found = options_.layers.edges.find(shape_.edges[i].number);
      if (found == options_.layers.edges.end()) continue;
      if (auto beside = stack(static_cast<int>(i), found->second, stacks))
        layered.emplace_back(static_cast<int>(i), std::move(*beside));
    }
    std::map<int, PrescribedEdge> of_layers;
    for (const auto& [edge, own] : stacks) divide(edge, stacks, of_layers);
    for (const auto& [edge, beside] : layered) {
      const bool all = std::all_of(beside.begin(), beside.end(), [&](int side) {
        const auto it = of_layers.find(side);
        return it != of_layers.end() && is_in_grids(side, it->second.segments, of_layers);
      });
      if (!all) continue;
      rows_.layered[edge] = 1;
      for (const int side : beside) rows_.prescribed[side] = of_layers.at(side);
    }
    for (std::size_t i = 0; i < rows_.prescribed.size(); ++i) {
      if (rows_.prescribed[i])
        rows_.divided[i] = is_in_grids(static_cast<int>(i), rows_.prescribed[i]->segments, of_layers);
    }
    return std::move(rows_);
  }

 private:
  /// Records the layers of an edge on the edges that run away from it. \return those edges; nothing if a face
  /// is not four-sided, or if one of those sides has several edges or a prescribed division.
  std::optional<std::vector<int>> stack(int index, const SizeLayers& layers,
                                        std::map<int, Stacks>& stacks) const {
    const CadEdge& edge = shape_.edges[index];
    std::vector<int> beside;
    std::vector<std::pair<int, bool>> found;  // edge, whether the layers start at its first vertex
    for (const int face : edge.faces) {
      const FaceSides& sides = sides_[face - 1];
      if (sides.outline != FaceSides::Outline::four || sides.facing.size() != 2) return std::nullopt;
      const bool in_first = holds(sides.facing[0], index);
      const FacingPair& across = sides.facing[in_first ? 1 : 0];
      if (across.first.size() != 1 || across.second.size() != 1) return std::nullopt;
      for (const int side : {across.first[0].edge, across.second[0].edge}) {
        const CadEdge& away = shape_.edges[side];
        const auto touches = [&](int vertex) {
          return vertex > 0 && (vertex == edge.first_vertex || vertex == edge.last_vertex);
        };
        if (touches(away.first_vertex) == touches(away.last_vertex)) return std::nullopt;
        found.emplace_back(side, touches(away.first_vertex));
        if (rows_.prescribed[side]) return std::nullopt;
      }
    }
    for (const auto& [side, at_first] : found) {
      (at_first ? stacks[side].first : stacks[side].last) = &layers;
      beside.push_back(side);
    }
    return beside;
  }

  static bool holds(const FacingPair& pair, int edge) {
    const auto is = [&](const SideEdge& side) { return side.edge == edge; };
    return std::any_of(pair.first.begin(), pair.first.end(), is) ||
           std::any_of(pair.second.begin(), pair.second.end(), is);
  }

  double size_on(int edge) const {
    const auto own = options_.edge_sizes.find(shape_.edges[edge].number);
    return own == options_.edge_sizes.end() ? size_ : std::min(size_, own->second);
  }

  StackedEdge stacked(int edge, const Stacks& stacks) const {
    return {shape_.edges[edge].length, stacks, size_on(edge), options_.growth};
  }

  /// Divides an edge with layers. It gets as many segments as the edge with layers in its chord that needs
  /// most, unless one of them has no room.
  void divide(int edge, const std::map<int, Stacks>& stacks, std::map<int, PrescribedEdge>& divided) const {
    int segments = 0;
    for (const int member : chord_of(edge)) {
      const auto own = stacks.find(member);
      if (own == stacks.end()) continue;
      const StackedEdge stack = stacked(member, own->second);
      if (!stack.has_room()) return;
      segments = std::max(segments, stack.segments());
    }
    const StackedEdge own = stacked(edge, stacks.at(edge));
    if (segments > own.layers()) divided[edge] = {segments, own.shares(segments)};
  }

  /// The edge opposite another one across a four-sided face or ring; -1 if there is no single such edge.
  int opposite(int face, int edge) const {
    const FaceSides& sides = sides_[face - 1];
    if (sides.outline != FaceSides::Outline::four && sides.outline != FaceSides::Outline::ring) return -1;
    for (const FacingPair& pair : sides.facing) {
      if (pair.first.size() != 1 || pair.second.size() != 1) continue;
      if (pair.first[0].edge == edge) return pair.second[0].edge;
      if (pair.second[0].edge == edge) return pair.first[0].edge;
    }
    return -1;
  }

  /// All edges connected to an edge through opposite(); includes -1 if some face has no opposite edge.
  std::set<int> chord_of(int edge) const {
    std::set<int> chord{edge};
    std::vector<int> open{edge};
    while (!open.empty()) {
      const int here = open.back();
      open.pop_back();
      for (const int face : shape_.edges[here].faces) {
        const int next = opposite(face, here);
        if (chord.insert(next).second && next >= 0) open.push_back(next);
      }
    }
    return chord;
  }

  bool is_in_grids(int edge, int segments, const std::map<int, PrescribedEdge>& of_layers) const {
    const std::set<int> chord = chord_of(edge);
    return std::all_of(chord.begin(), chord.end(), [&](int member) {
      if (member < 0) return false;
      if (rows_.prescribed[member]) return rows_.prescribed[member]->segments == segments;
      if (const auto it = of_layers.find(member); it != of_layers.end())
        return it->second.segments == segments;
      const double wanted = std::max(1.0, shape_.edges[member].length / size_on(member));
      return segments <= largest_ratio * wanted && wanted <= largest_ratio * segments;
    });
  }

  const CadShape& shape_;
  const std::vector<FaceSides>& sides_;
  const SizingOptions& options_;
  double size_;
  GridRows rows_;
};

}  // namespace

GridRows find_grid_rows(const CadShape& shape, const std::vector<FaceSides>& sides,
                        std::vector<std::optional<PrescribedEdge>> prescribed, const SizingOptions& options,
                        double size) {
  return RowFinder(shape, sides, std::move(prescribed), options, size).run();
}

namespace {

bool has_edge(const CadFace& face, const BoundaryNodes& nodes, bool BoundaryNodes::Edge::*is) {
  return std::any_of(face.wires.begin(), face.wires.end(), [&](const CadWire& wire) {
    return std::any_of(wire.coedges.begin(), wire.coedges.end(),
                       [&](const Coedge& coedge) { return nodes.edges[coedge.edge - 1].*is; });
  });
}

}  // namespace

bool has_kept_edge(const CadFace& face, const BoundaryNodes& nodes) {
  return has_edge(face, nodes, &BoundaryNodes::Edge::kept);
}

bool has_divided_edge(const CadFace& face, const BoundaryNodes& nodes) {
  return has_edge(face, nodes, &BoundaryNodes::Edge::divided);
}

}  // namespace quadrille
