/// Distinguishes edges shorter than the least size, sharp corners, narrow faces and places where nothing
/// forces poor quads.

#include "mesher/shell/poor_quads.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <optional>
#include <tuple>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "geometry/base/side_key.hpp"
#include "geometry/base/vector.hpp"
#include "mesher/mesh/criteria.hpp"
#include "mesher/mesh/sides.hpp"

namespace quadrille {

namespace {

constexpr double degrees = 180 / std::numbers::pi;

class Finder {
 public:
  Finder(const CadShape& shape, const ShellMesh& mesh, const std::map<int, int>& cut_corners)
      : shape_(shape),
        mesh_(mesh),
        limits_(limits_of(mesh)),
        vertex_at_(cut_corners.begin(), cut_corners.end()) {}

  std::vector<ShellMesh::PoorQuads> run() {
    find_poor_quads();
    if (poor_.empty()) return {};
    index_segments();
    corners_ = corners_by_node(mesh_.points.size(), mesh_.quads);
    measure_angles();
    for (const Side shortest : poor_) add(element_of(shortest), index_of(shortest));
    std::vector<ShellMesh::PoorQuads> result;
    for (auto& [place, found] : found_) {
      found.why = reason(place, found);
      result.push_back(std::move(found));
    }
    std::stable_sort(result.begin(), result.end(),
                     [](const auto& a, const auto& b) { return a.quads > b.quads; });
    return result;
  }

 private:
  using Reason = ShellMesh::PoorQuads::Cause;
  /// What forces quads: an edge, or a face and why; of a corner the node.
  using Place = std::tuple<int, int, Reason, int>;  // dimension, number
  /// The edges at the ends of a row across a face, and how far they are apart.
  struct Row {
    double width = 0;
    std::array<int, 2> edges{};
  };

  double length(int quad, int k) const {
    const auto& corners = mesh_.quads[quad];
    return (mesh_.points[corners[k & 3]] - mesh_.points[corners[(k + 1) & 3]]).norm();
  }

  void find_poor_quads() {
    std::vector<signed char> shortest(mesh_.quads.size(), -1);  // of poor quads
    const int count = static_cast<int>(mesh_.quads.size());
    oneapi::tbb::parallel_for(0, count, [&](int quad) {
      if (is_poor(quad)) shortest[quad] = shortest_side(quad);
    });
    for (int quad = 0; quad < count; ++quad) {
      if (shortest[quad] < 0) continue;
      poor_.push_back(make_side(quad, shortest[quad]));
      faces_.try_emplace(mesh_.quad_faces[quad]);
    }
  }

  bool is_poor(int quad) const {
    const auto& x = mesh_.points;
    const auto& [a, b, c, d] = mesh_.quads[quad];
    const bool is_finer = std::binary_search(mesh_.finer_quads.begin(), mesh_.finer_quads.end(), quad);
    const CriteriaValues values = measure_criteria(x[a], x[b], x[c], x[d]);
    for (std::size_t i = 0; i < criterion_count; ++i) {
      const auto criterion = static_cast<Criterion>(i);
      if (!is_of_shape(criterion) && (criterion == Criterion::warp || is_finer)) continue;
      if (limits_.fails(criterion, values[i])) return true;
    }
    return false;
  }

  signed char shortest_side(int quad) const {
    signed char result = 0;
    for (signed char k = 1; k < 4; ++k)
      if (length(quad, k) < length(quad, result)) result = k;
    return result;
  }

  void index_segments() {
    for (const ShellMesh::Segment& segment : mesh_.segments)
      edge_of_.try_emplace(side_key(segment.nodes[0], segment.nodes[1]), segment.edge);
    for (const CadEdge& edge : shape_.edges) length_of_[edge.number] += edge.length;  // pieces add up
    for (const auto& corner : mesh_.corners) vertex_at_.emplace(corner.node, corner.vertex);
  }

  /// The angles at vertices of the faces with poor quads.
  void measure_angles() {
    const auto& x = mesh_.points;
    for (const auto& [at, vertex] : vertex_at_) {
      for (const Side corner : corners_[at]) {
        const auto face = faces_.find(mesh_.quad_faces[element_of(corner)]);
        if (face == faces_.end()) continue;
        const auto& quad = mesh_.quads[element_of(corner)];
        const int k = index_of(corner);
        face->second[at] +=
            degrees * angle_between(x[quad[(k + 1) & 3]] - x[at], x[quad[(k + 3) & 3]] - x[at]);
      }
    }
  }

  /// The other quad at a side, among those of faces with poor quads, and its side there; -1 = none.
  std::pair<int, int> across(int quad, int k) const {
    const std::uint64_t key = side(quad, k);
    for (const Side corner : corners_[mesh_.quads[quad][k]]) {
      const int other = element_of(corner);
      if (other == quad || !faces_.contains(mesh_.quad_faces[other])) continue;
      for (const int there : {index_of(corner), (index_of(corner) + 3) & 3})
        if (side(other, there) == key) return {other, there};
    }
    return {-1, -1};
  }

  void add(int quad, int shortest) {
    const double length = this->length(quad, shortest);
    const int face = mesh_.quad_faces[quad];
    for (const int k : {shortest, shortest + 2}) {
      const auto edge = edge_of_.find(side(quad, k));
      if (edge != edge_of_.end() && length_of_[edge->second] < mesh_.size_min)
        return count({1, edge->second, Reason::short_edge, 0}, length);
    }
    const auto& angles = faces_[face];
    for (const int node : mesh_.quads[quad]) {
      // No quad in a sharper corner keeps within the usual limits.
      const auto angle = angles.find(node);
      if (angle != angles.end() && angle->second < usual_limit(Criterion::angle_min))
        return count({2, face, Reason::corner, node}, length);
    }
    const auto row = row_of(quad, shortest);
    if (!row || row->width >= mesh_.size_min) return count({2, face, Reason::none, 0}, length);
    count({2, face, Reason::narrow, 0}, length);
    const auto narrowest = narrowest_.try_emplace(face, *row).first;
    if (row->width < narrowest->second.width) narrowest->second = *row;
  }

  void count(const Place& place, double length) {
    ShellMesh::PoorQuads& found = found_[place];
    found.shortest = found.quads == 0 ? length : std::min(found.shortest, length);
    found.dimension = std::get<0>(place);
    found.number = std::get<1>(place);
    found.cause = std::get<2>(place);
    ++found.quads;
  }

  std::uint64_t side(int quad, int k) const {
    return side_key(mesh_.quads[quad][k & 3], mesh_.quads[quad][(k + 1) & 3]);
  }

  /// The rows that a short side is one of, from edge to edge of the face.
  std::optional<Row> row_of(int quad, int shortest) const {
    Row result{length(quad, shortest), {}};
    for (const int direction : {1, 3}) {
      constexpr int max_rows = 8;  // rows: more are not a strip
      int at = quad, k = (shortest + direction) & 3;
      int& end = result.edges[direction / 2];
      for (int row = 0; row < max_rows && end == 0; ++row) {
        if (const auto edge = edge_of_.find(side(at, k)); edge != edge_of_.end()) {
          end = edge->second;
          break;
        }
        std::tie(at, k) = across(at, k);
        if (at < 0) return std::nullopt;
        result.width += length(at, k + 1);
        k = (k + 2) & 3;
      }
      if (end == 0) return std::nullopt;
    }
    return result;
  }

  std::string reason(const Place& place, const ShellMesh::PoorQuads& found) const {
    switch (std::get<Reason>(place)) {
      case Reason::short_edge:
        return fmt::format("it is {:.3g} long", length_of_.at(found.number));
      case Reason::corner: {
        const int node = std::get<3>(place);
        return fmt::format("its sides meet at {:.0f} degrees at Vertex{}", faces_.at(found.number).at(node),
                           vertex_at_.at(node));
      }
      case Reason::narrow: {
        const auto& [width, edges] = narrowest_.at(found.number);
        const auto [one, other] = edges;
        return one == other
                   ? fmt::format("Edge{} comes within {:.3g} of itself", one, width)
                   : fmt::format("Edge{} and Edge{} come within {:.3g} of each other", one, other, width);
      }
      case Reason::none:
        break;
    }
    return "no edge or angle there is too small; the mesh itself is irregular there";
  }

  const CadShape& shape_;
  const ShellMesh& mesh_;
  const CriteriaLimits limits_;
  std::vector<Side> poor_;  // the shortest sides of poor quads
  std::unordered_map<int, std::unordered_map<int, double>>
      faces_;                                       // with poor quads: their angles at nodes of vertices
  std::unordered_map<std::uint64_t, int> edge_of_;  // by side_key()
  std::map<int, double> length_of_;                 // edges, by number
  std::unordered_map<int, int> vertex_at_;          // by node
  Rows<Side> corners_;                              // of quads, at each node
  std::map<Place, ShellMesh::PoorQuads> found_;
  std::map<int, Row> narrowest_;  // by face
};

}  // namespace

std::vector<ShellMesh::PoorQuads> poor_quads(const CadShape& shape, const ShellMesh& mesh,
                                             const std::map<int, int>& cut_corners) {
  return Finder(shape, mesh, cut_corners).run();
}

}  // namespace quadrille
