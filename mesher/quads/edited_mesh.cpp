/// Traces outlines of patches, prices the valences of fillings, and writes accepted quads back.

#include "mesher/quads/edited_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "mesher/mesh/quad_geometry.hpp"
#include "mesher/mesh/sides.hpp"

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

std::vector<QuadTopology::Quad> EditedMesh::corners_of(std::span<const int> quads) const {
  std::vector<Quad> result;
  result.reserve(quads.size());
  for (const int quad : quads) result.push_back(topology_.quad(quad));
  return result;
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

bool EditedMesh::trace(std::span<const int> quads, Outline& outline) {
  traced_.resize(topology_.size(), 0);
  met_.resize(node_count(), 0);
  ++traces_;
  for (const int quad : quads) traced_[quad] = traces_;
  const auto is_outer = [&](int side) {
    const int beyond = topology_.beyond(side);
    return beyond < 0 || traced_[beyond] != traces_;
  };
  const auto is_new = [&](int node) { return std::exchange(met_[node], traces_) != traces_; };
  int start = -1;
  std::size_t outer = 0;
  for (const int quad : quads)
    for (int side = 4 * quad; side < 4 * quad + 4; ++side)
      if (is_outer(side)) {
        start = side;
        ++outer;
      }
  if (start < 0) return false;
  int side = start;
  do {
    if (!is_new(topology_.origin(side))) return false;
    outline.ring.push_back(topology_.origin(side));
    outline.sides.push_back(side);
    int& uses = outline.uses.emplace_back(1);  // at the next node
    for (side = QuadTopology::next(side); !is_outer(side); ++uses)
      side = QuadTopology::next(topology_.twin(side));
  } while (side != start);
  if (outline.ring.size() != outer) return false;
  std::rotate(outline.uses.begin(), outline.uses.end() - 1, outline.uses.end());
  for (const int quad : quads)
    for (const int node : topology_.quad(quad)) {
      if (!is_new(node)) continue;
      if (!inner(node)) return false;
      outline.inside.push_back(node);
    }
  return quads.size() == outer / 2 - 1 + outline.inside.size();
}

double EditedMesh::find_costs(const Outline& outline, FillingCosts& costs) const {
  double cost = 0;
  for (int i = 0; i < outline.length(); ++i) {
    const int node = outline.ring[i], inside = outline.uses[i];
    const int beyond = topology_.valence(outline.sides[i]) - inside;
    const bool is_inner = inner(node);
    for (int uses = 1; uses <= PatchTemplate::max_uses; ++uses)
      costs.uses[i][uses] = is_inner ? inner_cost(beyond + uses) : node_cost(node, beyond + uses);
    cost += costs.uses[i][std::min(inside, PatchTemplate::max_uses)];
  }
  for (const int node : outline.inside) cost += node_cost(node, topology_.valence(topology_.side_of(node)));
  return cost;
}

Filling EditedMesh::laid(const Outline& outline, const PatchTemplate& filling) const {
  Filling result{filling, {}, {}, Vector3::Zero()};
  const int n = outline.length();
  auto& x = result.x;
  Vector3 center = Vector3::Zero();
  for (int i = 0; i < n; ++i) {
    result.nodes[i] = outline.ring[i];
    x[i] = point(outline.ring[i]);
    center += x[i] / n;
    result.normal += mesh_.normals[outline.ring[i]];
  }
  for (int i = 0; i < filling.interior; ++i) {
    result.nodes[n + i] = i < outline.inside_count() ? outline.inside[i] : -1;
    x[n + i] = center;
  }
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
    if (topology_.alive(quad)) result.mesh.quads.push_back(with_numbers(topology_.quad(quad), number));
  }
  for (const auto& triangle : mesh_.mesh.triangles)
    result.mesh.triangles.push_back(with_numbers(triangle, number));
  context_.check();
  mesh_ = std::move(result);
  return kept;
}

}  // namespace quadrille
