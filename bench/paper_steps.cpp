/// Based on: Giuliani & Krivodonova, Fast unstructured quadrilateral mesh generation (2018), sections 2.4
/// and 3.

#include "bench/paper_steps.hpp"

#include <algorithm>

#include "mesher/mesh/quad_geometry.hpp"
#include "mesher/mesh/sides.hpp"

namespace quadrille {

namespace {

template <class Element, class Visit>
void for_each_side(const std::vector<Element>& elements, Visit&& visit) {
  for (const Element& corners : elements) {
    for (std::size_t i = 0; i < corners.size(); ++i) visit(corners[i], corners[(i + 1) % corners.size()]);
  }
}

/// The ends of the sides that leave each node, one entry for each side of an element.
Rows<> ends_by_node(const QuadMesh& mesh) {
  return Rows<>(mesh.points.size(), [&](auto&& add) {
    for_each_side(mesh.quads, add);
    for_each_side(mesh.triangles, add);
  });
}

bool has_side(const Rows<>& ends, int from, int to) {
  return std::find(ends[from].begin(), ends[from].end(), to) != ends[from].end();
}

}  // namespace

int collapse_boundary_triangles(QuadMesh& mesh) {
  const Rows<> ends = ends_by_node(mesh);
  const Rows<Side> quads = corners_by_node(mesh.points.size(), mesh.quads);
  std::vector<char> moved(mesh.points.size(), 0);
  std::vector<int> in_triangles(mesh.points.size(), 0);
  for (const auto& corners : mesh.triangles) {
    for (int v : corners) ++in_triangles[v];
  }
  std::vector<std::size_t> gone;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& corners = mesh.triangles[t];
    int boundary = -1, count = 0;
    for (int i = 0; i < 3; ++i) {
      if (has_side(ends, corners[(i + 1) % 3], corners[i])) continue;
      boundary = i;
      ++count;
    }
    if (count != 1) continue;
    const int a = corners[boundary], b = corners[(boundary + 1) % 3];
    // At most one collapse at a node: the lists are those of the mesh before.
    const auto in_quad = [&](Side one, Side other) { return element_of(one) == element_of(other); };
    const bool clash = moved[a] || moved[b] ||
                       std::find_first_of(quads[b].begin(), quads[b].end(), quads[a].begin(), quads[a].end(),
                                          in_quad) != quads[b].end();
    if (clash || in_triangles[b] > 1) continue;
    for (const Side corner : quads[b]) mesh.quads[element_of(corner)][index_of(corner)] = a;
    mesh.points[a] = (mesh.points[a] + mesh.points[b]) / 2;
    moved[a] = moved[b] = 1;
    gone.push_back(t);
  }
  for (auto t = gone.rbegin(); t != gone.rend(); ++t) {
    mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(*t));
    if (!mesh.triangle_tags.empty())
      mesh.triangle_tags.erase(mesh.triangle_tags.begin() + static_cast<std::ptrdiff_t>(*t));
  }
  return static_cast<int>(gone.size());
}

int smooth_poor(QuadMesh& mesh, double q_limit, int sweeps) {
  const Rows<> ends = ends_by_node(mesh);
  std::vector<char> boundary(mesh.points.size(), 0), poor;
  const auto mark = [&](int from, int to) {
    if (!has_side(ends, to, from)) boundary[from] = boundary[to] = 1;
  };
  for_each_side(mesh.quads, mark);
  for_each_side(mesh.triangles, mark);
  int moves = 0;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    poor.assign(mesh.points.size(), 0);
    for (const auto& q : mesh.quads) {
      if (quad_q(mesh.points, q) >= q_limit) continue;
      for (int v : q) poor[v] = 1;
    }
    for (int v = 0; v < static_cast<int>(mesh.points.size()); ++v) {
      if (!poor[v] || boundary[v]) continue;
      Vector3 sum = Vector3::Zero();
      for (const int end : ends[v]) sum += mesh.points[end];
      mesh.points[v] = sum / static_cast<double>(ends[v].size());
      ++moves;
    }
  }
  return moves;
}

}  // namespace quadrille
