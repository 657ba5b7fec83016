/// Fills the face's loops with triangles in space, makes three quads of each, and moves nodes to the surface;
/// then moves nodes off surfaces and edges together.

#include "mesher/shell/last_resort.hpp"

#include <Standard_Failure.hxx>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>

#include "geometry/base/side_key.hpp"
#include "mesher/faces/boundary_crossings.hpp"
#include "mesher/faces/face_chart.hpp"
#include "mesher/faces/loop_filling.hpp"
#include "mesher/mesh/quad_geometry.hpp"
#include "mesher/mesh/sides.hpp"
#include "mesher/quads/improve.hpp"

namespace quadrille {

namespace {

bool is_near(const FaceMesh& mesh, double reach) {
  return std::all_of(mesh.off.begin(), mesh.off.end(), [&](double off) { return off <= reach; });
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
      if (nodes_.left_out.contains({id_, coedge.edge})) continue;
      for (int k = 0; k < edge.segments(); ++k) {
        const int i = coedge.forward ? k : edge.segments() - k;
        if (mesh_.nodes.size() > first && mesh_.nodes.back() == edge.nodes[i]) continue;
        mesh_.nodes.push_back(edge.nodes[i]);
        add(nodes_.points[edge.nodes[i]], parametric_point(coedge, edge.parameters[i]));
      }
    }
    if (mesh_.nodes.size() > first + 1 && mesh_.nodes.back() == mesh_.nodes[first]) {
      mesh_.nodes.pop_back();
      mesh_.points.pop_back();
      mesh_.uv.pop_back();
    }
  }

  int add(const Vector3& point, const Vector2& uv) {
    mesh_.points.push_back(point);
    mesh_.uv.push_back(uv);
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
    mesh_.off.assign(mesh_.points.size(), 0);
    if (has_inverted_quads(mesh_)) mesh_.points = spanned;
    std::vector<char> fixed(mesh_.points.size(), 0);
    std::fill_n(fixed.begin(), mesh_.nodes.size(), 1);
    unfold_in_space(mesh_.quads, mesh_.points, fixed, std::numeric_limits<double>::infinity(), context_);
    if (face_.reversed)
      for (auto& quad : mesh_.quads) std::swap(quad[1], quad[3]);
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

/// Whether the quads of a mesh face as the surface does, or all alike: those in loops that cross do neither.
bool faces_one_way(const CadFace& face, const FaceMesh& mesh) {
  const FaceSurface surface(face);
  double outward = 0, all = 0;
  Vector3 sum = Vector3::Zero();
  for (const auto& quad : mesh.quads) {
    const Vector3 area = quad_area_vector(mesh.points, quad);
    outward += (face.reversed ? -1 : 1) * area.dot(surface.normal(mesh.uv[quad[2]]));
    all += area.norm();
    sum += area;
  }
  constexpr double mostly = 0.5, all_alike = 0.9;
  return outward > mostly * all || sum.norm() > all_alike * all;
}

/// The quads around a face as one mesh, and back.
class Surroundings {
 public:
  Surroundings(const CadShape& shape, FaceId face, BoundaryNodes& nodes, FaceMeshes& meshes)
      : shape_(shape), nodes_(nodes), meshes_(meshes) {
    faces_.insert(face);
    for (const EdgeId edge : shape.faces[face].edges())
      for (const FaceId other : shape.edges[edge].faces)
        if (meshes[other]) faces_.insert(other);
    quads_.points = nodes.points;
    for (const FaceId id : faces_) {
      const FaceMesh& mesh = *meshes[id];
      std::vector<int> numbers = mesh.nodes;
      for (std::size_t i = mesh.nodes.size(); i < mesh.points.size(); ++i) {
        numbers.push_back(static_cast<int>(quads_.points.size()));
        quads_.points.push_back(mesh.points[i]);
      }
      for (const auto& quad : mesh.quads) quads_.quads.push_back(with_numbers(quad, numbers));
    }
  }

  /// \return whether no quad is inverted any more.
  bool unfold(double reach, const ExecutionContext& context) {
    std::vector<char> fixed(quads_.points.size(), 0);
    for (const int node : nodes_.vertex_nodes)
      if (node >= 0) fixed[node] = 1;
    for (const FaceId id : meshes_.ids())
      if (meshes_[id] && !faces_.contains(id))
        for (const int node : meshes_[id]->nodes) fixed[node] = 1;
    unfold_in_space(quads_.quads, quads_.points, fixed, reach, context);
    return !has_inverted_quads(quads_);
  }

  /// Puts the moved nodes back, unless one is farther from its surface than the reach. \return whether it
  /// did.
  bool commit(double reach) {
    std::map<int, double> off;
    for (std::size_t i = 0; i < nodes_.points.size(); ++i) {
      const double distance = (quads_.points[i] - nodes_.points[i]).norm();
      if (distance > 0) off[static_cast<int>(i)] = distance;
    }
    FaceMeshes made(meshes_.size());
    std::size_t next = nodes_.points.size();
    for (const FaceId id : faces_) {
      FaceMesh& mesh = made[id].emplace(*meshes_[id]);
      const FaceSurface surface(shape_.faces[id]);
      for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        const std::size_t at = i < mesh.nodes.size() ? mesh.nodes[i] : next++;
        if (quads_.points[at] == mesh.points[i]) continue;
        mesh.points[i] = quads_.points[at];
        mesh.off.resize(mesh.points.size(), 0);
        if (i < mesh.nodes.size()) continue;
        mesh.off[i] = (surface.project(mesh.uv[i], mesh.points[i]).point - mesh.points[i]).norm();
        if (mesh.off[i] > reach) return false;
      }
    }
    for (const FaceId id : faces_) meshes_[id] = std::move(made[id]);
    for (auto& edge : nodes_.edges)
      edge.kept |=
          std::any_of(edge.nodes.begin(), edge.nodes.end(), [&](int node) { return off.contains(node); });
    for (const auto& [node, distance] : off) {
      nodes_.points[node] = quads_.points[node];
      nodes_.off[node] += distance;
    }
    return true;
  }

 private:
  const CadShape& shape_;
  BoundaryNodes& nodes_;
  FaceMeshes& meshes_;
  std::set<FaceId> faces_;
  QuadMesh quads_;  // the boundary nodes of the model, then the inner nodes of these faces
};

}  // namespace

FaceMesh mesh_off_surface(const CadShape& shape, const FaceProblem& problem, const BoundaryNodes& nodes,
                          const SizingField& field, double reach, bool inverted_too,
                          const MeshOptions& options, ExecutionContext& context) {
  const FaceId face = problem.face();
  std::optional<FaceMesh> last;
  const auto attempt = [&](const auto& make) {
    try {
      std::optional<FaceMesh> mesh = make();
      if (!mesh || !is_near(*mesh, reach)) return false;
      const bool is_valid = !has_inverted_quads(*mesh);
      if (is_valid || inverted_too) last = std::move(mesh);
      return is_valid;
    } catch (const Error& error) {
      if (error.kind() != Error::Kind::failure || error.subject() == ExecutionContext::time_subject) throw;
    } catch (const Standard_Failure&) {
      context.check();  // the surface cannot be evaluated somewhere
    }
    return false;
  };
  for (const ChartKind kind : {ChartKind::own, ChartKind::new_curves, ChartKind::view}) {
    const auto chart = [&]() -> std::optional<FaceChart> {
      try {
        FaceChart made = make_chart(shape, face, nodes, kind);
        if (!crossing_problem(face, shape, made.boundary, *made.surface)) return made;
      } catch (const FaceProblem&) {
        context.check();  // there is no such chart
      }
      return std::nullopt;
    }();
    if (!chart) continue;
    for (const bool pair : {true, false}) {
      const FaceRecipe recipe{.chart = kind,
                              .mapped = false,
                              .clean_up = false,
                              .pair = pair,
                              .leaves_surface = true,
                              .reach = reach,
                              .inverted_too = inverted_too};
      const auto make = [&] {
        return mesh_face(shape, face, *chart, nodes, field, options, recipe, context);
      };
      if (attempt([&] { return std::optional(make()); })) return std::move(*last);
    }
  }
  for (const bool flips : {true, false}) {
    const auto span = [&] {
      auto mesh = LoopMesher(shape, face, nodes, context).run(flips);
      if (mesh && !faces_one_way(shape.faces[face], *mesh)) mesh.reset();
      return mesh;
    };
    if (attempt(span)) return std::move(*last);
  }
  if (!last) throw FaceProblem(problem);
  return std::move(*last);
}

bool unfold_with_edges(const CadShape& shape, FaceId face, double reach, BoundaryNodes& nodes,
                       FaceMeshes& meshes, const ExecutionContext& context) {
  Surroundings around(shape, face, nodes, meshes);
  return around.unfold(reach, context) && around.commit(reach);
}

}  // namespace quadrille
