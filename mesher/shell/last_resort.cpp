/// Fills the face's loops with triangles in space, makes three quads of each, and moves nodes to the surface.

#include "mesher/shell/last_resort.hpp"

#include <Standard_Failure.hxx>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>

#include "geometry/base/side_key.hpp"
#include "mesher/faces/boundary_crossings.hpp"
#include "mesher/faces/face_chart.hpp"
#include "mesher/faces/loop_filling.hpp"
#include "mesher/mesh/quad_geometry.hpp"
#include "mesher/mesh/quality.hpp"
#include "mesher/quads/unfold_in_space.hpp"
#include "mesher/shell/remedies.hpp"

namespace quadrille {

namespace {

bool is_valid(const FaceMesh& mesh, double reach) {
  return std::all_of(mesh.off.begin(), mesh.off.end(), [&](double off) { return off <= reach; }) &&
         std::all_of(mesh.quads.begin(), mesh.quads.end(), [&](const std::array<int, 4>& q) {
           return quad_scaled_jacobian(mesh.points, q) > no_jacobian;
         });
}

/// Spans the loops of a face in space: every other boundary node is a corner of triangles, the nodes between
/// are the middles of their sides, and each triangle becomes three quads.
class LoopMesher {
 public:
  LoopMesher(const CadShape& shape, FaceId face, const BoundaryNodes& nodes, const ExecutionContext& context)
      : id_(face), face_(shape.faces[face]), nodes_(nodes), surface_(face_), context_(context) {}

  /// Empty if the loops cannot be spanned. \param flips see fill_loops()
  std::optional<FaceMesh> run(bool flips) {
    std::vector<std::vector<int>> corners;
    for (const CadWire& wire : face_.wires) {
      const int first = static_cast<int>(mesh_.points.size());
      add_loop(wire);
      const int count = static_cast<int>(mesh_.points.size()) - first;
      if (count == 0) continue;
      if (count % 2 != 0 || count < 4 || (count == 4 && face_.wires.size() > 1)) return std::nullopt;
      std::vector<int>& loop = corners.emplace_back();
      for (int k = 0; k < count; k += 2) {
        loop.push_back(first + k);
        const int next = first + (k + 2) % count;
        if (count > 4 && !middles_.emplace(key(first + k, next), first + k + 1).second) return std::nullopt;
      }
    }
    if (corners.empty()) return std::nullopt;
    if (mesh_.points.size() == 4) {
      mesh_.quads.push_back({0, 1, 2, 3});
    } else {
      for (const auto& triangle : fill_loops(mesh_.points, corners, flips)) split(triangle);
    }
    if (mesh_.quads.empty()) return std::nullopt;
    unfold();
    return std::move(mesh_);
  }

 private:
  /// Identifies sides by their end nodes, so that both sides of a seam or a bridge share a middle.
  std::uint64_t key(int a, int b) const { return side_key(mesh_.nodes[a], mesh_.nodes[b]); }

  void add_loop(const CadWire& wire) {
    const std::size_t first = mesh_.nodes.size();
    for (const Coedge& coedge : wire.coedges) {
      const BoundaryNodes::Edge& edge = nodes_.edges[coedge.edge];
      const auto [unused_first, unused_last] = nodes_.unused_by(id_, coedge.edge);
      const int first_node = unused_first, last_node = edge.segments() - unused_last;
      for (int k = 0; k < last_node - first_node; ++k) {
        const int i = coedge.forward ? first_node + k : last_node - k;
        if (mesh_.nodes.size() > first && mesh_.nodes.back() == edge.nodes[i]) continue;
        mesh_.nodes.push_back(edge.nodes[i]);
        mesh_.points.push_back(nodes_.points[edge.nodes[i]]);
        mesh_.uv.push_back(parametric_point(coedge, edge.parameters[i]));
        mesh_.off.push_back(0);
      }
    }
    if (mesh_.nodes.size() > first + 1 && mesh_.nodes.back() == mesh_.nodes[first]) {
      mesh_.nodes.pop_back();
      mesh_.points.pop_back();
      mesh_.uv.pop_back();
      mesh_.off.pop_back();
    }
  }

  int add(const Vector3& point, const Vector2& uv) {
    mesh_.points.push_back(point);
    mesh_.uv.push_back(uv);
    mesh_.off.push_back(0);
    return static_cast<int>(mesh_.points.size()) - 1;
  }

  int middle(int a, int b) {
    const auto [found, is_new] = middles_.emplace(key(a, b), -1);
    if (is_new) found->second = add(0.5 * (mesh_.points[a] + mesh_.points[b]), mesh_.uv[a]);
    return found->second;
  }

  void split(const std::array<int, 3>& triangle) {
    std::array<int, 3> middles{};
    Vector3 center = Vector3::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      middles[k] = middle(triangle[k], triangle[(k + 1) % 3]);
      center += mesh_.points[middles[k]] / 3;
    }
    const int node = add(center, mesh_.uv[triangle[0]]);
    for (std::size_t k = 0; k < 3; ++k)
      mesh_.quads.push_back({triangle[k], middles[k], node, middles[(k + 2) % 3]});
  }

  /// Moves the inner nodes to the surface where that keeps all quads valid, and measures how far they are.
  void unfold() {
    const std::vector<Vector3> spanned = mesh_.points;
    for (std::size_t i = mesh_.nodes.size(); i < mesh_.points.size(); ++i)
      mesh_.points[i] = surface_.project(mesh_.uv[i], spanned[i]).point;
    mesh_.pole.assign(mesh_.points.size(), 0);
    if (!is_valid(mesh_, 0)) mesh_.points = spanned;
    QuadMesh quads;
    quads.points = std::move(mesh_.points);
    quads.quads = std::move(mesh_.quads);
    std::vector<char> fixed(quads.points.size(), 0);
    std::fill_n(fixed.begin(), mesh_.nodes.size(), 1);
    unfold_in_space(quads, fixed, context_);
    mesh_.points = std::move(quads.points);
    mesh_.quads = std::move(quads.quads);
    mesh_.q_min = 1;
    for (auto& quad : mesh_.quads) {
      if (face_.reversed) std::swap(quad[1], quad[3]);
      mesh_.q_min = std::min(mesh_.q_min, quad_q(mesh_.points, quad));
    }
    for (std::size_t i = mesh_.nodes.size(); i < mesh_.points.size(); ++i)
      mesh_.off[i] = (surface_.project(mesh_.uv[i], mesh_.points[i]).point - mesh_.points[i]).norm();
  }

  FaceId id_;
  const CadFace& face_;
  const BoundaryNodes& nodes_;
  const FaceSurface surface_;
  const ExecutionContext& context_;
  FaceMesh mesh_;
  std::unordered_map<std::uint64_t, int> middles_;
};

}  // namespace

FaceMesh mesh_off_surface(const CadShape& shape, const FaceProblem& problem, const BoundaryNodes& nodes,
                          const SizingField& field, double reach, const MeshOptions& options,
                          ExecutionContext& context) {
  const FaceId face = problem.face();
  const auto attempt = [&](const auto& make) -> std::optional<FaceMesh> {
    try {
      std::optional<FaceMesh> mesh = make();
      if (mesh && is_valid(*mesh, reach)) return mesh;
    } catch (const Error& error) {
      if (error.kind() != Error::Kind::failure || error.subject() == ExecutionContext::time_subject) throw;
    } catch (const Standard_Failure&) {
      context.check();  // the surface cannot be evaluated somewhere
    }
    return std::nullopt;
  };
  bool crosses = false;
  for (const ChartKind kind : {ChartKind::own, ChartKind::new_curves, ChartKind::view}) {
    const auto chart = [&]() -> std::optional<FaceChart> {
      try {
        FaceChart made = make_chart(shape, face, nodes, kind);
        if (!crossing_problem(face, shape, made.boundary, *made.surface)) return made;
        crosses = true;
      } catch (const FaceProblem&) {
        context.check();  // there is no such chart
      }
      return std::nullopt;
    }();
    if (!chart) continue;
    for (const auto off : {FaceRecipe::Off::where_inverted, FaceRecipe::Off::as_triangles}) {
      const FaceRecipe recipe{.chart = kind, .mapped = false, .clean_up = false, .off = off};
      const auto make = [&] {
        return mesh_face(shape, face, *chart, nodes, field, options, recipe, context);
      };
      if (auto mesh = attempt([&] { return std::optional(make()); })) return std::move(*mesh);
    }
  }
  // Loops that cross enclose no area that a mesh could be right about, unless all of it is below the reach.
  if (crosses && longest_edge(shape, face) > reach) throw FaceProblem(problem);
  for (const bool flips : {true, false}) {
    if (auto mesh = attempt([&] { return LoopMesher(shape, face, nodes, context).run(flips); }))
      return std::move(*mesh);
  }
  throw FaceProblem(problem);
}

}  // namespace quadrille
