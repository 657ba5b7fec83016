/// Counts the faces at each CAD edge and the quads at each side, and follows the segments of each edge.

#include "mesher/shell/shell_check.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>

#include <fmt/format.h>

#include "geometry/base/place_text.hpp"
#include "geometry/base/side_key.hpp"
#include "geometry/base/vector.hpp"
#include "mesher/edges/tiny_features.hpp"
#include "mesher/mesh/quad_geometry.hpp"
#include "mesher/mesh/sides.hpp"

namespace quadrille {

namespace {

class ShellCheck {
 public:
  ShellCheck(const CadShape& shape, const FaceFlags& requested, const ShellMesh& mesh)
      : shape_(shape),
        mesh_(mesh),
        counted_(requested),
        faces_at_(shape.edges.size(), 0),
        reach_(mesh.size_min) {
    for (const ShellMesh::Face& face : mesh.faces)
      if (face.status == FaceStatus::failed) counted_[FaceId::from_number(face.face)] = 0;
    for (const double tolerance : shape.vertex_tolerances) reach_ = std::max(reach_, tolerance);
    for (const auto& feature : mesh.suppressed_features) reach_ = std::max(reach_, feature.distance);
    for (const EdgeId id : shape.edges.ids()) {
      const auto& faces = shape.edges[id].faces;
      faces_at_[id] = static_cast<int>(
          std::count_if(faces.begin(), faces.end(), [&](FaceId face) { return counted_[face] != 0; }));
    }
  }

  std::vector<std::string> run() {
    find_lost_faces();
    find_inverted_quads();
    find_open_sides();
    find_broken_chains();
    return std::move(defects_);
  }

 private:
  void find_lost_faces() {
    std::vector<char> has_quads(shape_.faces.size(), 0);
    for (const int face : mesh_.quad_faces) has_quads[face - 1] = 1;
    for (const ShellMesh::Face& face : mesh_.faces) {
      const FaceId id = FaceId::from_number(face.face);
      if (counted_[id] == 0 || has_quads[id.index()] != 0 || face.status == FaceStatus::merged) continue;
      defects_.push_back(fmt::format("Face{} has no mesh", face.face));
      return;
    }
  }

  void find_inverted_quads() {
    int count = 0, first = -1;
    for (std::size_t i = 0; i < mesh_.quads.size(); ++i) {
      if (quad_scaled_jacobian(mesh_.points, mesh_.quads[i]) > 0) continue;
      if (count++ == 0) first = static_cast<int>(i);
    }
    if (count > 0)
      defects_.push_back(fmt::format("{} quads are inverted, the first on Face{} at {}", count,
                                     mesh_.quad_faces[first],
                                     place_text(mesh_.points[mesh_.quads[first][0]])));
  }

  void find_open_sides() {
    std::unordered_map<std::uint64_t, int> edges;  // by side_key(), the numbers
    std::vector<char> on_edges(mesh_.points.size(), 0);
    for (const ShellMesh::Segment& segment : mesh_.segments) {
      edges.emplace(side_key(segment.nodes[0], segment.nodes[1]), segment.edge);
      for (const int node : segment.nodes) on_edges[node] = 1;
    }
    int count = 0;
    std::string first;
    for_each_shared_side(
        mesh_.points.size(), no_check,
        [&](int a, int b, std::span<const Side> sides) {
          if (sides.size() == 2 || is_inside_faces(sides)) return;
          const auto edge = edges.find(side_key(a, b));
          if (edge != edges.end() && faces_at(edge->second) == static_cast<int>(sides.size())) return;
          if (is_explained(sides.size(), mesh_.points[a], mesh_.points[b], on_edges[a] && on_edges[b]))
            return;
          if (count++ > 0) return;
          const int face = mesh_.quad_faces[element_of(sides[0])];
          first =
              fmt::format("the first on Face{}{} at {}, has {} where the CAD model has {}", face,
                          edge == edges.end() ? "" : fmt::format(" along Edge{}", edge->second),
                          place_text(0.5 * (mesh_.points[a] + mesh_.points[b])),
                          sides.size() == 1 ? "one quad" : fmt::format("{} quads", sides.size()),
                          edge == edges.end() ? "no edge" : fmt::format("{} faces", faces_at(edge->second)));
        },
        mesh_.quads);
    if (count > 0)
      defects_.push_back(
          fmt::format("the mesh is not as tight as the CAD model: {} of its sides are open or "
                      "have too many quads; {}",
                      count, first));
  }

  /// Whether each face at a side has two quads there: it is inside faces that a thin part brings together,
  /// which Coincidences tells.
  bool is_inside_faces(std::span<const Side> sides) const {
    return std::all_of(sides.begin(), sides.end(), [&](Side side) {
      return std::count_if(sides.begin(), sides.end(), [&](Side other) {
               return mesh_.quad_faces[element_of(other)] == mesh_.quad_faces[element_of(side)];
             }) == 2;
    });
  }

  /// 0 for an edge that is not in the file, such as a seam that was added.
  int faces_at(int number) const {
    return number <= static_cast<int>(faces_at_.size()) ? faces_at_[EdgeId::from_number(number)] : 0;
  }

  /// Whether the CAD edges along a side allow so many quads there: where narrow parts are left out, the nodes
  /// of one edge stand for others, no farther away than the reach. Other nodes lie along crossed edges only.
  bool is_explained(std::size_t quads, const Vector3& a, const Vector3& b, bool has_nodes_of_edges) {
    constexpr double sag = 0.25;  // of the side's length
    const double length = (b - a).norm();
    int along = 0;
    for (const auto& [line, faces, is_crossed] : lines()) {
      if (!has_nodes_of_edges && !is_crossed) continue;
      if (quads == 1 ? faces != 1 : faces == 0) continue;
      const bool is_along = distance_to_line(a, line) <= reach_ && distance_to_line(b, line) <= reach_ &&
                            distance_to_line(0.5 * (a + b), line) <= reach_ + sag * length;
      if (is_along) along += faces;
    }
    return along >= static_cast<int>(quads);
  }

  struct Line {
    std::vector<Vector3> points;
    int faces;  ///< that count, at the edge
    bool is_crossed;
  };

  const std::vector<Line>& lines() {
    constexpr int pieces = 256;
    if (!lines_.empty()) return lines_;
    std::set<int> crossed;
    for (const ShellMesh::CrossedEdge& edge : mesh_.crossed_edges) crossed.insert(edge.edge);
    for (const EdgeId id : shape_.edges.ids()) {
      const CadEdge& edge = shape_.edges[id];
      if (edge.degenerate || !(edge.length > 0)) continue;
      lines_.push_back({points_along(edge, pieces), faces_at_[id], crossed.contains(edge.number)});
    }
    return lines_;
  }

  /// An edge that the model has in pieces, such as a seam under a hole, may have as many chains.
  void find_broken_chains() {
    std::map<int, int> balance;  // edges that are not crossed: segments less nodes
    std::map<int, std::set<int>> nodes;
    for (const ShellMesh::Segment& segment : mesh_.segments) {
      auto& of_edge = nodes[segment.edge];
      of_edge.insert(segment.nodes.begin(), segment.nodes.end());
      ++balance[segment.edge];
    }
    for (const ShellMesh::CrossedEdge& crossed : mesh_.crossed_edges) balance.erase(crossed.edge);
    std::map<int, int> pieces;
    for (const CadEdge& edge : shape_.edges) pieces[edge.number] += !edge.faces.empty();
    for (const auto& [edge, segments] : balance) {
      const int chains = static_cast<int>(nodes[edge].size()) - segments;  // a loop counts as none
      if (chains <= std::max(1, pieces[edge])) continue;
      defects_.push_back(fmt::format("the nodes on Edge{} form {} chains in place of one, near {}", edge,
                                     chains, place_text(mesh_.points[*nodes[edge].begin()])));
      return;
    }
  }

  const CadShape& shape_;
  const ShellMesh& mesh_;
  FaceFlags counted_;               ///< 1 = requested, and not failed
  IdVector<EdgeId, int> faces_at_;  ///< how many of the counted faces are at each edge
  double reach_;                    ///< how far nodes may lie from the edges that they stand for
  std::vector<Line> lines_;         ///< of all edges, once they are needed
  std::vector<std::string> defects_;
};

}  // namespace

std::vector<std::string> shell_defects(const CadShape& shape, const FaceFlags& requested,
                                       const ShellMesh& mesh) {
  return ShellCheck(shape, requested, mesh).run();
}

}  // namespace quadrille
