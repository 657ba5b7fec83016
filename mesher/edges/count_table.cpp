/// Equidistribution of 1 / size along the arc length.

#include "mesher/edges/count_table.hpp"

#include <fmt/format.h>

#include "geometry/base/error.hpp"
#include "geometry/surfaces/edge_curve.hpp"

namespace quadrille {

namespace {

class EdgeTabulator {
 public:
  EdgeTabulator(const CadEdge& edge, bool by_shape, SizingField::Sampler& size_at)
      : edge_(edge),
        curve_(edge),
        size_at_(size_at),
        uniform_(curve_.straight() || curve_.circular()),
        bends_(by_shape && !curve_.straight()) {
    const int intervals = std::max(uniform_ ? 4 : 8, 2 * curve_.spans());
    add(edge.first, curve_.point(edge.first), 0);
    for (int i = 1; i <= intervals; ++i) {
      const double t = edge.first + (edge.last - edge.first) * i / intervals;
      split(t, curve_.point(t), 0);
    }
  }
  CountTable table;

 private:
  void split(double t, const Vector3& p, int depth) {
    const double chord = (p - point_).norm();
    constexpr int max_depth = 40;  // steep changes of the size are resolved long before
    if (depth < max_depth && chord > 0.5 * std::min(size_, size_at(t, p))) {
      const double middle = 0.5 * (table.parameters.back() + t);
      split(middle, curve_.point(middle), depth + 1);
      split(t, p, depth + 1);
      return;
    }
    add(t, p, arc(table.parameters.back(), t, chord));
  }

  double size_at(double t, const Vector3& p) {
    const double size = size_at_(p);
    return bends_ ? size_at_.bent(size, curve_.curvature(t)) : size;
  }

  void add(double t, const Vector3& p, double length) {
    const double size = size_at(t, p);
    const Vector3 direction = curve_.derivative(t);
    if (table.parameters.empty()) {
      table.counts.push_back(0);
      table.lengths.push_back(0);
    } else {
      table.counts.push_back(table.counts.back() + 0.5 * length * (1 / size + 1 / size_));
      table.lengths.push_back(table.lengths.back() + length);
      hold_segments(table.total(), size_at_.budget(), edge_);
      table.turning += angle_between(direction, direction_);
    }
    table.parameters.push_back(t);
    point_ = p;
    size_ = size;
    direction_ = direction;
  }

  /// Arc length by Simpson's rule on the speed.
  double arc(double a, double b, double chord) const {
    if (curve_.straight()) return chord;
    const double speeds = curve_.derivative(a).norm() + curve_.derivative(b).norm() +
                          4 * curve_.derivative(0.5 * (a + b)).norm();
    return std::max(chord, (b - a) * speeds / 6);
  }

  const CadEdge& edge_;
  EdgeCurve curve_;
  SizingField::Sampler& size_at_;
  bool uniform_, bends_;
  Vector3 point_, direction_;
  double size_ = 0;
};

/// The index of a parameter in a table. Inserts the parameter if it is missing.
std::size_t split_at(CountTable& table, double t) {
  std::vector<double>& parameters = table.parameters;
  const auto it = std::ranges::lower_bound(parameters, t);
  const std::size_t i = it - parameters.begin();
  if (it == parameters.end()) return i - 1;
  if (i == 0 || *it == t) return i;
  const double share = (t - parameters[i - 1]) / (parameters[i] - parameters[i - 1]);
  for (std::vector<double>* values : {&table.counts, &table.lengths}) {
    const double before = (*values)[i - 1], after = (*values)[i];
    values->insert(values->begin() + static_cast<long>(i), before + share * (after - before));
  }
  parameters.insert(it, t);
  return i;
}

}  // namespace

void hold_segments(double segments, const Budget& budget, const CadEdge& edge) {
  if (!(segments > budget.segments)) return;
  throw usage_error("size", fmt::format("the edges take more than {:g} million segments at the requested "
                                        "sizes, many of them on Edge{}: `force` meshes anyway",
                                        budget.segments / 1e6, edge.number));
}

void CountTable::make_finer(double from, double to, double least) {
  const std::size_t first = split_at(*this, from), last = split_at(*this, to);
  const double before = counts[first], there = counts[last] - before;
  if (last <= first || there >= least) return;
  for (std::size_t i = first + 1; i < counts.size(); ++i) {
    const double done = std::min(counts[i], before + there) - before;
    counts[i] += done * (least / std::max(there, 1e-300) - 1);
  }
}

void CountTable::raise_to(double density) {
  double before = 0;
  for (std::size_t i = 1; i < counts.size(); ++i) {
    const double own = counts[i] - before;
    before = counts[i];
    counts[i] = counts[i - 1] + std::max(own, density * (lengths[i] - lengths[i - 1]));
  }
}

CountTable tabulate(const CadEdge& edge, bool by_shape, SizingField::Sampler& size_at) {
  return EdgeTabulator(edge, by_shape, size_at).table;
}

}  // namespace quadrille
