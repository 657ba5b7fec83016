/// Tells edges shorter than the least size, narrow faces, sharp corners and places where nothing forces short
/// sides from each other.

#include "mesher/shell/short_sides.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "geometry/base/side_key.hpp"
#include "geometry/base/vector.hpp"

namespace quadrille {

namespace {

constexpr double degrees = 180 / std::numbers::pi;
constexpr double sharp = 40;  // degrees: quads in such a corner get shorter and shorter sides

class Finder {
 public:
  Finder(const CadShape& shape, const ShellMesh& mesh) : shape_(shape), mesh_(mesh) {}

  std::vector<ShellMesh::ShortSides> run() {
    find_short_quads();
    if (short_.empty()) return {};
    index_segments();
    for (const auto& [quad, k] : short_) add(quad, k);
    index_sides();
    for (const auto& [quad, k] : short_) measure_width(quad, k);
    find_corners();
    for (auto& [entity, found] : found_)
      if (entity.first == 2) found.why = reason(extents_[entity.second]);
    std::vector<ShellMesh::ShortSides> result;
    for (auto& [entity, found] : found_) result.push_back(std::move(found));
    std::stable_sort(result.begin(), result.end(),
                     [](const auto& a, const auto& b) { return a.quads > b.quads; });
    return result;
  }

 private:
  struct ShortQuad {
    int quad, side;  // its shortest
  };

  double length(int quad, int k) const {
    const auto& corners = mesh_.quads[quad];
    return (mesh_.points[corners[k & 3]] - mesh_.points[corners[(k + 1) & 3]]).norm();
  }

  void find_short_quads() {
    const double least = 0.5 * mesh_.size_min;
    for (int quad = 0; quad < static_cast<int>(mesh_.quads.size()); ++quad) {
      int shortest = 0;
      for (int k = 1; k < 4; ++k)
        if (length(quad, k) < length(quad, shortest)) shortest = k;
      if (length(quad, shortest) < least) short_.push_back({quad, shortest});
    }
  }

  void index_segments() {
    for (const ShellMesh::Segment& segment : mesh_.segments)
      edge_of_.try_emplace(side_key(segment.nodes[0], segment.nodes[1]), segment.edge);
    for (const CadEdge& edge : shape_.edges) {
      double& length = length_of_[edge.number];  // pieces add up
      length += edge.length;
    }
  }

  void add(int quad, int shortest) {
    const double length = this->length(quad, shortest);
    const auto& corners = mesh_.quads[quad];
    for (const int k : {shortest, (shortest + 2) & 3}) {
      const auto edge = edge_of_.find(side_key(corners[k], corners[(k + 1) & 3]));
      if (edge == edge_of_.end() || length_of_[edge->second] >= mesh_.size_min) continue;
      auto& found = count(1, edge->second, length);
      found.why = fmt::format("it is {:.3g} long", length_of_[edge->second]);
      return;
    }
    count(2, mesh_.quad_faces[quad], length);
    extents_.try_emplace(mesh_.quad_faces[quad]);
  }

  ShellMesh::ShortSides& count(int dimension, int number, double length) {
    ShellMesh::ShortSides& found = found_[{dimension, number}];
    found.shortest = found.quads == 0 ? length : std::min(found.shortest, length);
    found.dimension = dimension;
    found.number = number;
    ++found.quads;
    return found;
  }

  /// The narrowest row of quads between two edges, and the sharpest corner of a face.
  struct Extent {
    double width = std::numeric_limits<double>::infinity();
    std::array<int, 2> edges{};
    double angle = 360;
    int vertex = 0;
  };

  /// The quads at each side of the faces that have short sides.
  void index_sides() {
    for (int quad = 0; quad < static_cast<int>(mesh_.quads.size()); ++quad) {
      if (!found_.contains({2, mesh_.quad_faces[quad]})) continue;
      for (int k = 0; k < 4; ++k) {
        auto& uses = quads_at_.try_emplace(side(quad, k), std::array{-1, -1}).first->second;
        uses[uses[0] < 0 ? 0 : 1] = quad;
      }
    }
  }

  std::uint64_t side(int quad, int k) const {
    return side_key(mesh_.quads[quad][k & 3], mesh_.quads[quad][(k + 1) & 3]);
  }

  /// The rows that a short side is one of, from edge to edge of the face.
  void measure_width(int quad, int shortest) {
    const auto extent = extents_.find(mesh_.quad_faces[quad]);
    if (extent == extents_.end()) return;
    double width = length(quad, shortest);
    std::array<int, 2> edges{};
    for (const int direction : {1, 3}) {
      constexpr int most = 8;  // rows: more are no strip
      int at = quad, k = (shortest + direction) & 3;
      for (int row = 0; row < most && edges[direction / 2] == 0; ++row) {
        const std::uint64_t key = side(at, k);
        if (const auto edge = edge_of_.find(key); edge != edge_of_.end()) {
          edges[direction / 2] = edge->second;
          break;
        }
        const auto& uses = quads_at_[key];
        at = uses[0] == at ? uses[1] : uses[0];
        if (at < 0) return;
        for (k = 0; side(at, k) != key;) ++k;
        width += length(at, k + 1);
        k = (k + 2) & 3;
      }
    }
    if (edges[0] == 0 || edges[1] == 0 || width >= extent->second.width) return;
    extent->second.width = width;
    extent->second.edges = edges;
  }

  void find_corners() {
    std::unordered_map<int, int> vertex_at;
    for (const auto& corner : mesh_.corners) vertex_at.emplace(corner.node, corner.vertex);
    std::map<std::pair<int, int>, double> angles;  // of a face at a vertex's node, all its quads
    const auto& x = mesh_.points;
    for (std::size_t i = 0; i < mesh_.quads.size(); ++i) {
      const int face = mesh_.quad_faces[i];
      if (!extents_.contains(face)) continue;
      const auto& quad = mesh_.quads[i];
      for (int k = 0; k < 4; ++k) {
        const int at = quad[k], next = quad[(k + 1) & 3], before = quad[(k + 3) & 3];
        if (vertex_at.contains(at))
          angles[{face, at}] += degrees * angle_between(x[next] - x[at], x[before] - x[at]);
      }
    }
    for (const auto& [place, angle] : angles) {
      Extent& extent = extents_[place.first];
      if (angle >= extent.angle) continue;
      extent.angle = angle;
      extent.vertex = vertex_at[place.second];
    }
  }

  std::string reason(const Extent& extent) const {
    const auto [one, other] = extent.edges;
    if (extent.width < mesh_.size_min)
      return one == other ? fmt::format("Edge{} comes within {:.3g} of itself", one, extent.width)
                          : fmt::format("Edge{} and Edge{} come within {:.3g} of each other", one, other,
                                        extent.width);
    if (extent.angle < sharp)
      return fmt::format("its sides meet at {:.0f} degrees at Vertex{}", extent.angle, extent.vertex);
    return "nothing on it is so small: rows of quads end there, or pass on from a neighbor";
  }

  const CadShape& shape_;
  const ShellMesh& mesh_;
  std::vector<ShortQuad> short_;
  std::unordered_map<std::uint64_t, int> edge_of_;                  // by side_key()
  std::map<int, double> length_of_;                                 // edges, by number
  std::unordered_map<std::uint64_t, std::array<int, 2>> quads_at_;  // -1 = none
  std::map<std::pair<int, int>, ShellMesh::ShortSides> found_;      // by dimension and number
  std::map<int, Extent> extents_;                                   // faces, by number
};

}  // namespace

std::vector<ShellMesh::ShortSides> short_sides(const CadShape& shape, const ShellMesh& mesh) {
  if (!(mesh.size_min > 0)) return {};
  return Finder(shape, mesh).run();
}

}  // namespace quadrille
