#include "mesher/assembly.hpp"

#include <algorithm>
#include <unordered_map>

#include <fmt/format.h>

#include "geometry/edge_curve.hpp"
#include "geometry/face_surface.hpp"
#include "mesher/second_order.hpp"
#include "mesher/side_key.hpp"

namespace quadrille {

namespace {

/// Moves the midside nodes inside one face where curved boundary sides make second-order elements invalid.
class MidsideRepair {
 public:
  /// \param first_quad the face's elements are those from here to the end of mesh.midsides
  /// \param first_inner index of the first midside node inside a face; `parameters` are theirs
  MidsideRepair(ShellMesh& mesh, const FaceSurface& surface, std::size_t first_quad, std::size_t first_inner,
                std::vector<Vector2>& parameters)
      : mesh_(mesh),
        surface_(surface),
        first_quad_(first_quad),
        first_inner_(first_inner),
        parameters_(parameters) {}

  void run() {
    std::vector<std::size_t> bad;
    for (std::size_t quad = first_quad_; quad < mesh_.midsides.size(); ++quad) {
      if (jacobian_bound(mesh_, quad) <= 0) bad.push_back(quad);
    }
    if (bad.empty()) return;
    for (std::size_t quad = first_quad_; quad < mesh_.midsides.size(); ++quad) {
      for (const int node : mesh_.midsides[quad]) users_[node].push_back(quad);
    }
    constexpr int sweeps = 4;
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      for (const std::size_t quad : bad) repair(quad);
    }
  }

 private:
  void repair(std::size_t quad) {
    for (int k = 0; k < 4 && jacobian_bound(mesh_, quad) <= 0; ++k) {
      const int node = mesh_.midsides[quad][k];
      if (node >= static_cast<int>(first_inner_))
        search(node, mesh_.quads[quad][k], mesh_.quads[quad][(k + 1) % 4]);
    }
  }

  double worst(int node) const {
    double result = 1;
    for (const std::size_t quad : users_.at(node)) result = std::min(result, jacobian_bound(mesh_, quad));
    return result;
  }

  /// Compass search in the tangent plane for the best of the node's elements at their worst.
  void search(int node, int a, int b) {
    Vector2& uv = parameters_[node - first_inner_];
    const Vector3 along = mesh_.points[b] - mesh_.points[a];
    const Vector3 across = surface_.normal(uv).cross(along);
    double best = worst(node);
    constexpr int halvings = 5;
    double step = 0.25;
    for (int i = 0; i < halvings; ++i, step *= 0.5) {
      for (const Vector3& direction : {across, Vector3(-across), along, Vector3(-along)}) {
        const Vector3 old = mesh_.points[node];
        Vector2 moved = uv;
        mesh_.points[node] = surface_.project(moved, old + step * direction).point;
        const double now = worst(node);
        if (now > best) {
          best = now;
          uv = moved;
        } else {
          mesh_.points[node] = old;
        }
      }
    }
  }

  ShellMesh& mesh_;
  const FaceSurface& surface_;
  std::size_t first_quad_, first_inner_;
  std::vector<Vector2>& parameters_;
  std::unordered_map<int, std::vector<std::size_t>> users_;
};

class Assembler {
 public:
  Assembler(const CadShape& shape, const BoundaryNodes& nodes,
            const std::vector<std::optional<FaceMesh>>& faces)
      : shape_(shape), nodes_(nodes), faces_(faces), renumbered_(nodes.points.size(), -1) {}

  ShellMesh run(int order) {
    number_boundary();
    for (std::size_t face = 0; face < faces_.size(); ++face) {
      if (faces_[face]) add_face(static_cast<int>(face));
    }
    add_segments();
    if (order == 2) add_midsides();
    return std::move(mesh_);
  }

 private:
  void number_boundary() {
    std::vector<char> used(nodes_.points.size(), 0);
    for (const auto& face : faces_) {
      if (!face) continue;
      const int fixed = static_cast<int>(face->nodes.size());
      for (const auto& quad : face->quads) {
        for (const int corner : quad) {
          if (corner < fixed) used[face->nodes[corner]] = 1;
        }
      }
    }
    for (std::size_t i = 0; i < used.size(); ++i) {
      if (!used[i]) continue;
      renumbered_[i] = static_cast<int>(mesh_.points.size());
      mesh_.points.push_back(nodes_.points[i]);
    }
    std::vector<char> listed(nodes_.points.size(), 0);
    for (std::size_t vertex = 0; vertex < nodes_.vertex_nodes.size(); ++vertex) {
      const int node = nodes_.vertex_nodes[vertex];
      // The ends of edges that became points share a node: it is the first one's.
      if (node >= 0 && renumbered_[node] >= 0 && !listed[node]) {
        listed[node] = 1;
        mesh_.corners.push_back({renumbered_[node], static_cast<int>(vertex) + 1});
      }
    }
  }

  void add_face(int index) {
    const FaceMesh& face = *faces_[index];
    const int fixed = static_cast<int>(face.nodes.size());
    std::vector<int>& global = globals_.emplace_back(face.points.size(), -1);
    for (int i = 0; i < fixed; ++i) global[i] = renumbered_[face.nodes[i]];
    for (std::size_t i = fixed; i < face.points.size(); ++i) {
      global[i] = static_cast<int>(mesh_.points.size());
      mesh_.points.push_back(face.points[i]);
    }
    for (const auto& quad : face.quads) {
      mesh_.quads.push_back({global[quad[0]], global[quad[1]], global[quad[2]], global[quad[3]]});
      mesh_.quad_faces.push_back(index + 1);
    }
  }

  void add_segments() {
    for (std::size_t i = 0; i < nodes_.edges.size(); ++i) {
      const auto& edge = nodes_.edges[i];
      if (edge.borrowed) continue;
      for (int k = 0; k < edge.segments(); ++k) {
        const int a = renumbered_[edge.nodes[k]], b = renumbered_[edge.nodes[k + 1]];
        if (a < 0 || b < 0) continue;
        mesh_.segments.push_back({{a, b}, -1, shape_.edges[i].number});
        segment_origins_.push_back({static_cast<int>(i), k});
      }
    }
  }

  /// Midside nodes of CAD edges on their curves, of other sides on the surface of their face.
  void add_midsides() {
    mesh_.order = 2;
    std::unordered_map<std::uint64_t, int> middles;
    middles.reserve(2 * mesh_.quads.size() + 16);
    for (std::size_t s = 0; s < mesh_.segments.size(); ++s) {
      auto& segment = mesh_.segments[s];
      const auto [edge, k] = segment_origins_[s];
      const EdgeCurve curve(shape_.edges[edge]);
      const auto& t = nodes_.edges[edge].parameters;
      segment.middle = static_cast<int>(mesh_.points.size());
      mesh_.points.push_back(curve_middle(curve, t[k], t[k + 1]));
      middles.emplace(side_key(segment.nodes[0], segment.nodes[1]), segment.middle);
    }
    const std::size_t first_inner = mesh_.points.size();
    std::vector<Vector2> parameters;  // of the midside nodes inside faces
    std::size_t face_rank = 0, first_quad = 0;
    for (std::size_t index = 0; index < faces_.size(); ++index) {
      if (!faces_[index]) continue;
      const FaceMesh& face = *faces_[index];
      const auto surface_of_face =
          face.surface ? face.surface : std::make_shared<const FaceSurface>(shape_.faces[index]);
      const FaceSurface& surface = *surface_of_face;
      const std::vector<int>& global = globals_[face_rank++];
      for (const auto& quad : face.quads) {
        std::array<int, 4>& midsides = mesh_.midsides.emplace_back();
        for (int k = 0; k < 4; ++k) {
          const int a = quad[k], b = quad[(k + 1) % 4];
          const auto [it, is_new] = middles.emplace(side_key(global[a], global[b]), -1);
          if (is_new) {
            it->second = static_cast<int>(mesh_.points.size());
            mesh_.points.push_back(surface_middle(surface, face, a, b, parameters.emplace_back()));
          }
          midsides[k] = it->second;
        }
      }
      MidsideRepair(mesh_, surface, first_quad, first_inner, parameters).run();
      first_quad = mesh_.midsides.size();
    }
  }

  /// The point of a curve as far from both ends: half the arc for the short pieces here.
  static Vector3 curve_middle(const EdgeCurve& curve, double a, double b) {
    const Vector3 from = curve.point(a), to = curve.point(b);
    double low = a, high = b;
    constexpr int bisections = 30;
    for (int i = 0; i < bisections; ++i) {
      const double t = 0.5 * (low + high);
      Vector3 p = curve.point(t);
      const double difference = (p - from).norm() - (p - to).norm();
      if (std::abs(difference) < 1e-9 * (to - from).norm()) return p;
      (difference < 0 ? low : high) = t;
    }
    return curve.point(0.5 * (low + high));
  }

  static Vector3 surface_middle(const FaceSurface& surface, const FaceMesh& face, int a, int b, Vector2& uv) {
    const Vector3 target = 0.5 * (face.points[a] + face.points[b]);
    uv = 0.5 * (face.uv[a] + face.uv[b]);
    if (face.pole[a]) uv = face.uv[b];
    if (face.pole[b]) uv = face.uv[a];
    return surface.project(uv, target).point;
  }

  const CadShape& shape_;
  const BoundaryNodes& nodes_;
  const std::vector<std::optional<FaceMesh>>& faces_;
  std::vector<int> renumbered_;
  std::vector<std::vector<int>> globals_;
  std::vector<std::pair<int, int>> segment_origins_;
  ShellMesh mesh_;
};

/// Says where second-order elements stay invalid: between curves that touch each other (a cusp) no position
/// of the midside nodes mends them.
void note_folded(ShellMesh& mesh) {
  std::vector<int> folded(mesh.faces.size(), 0);
  for (std::size_t i = 0; i < mesh.quads.size(); ++i)
    folded[mesh.quad_faces[i] - 1] += jacobian_bound(mesh, i) <= 0;
  for (std::size_t face = 0; face < folded.size(); ++face) {
    if (folded[face] == 0) continue;
    std::string& note = mesh.faces[face].note;
    if (!note.empty()) note += "; ";
    note += fmt::format("{} second-order elements fold: choose a smaller size on this face", folded[face]);
  }
}

}  // namespace

ShellMesh assemble(const CadShape& shape, const BoundaryNodes& nodes,
                   const std::vector<std::optional<FaceMesh>>& faces,
                   std::vector<ShellMesh::FaceStatus> statuses, const MeshOptions& options,
                   ExecutionContext& context) {
  const StageTimer timer(context, "assemble");
  ShellMesh mesh = Assembler(shape, nodes, faces).run(options.order);
  mesh.faces = std::move(statuses);
  if (mesh.order == 2) note_folded(mesh);
  return mesh;
}

}  // namespace quadrille
