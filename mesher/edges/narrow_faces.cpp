/// Moves nodes along their curves to the places nearest to those opposite, by golden section search.

#include "mesher/edges/narrow_faces.hpp"

#include <algorithm>

#include "geometry/surfaces/edge_curve.hpp"

namespace quadrille {

namespace {

class NarrowFaces {
 public:
  NarrowFaces(const CadShape& shape, const FaceFlags& used, const std::vector<SplitStrip>& strips,
              BoundaryNodes& nodes)
      : shape_(shape), used_(used), strips_(strips), nodes_(nodes), settled_(shape.edges.size()) {}

  void run() {
    for (const FaceId face : shape_.faces.ids()) {
      if (!used_[face]) continue;
      for (const FacingSides& sides : facing_sides(shape_, shape_.faces[face])) align(sides);
    }
    for (const SplitStrip& strip : strips_) align(strip);
  }

 private:
  void align(const FacingSides& sides) {
    const Coedge &first = *sides.first, &second = *sides.second;
    const EdgeId a = first.edge, b = second.edge;
    const CadEdge &edge_a = shape_.edges[a], &edge_b = shape_.edges[b];
    const int n = nodes_.edges[a].segments();
    if (a == b || n < 2 || nodes_.edges[b].segments() != n || first.internal || second.internal) return;
    if (edge_a.closed() != edge_b.closed() || nodes_.edges[a].borrows() || nodes_.edges[b].borrows()) return;
    if (!(sides.width < narrow * edge_a.length / n) || (settled_[a] && settled_[b])) return;
    // Both coedges run around the face, so across it they run in opposite directions.
    const bool against = first.forward == second.forward;
    const EdgeId leader = settled_[b] ? b : a;
    std::vector<int> targets = nodes_.edges[leader].nodes;
    if (against) std::reverse(targets.begin(), targets.end());
    follow(targets, leader == a ? b : a, false);
    settled_[a] = settled_[b] = 1;
  }

  /// Nodes between the parts of a strip cannot move, so its whole side follows.
  void align(const SplitStrip& strip) {
    const EdgeId whole = strip.whole->edge;
    if (nodes_.edges[whole].borrows() || settled_[whole]) return;
    std::vector<int> targets;
    for (const Coedge* part : strip.parts) {
      std::vector<int> nodes = nodes_.edges[part->edge].nodes;
      if (nodes.empty()) return;
      if (!part->forward) std::reverse(nodes.begin(), nodes.end());
      targets.insert(targets.end(), nodes.begin() + (targets.empty() ? 0 : 1), nodes.end());
    }
    // The wire runs along the parts, and back along the whole side.
    if (strip.whole->forward) std::reverse(targets.begin(), targets.end());
    if (static_cast<int>(targets.size()) != nodes_.edges[whole].segments() + 1) return;
    if (follow(targets, whole, true)) settled_[whole] = 1;
  }

  /// Moves each node of an edge to the point of the edge nearest to its target.
  /// \param targets one node for each node of the edge \param after_moved the lower limit of a node depends
  /// on the new place of the node before it, not on the old one. \return false, with nothing moved, if a node
  /// would not come after the one before it.
  bool follow(const std::vector<int>& targets, EdgeId follower, bool after_moved) {
    BoundaryNodes::Edge& to = nodes_.edges[follower];
    const EdgeCurve curve(shape_.edges[follower]);
    const int n = to.segments();
    std::vector<double> parameters = to.parameters;
    const std::vector<double>& before = after_moved ? parameters : to.parameters;
    for (int k = 1; k < n; ++k) {
      const Vector3& target = nodes_.points[targets[k]];
      parameters[k] = nearest(curve, target, before[k - 1], to.parameters[k], to.parameters[k + 1]);
      if (!(parameters[k] > parameters[k - 1])) return false;
    }
    to.parameters = parameters;
    for (int k = 1; k < n; ++k) nodes_.points[to.nodes[k]] = curve.point(parameters[k]);
    return true;
  }

  /// The parameter nearest to a point, by golden section search. It stays within four fifths of the way to
  /// the neighboring nodes.
  static double nearest(const EdgeCurve& curve, const Vector3& target, double before, double at,
                        double after) {
    constexpr double golden = 0.61803398874989485, reach = 0.8;
    constexpr int sections = 40;
    double low = at - reach * (at - before), high = at + reach * (after - at);
    const auto distance = [&](double t) { return (curve.point(t) - target).squaredNorm(); };
    for (int i = 0; i < sections; ++i) {
      const double a = high - golden * (high - low), b = low + golden * (high - low);
      if (distance(a) < distance(b))
        high = b;
      else
        low = a;
    }
    return 0.5 * (low + high);
  }

  const CadShape& shape_;
  const FaceFlags& used_;
  const std::vector<SplitStrip>& strips_;
  BoundaryNodes& nodes_;
  EdgeFlags settled_;
};

}  // namespace

void align_narrow_faces(const CadShape& shape, const FaceFlags& used, const std::vector<SplitStrip>& strips,
                        BoundaryNodes& nodes) {
  NarrowFaces(shape, used, strips, nodes).run();
}

}  // namespace quadrille
