/// Turns numbers of segments and their ratios into shares of the length, split over the pieces of an edge.

#include "geometry/sizing/edge_spacing.hpp"

#include <Precision.hxx>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "geometry/base/error.hpp"
#include "geometry/base/whole_number.hpp"

namespace quadrille {

namespace {

/// Shares of the whole length at which segments in the given ratios begin and end; empty if all are equal.
std::vector<double> shares_by(int segments, const EdgeSpacing& spacing) {
  if (spacing.bias == 1 && spacing.bias_both == 1) return {};
  std::vector<double> shares{0};
  for (int k = 0; k < segments; ++k) {
    const int from_end = std::min(k, segments - 1 - k);
    shares.push_back(shares.back() + std::pow(spacing.bias, k) * std::pow(spacing.bias_both, from_end));
  }
  for (double& share : shares) share /= shares.back();
  return shares;
}

/// The pieces of a CAD edge in the order of the edge's parameter.
std::vector<EdgeId> pieces_of(const CadShape& shape, int number) {
  std::vector<EdgeId> pieces;
  for (const EdgeId id : shape.edges.ids()) {
    const CadEdge& edge = shape.edges[id];
    if (edge.number == number && !edge.degenerate && edge.length > 0) pieces.push_back(id);
  }
  std::sort(pieces.begin(), pieces.end(),
            [&](EdgeId a, EdgeId b) { return shape.edges[a].first < shape.edges[b].first; });
  return pieces;
}

/// The number of segments of each piece: in proportion to its length, but at least one.
std::vector<int> split_count(const CadShape& shape, const std::vector<EdgeId>& pieces, int segments) {
  double length = 0, before = 0;
  for (const EdgeId piece : pieces) length += shape.edges[piece].length;
  std::vector<int> counts;
  int left = segments;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    before += shape.edges[pieces[i]].length;
    const int others = static_cast<int>(pieces.size() - 1 - i);
    const int upto = i + 1 == pieces.size() ? segments : round_to_int(segments * before / length);
    counts.push_back(std::clamp(upto - (segments - left), 1, std::max(1, left - others)));
    left -= counts.back();
  }
  return counts;
}

}  // namespace

PrescribedEdge PrescribedEdge::make(const CadEdge& edge, int segments, const EdgeSpacing& spacing) {
  PrescribedEdge made{segments, shares_by(segments, spacing), spacing};
  const double shortest = made.shortest(edge.length);
  if (made.shares.empty() || shortest >= Precision::Confusion()) return made;
  const bool is_both = spacing.bias == 1;
  const char* name = is_both ? "bias_both" : "bias";
  throw usage_error(
      name, fmt::format("`{}` {:g} on Edge{} makes the shortest of its {} segments {:.2g} mm long: "
                        "use a ratio nearer to 1, or `segments` with a smaller number",
                        name, is_both ? spacing.bias_both : spacing.bias, edge.number, segments, shortest));
}

double PrescribedEdge::size_at(double share, double length) const {
  if (shares.empty()) return length / segments;
  const auto it = std::upper_bound(shares.begin() + 1, shares.end() - 1, share);
  return length * (*it - *(it - 1));
}

double PrescribedEdge::shortest(double length) const {
  double share = shares.empty() ? 1.0 / segments : 1;
  for (std::size_t i = 1; i < shares.size(); ++i) share = std::min(share, shares[i] - shares[i - 1]);
  return length * share;
}

PrescribedEdges prescribed_edges(const CadShape& shape, const SizingOptions& options, double size) {
  PrescribedEdges result(shape.edges.size());
  for (const auto& [number, spacing] : options.spacings) {
    const std::vector<EdgeId> pieces = pieces_of(shape, number);
    if (pieces.empty()) continue;
    int segments = spacing.segments;
    if (segments == 0) {
      const double cap = std::min(size, value_or(options.edge_sizes, number, size));
      double length = 0;
      for (const EdgeId piece : pieces) length += shape.edges[piece].length;
      segments = std::max(1, round_to_int(length / cap));
    }
    if (pieces.size() > 1 && (spacing.bias != 1 || spacing.bias_both != 1))
      throw usage_error("bias",
                        fmt::format("`bias` cannot be given on Edge{}, which a seam divides", number));
    if (segments < static_cast<int>(pieces.size()))
      throw usage_error(
          "segments",
          fmt::format("`segments` gives {} to Edge{}, which is in {} pieces: give at least one per piece",
                      segments, number, pieces.size()));
    const std::vector<int> counts = split_count(shape, pieces, segments);
    for (std::size_t i = 0; i < pieces.size(); ++i)
      result[pieces[i]] = PrescribedEdge::make(shape.edges[pieces[i]], counts[i], spacing);
  }
  return result;
}

}  // namespace quadrille
