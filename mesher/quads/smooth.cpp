/// Smoothing of quad meshes on a surface.
/// Based on: Field, Laplacian smoothing and Delaunay triangulations (1988), made "smart" by the acceptance
/// test of Freitag, On combining Laplacian and optimization-based mesh smoothing techniques (1997): sweeps of
/// averages first, then the worst elements node by node, by a compass search on the least scaled Jacobian
/// around the node. Untangling maximizes the negative part of the corner areas, as in Freitag & Plassmann
/// (2000).

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include "mesher/mesh/quad_geometry.hpp"
#include "mesher/mesh/sides.hpp"
#include "mesher/quads/criteria_patch.hpp"
#include "mesher/quads/improve.hpp"
#include "mesher/quads/tangent_plan.hpp"

namespace quadrille {
namespace {

/// A move that leaves every element above this scaled Jacobian is accepted even if the least one falls.
constexpr double good_jacobian = 0.6;
/// Weight of the corner opposite in a quad, beside 1 for the neighbors.
constexpr double opposite_weight = 0.5;
/// Factor on a sweep's moves.
constexpr double overshoot = 1.3;
/// Moves below this fraction of the mean side around the node are not worth evaluating the surface for.
constexpr double still_share = 4e-3;
/// A place on the surface this near to the judged place (as a share of the mean side) is not judged again.
constexpr double near_share = 0.01;
/// A side shorter than this share of the mean side around the node counts against the node's place.
constexpr double short_side = 0.5;
/// Elements with a scaled Jacobian below this (q < 0.5) are worked on node by node.
constexpr double poor_jacobian = 0.7071;
/// Elements below this (q < 0.33) are worked on longer; they are few.
constexpr double bad_jacobian = 0.5;

/// A surface mesh whose nodes move one after the other, with the quality of the quads around them.
struct SmoothedMesh {
  SmoothedMesh(SurfaceMesh& surface_mesh, const MeshSurface& on, const ExecutionContext& within)
      : nodes(surface_mesh),
        points(surface_mesh.mesh.points),
        quads(surface_mesh.mesh.quads),
        normals(surface_mesh.normals),
        surface(on),
        context(within),
        free(points.size()),
        quality(quads.size()) {
    for (std::size_t i = 0; i < free.size(); ++i) free[i] = surface_mesh.fixed[i] ? 0 : 1;
    // The nodes of remaining triangles stay, since only quads are measured here.
    for (const auto& triangle : surface_mesh.mesh.triangles)
      for (const int node : triangle) free[node] = 0;
    context.check();
    corners = corners_by_node(points.size(), quads, SparseCheck(context, 512));
    context.check();
    measure_all();
  }

  /// Checks for cancellation in loops over nodes or elements.
  void check(int i) const {
    if (i % 256 == 0) context.check();
  }

  /// Calls visit(node) for each free node, in index order. \return whether a call returned true.
  template <class Visit>
  bool visit_free(Visit&& visit) {
    bool any = false;
    for (int node = 0; node < static_cast<int>(points.size()); ++node) {
      check(node);
      if (free[node] && visit(node)) any = true;
    }
    return any;
  }

  /// Measures all quads exactly, since sweeps judge them in tangent planes.
  void measure_all() {
    for (int i = 0; i < static_cast<int>(quads.size()); ++i) {
      check(i);
      quality[i] = nodes.quality(quads[i]);
    }
  }

  double least_round(int node) const {
    double least = 1;
    for (const Side corner : corners[node]) least = std::min(least, quality[element_of(corner)]);
    return least;
  }

  /// The other corners of a quad around a node, counter-clockwise from the node.
  struct Others {
    const Vector3 &next, &opposite, &previous;
  };
  Others beside(Side corner) const {
    const auto& q = quads[element_of(corner)];
    const int k = index_of(corner);
    return {points[q[(k + 1) & 3]], points[q[(k + 2) & 3]], points[q[(k + 3) & 3]]};
  }

  /// Least scaled Jacobian around the node if it were at `p`.
  double least_at(int node, const Vector3& p, const Vector3& normal) const {
    double least = 1;
    for (const Side corner : corners[node]) {
      const auto [b, c, d] = beside(corner);
      least = std::min(least, folded_scaled_jacobian(p, b, c, d, normal));
    }
    return least;
  }

  double mean_side(int node) const {
    double sum = 0;
    for (const Side corner : corners[node]) sum += (beside(corner).next - points[node]).norm();
    return sum / static_cast<double>(std::max<std::size_t>(corners[node].size(), 1));
  }

  /// The mean of the neighbors, in the tangent plane of the node.
  Vector3 middle_of(int node) const {
    Vector3 sum = Vector3::Zero();
    for (const Side corner : corners[node]) sum += beside(corner).next;
    const Vector3 shift = sum / static_cast<double>(corners[node].size()) - points[node];
    return points[node] + shift - normals[node].dot(shift) * normals[node];
  }

  /// Marks the nodes of the quads around a node.
  void mark_around(int node, std::vector<char>& marks) const {
    for (const Side corner : corners[node])
      for (const int other : quads[element_of(corner)]) marks[other] = 1;
  }

  SurfacePlace moved(int node, const Vector3& target) const { return nodes.moved(surface, node, target); }
  void put(int node, const SurfacePlace& place) {
    nodes.put(node, place);
    for (const Side corner : corners[node])
      quality[element_of(corner)] = nodes.quality(quads[element_of(corner)]);
  }

  SurfaceMesh& nodes;
  std::vector<Vector3>& points;
  const std::vector<std::array<int, 4>>& quads;
  std::vector<Vector3>& normals;
  const MeshSurface& surface;
  const ExecutionContext& context;
  std::vector<char> free;
  Rows<Side> corners;
  std::vector<double> quality;  ///< scaled Jacobian of each quad
};

/// How thick the row between a node and one on the boundary may be.
struct RowLimit {
  int boundary = -1;  ///< the node on the boundary; -1 = no limit
  double thickness = std::numeric_limits<double>::infinity();
};

/// The shorter side of the boundary at a fixed node where the boundary bends into the mesh, as along an arc
/// that is cut out of a face; 0 elsewhere, and at corners.
double side_on_notch(const SmoothedMesh& mesh, int node) {
  constexpr double least_turn = 0.1, largest_turn = 1.2;
  double angle = 0, shortest = std::numeric_limits<double>::infinity();
  for (const Side corner : mesh.corners[node]) {
    const auto& q = mesh.quads[element_of(corner)];
    const int next = q[(index_of(corner) + 1) & 3], before = q[(index_of(corner) + 3) & 3];
    const Vector3 b = mesh.points[next] - mesh.points[node], d = mesh.points[before] - mesh.points[node];
    angle += std::atan2(b.cross(d).norm(), b.dot(d));
    if (!mesh.free[next]) shortest = std::min(shortest, b.norm());
    if (!mesh.free[before]) shortest = std::min(shortest, d.norm());
  }
  const double turn = angle - std::numbers::pi;
  return turn > least_turn && turn < largest_turn && std::isfinite(shortest) ? shortest : 0;
}

/// Beside such arcs, quads are to be no thicker than they are long: stresses fall off there within a share of
/// the radius, and averages spread the rows evenly as far as the next boundary.
std::vector<RowLimit> row_limits(const SmoothedMesh& mesh) {
  std::vector<RowLimit> limits(mesh.points.size());
  for (int node = 0; node < static_cast<int>(limits.size()); ++node) {
    mesh.check(node);
    if (mesh.free[node]) continue;
    const double length = side_on_notch(mesh, node);
    if (!(length > 0)) continue;
    for (const Side corner : mesh.corners[node]) {
      const auto& q = mesh.quads[element_of(corner)];
      for (const int k : {1, 3}) {
        const int other = q[(index_of(corner) + k) & 3];
        if (mesh.free[other] && length < limits[other].thickness) limits[other] = {node, length};
      }
    }
  }
  return limits;
}

/// Sweeps of averages, in tangent planes. Nodes see the moves of the nodes before them.
class Sweeps {
 public:
  explicit Sweeps(SmoothedMesh& mesh)
      : mesh_(mesh),
        active_(mesh.points.size(), 1),
        next_active_(mesh.points.size(), 0),
        row_limits_(row_limits(mesh)) {
    // Mark nodes where the surface turns far from one node to the next, as around a tube of four coarse
    // quads. There, averages in tangent planes would pull a node further to the side to which it leans.
    constexpr double least_cosine = 0.1;
    turns_sharply_.assign(mesh_.points.size(), 0);
    for (const auto& quad : mesh_.quads)
      for (int k = 0; k < 4; ++k) {
        const int a = quad[k], b = quad[(k + 1) & 3];
        if (mesh_.normals[a].dot(mesh_.normals[b]) < least_cosine) turns_sharply_[a] = turns_sharply_[b] = 1;
      }
  }

  /// Moves each active node once; false when nothing is active any more.
  bool sweep() {
    const bool any = mesh_.visit_free([&](int node) {
      if (!active_[node] || turns_sharply_[node] || !relax(node)) return false;
      mesh_.mark_around(node, next_active_);
      return true;
    });
    active_.swap(next_active_);
    std::fill(next_active_.begin(), next_active_.end(), 0);
    return any;
  }

  /// Makes the nodes around one that was moved active.
  void wake_around(int node) { mesh_.mark_around(node, active_); }

 private:
  /// Moves a place towards the boundary until the row there is no thicker than allowed.
  void keep_near(const RowLimit& limit, const TangentPlan& plan, double& x, double& y) const {
    if (limit.boundary < 0) return;
    const auto [end_x, end_y] = plan.coordinates(mesh_.points[limit.boundary]);
    const double distance = std::hypot(x - end_x, y - end_y);
    if (!(distance > limit.thickness)) return;
    x = end_x + (x - end_x) * limit.thickness / distance;
    y = end_y + (y - end_y) * limit.thickness / distance;
  }

  /// One step of a sweep: moves the node towards the mean of the nodes of its quads, and beyond. Opposite
  /// corners count half as much as neighbors. On graded meshes, this weight and the overshoot reach in 3
  /// sweeps the mean quality that plain averages of neighbors reach in 8. Weights by length or area, and
  /// parallelogram targets, gave less.
  bool relax(int node) {
    TangentPlan plan(mesh_.points[node], mesh_.normals[node]);
    for (const Side corner : mesh_.corners[node]) {
      const auto [b, c, d] = mesh_.beside(corner);
      if (!plan.add(b, c, d)) return false;
    }
    if (plan.count() == 0) return false;
    double x = 0, y = 0, size2 = 0;
    for (int i = 0; i < plan.count(); ++i) {
      const auto& [bx, by, cx, cy, dx, dy] = plan.corner(i);
      x += bx + dx + opposite_weight * cx;
      y += by + dy + opposite_weight * cy;
      size2 += bx * bx + by * by;
    }
    const double share = overshoot / ((2 + opposite_weight) * plan.count());
    x *= share;
    y *= share;
    size2 /= plan.count();
    keep_near(row_limits_[node], plan, x, y);
    if (x * x + y * y < still_share * still_share * size2) return false;
    const double floor = std::min(mesh_.least_round(node), good_jacobian);
    if (!plan.fits(x, y, floor)) {
      x *= 0.5;
      y *= 0.5;
      if (!plan.fits(x, y, floor)) return false;
    }
    const SurfacePlace place = mesh_.moved(node, plan.place(x, y));
    const auto [px, py] = plan.coordinates(place.point);
    const double off2 = (px - x) * (px - x) + (py - y) * (py - y);
    // If the surface is not that near to the place, judge again; reject a place that is not finite.
    if (!(off2 < near_share * near_share * size2) && !(place.point.allFinite() && plan.fits(px, py, floor)))
      return false;
    mesh_.nodes.put(node, place);
    for (int i = 0; i < plan.count(); ++i)
      mesh_.quality[element_of(mesh_.corners[node][i])] = plan.quality(i);
    return true;
  }

  SmoothedMesh& mesh_;
  std::vector<char> active_, next_active_, turns_sharply_;
  std::vector<RowLimit> row_limits_;  ///< (points)
};

/// How far the corner areas that `p` touches fall short of a small positive area, in all, over the squared
/// size: negative, or 0 if none does.
double tangle_at(const SmoothedMesh& m, int node, const Vector3& p, const Vector3& normal, double size) {
  double sum = 0;
  const double wanted = 0.02 * size * size;
  for (const Side corner : m.corners[node]) {
    const auto [b, c, d] = m.beside(corner);
    sum += std::min(0.0, (b - p).cross(d - p).dot(normal) - wanted);
    sum += std::min(0.0, (c - b).cross(p - b).dot(normal) - wanted);
    sum += std::min(0.0, (p - d).cross(c - d).dot(normal) - wanted);
  }
  return sum / (size * size);
}

/// What the search raises: the least scaled Jacobian, reduced if a side gets short compared to the others.
/// By the worst angle alone, the best place would often be that of a neighbor.
double merit_at(const SmoothedMesh& m, int node, const Vector3& p, const Vector3& normal) {
  const double least = m.least_at(node, p, normal);
  if (least <= 0) return least;
  double shortest = std::numeric_limits<double>::max(), sum = 0;
  for (const Side corner : m.corners[node]) {
    const double side = (m.beside(corner).next - p).squaredNorm();
    shortest = std::min(shortest, side);
    sum += std::sqrt(side);
  }
  const double share = std::sqrt(shortest) * static_cast<double>(m.corners[node].size()) / (short_side * sum);
  return least * std::min(1.0, share);
}

/// \return whether the patch has all quads of the node
bool draw(const SmoothedMesh& m, int node, const Vector3& u, const Vector3& v, CriteriaPatch& patch) {
  for (const Side corner : m.corners[node]) {
    const auto& q = m.quads[element_of(corner)];
    const FlatQuad flat(m.points[q[0]], m.points[q[1]], m.points[q[2]], m.points[q[3]], m.normals[node], u,
                        v);
    if (!patch.add(flat, index_of(corner))) return false;
  }
  return true;
}

/// Puts the node on the surface near the place found, if that is better there too.
bool settle(SmoothedMesh& m, int node, const Vector3& target, bool tangled, double size) {
  const SurfacePlace place = m.moved(node, target);
  if (!place.point.allFinite()) return false;
  const auto value = [&](const Vector3& p, const Vector3& normal) {
    return tangled ? tangle_at(m, node, p, normal, size) : merit_at(m, node, p, normal);
  };
  const bool better = value(place.point, place.normal) > value(m.points[node], m.normals[node]);
  if (better) m.put(node, place);
  return better;
}

/// Compass search in the tangent plane for the place where the worst element around the node is best.
bool search(SmoothedMesh& m, int node) {
  const bool tangled = !(m.least_round(node) > 0);
  using Lanes = CriteriaPatch::Lanes;
  const Vector3 origin = m.points[node], normal = m.normals[node];
  const double size = m.mean_side(node);
  const Vector3 u = normal.unitOrthogonal(), v = normal.cross(u);
  CriteriaPatch patch(u, v);
  if (!(size > 0) || (!tangled && !draw(m, node, u, v, patch))) return false;
  const auto values_at = [&](const Lanes& x, const Lanes& y) {
    if (!tangled) return patch.merits(x, y, short_side);
    Lanes result;
    for (int k = 0; k < CriteriaPatch::lanes; ++k)
      result[k] = tangle_at(m, node, origin + x[k] * u + y[k] * v, normal, size);
    return result;
  };
  const Vector3 to_middle = m.middle_of(node) - origin;
  const double middle_x = u.dot(to_middle), middle_y = v.dot(to_middle);
  const Lanes first = values_at({0, middle_x}, {0, middle_y});
  double value = first[0], best_x = 0, best_y = 0;
  if (first[1] > value) {
    value = first[1];
    best_x = middle_x;
    best_y = middle_y;
  }
  constexpr double diagonal = 0.70710678118654752;
  constexpr Lanes compass_x{1, 0, -1, 0, diagonal, -diagonal, -diagonal, diagonal};
  constexpr Lanes compass_y{0, 1, 0, -1, diagonal, diagonal, -diagonal, -diagonal};
  double step = 0.25 * size;
  for (int halvings = 0; halvings < 4; ++halvings, step *= 0.5) {
    for (int tries = 0; tries < 3; ++tries) {
      Lanes x, y;
      for (int k = 0; k < CriteriaPatch::lanes; ++k) {
        x[k] = best_x + step * compass_x[k];
        y[k] = best_y + step * compass_y[k];
      }
      const Lanes values = values_at(x, y);
      const auto best = std::max_element(values.begin(), values.end()) - values.begin();
      if (!(values[best] > value)) break;
      value = values[best];
      best_x = x[best];
      best_y = y[best];
    }
  }
  if (value <= first[0] || (best_x == 0 && best_y == 0)) return false;
  return settle(m, node, origin + best_x * u + best_y * v, tangled, size);
}

/// Works on the nodes of the elements below `floor`, in index order; returns whether a node moved.
bool optimize_below(double floor, SmoothedMesh& m, Sweeps& sweeps) {
  return m.visit_free([&](int node) {
    if (!(m.least_round(node) < floor) || !search(m, node)) return false;
    sweeps.wake_around(node);
    return true;
  });
}

}  // namespace

void smooth(SurfaceMesh& surface_mesh, const MeshSurface& surface, const ImproveOptions& options,
            ExecutionContext& context) {
  SmoothedMesh mesh(surface_mesh, surface, context);
  Sweeps sweeps(mesh);
  const auto optimize = [&](int times, double floor) {
    for (int i = 0; i < times && optimize_below(floor, mesh, sweeps); ++i) continue;
  };
  optimize(10, 1e-3);
  for (int i = 0; i < options.smoothing_sweeps && sweeps.sweep(); ++i) continue;
  mesh.measure_all();
  optimize(10, 1e-3);
  // Alternate between the worst elements and their surroundings, which have to give way.
  for (int i = 0; i < 8 && optimize_below(bad_jacobian, mesh, sweeps); ++i) {
    for (int k = 0; k < 3 && sweeps.sweep(); ++k) continue;
    mesh.measure_all();
  }
  optimize(2, poor_jacobian);
}

}  // namespace quadrille
