/// Cuts the surface at folds, pairs its triangles, subdivides, and carries groups, segments and corners over.

#include "mesher/shell/from_triangles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "geometry/base/error.hpp"
#include "geometry/base/place_text.hpp"
#include "mesher/mesh/sides.hpp"
#include "mesher/mesh/surface_cut.hpp"
#include "mesher/pairing/recombine.hpp"
#include "mesher/quads/triangulated_surface.hpp"
#include "mesher/shell/triangle_input.hpp"

namespace quadrille {

namespace {

/// Finds the groups of nodes that have all nodes of a face. Such a group gets the nodes of the face's quads.
class NodeGroups {
 public:
  NodeGroups(const ShellMesh& input, const TriangleInput& work)
      : work_(work), groups_of_(work.mesh.points.size()) {
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
    for (std::size_t t = 0; t < work.mesh.triangles.size(); ++t) {
      for (const int v : work.mesh.triangles[t]) {
        const auto [found, is_new] = covering_.try_emplace(work.mesh.tags[t], groups_of_[v]);
        if (is_new || found->second.empty()) continue;
        std::erase_if(found->second, [&](int group) {
          return !std::binary_search(groups_of_[v].begin(), groups_of_[v].end(), group);
        });
      }
    }
  }

  /// The groups that have all nodes of a face, ascending.
  const std::vector<int>& covering(int face) const { return covering_.at(face); }

  /// Points that must stay: corners of the input, unless their groups are those that cover their faces.
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
  const TriangleInput& work_;
  std::vector<std::vector<int>> groups_of_;   // by point
  std::map<int, std::vector<int>> covering_;  // by face
};

/// Numbers the points by their first use in an element, and joins the copies that cuts made.
class ResultPoints {
 public:
  /// \param renumbered point of the cut surface -> point of the quads, -1 = removed.
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

  /// The number of a point of the triangulation in the result; -1 = removed.
  int of_original(int point) const { return place_[point] < 0 ? -1 : number_[place_[point]]; }

 private:
  const QuadMesh& quads_;
  std::vector<int> joined_, number_, place_;
};

/// Adds the nodes that faces have now to the groups that had all nodes of a face.
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

/// Keeps the segments and corners whose nodes still exist; each corner once.
void keep_sides_and_corners(const ShellMesh& input, const TriangleInput& work, const ResultPoints& points,
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

/// Throws Error (failure) unless the quads are as tight as the triangles: pairing moves no node on a rim.
void check_rim(const TriangleMesh& triangles, const ShellMesh& shell) {
  const Rim before = rim_of(triangles.points, triangles.triangles);
  const Rim after = rim_of(shell.points, shell.quads, shell.triangles);
  constexpr double rounding = 1e-6;
  if (after.sides != before.sides || std::abs(after.length - before.length) > rounding * before.length)
    throw failure(
        "", fmt::format("the quads have {} open sides, {} mm long, where the triangles have {}, {} mm "
                        "long",
                        after.sides, number_text(after.length), before.sides, number_text(before.length)));
}

}  // namespace

ShellMesh quads_from_triangles(const ShellMesh& input, const FromTrianglesOptions& options,
                               std::vector<std::string>& notes, ExecutionContext& context) {
  TriangleInput work = triangle_input(input, options.merge, 0, notes, context);
  if (input.order == 2)
    notes.emplace_back("the mesh was of second order: the quads are of first order, on the corner nodes");
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
    quads = improve_on(surface.mesh, quads, {}, renumbered, context);
  }
  ShellMesh shell;
  shell.groups = input.groups;
  ResultPoints points(quads, surface, renumbered);
  for (const auto& quad : quads.quads) shell.quads.push_back(points(quad, shell.points));
  for (const auto& triangle : quads.triangles) shell.triangles.push_back(points(triangle, shell.points));
  check_rim(work.mesh, shell);
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
