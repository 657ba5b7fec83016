/// Tries places that complete parallelograms, then shorter and shorter steps along the axes.

#include "mesher/quads/improve.hpp"

#include <algorithm>
#include <set>

#include "mesher/mesh/quad_geometry.hpp"
#include "mesher/mesh/quality.hpp"
#include "mesher/mesh/sides.hpp"

namespace quadrille {

namespace {

class SpaceUnfolding {
 public:
  SpaceUnfolding(const std::vector<std::array<int, 4>>& quads, std::vector<Vector3>& points,
                 const std::vector<char>& fixed, double reach, const ExecutionContext& context)
      : quads_(quads), points_(points), starts_(points), fixed_(fixed), reach_(reach), context_(context) {}

  std::vector<char> run() {
    constexpr int rounds = 20;
    std::vector<char> moved(points_.size(), 0);
    for (int round = 0; round < rounds; ++round) {
      context_.check();
      const std::set<int> nodes = free_nodes_of_inverted();
      if (nodes.empty()) break;
      if (round == 0) corners_ = corners_by_node(points_.size(), quads_);
      for (const int node : nodes) {
        if (round == 0) try_places(node);
        if (round > 0) search(node);
        moved[node] = 1;
      }
    }
    return moved;
  }

 private:
  /// The least scaled Jacobian around a node.
  double worst(int node) const {
    double least = 1;
    for (const Side corner : corners_[node])
      least = std::min(least, quad_scaled_jacobian(points_, quads_[element_of(corner)]));
    return least;
  }

  std::set<int> free_nodes_of_inverted() const {
    std::set<int> result;
    for (const auto& quad : quads_) {
      if (quad_scaled_jacobian(points_, quad) > no_jacobian) continue;
      for (const int node : quad)
        if (!fixed_[node]) result.insert(node);
    }
    return result;
  }

  void try_places(int node) {
    Vector3 sum = Vector3::Zero();
    std::vector<Vector3> places;
    for (const Side corner : corners_[node]) {
      const auto& quad = quads_[element_of(corner)];
      const int k = index_of(corner);
      const Vector3 &next = points_[quad[(k + 1) % 4]], &opposite = points_[quad[(k + 2) % 4]],
                    &previous = points_[quad[(k + 3) % 4]];
      sum += next + previous;
      places.emplace_back(next + previous - opposite);
    }
    places.emplace_back(sum / (2.0 * static_cast<double>(corners_[node].size())));
    double best = worst(node);
    for (const Vector3& place : places) try_place(node, place, best);
  }

  void try_place(int node, const Vector3& place, double& best) {
    if ((place - starts_[node]).norm() > reach_) return;
    const Vector3 before = points_[node];
    points_[node] = place;
    if (const double now = worst(node); now > best)
      best = now;
    else
      points_[node] = before;
  }

  /// Ever shorter steps along the axes.
  void search(int node) {
    double step = 0;
    for (const Side corner : corners_[node])
      for (const int other : quads_[element_of(corner)])
        step = std::max(step, 0.5 * (points_[other] - points_[node]).norm());
    step = std::min(step, reach_);
    double best = worst(node);
    constexpr int halvings = 16;
    for (int k = 0; k < halvings; ++k, step *= 0.5) {
      for (int axis = 0; axis < 6; ++axis)
        try_place(node, points_[node] + (axis < 3 ? step : -step) * Vector3::Unit(axis % 3), best);
    }
  }

  const std::vector<std::array<int, 4>>& quads_;
  std::vector<Vector3>& points_;
  const std::vector<Vector3> starts_;
  Rows<Side> corners_;
  const std::vector<char>& fixed_;
  double reach_;
  const ExecutionContext& context_;
};

}  // namespace

std::vector<char> unfold_in_space(const std::vector<std::array<int, 4>>& quads, std::vector<Vector3>& points,
                                  const std::vector<char>& fixed, double reach,
                                  const ExecutionContext& context) {
  return SpaceUnfolding(quads, points, fixed, reach, context).run();
}

}  // namespace quadrille
