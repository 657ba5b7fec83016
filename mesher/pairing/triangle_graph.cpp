/// Neighbours by a counting sort of the sides over their lower point, and the costs of pairs from corner
/// angles.

#include "mesher/pairing/triangle_graph.hpp"

#include <algorithm>
#include <cmath>

#include "mesher/pairing/edge_coloring.hpp"

namespace quadrille {

namespace {

/// atan2(y, x) for y >= 0, to 2e-6.
inline float arc(float y, float x) {
  const float ax = std::fabs(x);
  const float high = std::max(y, ax), low = std::min(y, ax);
  const float r = high > 0 ? low / high : 0.0F, s = r * r;
  float a =
      r * (0.99997726F +
           s * (-0.33262347F + s * (0.19354346F + s * (-0.11643287F + s * (0.05265332F - s * 0.01172120F)))));
  a = y > ax ? 1.57079633F - a : a;
  return x < 0 ? 3.14159265F - a : a;
}

TriangleShape shape_of(const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 ab = b - a, bc = c - b, ca = a - c;
  const Vector3 cross = ab.cross(-ca);
  const double area = cross.norm();
  TriangleShape shape{};
  shape.angle[0] = arc(static_cast<float>(area), static_cast<float>(-ab.dot(ca)));
  shape.angle[1] = arc(static_cast<float>(area), static_cast<float>(-bc.dot(ab)));
  shape.angle[2] = 3.14159265F - shape.angle[0] - shape.angle[1];
  const double scale = area > 0 ? 1 / area : 0;
  for (int k = 0; k < 3; ++k) shape.normal[k] = static_cast<float>(cross[k] * scale);
  return shape;
}

TriangleShape shape_of(const GraphTriangle& t, const std::vector<Vector3>& points) {
  return shape_of(points[t.corner[0]], points[t.corner[1]], points[t.corner[2]]);
}

void invert(TriangleShape& shape) {
  for (float& angle : shape.angle) angle = -angle;
  for (float& component : shape.normal) component = -component;
}

}  // namespace

float pair_cost(const TriangleShape& first, int i, const TriangleShape& second, int j, Objective objective) {
  constexpr float right = 1.57079633F;
  const float corners[4] = {first.angle[previous_index(i)], second.angle[previous_index(j)],
                            first.angle[i] + second.angle[next_index(j)],
                            first.angle[next_index(i)] + second.angle[j]};
  float worst = 0, squares = 0;
  for (float corner : corners) {
    const float deviation = std::fabs(corner / right - 1);
    worst = std::max(worst, deviation);
    squares += deviation * deviation;
  }
  float aligned = 0;
  for (int k = 0; k < 3; ++k) aligned += first.normal[k] * second.normal[k];
  if (objective == Objective::shape) return worst + 2 * (1 - aligned);
  const float bad = std::max(worst - 0.6F, 0.0F);
  const float reflex = std::max(worst - 0.95F, 0.0F);
  return 0.5F * worst + 0.3F * squares + 4 * bad * bad + 10 * reflex + 2 * (1 - aligned);
}

TriangleGraph::TriangleGraph(const TriangleMesh& mesh, const ExecutionContext& context) {
  check_indices(mesh);
  triangles.resize(mesh.triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& c = mesh.triangles[t];
    triangles[t] = {{c[0], c[1], c[2]}, {-1, -1, -1}, {0, 0, 0}, -1};
  }
  context.check();
  SparseCheck check(context);
  join_twins(mesh, [&](Side a, Side b) {
    check();
    triangles[triangle_of(a)].twin[index_of(a)] = b;
    triangles[triangle_of(b)].twin[index_of(b)] = a;
  });
}

TriangleGraph::TriangleGraph(const TriangleMesh& mesh, const EdgeColoring& connected) {
  triangles.resize(mesh.triangles.size());
  for (int t = 0; t < size(); ++t) {
    const auto& c = mesh.triangles[t];
    triangles[t] = {
        {c[0], c[1], c[2]},
        {connected.twin(make_side(t, 0)), connected.twin(make_side(t, 1)), connected.twin(make_side(t, 2))},
        {0, 0, 0},
        -1};
  }
}

constexpr float worst_cost = 1e6f;

void TriangleGraph::compute_costs(const std::vector<Vector3>& points, const ExecutionContext& context) {
  SparseCheck check(context);
  std::vector<TriangleShape> shapes(triangles.size());
  for (int t = 0; t < size(); ++t) {
    check();
    shapes[t] = shape_of(triangles[t], points);
  }
  for (int t = 0; t < size(); ++t) {
    check();
    for (int i = 0; i < 3; ++i) {
      const Side twin = triangles[t].twin[i];
      if (twin < make_side(t, i)) continue;  // boundary, or done from the other side
      float cost = pair_cost(shapes[t], i, shapes[triangle_of(twin)], index_of(twin), objective);
      if (!(cost < worst_cost)) cost = worst_cost;  // not a number where products overflow
      triangles[t].cost[i] = triangles[triangle_of(twin)].cost[index_of(twin)] = cost;
    }
  }
}

Side TriangleGraph::flip(Side side, const std::vector<Vector3>& points) {
  const Side opposite = twin_of(side);
  const int t = triangle_of(side), s = triangle_of(opposite);
  const int i = index_of(side), j = index_of(opposite);
  const bool paired = triangles[t].mate == i;
  const int p = corner_at(side), q = end_of(side), r = apex_of(side), w = apex_of(opposite);
  const Side qr = triangles[t].twin[next_index(i)], rp = triangles[t].twin[previous_index(i)];
  const Side pw = triangles[s].twin[next_index(j)], wq = triangles[s].twin[previous_index(j)];
  const auto attach = [this](int triangle, int index, Side neighbour) {
    triangles[triangle].twin[index] = neighbour;
    if (neighbour >= 0)
      triangles[triangle_of(neighbour)].twin[index_of(neighbour)] = make_side(triangle, index);
  };
  triangles[t] = {{w, q, r}, {-1, -1, -1}, {0, 0, 0}, paired ? 2 : triangles[t].mate};
  triangles[s] = {{p, w, r}, {-1, -1, -1}, {0, 0, 0}, paired ? 1 : triangles[s].mate};
  attach(t, 0, wq);
  attach(t, 1, qr);
  attach(t, 2, make_side(s, 1));
  attach(s, 0, pw);
  attach(s, 2, rp);
  for (int k = 0; k < 3; ++k) {
    update_cost(make_side(t, k), points);
    if (k != 1) update_cost(make_side(s, k), points);
  }
  return make_side(t, 2);
}

void TriangleGraph::update_cost(Side side, const std::vector<Vector3>& points) {
  const Side other = twin_of(side);
  if (other < 0) return;
  const auto shape = [&](int t) {
    TriangleShape result = shape_of(triangles[t], points);
    // Only flips make inverted triangles: against the mean normal of their neighbours.
    Vector3 mean = Vector3::Zero();
    const auto add = [&](int n) {
      const auto& c = triangles[n].corner;
      mean += (points[c[1]] - points[c[0]]).cross(points[c[2]] - points[c[0]]);
    };
    add(t);
    for (Side neighbour : triangles[t].twin) {
      if (neighbour >= 0) add(triangle_of(neighbour));
    }
    const Vector3 normal(result.normal[0], result.normal[1], result.normal[2]);
    if (normal.dot(mean) < 0) invert(result);
    return result;
  };
  const float cost = pair_cost(shape(triangle_of(side)), index_of(side), shape(triangle_of(other)),
                               index_of(other), objective);
  triangles[triangle_of(side)].cost[index_of(side)] = cost;
  triangles[triangle_of(other)].cost[index_of(other)] = cost;
}

}  // namespace quadrille
