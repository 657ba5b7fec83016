/// Joins the meshes of faces along smooth edges, improves the quads beside these, and gives each quad back to
/// the face that its center lies on.

#include "mesher/shell/crossed_edges.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <unordered_map>
#include <utility>

#include "geometry/base/error.hpp"
#include "geometry/base/side_key.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/mesh/sides.hpp"
#include "mesher/quads/criteria_patch.hpp"
#include "mesher/quads/mending.hpp"
#include "mesher/shell/composite_surface.hpp"

namespace quadrille {

namespace {

/// Normals beside a smooth edge differ by at most 10 degrees.
constexpr double smooth_cosine = 0.985;

/// A side of a quad, from corner to corner.
struct FaceSideUse {
  FaceId face;
  int from = -1, to = -1;  ///< points of the face's mesh
};

/// Sides by the boundary nodes at their ends, in the direction of the quad. Without a face where there are
/// several.
using DirectedSides = std::map<std::pair<int, int>, FaceSideUse>;

using Sets = boost::disjoint_sets_with_storage<>;

/// Faces that may be treated as one, and the sides along the edges between them.
struct Candidates {
  std::vector<CompositeFace> composites;
  DirectedSides sides;
};

class CandidateFinder {
 public:
  CandidateFinder(const CadShape& shape, const EdgeFlags& kept, const BoundaryNodes& nodes,
                  const FaceMeshes& faces, const ExecutionContext& context)
      : shape_(shape),
        kept_(kept),
        nodes_(nodes),
        faces_(faces),
        context_(context),
        surfaces_(faces.size()) {}

  Candidates run() && {
    const std::vector<char> touched = nodes_of_poor_quads();
    std::vector<EdgeId> candidates;
    for (const EdgeId id : nodes_.edges.ids())
      if (is_eligible(id) && is_touched(id, touched) && is_smooth(id)) candidates.push_back(id);
    DirectedSides sides = find_sides(candidates);
    std::erase_if(candidates, [&](EdgeId id) { return !has_sides(id, sides); });
    Sets sets(faces_.size());
    for (const EdgeId id : candidates)
      sets.union_set(shape_.edges[id].faces.front().index(), shape_.edges[id].faces.back().index());
    std::vector<CompositeFace> of_sets(faces_.size());
    for (const EdgeId id : candidates)
      of_sets[sets.find_set(shape_.edges[id].faces.front().index())].edges.push_back(id);
    for (const FaceId face : faces_.ids()) {
      CompositeFace& composite = of_sets[sets.find_set(face.index())];
      if (composite.edges.empty()) continue;
      composite.members.push_back(face);
      const auto& own = composite.own_surfaces.emplace_back(faces_[face]->surface);
      composite.surfaces.push_back(own ? own : surface_of(face));
    }
    std::erase_if(of_sets, [](const CompositeFace& composite) { return composite.edges.empty(); });
    std::sort(of_sets.begin(), of_sets.end(), [](const CompositeFace& a, const CompositeFace& b) {
      return a.members.front() < b.members.front();
    });
    return {std::move(of_sets), std::move(sides)};
  }

 private:
  std::vector<char> nodes_of_poor_quads() const {
    std::vector<char> touched(nodes_.points.size(), 0);
    SparseCheck check(context_, 256);
    for (const auto& mesh : faces_) {
      if (!mesh) continue;
      for (const auto& quad : mesh->quads) {
        check();
        const bool is_at_boundary = std::any_of(
            quad.begin(), quad.end(), [&](int p) { return p < static_cast<int>(mesh->nodes.size()); });
        if (!is_at_boundary || !(measure_objective(mesh->points, quad).value > outside_objective)) continue;
        for (const int p : quad)
          if (p < static_cast<int>(mesh->nodes.size())) touched[mesh->nodes[p]] = 1;
      }
    }
    return touched;
  }

  bool is_eligible(EdgeId id) const {
    const CadEdge& cad = shape_.edges[id];
    const BoundaryNodes::Edge& edge = nodes_.edges[id];
    if (kept_[id] || edge.kept || edge.divided || edge.borrows || edge.segments() < 1) return false;
    if (cad.faces.size() != 2 || cad.degenerate) return false;
    for (const FaceId face : cad.faces)
      if (!faces_[face] || !faces_[face]->off.empty() || nodes_.left_out.contains({face, id})) return false;
    for (int k = 1; k < edge.segments(); ++k)
      if (edges_at_node_[edge.nodes[k]] != 1) return false;
    return edge.nodes.front() != edge.nodes.back() || edge.segments() > 2;
  }

  bool is_touched(EdgeId id, const std::vector<char>& touched) const {
    const auto& nodes = nodes_.edges[id].nodes;
    return std::any_of(nodes.begin(), nodes.end(), [&](int node) { return touched[node] != 0; });
  }

  const std::shared_ptr<const FaceSurface>& surface_of(FaceId face) {
    if (!surfaces_[face]) surfaces_[face] = std::make_shared<const FaceSurface>(shape_.faces[face]);
    return surfaces_[face];
  }

  bool is_smooth(EdgeId id) {
    const CadEdge& cad = shape_.edges[id];
    const FaceId a = cad.faces.front(), b = cad.faces.back();
    if (a == b) return true;  // a seam
    constexpr int places_on_edge = 5;
    for (int i = 0; i < places_on_edge; ++i) {
      const double t = cad.first + (cad.last - cad.first) * (i + 0.5) / places_on_edge;
      const Vector3 first = normal_at(a, id, t), second = normal_at(b, id, t);
      if (!(first.dot(second) > smooth_cosine)) return false;
    }
    return true;
  }

  /// The normal of a face at a place of one of its edges, as the model turns the face.
  Vector3 normal_at(FaceId face, EdgeId edge, double t) {
    for (const CadWire& wire : shape_.faces[face].wires)
      for (const Coedge& coedge : wire.coedges)
        if (coedge.edge == edge && !coedge.parametric_curve.IsNull())
          return (shape_.faces[face].reversed ? -1 : 1) *
                 surface_of(face)->normal(parametric_point(coedge, t));
    return Vector3::Zero();
  }

  DirectedSides find_sides(const std::vector<EdgeId>& edges) const {
    DirectedSides sides;
    std::vector<char> is_on(nodes_.points.size(), 0);
    FaceFlags is_member(faces_.size(), 0);
    for (const EdgeId id : edges) {
      for (const int node : nodes_.edges[id].nodes) is_on[node] = 1;
      for (const FaceId face : shape_.edges[id].faces) is_member[face] = 1;
    }
    for (const FaceId face : faces_.ids()) {
      if (!is_member[face]) continue;
      const FaceMesh& mesh = *faces_[face];
      const int fixed = static_cast<int>(mesh.nodes.size());
      for (const auto& quad : mesh.quads) {
        for (int k = 0; k < 4; ++k) {
          const int from = quad[k], to = quad[(k + 1) & 3];
          if (from >= fixed || to >= fixed || !is_on[mesh.nodes[from]] || !is_on[mesh.nodes[to]]) continue;
          const auto [use, is_new] =
              sides.try_emplace({mesh.nodes[from], mesh.nodes[to]}, FaceSideUse{face, from, to});
          if (!is_new) use->second.face = FaceId();
        }
      }
    }
    return sides;
  }

  /// Whether each segment of an edge is a side of one quad of each of its faces, in opposite directions.
  bool has_sides(EdgeId id, const DirectedSides& sides) const {
    const auto& nodes = nodes_.edges[id].nodes;
    const auto& faces = shape_.edges[id].faces;
    for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
      for (const auto side : {sides.find({nodes[k], nodes[k + 1]}), sides.find({nodes[k + 1], nodes[k]})})
        if (side == sides.end() || (side->second.face != faces[0] && side->second.face != faces[1]))
          return false;
    }
    return true;
  }

  const CadShape& shape_;
  const EdgeFlags& kept_;
  const BoundaryNodes& nodes_;
  const FaceMeshes& faces_;
  const ExecutionContext& context_;
  IdVector<FaceId, std::shared_ptr<const FaceSurface>> surfaces_;
  const std::vector<char> edges_at_node_ = nodes_.edges_at_nodes();  // (nodes)
};

/// (points) 1 = on a side that only one quad has. Empty if a side or a point is used more often than on a
/// manifold.
std::optional<std::vector<char>> boundary_points(const std::vector<std::array<int, 4>>& quads, int count) {
  std::vector<char> starts(count, 0), fixed(count, 0);
  bool is_manifold = true;
  const auto start = [&](Side side) { return quads[element_of(side)][index_of(side)]; };
  const auto look_at = [&](int low, int high, std::span<const Side> sides) {
    if (low == high && sides.size() == 1) return;
    if (sides.size() == 1) {
      is_manifold = is_manifold && starts[start(sides[0])]++ == 0;
      fixed[low] = fixed[high] = 1;
    } else {
      is_manifold = is_manifold && sides.size() == 2 && start(sides[0]) != start(sides[1]);
    }
  };
  for_each_shared_side(count, no_check, look_at, quads);
  if (!is_manifold) return std::nullopt;
  return fixed;
}

/// Gives a composite and its mesh a surface. \param faces with the meshes of the members
void add_surface(const FaceMeshes& faces, CompositeFace& composite, FaceMesh& mesh) {
  TriangleMesh triangles;
  triangles.points = mesh.points;
  std::vector<int> members;
  std::vector<std::array<Vector2, 3>> uvs;
  std::size_t at = 0;
  for (std::size_t m = 0; m < composite.members.size(); ++m) {
    const FaceMesh& part = *faces[composite.members[m]];
    for (const auto& quad : part.quads) {
      const auto& joined = mesh.quads[at++];
      for (const auto& corners : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
        const auto triangle = static_cast<double>(triangles.triangles.size());
        auto& uv = uvs.emplace_back();
        std::array<int, 3> places{};
        for (int k = 0; k < 3; ++k) {
          const int p = quad[corners[k]], next = quad[corners[(k + 1) % 3]];
          places[k] = joined[corners[k]];
          uv[k] = part.uv[part.pole[p] ? next : p];
          if (mesh.uv[places[k]].x() < 0) mesh.uv[places[k]] = {triangle, 0};
        }
        triangles.triangles.push_back(places);
        members.push_back(static_cast<int>(m));
      }
    }
  }
  const auto surface = std::make_shared<const CompositeSurface>(std::move(triangles), std::move(members),
                                                                std::move(uvs), composite.surfaces);
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    Vector2 uv = mesh.uv[p];
    surface->move(uv, mesh.points[p], mesh.normals.emplace_back());
  }
  mesh.surface = composite.surface = surface;
}

/// Empty if the faces do not make a surface that is a manifold. \param edges_at_node see
/// BoundaryNodes::edges_at_nodes()
std::optional<FaceMesh> join(const BoundaryNodes& boundary_nodes, const std::vector<char>& edges_at_node,
                             const DirectedSides& sides, const FaceMeshes& faces, CompositeFace& composite) {
  IdVector<FaceId, int> offset(faces.size(), -1);
  int count = 0;
  for (const FaceId face : composite.members) {
    offset[face] = count;
    count += static_cast<int>(faces[face]->points.size());
  }
  Sets sets(count);
  for (const EdgeId id : composite.edges) {
    const auto& nodes = boundary_nodes.edges[id].nodes;
    for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
      const FaceSideUse &one = sides.at({nodes[k], nodes[k + 1]}),
                        &other = sides.at({nodes[k + 1], nodes[k]});
      sets.union_set(offset[one.face] + one.from, offset[other.face] + other.to);
      sets.union_set(offset[one.face] + one.to, offset[other.face] + other.from);
    }
  }
  const auto joined = [&](FaceId face, int p) { return static_cast<int>(sets.find_set(offset[face] + p)); };
  std::vector<std::array<int, 4>> quads;
  for (const FaceId face : composite.members)
    for (auto quad : faces[face]->quads) {
      for (int& p : quad) p = joined(face, p);
      quads.push_back(quad);
    }
  std::optional<std::vector<char>> fixed = boundary_points(quads, count);
  if (!fixed) return std::nullopt;
  // CAD vertices keep their nodes.
  for (const FaceId face : composite.members) {
    const std::vector<int>& nodes = faces[face]->nodes;
    for (int p = 0; p < std::ssize(nodes); ++p)
      if (edges_at_node[nodes[p]] == 2) (*fixed)[joined(face, p)] = 1;
  }
  FaceMesh mesh;
  std::vector<int> index(count, -1);
  for (const bool boundary : {true, false}) {
    for (const FaceId face : composite.members) {
      const FaceMesh& part = *faces[face];
      for (int p = 0; p < static_cast<int>(part.points.size()); ++p) {
        const int at = joined(face, p);
        if ((*fixed)[at] != boundary || index[at] >= 0) continue;
        if (boundary && p >= static_cast<int>(part.nodes.size())) return std::nullopt;
        index[at] = static_cast<int>(mesh.points.size());
        mesh.points.push_back(part.points[p]);
        mesh.pole.push_back(boundary ? part.pole[p] : 0);
        if (boundary) mesh.nodes.push_back(part.nodes[p]);
      }
    }
  }
  for (const auto& quad : quads) mesh.quads.push_back(with_numbers(quad, index));
  mesh.uv.assign(mesh.points.size(), Vector2(-1, 0));
  try {
    add_surface(faces, composite, mesh);
  } catch (const Error& error) {
    if (error.kind() != Error::Kind::failure) throw;
    return std::nullopt;  // quads with two sides in common make triangles that are not manifold
  }
  return mesh;
}

/// The mesh of a composite, and which of its quads belong to which face.
struct Division {
  FaceMesh mesh;
  std::vector<Vector2> centers;                        // of the quads
  std::vector<std::vector<std::size_t>> quads_of;      // (members)
  std::vector<char> is_shared;                         // (points) 1 = quads of several members use it
  std::vector<int> node;                               // (points) see number_nodes()
  std::unordered_map<std::uint64_t, Vector3> middles;  // of all sides between boundary nodes
};

void divide(const CompositeFace& composite, Division& division) {
  const FaceMesh& mesh = division.mesh;
  division.quads_of.resize(composite.members.size());
  division.is_shared.assign(mesh.points.size(), 0);
  std::vector<int> member(mesh.points.size(), -1);
  for (const auto& quad : mesh.quads) {
    Vector3 center = Vector3::Zero();
    for (const int p : quad) center += 0.25 * mesh.points[p];
    Vector2& uv = division.centers.emplace_back(mesh.uv[quad[0]]);
    composite.surface->approach(uv, center);
    const int m = composite.surface->member(uv);
    division.quads_of[m].push_back(division.centers.size() - 1);
    for (const int p : quad) {
      division.is_shared[p] |= member[p] >= 0 && member[p] != m;
      member[p] = m;
    }
  }
}

/// (points) the boundary node of each point that is on the boundary, that several faces use, or that lies
/// where a node of an edge was; -1 for the others.
void number_nodes(const CompositeFace& composite, BoundaryNodes& nodes, Division& division) {
  const FaceMesh& mesh = division.mesh;
  std::map<std::array<double, 3>, int> known;
  const auto key_of = [](const Vector3& p) { return std::array{p.x(), p.y(), p.z()}; };
  for (const EdgeId id : composite.edges)
    for (const int node : nodes.edges[id].nodes) known.emplace(key_of(nodes.points[node]), node);
  std::vector<int>& result = division.node;
  result = mesh.nodes;
  result.reserve(mesh.points.size());
  for (int p = static_cast<int>(mesh.nodes.size()); p < static_cast<int>(mesh.points.size()); ++p) {
    const auto found = known.find(key_of(mesh.points[p]));
    result.push_back(found != known.end() ? found->second : -1);
    if (result.back() >= 0 || !division.is_shared[p]) continue;
    result.back() = static_cast<int>(nodes.points.size());
    nodes.points.push_back(mesh.points[p]);
  }
}

void find_middles(const CompositeFace& composite, Division& division) {
  const FaceMesh& mesh = division.mesh;
  for (const auto& quad : mesh.quads) {
    for (int k = 0; k < 4; ++k) {
      const int p = quad[k], next = quad[(k + 1) & 3], a = division.node[p], b = division.node[next];
      if (a < 0 || b < 0) continue;
      Vector2 uv = mesh.uv[p];
      division.middles.try_emplace(
          side_key(a, b), composite.surface->nearest(uv, 0.5 * (mesh.points[p] + mesh.points[next])));
    }
  }
}

void give_back(const CompositeFace& composite, const Division& division, FaceMeshes& faces) {
  const FaceMesh& mesh = division.mesh;
  const std::vector<int>& node = division.node;
  const int fixed = static_cast<int>(mesh.nodes.size());
  std::vector<int> index(mesh.points.size(), -1);  // of points in the face at hand
  for (std::size_t m = 0; m < composite.members.size(); ++m) {
    FaceMesh part;
    part.surface = composite.own_surfaces[m];
    const auto add = [&](int p, const Vector2& near) {
      index[p] = static_cast<int>(part.points.size());
      part.points.push_back(mesh.points[p]);
      part.pole.push_back(p < fixed ? mesh.pole[p] : 0);
      if (node[p] >= 0) part.nodes.push_back(node[p]);
      const bool is_own = composite.surface->member(mesh.uv[p]) == static_cast<int>(m);
      Vector2& uv =
          part.uv.emplace_back(composite.surface->member_uv(is_own ? mesh.uv[p] : near, mesh.points[p]));
      composite.surfaces[m]->nearest(uv, mesh.points[p]);
    };
    for (const bool boundary : {true, false}) {
      for (const std::size_t q : division.quads_of[m]) {
        for (const int p : mesh.quads[q])
          if (index[p] < 0 && (node[p] >= 0) == boundary) add(p, division.centers[q]);
      }
    }
    for (const std::size_t q : division.quads_of[m]) part.quads.push_back(with_numbers(mesh.quads[q], index));
    for (const std::size_t q : division.quads_of[m])
      for (const int p : mesh.quads[q]) index[p] = -1;
    faces[composite.members[m]] = std::move(part);
  }
}

}  // namespace

std::vector<CompositeFace> join_smooth_faces(const CadShape& shape, const EdgeFlags& kept,
                                             const BoundaryNodes& nodes, FaceMeshes& faces,
                                             const ExecutionContext& context) {
  Candidates found = CandidateFinder(shape, kept, nodes, faces, context).run();
  const std::vector<char> edges_at_node = nodes.edges_at_nodes();
  oneapi::tbb::parallel_for(std::size_t{0}, found.composites.size(), [&](std::size_t i) {
    context.check();
    CompositeFace& composite = found.composites[i];
    std::optional<FaceMesh> mesh = join(nodes, edges_at_node, found.sides, faces, composite);
    if (!mesh) return;
    for (const FaceId face : composite.members) faces[face].reset();
    faces[composite.members.front()] = std::move(mesh);
  });
  std::erase_if(found.composites, [](const CompositeFace& composite) { return !composite.surface; });
  return std::move(found.composites);
}

std::vector<EdgeId> split_faces(const std::vector<CompositeFace>& composites, BoundaryNodes& nodes,
                                FaceMeshes& faces, const ExecutionContext& context) {
  std::vector<Division> divisions(composites.size());
  const auto for_each = [&](auto&& work) {
    oneapi::tbb::parallel_for(std::size_t{0}, composites.size(), [&](std::size_t i) {
      context.check();
      work(composites[i], divisions[i]);
    });
  };
  for_each([&](const CompositeFace& composite, Division& division) {
    division.mesh = std::move(*faces[composite.members.front()]);
    divide(composite, division);
  });
  // New boundary nodes are numbered in the order of the composites.
  for (std::size_t i = 0; i < composites.size(); ++i) number_nodes(composites[i], nodes, divisions[i]);
  for_each([&](const CompositeFace& composite, Division& division) {
    find_middles(composite, division);
    give_back(composite, division, faces);
  });
  std::vector<EdgeId> suppressed;
  for (std::size_t i = 0; i < composites.size(); ++i) {
    for (const EdgeId id : composites[i].edges) {
      BoundaryNodes::Edge& edge = nodes.edges[id];
      bool is_whole = true;
      for (int k = 0; is_whole && k < edge.segments(); ++k)
        is_whole = divisions[i].middles.contains(side_key(edge.nodes[k], edge.nodes[k + 1]));
      if (is_whole) continue;
      edge.nodes.clear();
      edge.parameters.clear();
      suppressed.push_back(id);
    }
    nodes.middles.insert(divisions[i].middles.begin(), divisions[i].middles.end());
  }
  std::sort(suppressed.begin(), suppressed.end());
  return suppressed;
}

}  // namespace quadrille
