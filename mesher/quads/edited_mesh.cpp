/// Traces outlines of patches, prices the valences of fillings, and writes accepted quads back.

#include "mesher/quads/edited_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesher/mesh/quad_geometry.hpp"

namespace quadrille {

EditedMesh::EditedMesh(SurfaceMesh& mesh, const ExecutionContext& context)
    : mesh_(mesh),
      context_(context),
      topology_(mesh.mesh.quads, static_cast<int>(mesh.mesh.points.size()), context),
      on_triangle_(mesh.mesh.points.size(), 0) {
  for (const auto& triangle : mesh_.mesh.triangles)
    for (const int node : triangle) on_triangle_[node] = 1;
  angles_.assign(mesh_.mesh.points.size(), 0);
  std::vector<int> fans(mesh_.mesh.points.size(), 0);
  SparseCheck check(context_);
  for (int side = 0; side < 4 * topology_.size(); ++side) {
    check();
    const int node = topology_.origin(side);
    if (inner(node)) continue;  // its angle is never used
    const int before = topology_.origin(QuadTopology::previous(side));
    const Vector3 forth = point(topology_.end(side)) - point(node), back = point(before) - point(node);
    const double angle = std::atan2(forth.cross(back).dot(normal(node)), forth.dot(back));
    angles_[node] += angle < 0 ? angle + 2 * std::numbers::pi : angle;
    if (topology_.twin(side) < 0) ++fans[node];
  }
  for (std::size_t i = 0; i < angles_.size(); ++i)
    if (fans[i] > 1) angles_[i] /= fans[i];
  if (mesh_.boundary_angles.empty()) return;
  for (std::size_t i = 0; i < angles_.size(); ++i)
    if (fans[i] == 1 && mesh_.boundary_angles[i] > 0) angles_[i] = mesh_.boundary_angles[i];
}

double EditedMesh::worst(std::span<const Quad> quads) const {
  double least = 1;
  for (const Quad& quad : quads) least = std::min(least, mesh_.quality(quad));
  return least;
}

bool EditedMesh::too_long(std::span<const Quad> before, std::span<const Quad> quads) const {
  constexpr double max_over_mean = 1.9;
  const auto side = [&](const Quad& q, int k) { return (point(q[k]) - point(q[(k + 1) & 3])).norm(); };
  double sum = 0, most = 0, longest = 0;
  for (const Quad& q : before)
    for (int k = 0; k < 4; ++k) {
      sum += side(q, k);
      most = std::max(most, side(q, k));
    }
  for (const Quad& q : quads)
    for (int k = 0; k < 4; ++k) longest = std::max(longest, side(q, k));
  return longest > std::max(most, max_over_mean * sum / (4 * static_cast<double>(before.size())));
}

bool EditedMesh::trace(const SmallPatch& patch, Outline& outline) const {
  int start = -1, outer = 0;
  for (int i = 0; i < patch.count; ++i)
    for (int k = 0; k < 4; ++k) {
      const int twin = topology_.twin(4 * patch.quads[i] + k);
      if (twin >= 0 && patch.contains(twin >> 2)) continue;
      start = 4 * patch.quads[i] + k;
      ++outer;
    }
  if (start < 0 || outer > PatchTemplate::max_sides) return false;
  int side = start;
  do {
    if (outline.length == outer) return false;
    outline.sides[outline.length] = side;
    outline.ring[outline.length++] = topology_.origin(side);
    int& uses = outline.uses[outline.length == outer ? 0 : outline.length];  // at the next node
    uses = 1;
    side = QuadTopology::next(side);
    for (int twin = topology_.twin(side); twin >= 0 && patch.contains(twin >> 2);
         twin = topology_.twin(side)) {
      side = QuadTopology::next(twin);
      ++uses;
    }
  } while (side != start);
  if (outline.length != outer) return false;
  const auto ring_end = outline.ring.begin() + outline.length;
  for (auto at = outline.ring.begin(); at != ring_end; ++at)
    if (std::find(at + 1, ring_end, *at) != ring_end) return false;
  for (int i = 0; i < patch.count; ++i)
    for (const int node : topology_.quad(patch.quads[i])) {
      if (std::find(outline.ring.begin(), ring_end, node) != ring_end) continue;
      const auto inside_end = outline.inside.begin() + outline.inside_count;
      if (std::find(outline.inside.begin(), inside_end, node) != inside_end) continue;
      if (outline.inside_count == 4 || !inner(node)) return false;
      outline.inside[outline.inside_count++] = node;
    }
  return patch.count == outline.length / 2 - 1 + outline.inside_count;
}

double EditedMesh::find_costs(const Outline& outline, FillingCosts& costs) const {
  double cost = 0;
  for (int i = 0; i < outline.length; ++i) {
    const int node = outline.ring[i], inside = outline.uses[i];
    const int beyond = topology_.valence(outline.sides[i]) - inside;
    const bool is_inner = inner(node);
    for (int uses = 1; uses <= PatchTemplate::max_uses; ++uses)
      costs.uses[i][uses] = is_inner ? inner_cost(beyond + uses) : node_cost(node, beyond + uses);
    cost += costs.uses[i][std::min(inside, PatchTemplate::max_uses)];
  }
  for (int i = 0; i < outline.inside_count; ++i)
    cost += node_cost(outline.inside[i], topology_.valence(topology_.side_of(outline.inside[i])));
  return cost;
}

Filling EditedMesh::laid(const Outline& outline, const PatchTemplate& filling) const {
  Filling result{filling, {}, {}, Vector3::Zero()};
  const int n = outline.length;
  auto& x = result.x;
  Vector3 center = Vector3::Zero();
  for (int i = 0; i < n; ++i) {
    result.nodes[i] = outline.ring[i];
    x[i] = point(outline.ring[i]);
    center += x[i] / n;
    result.normal += mesh_.normals[outline.ring[i]];
  }
  for (int i = 0; i < filling.interior; ++i) x[n + i] = center;
  for (int sweep = 0; sweep < 6; ++sweep)
    for (int i = n; i < n + filling.interior; ++i) {
      Vector3 sum = Vector3::Zero();
      int neighbors = 0;
      for (int k = 0; k < filling.quads; ++k)
        for (int j = 0; j < 4; ++j)
          if (filling.corners[k][j] == i) {
            sum += x[filling.corners[k][(j + 1) & 3]];
            ++neighbors;
          }
      x[i] = sum / neighbors;
    }
  return result;
}

double Filling::worst() const {
  double least = 1;
  for (int k = 0; k < filling.quads; ++k) {
    const auto& c = filling.corners[k];
    least = std::min(least, folded_scaled_jacobian(x[c[0]], x[c[1]], x[c[2]], x[c[3]], normal));
  }
  return least;
}

int EditedMesh::add_node_like(int donor) {
  const int node = topology_.add_node();
  mesh_.add(mesh_.place_of(donor), false);
  if (!mesh_.boundary_angles.empty()) mesh_.boundary_angles.push_back(0);
  on_triangle_.push_back(0);
  angles_.push_back(0);
  return node;
}

std::vector<int> EditedMesh::write_back() {
  std::vector<int> number(mesh_.mesh.points.size(), -1), kept;
  SurfaceMesh result;
  SparseCheck check(context_);
  const auto keep = [&](int node) {
    check();
    number[node] = static_cast<int>(kept.size());
    kept.push_back(node);
    result.add(mesh_.place_of(node), mesh_.fixed[node] != 0);
    if (!mesh_.boundary_angles.empty()) result.boundary_angles.push_back(mesh_.boundary_angles[node]);
  };
  for (int node = 0; node < node_count(); ++node)
    if (mesh_.fixed[node]) keep(node);
  for (int node = 0; node < node_count(); ++node)
    if (!mesh_.fixed[node] && (on_triangle_[node] || topology_.side_of(node) >= 0)) keep(node);
  for (int quad = 0; quad < topology_.size(); ++quad) {
    check();
    if (!topology_.alive(quad)) continue;
    const Quad& q = topology_.quad(quad);
    result.mesh.quads.push_back({number[q[0]], number[q[1]], number[q[2]], number[q[3]]});
  }
  for (auto& triangle : mesh_.mesh.triangles)
    result.mesh.triangles.push_back({number[triangle[0]], number[triangle[1]], number[triangle[2]]});
  context_.check();
  mesh_ = std::move(result);
  return kept;
}

}  // namespace quadrille
