/// Walks the wires for runs of edges with the same layers, and looks at what the runs end on.

#include "mesher/edges/row_lines.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "geometry/surfaces/face_surface.hpp"

namespace quadrille {

double sum_of(const std::vector<double>& lengths) {
  return std::accumulate(lengths.begin(), lengths.end(), 0.0);
}

std::vector<double> heights_of(const SizeLayers& layers) {
  std::vector<double> heights;
  heights.reserve(layers.count);
  for (int i = 0; i < layers.count; ++i) heights.push_back(layers.first * std::pow(layers.ratio, i));
  return heights;
}

std::vector<double> EdgeHeads::shares(double length, int segments,
                                      const std::function<double(int k, int between)>& place_of) const {
  const int between = segments - this->segments();
  if (between < 1) return {};
  std::vector<double> places{0};
  for (const double head : first) places.push_back(places.back() + head);
  for (int k = 1; k < between; ++k) places.push_back(place_of(k, between));
  places.push_back(length - sum_of(last));
  for (auto head = last.rbegin(); head != last.rend(); ++head) places.push_back(places.back() + *head);
  for (double& place : places) place /= length;
  places.back() = 1;
  return places;
}

bool has_chain(const RowLinesOfFaces& lines, FaceId face) {
  const auto own = lines.find(face);
  return own != lines.end() && std::any_of(own->second.begin(), own->second.end(),
                                           [](const RowLine& line) { return !line.is_closed(); });
}

namespace {

/// Least and largest angle of a face (radians) at which rows can end on the edge beside their own.
constexpr double least_angle = 40 * M_PI / 180, largest_angle = 140 * M_PI / 180;
/// Largest share of an edge that the ends of rows may take.
constexpr double most_of_edge = 0.9;

class RowLineFinder {
 public:
  RowLineFinder(const CadShape& shape, const FaceOutlines& sides, const FaceFlags& used,
                const TinyFeatures& tiny, const PrescribedEdges& prescribed,
                const ByElement<SizeLayers>& layers)
      : shape_(shape), sides_(sides), used_(used), tiny_(tiny), prescribed_(prescribed), layers_(layers) {
    lines_.along.resize(shape.edges.size());
  }

  RowLines run() {
    for (const FaceId face : shape_.faces.ids()) {
      if (!used_[face] || sides_[face].is_rectangle()) continue;
      for (const CadWire& wire : shape_.faces[face].wires) take_wire(face, wire);
    }
    for (const EdgeId edge : shape_.edges.ids())
      if (lines_.along[edge]) lines_.without.erase(shape_.edges[edge].number);
    return std::move(lines_);
  }

 private:
  using Coedges = std::vector<const Coedge*>;

  const SizeLayers* layers_of(EdgeId edge) const {
    const auto own = layers_.edges.find(shape_.edges[edge].number);
    return own == layers_.edges.end() ? nullptr : &own->second;
  }

  bool are_alike(EdgeId a, EdgeId b) const {
    const SizeLayers *one = layers_of(a), *other = layers_of(b);
    if (one == nullptr || other == nullptr) return one == other;
    return heights_of(*one) == heights_of(*other);
  }

  void take_wire(FaceId face, const CadWire& wire) {
    const Coedges coedges = coedges_left(shape_, tiny_, face, wire);
    const std::size_t n = coedges.size();
    const auto edge = [&](std::size_t k) { return coedges[k % n]->edge; };
    std::size_t first = 0;  // an edge that differs from the one before
    while (first < n && are_alike(edge(first), edge(first + n - 1))) ++first;
    if (first == n) {
      if (n > 0 && layers_of(edge(0)) != nullptr) add(face, line_of(coedges, 0, n));
      return;
    }
    for (std::size_t from = first, to = first; from < first + n; from = to) {
      while (to < first + n && are_alike(edge(from), edge(to))) ++to;
      if (layers_of(edge(from)) != nullptr) take_chain(face, coedges, from, to);
    }
  }

  RowLine line_of(const Coedges& coedges, std::size_t from, std::size_t to) const {
    RowLine line;
    for (std::size_t k = from; k < to; ++k) line.edges.push_back(coedges[k % coedges.size()]->edge);
    line.heights = heights_of(*layers_of(line.edges.front()));
    return line;
  }

  void add(FaceId face, RowLine line) {
    for (const EdgeId edge : line.edges) lines_.along[edge] = 1;
    lines_.of_faces[face].push_back(std::move(line));
  }

  /// Adds the edges from `from` to before `to` as a line, if rows can end at both ends.
  void take_chain(FaceId face, const Coedges& coedges, std::size_t from, std::size_t to) {
    const std::size_t n = coedges.size();
    const Coedge &before = *coedges[(from + n - 1) % n], &first = *coedges[from % n],
                 &last = *coedges[(to - 1) % n], &after = *coedges[to % n];
    const FaceSurface surface(shape_.faces[face]);
    const auto turning = [&](const Coedge& a, const Coedge& b) { return turning_at(shape_, surface, a, b); };
    RowLine line = line_of(coedges, from, to);
    auto heads = lines_.heads;
    std::string why = end(line, 0, turning(before, first), face, before, heads);
    if (why.empty()) why = end(line, 1, turning(last, after), face, after, heads);
    if (!why.empty()) {
      for (const EdgeId edge : line.edges) lines_.without.emplace(shape_.edges[edge].number, why);
      return;
    }
    lines_.heads = std::move(heads);
    note_step(line.ends[0], before, shape_.start_of(first), *layers_of(first.edge));
    note_step(line.ends[1], after, shape_.start_of(after), *layers_of(first.edge));
    add(face, std::move(line));
  }

  /// Decides how rows end. \param turning of the boundary there, to the left \param beside the next edge
  /// \return why they cannot; empty if they can
  std::string end(RowLine& line, int which, double turning, FaceId face, const Coedge& beside,
                  std::map<EdgeId, EdgeHeads>& heads) const {
    const CadEdge& edge = shape_.edges[beside.edge];
    const double angle = M_PI - turning;
    if (std::count(edge.faces.begin(), edge.faces.end(), face) != 1)
      return fmt::format("its rows would end on Edge{}, which is a seam of Face{}", edge.number,
                         face.number());
    if (layers_of(beside.edge) != nullptr)
      return fmt::format("its rows would end on Edge{}, which has other layers", edge.number);
    if (angle < least_angle)
      return fmt::format(
          "its angle of {:.0f} degrees with Edge{} in Face{} is too sharp for rows to end there",
          angle * 180 / M_PI, edge.number, face.number());
    line.ends[which] = angle > largest_angle ? RowLine::End::free : RowLine::End::meets;
    if (line.ends[which] == RowLine::End::free) return {};
    if (prescribed_[beside.edge])
      return fmt::format("its rows would end on Edge{}, which has a prescribed division", edge.number);
    // The edge's start lies at the line's end where the wire leaves the line along its direction.
    const bool at_start = beside.forward == (which == 1);
    EdgeHeads& own = heads[beside.edge];
    std::vector<double> lengths = line.heights;
    for (double& length : lengths) length /= std::sin(angle);
    std::vector<double>& head = at_start ? own.first : own.last;
    if (!head.empty() && head != lengths)
      return fmt::format("its rows would end on Edge{}, where other rows end", edge.number);
    head = std::move(lengths);
    const double left = edge.length - sum_of(own.first) - sum_of(own.last);
    if (left < std::max((1 - most_of_edge) * edge.length, line.heights.back()))
      return fmt::format("its rows would end on Edge{}, which is too short for them", edge.number);
    return {};
  }

  /// Requests sizes where rows end freely, and where another face has the short segments on which they end.
  void note_step(RowLine::End end, const Coedge& beside, VertexId vertex, const SizeLayers& layers) {
    if (end == RowLine::End::meets && shape_.edges[beside.edge].faces.size() == 1) return;
    if (vertex.exists()) lines_.steps.emplace(vertex, layers);
  }

  const CadShape& shape_;
  const FaceOutlines& sides_;
  const FaceFlags& used_;
  const TinyFeatures& tiny_;
  const PrescribedEdges& prescribed_;
  const ByElement<SizeLayers>& layers_;
  RowLines lines_;
};

}  // namespace

RowLines find_row_lines(const CadShape& shape, const FaceOutlines& sides, const FaceFlags& used,
                        const TinyFeatures& tiny, const PrescribedEdges& prescribed,
                        const ByElement<SizeLayers>& layers) {
  return RowLineFinder(shape, sides, used, tiny, prescribed, layers).run();
}

}  // namespace quadrille
