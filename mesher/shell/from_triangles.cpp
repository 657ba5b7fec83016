#include "mesher/shell/from_triangles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "geometry/base/error.hpp"
#include "mesher/mesh/renumbering.hpp"
#include "mesher/mesh/surface_cut.hpp"
#include "mesher/pairing/recombine.hpp"
#include "mesher/quads/triangulated_surface.hpp"

namespace quadrille {

namespace {

/// A mesh while its triangles become quads.
struct Work {
  TriangleMesh mesh;                      ///< tags are faces
  std::vector<int> node;                  ///< node of the input -> point of the mesh; -1 = of no triangle
  std::vector<std::array<int, 2>> sides;  ///< that stay
};

double least_sine(const Vector3& a, const Vector3& b, const Vector3& c) {
  const double area = (b - a).cross(c - a).norm();
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return longest > 0 ? area / longest : 0;
}

/// The two triangles of a quad whose lesser one is the better, on the side that the quad lies on.
std::array<std::array<int, 3>, 2> halves(const std::array<int, 4>& quad, const std::vector<Vector3>& points) {
  const auto& [a, b, c, d] = quad;
  const Vector3 normal = (points[c] - points[a]).cross(points[d] - points[b]);
  const auto value = [&](int i, int j, int k) {
    const bool turned = (points[j] - points[i]).cross(points[k] - points[i]).dot(normal) < 0;
    return (turned ? -1 : 1) * least_sine(points[i], points[j], points[k]);
  };
  const double along_ac = std::min(value(a, b, c), value(a, c, d));
  const double along_bd = std::min(value(a, b, d), value(b, c, d));
  if (along_ac >= along_bd) return {{{a, b, c}, {a, c, d}}};
  return {{{a, b, d}, {b, c, d}}};
}

void check_places(const std::vector<Vector3>& points) {
  const std::vector<int> first = coincident_points(points, 0);
  for (int v = 0; v < static_cast<int>(points.size()); ++v) {
    const Vector3& p = points[v];
    if (first[v] != v)
      throw failure(fmt::format("point {}", v),
                    fmt::format("the points {} and {} lie on one place, {} {} {}: join them with `merge` 0",
                                first[v], v, p.x(), p.y(), p.z()));
  }
}

/// Triangles without area leave cracks and folds.
void check_shapes(const TriangleMesh& mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    if (least_sine(mesh.points[a], mesh.points[b], mesh.points[c]) <= 1e-14)
      throw failure(
          fmt::format("triangle {}", t),
          fmt::format("triangle {} has no area: its corners are the points {}, {} and {}", t, a, b, c));
  }
}

int face_of(const std::vector<int>& faces, std::size_t element) {
  return element < faces.size() ? faces[element] : 0;
}

/// Puts the triangles into an order in which neighbors are near each other in memory, which pays for itself
/// many times over in what follows: Gmsh lists triangles as they came to be.
void order(Work& work, const ExecutionContext& context) {
  constexpr std::size_t fit_the_caches = 1 << 14;
  if (work.mesh.triangles.size() < fit_the_caches) return;
  RenumberedMesh ordered = order_by_place(work.mesh, context);
  std::vector<int> now(work.mesh.points.size(), -1);
  for (std::size_t v = 0; v < ordered.old_point.size(); ++v) now[ordered.old_point[v]] = static_cast<int>(v);
  work.mesh = std::move(ordered.mesh);
  for (int& point : work.node) point = now[point];
}

/// Nodes merged, quads cut in two, triangles turned.
Work prepare(const ShellMesh& input, double merge, std::vector<std::string>& notes,
             const ExecutionContext& context) {
  Work work;
  work.mesh.points = input.points;
  if (merge >= 0) {
    work.node = coincident_points(input.points, merge);
  } else {
    check_places(input.points);
    work.node.resize(input.points.size());
    std::iota(work.node.begin(), work.node.end(), 0);
  }
  std::size_t lost = 0;
  const auto add = [&](std::array<int, 3> triangle, int face) {
    for (int& v : triangle) v = work.node[v];
    if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) {
      ++lost;
      return;
    }
    work.mesh.triangles.push_back(triangle);
    work.mesh.tags.push_back(face);
  };
  for (std::size_t t = 0; t < input.triangles.size(); ++t)
    add(input.triangles[t], face_of(input.triangle_faces, t));
  for (std::size_t q = 0; q < input.quads.size(); ++q)
    for (const auto& half : halves(input.quads[q], input.points)) add(half, face_of(input.quad_faces, q));
  std::size_t merged = 0;
  for (std::size_t v = 0; v < work.node.size(); ++v) merged += work.node[v] != static_cast<int>(v);
  if (merged > 0) notes.push_back(fmt::format("{} nodes were merged with others", merged));
  if (lost > 0) notes.push_back(fmt::format("{} triangles lost their area by that and are left out", lost));
  if (work.mesh.triangles.empty()) throw failure("", "no triangle is left");
  check_shapes(work.mesh);
  const int turned = orient_alike(work.mesh);
  if (turned > 0)
    notes.push_back(fmt::format("{} triangles were turned to agree with their neighbors", turned));
  if (input.order == 2)
    notes.push_back("the mesh was of second order: the quads are of first order, on the corner nodes");
  order(work, context);
  for (const ShellMesh::Segment& segment : input.segments) {
    const int a = work.node[segment.nodes[0]], b = work.node[segment.nodes[1]];
    if (a >= 0 && b >= 0 && a != b) work.sides.push_back({a, b});
  }
  return work;
}

/// Which groups of nodes have all nodes of a face: such a group follows the face's quads.
class NodeGroups {
 public:
  NodeGroups(const ShellMesh& input, const Work& work) : work_(work), groups_of_(work.mesh.points.size()) {
    std::map<int, std::vector<int>> of_vertex;
    for (std::size_t g = 0; g < input.groups.size(); ++g) {
      if (input.groups[g].dimension != 0) continue;
      for (const int vertex : input.groups[g].entities) of_vertex[vertex].push_back(static_cast<int>(g));
    }
    for (const ShellMesh::Corner& corner : input.corners) {
      if (work.node[corner.node] < 0) continue;
      std::vector<int>& groups = groups_of_[work.node[corner.node]];
      const std::vector<int>& more = of_vertex[corner.vertex];
      groups.insert(groups.end(), more.begin(), more.end());
      std::sort(groups.begin(), groups.end());
    }
    find_covering();
  }

  /// Groups that have all nodes of a face, ascending.
  const std::vector<int>& covering(int face) const { return covering_.at(face); }

  /// Points that must stay: corners of the input, but for nodes that have no more to tell than their face.
  std::vector<char> kept_points(const ShellMesh& input) const {
    std::vector<char> kept(work_.mesh.points.size(), 0);
    for (const ShellMesh::Corner& corner : input.corners)
      if (work_.node[corner.node] >= 0) kept[work_.node[corner.node]] = 1;
    std::vector<char> tells_more(kept.size(), 0);
    for (std::size_t t = 0; t < work_.mesh.triangles.size(); ++t)
      for (const int v : work_.mesh.triangles[t])
        tells_more[v] |= groups_of_[v].empty() || groups_of_[v] != covering(work_.mesh.tags[t]);
    for (std::size_t v = 0; v < kept.size(); ++v) kept[v] &= tells_more[v];
    return kept;
  }

 private:
  void find_covering() {
    for (std::size_t t = 0; t < work_.mesh.triangles.size(); ++t) {
      for (const int v : work_.mesh.triangles[t]) {
        const auto [found, is_new] = covering_.try_emplace(work_.mesh.tags[t], groups_of_[v]);
        if (is_new || found->second.empty()) continue;
        std::erase_if(found->second, [&](int group) {
          return !std::binary_search(groups_of_[v].begin(), groups_of_[v].end(), group);
        });
      }
    }
  }

  const Work& work_;
  std::vector<std::vector<int>> groups_of_;   // by point
  std::map<int, std::vector<int>> covering_;  // by face
};

/// The points that elements use, numbered in that order, with the copies that cuts made joined again.
class ResultPoints {
 public:
  /// \param renumbered point of the cut surface -> of the quads, -1 = gone.
  ResultPoints(const QuadMesh& quads, const CutSurface& surface, const std::vector<int>& renumbered)
      : quads_(quads), joined_(quads.points.size()), number_(quads.points.size(), -1) {
    std::iota(joined_.begin(), joined_.end(), 0);
    place_.assign(surface.original.size(), -1);
    for (std::size_t v = 0; v < renumbered.size(); ++v) {
      if (renumbered[v] < 0) continue;
      int& first = place_[surface.original[v]];
      if (first < 0) first = renumbered[v];
      joined_[renumbered[v]] = first;
    }
  }

  template <class Element>
  Element operator()(Element element, std::vector<Vector3>& points) {
    for (int& v : element) {
      v = joined_[v];
      if (number_[v] < 0) {
        number_[v] = static_cast<int>(points.size());
        points.push_back(quads_.points[v]);
      }
      v = number_[v];
    }
    return element;
  }

  /// Where a point of the triangulation is now; -1 = gone.
  int of_original(int point) const { return place_[point] < 0 ? -1 : number_[place_[point]]; }

 private:
  const QuadMesh& quads_;
  std::vector<int> joined_, number_, place_;
};

/// The groups, with the nodes that faces have now in those that have all of a face's.
void follow_faces(const NodeGroups& groups, ShellMesh& shell) {
  int last = 0;
  std::vector<char> is_corner(shell.points.size(), 0);
  for (const ShellMesh::Corner& corner : shell.corners) {
    is_corner[corner.node] = 1;
    last = std::max(last, corner.vertex);
  }
  for (const ShellMesh::Group& group : shell.groups)
    if (group.dimension == 0 && !group.entities.empty()) last = std::max(last, group.entities.back());
  std::map<std::vector<int>, int> vertex_of;  // by groups
  const auto add = [&](const auto& elements, const std::vector<int>& faces) {
    for (std::size_t e = 0; e < elements.size(); ++e) {
      const std::vector<int>& covering = groups.covering(faces[e]);
      if (covering.empty()) continue;
      const auto [vertex, is_new] = vertex_of.try_emplace(covering, last + 1);
      if (is_new) {
        ++last;
        for (const int group : covering) shell.groups[group].entities.push_back(last);
      }
      for (const int node : elements[e]) {
        if (is_corner[node]) continue;
        is_corner[node] = 1;
        shell.corners.push_back({node, vertex->second});
      }
    }
  };
  add(shell.quads, shell.quad_faces);
  add(shell.triangles, shell.triangle_faces);
}

/// Segments and corners where their nodes still exist, each once.
void keep_sides_and_corners(const ShellMesh& input, const Work& work, const ResultPoints& points,
                            ShellMesh& shell) {
  const auto now = [&](int node) { return work.node[node] < 0 ? -1 : points.of_original(work.node[node]); };
  for (const ShellMesh::Segment& segment : input.segments) {
    const int a = now(segment.nodes[0]), b = now(segment.nodes[1]);
    if (a >= 0 && b >= 0 && a != b) shell.segments.push_back({{a, b}, -1, segment.edge});
  }
  std::set<std::pair<int, int>> known;
  for (const ShellMesh::Corner& corner : input.corners) {
    const int node = now(corner.node);
    if (node >= 0 && known.insert({node, corner.vertex}).second)
      shell.corners.push_back({node, corner.vertex});
  }
}

}  // namespace

ShellMesh quads_from_triangles(const ShellMesh& input, const FromTrianglesOptions& options,
                               std::vector<std::string>& notes, ExecutionContext& context) {
  Work work = prepare(input, options.merge, notes, context);
  const NodeGroups node_groups(input, work);
  work.mesh.fixed = node_groups.kept_points(input);
  context.check();
  const CutSurface surface = cut_surface(work.mesh, options.feature_angle, work.sides);
  std::vector<int> face_of_piece(surface.pieces);
  for (std::size_t t = 0; t < work.mesh.triangles.size(); ++t)
    face_of_piece[surface.mesh.tags[t]] = work.mesh.tags[t];
  QuadMesh quads = recombine(surface.mesh, options.recombine, context);
  std::vector<int> renumbered(surface.mesh.points.size());
  std::iota(renumbered.begin(), renumbered.end(), 0);
  if (options.improve) {
    const StageTimer timer(context, Stage::improve);
    context.report(Stage::improve, 0);
    ImproveReport improved;
    quads = improve_on(surface.mesh, quads, {}, renumbered, improved, context);
  }
  ShellMesh shell;
  shell.groups = input.groups;
  ResultPoints points(quads, surface, renumbered);
  for (const auto& quad : quads.quads) shell.quads.push_back(points(quad, shell.points));
  for (const auto& triangle : quads.triangles) shell.triangles.push_back(points(triangle, shell.points));
  for (const int piece : quads.quad_tags) shell.quad_faces.push_back(face_of_piece[piece]);
  for (const int piece : quads.triangle_tags) shell.triangle_faces.push_back(face_of_piece[piece]);
  keep_sides_and_corners(input, work, points, shell);
  follow_faces(node_groups, shell);
  const bool has_faces = std::any_of(face_of_piece.begin(), face_of_piece.end(),
                                     [&](int face) { return face != face_of_piece.front(); }) ||
                         std::any_of(input.groups.begin(), input.groups.end(),
                                     [](const ShellMesh::Group& group) { return group.dimension == 2; });
  if (!has_faces && surface.pieces > 1) {
    shell.quad_faces = quads.quad_tags;
    shell.triangle_faces = quads.triangle_tags;
    for (std::vector<int>* faces : {&shell.quad_faces, &shell.triangle_faces})
      for (int& face : *faces) ++face;
  }
  return shell;
}

}  // namespace quadrille
