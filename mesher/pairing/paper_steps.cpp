/// Based on: Giuliani & Krivodonova, Fast unstructured quadrilateral mesh generation (2018), sections 2.4
/// and 3.

#include "mesher/pairing/paper_steps.hpp"

#include <algorithm>
#include <utility>

#include "mesher/mesh/quality.hpp"

namespace quadrille {

namespace {

/// Lists by node, in compressed rows.
class Rows {
 public:
  /// \param visit calls its argument with (node, item) for each entry; is called twice.
  template <class Visit>
  Rows(std::size_t nodes, Visit&& visit) : first_(nodes + 1, 0) {
    visit([this](int node, int) { ++first_[node + 1]; });
    for (std::size_t n = 1; n < first_.size(); ++n) first_[n] += first_[n - 1];
    items_.resize(first_.back());
    std::vector<int> place(first_.begin(), first_.end() - 1);
    visit([&](int node, int item) { items_[place[node]++] = item; });
  }
  const int* begin(int node) const { return items_.data() + first_[node]; }
  const int* end(int node) const { return items_.data() + first_[node + 1]; }

 private:
  std::vector<int> first_, items_;
};

template <class Element, class Visit>
void for_each_side(const std::vector<Element>& elements, Visit&& visit) {
  for (const Element& corners : elements) {
    for (std::size_t i = 0; i < corners.size(); ++i) visit(corners[i], corners[(i + 1) % corners.size()]);
  }
}

/// The ends of the sides that leave each node, one entry for each side of an element.
Rows ends_by_node(const QuadMesh& mesh) {
  return Rows(mesh.points.size(), [&](auto&& add) {
    for_each_side(mesh.quads, add);
    for_each_side(mesh.triangles, add);
  });
}

bool has_side(const Rows& ends, int from, int to) {
  return std::find(ends.begin(from), ends.end(from), to) != ends.end(from);
}

/// The quads of each node.
Rows quads_by_node(const QuadMesh& mesh) {
  return Rows(mesh.points.size(), [&](auto&& add) {
    for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
      for (int v : mesh.quads[q]) add(v, static_cast<int>(q));
    }
  });
}

}  // namespace

int collapse_boundary_triangles(QuadMesh& mesh) {
  const Rows ends = ends_by_node(mesh), quads = quads_by_node(mesh);
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
    const bool clash = moved[a] || moved[b] || std::any_of(quads.begin(b), quads.end(b), [&](int q) {
                         return std::find(quads.begin(a), quads.end(a), q) != quads.end(a);
                       });
    if (clash || in_triangles[b] > 1) continue;
    for (const int* q = quads.begin(b); q != quads.end(b); ++q) {
      std::replace(mesh.quads[*q].begin(), mesh.quads[*q].end(), b, a);
    }
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
  const Rows ends = ends_by_node(mesh);
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
      if (quad_q(mesh.points[q[0]], mesh.points[q[1]], mesh.points[q[2]], mesh.points[q[3]]) >= q_limit)
        continue;
      for (int v : q) poor[v] = 1;
    }
    for (int v = 0; v < static_cast<int>(mesh.points.size()); ++v) {
      if (!poor[v] || boundary[v]) continue;
      Vector3 sum = Vector3::Zero();
      for (const int* end = ends.begin(v); end != ends.end(v); ++end) sum += mesh.points[*end];
      mesh.points[v] = sum / static_cast<double>(ends.end(v) - ends.begin(v));
      ++moves;
    }
  }
  return moves;
}

}  // namespace quadrille
