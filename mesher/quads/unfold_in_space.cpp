/// Tries places that complete parallelograms, then shorter and shorter steps along the axes.

#include "mesher/quads/improve.hpp"

#include <algorithm>
#include <map>

#include "mesher/mesh/quad_geometry.hpp"
#include "mesher/mesh/quality.hpp"

namespace quadrille {

namespace {

class SpaceUnfolding {
 public:
  SpaceUnfolding(QuadMesh& mesh, const std::vector<char>& fixed, double reach,
                 const ExecutionContext& context)
      : quads_(mesh.quads),
        points_(mesh.points),
        starts_(mesh.points),
        fixed_(fixed),
        reach_(reach),
        context_(context) {}

  std::vector<char> run() {
    constexpr int rounds = 20;
    std::vector<char> moved(points_.size(), 0);
    for (int round = 0; round < rounds; ++round) {
      context_.check();
      const std::map<int, std::vector<int>> nodes = free_nodes_of_inverted();
      if (nodes.empty()) break;
      for (const auto& [node, quads] : nodes) {
        if (round == 0) try_places(node, quads);
        if (round > 0) search(node, quads);
        moved[node] = 1;
      }
    }
    return moved;
  }

 private:
  double shape(int quad) const { return quad_scaled_jacobian(points_, quads_[quad]); }

  double worst(const std::vector<int>& quads) const {
    double least = 1;
    for (const int quad : quads) least = std::min(least, shape(quad));
    return least;
  }

  /// The free nodes of inverted quads, each with all quads around it.
  std::map<int, std::vector<int>> free_nodes_of_inverted() const {
    std::map<int, std::vector<int>> result;
    const int count = static_cast<int>(quads_.size());
    for (int quad = 0; quad < count; ++quad) {
      if (shape(quad) > no_jacobian) continue;
      for (const int node : quads_[quad])
        if (!fixed_[node]) result[node];
    }
    if (result.empty()) return result;
    for (int quad = 0; quad < count; ++quad) {
      for (const int node : quads_[quad])
        if (const auto found = result.find(node); found != result.end()) found->second.push_back(quad);
    }
    return result;
  }

  void try_places(int node, const std::vector<int>& quads) {
    Vector3 sum = Vector3::Zero();
    std::vector<Vector3> places;
    for (const int quad : quads) {
      const auto& corners = quads_[quad];
      const auto k = static_cast<int>(std::find(corners.begin(), corners.end(), node) - corners.begin());
      const Vector3 &next = points_[corners[(k + 1) % 4]], &opposite = points_[corners[(k + 2) % 4]],
                    &previous = points_[corners[(k + 3) % 4]];
      sum += next + previous;
      places.emplace_back(next + previous - opposite);
    }
    places.emplace_back(sum / (2.0 * static_cast<double>(quads.size())));
    double best = worst(quads);
    for (const Vector3& place : places) try_place(node, quads, place, best);
  }

  void try_place(int node, const std::vector<int>& quads, const Vector3& place, double& best) {
    if ((place - starts_[node]).norm() > reach_) return;
    const Vector3 before = points_[node];
    points_[node] = place;
    if (const double now = worst(quads); now > best)
      best = now;
    else
      points_[node] = before;
  }

  /// Ever shorter steps along the axes.
  void search(int node, const std::vector<int>& quads) {
    double step = 0;
    for (const int quad : quads)
      for (const int other : quads_[quad])
        step = std::max(step, 0.5 * (points_[other] - points_[node]).norm());
    step = std::min(step, reach_);
    double best = worst(quads);
    constexpr int halvings = 16;
    for (int k = 0; k < halvings; ++k, step *= 0.5) {
      for (int axis = 0; axis < 6; ++axis)
        try_place(node, quads, points_[node] + (axis < 3 ? step : -step) * Vector3::Unit(axis % 3), best);
    }
  }

  const std::vector<std::array<int, 4>>& quads_;
  std::vector<Vector3>& points_;
  const std::vector<Vector3> starts_;
  const std::vector<char>& fixed_;
  double reach_;
  const ExecutionContext& context_;
};

}  // namespace

std::vector<char> unfold_in_space(QuadMesh& mesh, const std::vector<char>& fixed, double reach,
                                  const ExecutionContext& context) {
  return SpaceUnfolding(mesh, fixed, reach, context).run();
}

}  // namespace quadrille
