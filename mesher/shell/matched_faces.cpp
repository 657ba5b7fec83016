/// A copied mesh keeps the order of points and quads, so pairs of nodes are found by their places.

#include "mesher/shell/matched_faces.hpp"

#include <algorithm>
#include <map>
#include <mutex>

#include <fmt/format.h>

#include "geometry/base/error.hpp"
#include "geometry/base/place_text.hpp"
#include "geometry/surfaces/face_surface.hpp"

namespace quadrille {

namespace {

/// The surface of another face, moved; parameters are those on the other face. Calls from several threads are
/// allowed, since both faces may have the same surface.
class MovedSurface : public MeshSurface {
 public:
  /// \param turned the normal is that of the other side
  MovedSurface(std::shared_ptr<const MeshSurface> own, const RigidMotion& motion, bool turned)
      : own_(std::move(own)), motion_(motion), back_(motion.inverse()), sign_(turned ? -1 : 1) {}

  Vector3 move(Vector2& uv, const Vector3& target, Vector3& normal) const override {
    const std::lock_guard lock(mutex_);
    const Vector3 point = own_->move(uv, back_(target), normal);
    normal = sign_ * (motion_.rotation() * normal);
    return motion_(point);
  }
  Vector3 approach(Vector2& uv, const Vector3& target) const override {
    const std::lock_guard lock(mutex_);
    return motion_(own_->approach(uv, back_(target)));
  }
  Vector3 nearest(Vector2& uv, const Vector3& target) const override {
    const std::lock_guard lock(mutex_);
    return motion_(own_->nearest(uv, back_(target)));
  }
  Vector2 between(std::span<const Vector2> uvs) const override {
    const std::lock_guard lock(mutex_);
    return own_->between(uvs);
  }

 private:
  std::shared_ptr<const MeshSurface> own_;
  RigidMotion motion_, back_;
  double sign_;
  mutable std::mutex mutex_;
};

std::string name_of(const MatchedPair& pair, int number) {
  return fmt::format("{}{}", pair.dimension == 2 ? "Face" : "Edge", number);
}

/// (nodes of the first face's boundary) the nodes that they become; -1 = none.
std::map<int, int> images(const CadShape& shape, const MatchedFace& face, const BoundaryNodes& nodes) {
  std::map<int, int> result;
  for (const MatchedEdge& edge : face.edges) {
    const auto &from = nodes.edges[edge.from].nodes, &to = nodes.edges[edge.to].nodes;
    if (from.size() != to.size()) continue;
    for (std::size_t k = 0; k < from.size(); ++k)
      result[from[k]] = to[edge.reversed ? from.size() - 1 - k : k];
  }
  for (const InnerVertex& inner : shape.faces[face.from].inner_vertices) {
    const Vector3 place = face.motion(shape.vertices[inner.vertex]);
    for (const InnerVertex& other : shape.faces[face.to].inner_vertices) {
      const double tolerance = shape.vertex_tolerances[inner.vertex] + shape.vertex_tolerances[other.vertex];
      if ((shape.vertices[other.vertex] - place).norm() <= tolerance)
        result[nodes.vertex_nodes[inner.vertex]] = nodes.vertex_nodes[other.vertex];
    }
  }
  return result;
}

FaceMesh moved(const CadShape& shape, const MatchedFace& face, const BoundaryNodes& nodes, FaceMesh& source) {
  const CadFace &from = shape.faces[face.from], &to = shape.faces[face.to];
  if (source.surface) source.surface = std::make_shared<MovedSurface>(source.surface, RigidMotion(), false);
  FaceMesh result = source;
  const bool turned = face.flips != (from.reversed != to.reversed);
  result.surface = std::make_shared<MovedSurface>(
      source.surface ? source.surface : std::make_shared<const FaceSurface>(from), face.motion, turned);
  const std::map<int, int> at = images(shape, face, nodes);
  for (int& node : result.nodes) {
    const auto found = at.find(node);
    if (found == at.end() || found->second < 0)
      throw failure("match", fmt::format("`match` cannot give Face{} the mesh of Face{}, which has a node at "
                                         "{} without a counterpart on Face{}",
                                         face.to.number(), face.from.number(), place_text(nodes.points[node]),
                                         face.to.number()));
    node = found->second;
  }
  for (std::size_t i = 0; i < result.points.size(); ++i)
    result.points[i] =
        i < result.nodes.size() ? nodes.points[result.nodes[i]] : face.motion(source.points[i]);
  const Eigen::Matrix3d turn = (turned ? -1 : 1) * face.motion.rotation();
  for (Vector3& normal : result.normals) normal = turn * normal;
  if (face.flips)
    for (auto& quad : result.quads) std::swap(quad[1], quad[3]);
  return result;
}

using Pairs = std::vector<std::array<int, 2>>;

/// Pairs of nodes of two faces' quads, which have the same order.
void add_pairs(const MatchedFace& face, const ShellNumbering& numbering, const ShellMesh& mesh,
               Pairs& pairs) {
  const auto [first, last] = numbering.quads_of(face.from);
  const auto [other, end] = numbering.quads_of(face.to);
  if (last - first != end - other) return;  // one of them has no mesh
  for (std::size_t i = 0; i < last - first; ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      pairs.push_back({mesh.quads[first + i][k], mesh.quads[other + i][face.flips ? (4 - k) % 4 : k]});
      if (mesh.order == 2)
        pairs.push_back({mesh.midsides[first + i][k], mesh.midsides[other + i][face.flips ? 3 - k : k]});
    }
  }
}

/// Pairs of nodes of two edges.
void add_pairs(const MatchedEdge& edge, const BoundaryNodes& nodes, const ShellNumbering& numbering,
               const ShellMesh& mesh, Pairs& pairs) {
  const auto &from = nodes.edges[edge.from].nodes, &to = nodes.edges[edge.to].nodes;
  const std::size_t n = from.size();
  for (std::size_t k = 0; k < n && to.size() == n; ++k) {
    const int a = numbering.nodes[from[k]], b = numbering.nodes[to[edge.reversed ? n - 1 - k : k]];
    if (a >= 0 && b >= 0) pairs.push_back({a, b});
  }
  std::map<int, int> middles;  // by segment of the first edge
  for (std::size_t i = 0; i < mesh.segments.size() && mesh.order == 2; ++i)
    if (numbering.segments[i].first == edge.from)
      middles[numbering.segments[i].second] = mesh.segments[i].middle;
  for (std::size_t i = 0; i < mesh.segments.size() && mesh.order == 2; ++i) {
    const auto& [id, k] = numbering.segments[i];
    if (id != edge.to) continue;
    const auto found = middles.find(edge.reversed ? static_cast<int>(n) - 2 - k : k);
    if (found != middles.end()) pairs.push_back({found->second, mesh.segments[i].middle});
  }
}

/// Moves the midside nodes to the images of their partners. A node off the geometry takes its partner off it
/// too. \return whether a node became one off the geometry.
bool align_midsides(const RigidMotion& motion, const Pairs& pairs, ShellMesh& mesh) {
  std::map<int, double> off;
  for (const auto& node : mesh.off_geometry) off[node.node] = node.distance;
  std::size_t first_middle = mesh.points.size();
  for (const auto& middles : mesh.midsides)
    for (const int node : middles) first_middle = std::min(first_middle, static_cast<std::size_t>(node));
  const std::size_t before = off.size();
  for (const auto& [a, b] : pairs) {
    if (a == b || static_cast<std::size_t>(b) < first_middle) continue;
    if (off.contains(b) && !off.contains(a)) {
      mesh.points[a] = motion.inverse()(mesh.points[b]);
      off[a] = off[b];
    } else {
      mesh.points[b] = motion(mesh.points[a]);
      if (off.contains(a)) off.try_emplace(b, off[a]);
    }
  }
  mesh.off_geometry.clear();
  for (const auto& [node, distance] : off) mesh.off_geometry.push_back({node, distance});
  return off.size() > before;
}

}  // namespace

void copy_faces(const CadShape& shape, const Matches& matches, const BoundaryNodes& nodes,
                FaceMeshes& faces) {
  for (const MatchedFace& face : matches.faces) {
    faces[face.to].reset();
    if (faces[face.from]) faces[face.to] = moved(shape, face, nodes, *faces[face.from]);
  }
}

void list_matches(const Matches& matches, const BoundaryNodes& nodes, const ShellNumbering& numbering,
                  ShellMesh& mesh) {
  for (const MatchLink& link : matches.links) {
    Pairs pairs;
    if (link.pair.dimension == 2) add_pairs(link.found, numbering, mesh, pairs);
    for (const MatchedEdge& edge : link.found.edges)
      if (link.pair.dimension == 1) add_pairs(edge, nodes, numbering, mesh, pairs);
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    mesh.matches.push_back(
        {link.pair.dimension, {link.pair.first, link.pair.second}, link.found.motion, std::move(pairs)});
  }
  // A node off the geometry takes its partner off it too, and that one the next.
  for (std::size_t round = 0; round <= mesh.matches.size(); ++round) {
    bool any = false;
    for (const ShellMesh::Match& match : mesh.matches) any |= align_midsides(match.motion, match.nodes, mesh);
    if (!any) break;
  }
  for (std::size_t i = 0; i < mesh.matches.size(); ++i) {
    const ShellMesh::Match& match = mesh.matches[i];
    const MatchedPair& pair = matches.links[i].pair;
    for (const auto& [a, b] : match.nodes) {
      const double apart = (match.motion(mesh.points[a]) - mesh.points[b]).norm();
      if (apart <= matches.links[i].tolerance) continue;
      throw failure("match", fmt::format("`match` {}={} contradicts the other pairs: a node at {} lies {} mm "
                                         "from the image of its partner",
                                         name_of(pair, pair.first), name_of(pair, pair.second),
                                         place_text(mesh.points[b]), number_text(apart)));
    }
  }
}

}  // namespace quadrille
