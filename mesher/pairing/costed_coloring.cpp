/// Based on: Karp & Sipser, Maximum matching in sparse random graphs (1981), for forced pairs; Remacle et
/// al., Blossom-Quad (2012), for the cost from corner angles.

#include "mesher/pairing/costed_coloring.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace quadrille {

namespace {

constexpr auto pi = std::numbers::pi_v<float>;

/// Corner angles of a triangle and its unit normal. The angles of an inverted triangle are negative.
struct TriangleShape {
  float angle[3];
  Eigen::Vector3f normal;
};

/// atan2(y, x) for y >= 0, to 2e-6.
inline float arc(float y, float x) {
  const float ax = std::fabs(x);
  const float high = std::max(y, ax), low = std::min(y, ax);
  const float r = high > 0 ? low / high : 0.0F, s = r * r;
  float a =
      r * (0.99997726F +
           s * (-0.33262347F + s * (0.19354346F + s * (-0.11643287F + s * (0.05265332F - s * 0.01172120F)))));
  a = y > ax ? pi / 2 - a : a;
  return x < 0 ? pi - a : a;
}

TriangleShape shape_of(const std::array<int, 3>& corner, const std::vector<Vector3>& points) {
  const Vector3 &a = points[corner[0]], &b = points[corner[1]], &c = points[corner[2]];
  const Vector3 ab = b - a, bc = c - b, ca = a - c;
  const Vector3 cross = ab.cross(-ca);
  const double area = cross.norm();
  TriangleShape shape{};
  shape.angle[0] = arc(static_cast<float>(area), static_cast<float>(-ab.dot(ca)));
  shape.angle[1] = arc(static_cast<float>(area), static_cast<float>(-bc.dot(ab)));
  shape.angle[2] = pi - shape.angle[0] - shape.angle[1];
  const double scale = area > 0 ? 1 / area : 0;
  shape.normal = (cross * scale).cast<float>();
  return shape;
}

/// The cost of the quad made of two triangles across the side i of the first and j of the second, from its
/// corner angles and the fold between the two: 0 for a rectangle, about 0.3 for two equilateral triangles,
/// above 2 for a concave quad.
float pair_cost(const TriangleShape& first, int i, const TriangleShape& second, int j) {
  const float corners[4] = {first.angle[previous_index(i)], second.angle[previous_index(j)],
                            first.angle[i] + second.angle[next_index(j)],
                            first.angle[next_index(i)] + second.angle[j]};
  float worst = 0, squares = 0;
  for (float corner : corners) {
    const float deviation = std::fabs(corner / (pi / 2) - 1);
    worst = std::max(worst, deviation);
    squares += deviation * deviation;
  }
  float aligned = 0;
  for (int k = 0; k < 3; ++k) aligned += first.normal[k] * second.normal[k];
  const float bad = std::max(worst - 0.6F, 0.0F);
  const float reflex = std::max(worst - 0.95F, 0.0F);
  return 0.5F * worst + 0.3F * squares + 4 * bad * bad + 10 * reflex + 2 * (1 - aligned);
}

}  // namespace

CostedColoring::CostedColoring(const TriangleMesh& mesh, EdgeColoring colors)
    : EdgeColoring(std::move(colors)), triangles_(mesh.triangles.size()) {
  for (int t = 0; t < size(); ++t) triangles_[t] = {mesh.triangles[t], {0, 0, 0}};
}

void CostedColoring::compute_costs(const std::vector<Vector3>& points, const ExecutionContext& context) {
  SparseCheck check(context);
  std::vector<TriangleShape> shapes(triangles_.size());
  for (int t = 0; t < size(); ++t) {
    check();
    shapes[t] = shape_of(corners(t), points);
  }
  for (int t = 0; t < size(); ++t) {
    check();
    for (int i = 0; i < 3; ++i) {
      const Side other = twin(make_side(t, i));
      if (other < make_side(t, i)) continue;  // boundary, or done from the other side
      set_cost(make_side(t, i), pair_cost(shapes[t], i, shapes[triangle_of(other)], index_of(other)));
    }
  }
}

void CostedColoring::flip(Side side, const std::vector<Vector3>& points) {
  const Side opposite = twin(side);
  const int t = triangle_of(side), s = triangle_of(opposite);
  const int i = index_of(side), j = index_of(opposite), old_color = color(side);
  for (int k = 0; k < 3; ++k) {
    set_color(make_side(t, k), blank);
    set_color(make_side(s, k), blank);
  }
  const int p = corner_at(side), q = end_of(side), r = apex_of(side), w = apex_of(opposite);
  const Side qr = cell(t).twin[next_index(i)], rp = cell(t).twin[previous_index(i)];
  const Side pw = cell(s).twin[next_index(j)], wq = cell(s).twin[previous_index(j)];
  const auto attach = [this](Side own, Side neighbor) {
    cell(triangle_of(own)).twin[index_of(own)] = neighbor;
    if (neighbor >= 0) cell(triangle_of(neighbor)).twin[index_of(neighbor)] = own;
  };
  triangles_[t] = {{w, q, r}, {0, 0, 0}};
  triangles_[s] = {{p, w, r}, {0, 0, 0}};
  attach(make_side(t, 0), wq);
  attach(make_side(t, 1), qr);
  attach(make_side(t, 2), make_side(s, 1));
  attach(make_side(s, 0), pw);
  attach(make_side(s, 2), rp);
  set_color(make_side(t, 2), old_color);
  for (int k = 0; k < 3; ++k) {
    update_cost(make_side(t, k), points);
    if (k != 1) update_cost(make_side(s, k), points);
  }
}

void CostedColoring::update_cost(Side side, const std::vector<Vector3>& points) {
  const Side other = twin(side);
  if (other < 0) return;
  const auto shape = [&](int t) {
    TriangleShape result = shape_of(corners(t), points);
    // Only flips can invert a triangle: its normal then opposes the mean normal of the neighborhood.
    Vector3 mean = Vector3::Zero();
    const auto add = [&](int n) {
      const auto& [a, b, c] = corners(n);
      mean += (points[b] - points[a]).cross(points[c] - points[a]);
    };
    add(t);
    for (Side neighbor : cell(t).twin) {
      if (neighbor >= 0) add(triangle_of(neighbor));
    }
    const Vector3 normal = result.normal.cast<double>();
    if (normal.dot(mean) < 0) {
      for (float& angle : result.angle) angle = -angle;
      result.normal = -result.normal;
    }
    return result;
  };
  set_cost(side,
           pair_cost(shape(triangle_of(side)), index_of(side), shape(triangle_of(other)), index_of(other)));
}

void CostedColoring::set_cost(Side side, float cost) {
  constexpr float worst_cost = 1e6F;
  if (!(cost < worst_cost)) cost = worst_cost;  // not a number where products overflow
  for (const Side one : {side, twin(side)}) triangles_[triangle_of(one)].cost[index_of(one)] = cost;
}

namespace {

/// Pairs triangles with one choice left, until there are none. Each pair takes choices from its neighbors.
class ForcedPairs {
 public:
  explicit ForcedPairs(EdgeColoring& coloring) : coloring_(coloring) {}

  /// Pairs across a side, then all triangles to which this leaves one choice.
  void pair(Side s) {
    join(s);
    settle();
  }

  /// Pairs a triangle if it has only one choice, then all triangles to which this leaves one choice.
  void start(int t) {
    offer(t);
    settle();
  }

 private:
  bool can_pair(Side s) const { return s >= 0 && coloring_.free(triangle_of(s)); }

  void offer(int t) {
    if (!coloring_.free(t)) return;
    int choices = 0;
    for (int i = 0; i < 3; ++i) choices += can_pair(coloring_.twin(make_side(t, i)));
    if (choices == 1) stack_.push_back(t);
  }

  void join(Side s) {
    coloring_.pair(s);
    for (int t : {triangle_of(s), triangle_of(coloring_.twin(s))}) {
      for (int i = 0; i < 3; ++i) {
        if (const Side other = coloring_.twin(make_side(t, i)); other >= 0) offer(triangle_of(other));
      }
    }
  }

  void settle() {
    while (!stack_.empty()) {
      const int t = stack_.back();
      stack_.pop_back();
      for (int i = 0; i < 3 && coloring_.free(t); ++i) {
        if (can_pair(coloring_.twin(make_side(t, i)))) join(make_side(t, i));
      }
    }
  }

  EdgeColoring& coloring_;
  std::vector<int> stack_;
};

/// The inner sides in order of cost, equal ones (to 1/256) in the order of the mesh.
std::vector<Side> sides_by_cost(const CostedColoring& coloring, SparseCheck& check) {
  constexpr int buckets = 1024;
  // A cost that is not a number (products of distances overflow) comes last.
  const auto bucket = [](float cost) {
    return cost < 0.F ? 0 : cost * 256 < buckets ? static_cast<int>(cost * 256) : buckets - 1;
  };
  Rows<Side> rows(buckets, [&](auto&& add) {
    for (int t = 0; t < coloring.size(); ++t) {
      check();
      for (int i = 0; i < 3; ++i) {
        const Side side = make_side(t, i);
        if (coloring.twin(side) > side) add(bucket(coloring.cost_of(side)), side);
      }
    }
  });
  return rows.take_items();
}

}  // namespace

void color_by_cost(CostedColoring& coloring, const ExecutionContext& context) {
  SparseCheck check(context);
  ForcedPairs forced(coloring);
  for (int t = 0; t < coloring.size(); ++t) {
    int outer = 0;
    for (int i = 0; i < 3; ++i) outer += coloring.twin(make_side(t, i)) < 0;
    if (outer == 2) forced.start(t);
  }
  for (Side s : sides_by_cost(coloring, check)) {
    check();
    if (coloring.free(triangle_of(s)) && coloring.free(triangle_of(coloring.twin(s)))) forced.pair(s);
  }
}

}  // namespace quadrille
