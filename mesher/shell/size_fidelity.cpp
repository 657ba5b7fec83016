#include "mesher/shell/size_fidelity.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <utility>

namespace quadrille {

namespace {

constexpr int bins_a_factor = 4;        // of two
constexpr double histogram_low = 0.25;  // to its inverse
constexpr int bins = 4 * bins_a_factor;

SizeFidelity summary(std::vector<double> ratios) {
  SizeFidelity result;
  for (int bin = 0; bin < bins; ++bin)
    result.histogram.push_back({histogram_low * std::exp2(1.0 * bin / bins_a_factor),
                                histogram_low * std::exp2((bin + 1.0) / bins_a_factor), 0});
  result.sides = static_cast<int>(ratios.size());
  if (ratios.empty()) return result;
  int below = 0, above = 0;
  for (const double ratio : ratios) {
    below += ratio < SizeFidelity::low;
    above += ratio > SizeFidelity::high;
    const double place = std::floor(bins_a_factor * std::log2(ratio / histogram_low));
    ++result.histogram[static_cast<std::size_t>(std::clamp(place, 0.0, bins - 1.0))].count;
  }
  result.below_percent = 100.0 * below / result.sides;
  result.above_percent = 100.0 * above / result.sides;
  result.within_percent = 100 - result.below_percent - result.above_percent;
  const auto middle = ratios.begin() + result.sides / 2;
  std::nth_element(ratios.begin(), middle, ratios.end());
  result.median = *middle;
  return result;
}

}  // namespace

nlohmann::ordered_json SizeFidelity::json() const {
  nlohmann::ordered_json bars = nlohmann::ordered_json::array();
  for (const Bin& bin : histogram) bars.push_back({{"from", bin.from}, {"to", bin.to}, {"count", bin.count}});
  return {{"sides", sides},
          {"median", median},
          {"within_percent", within_percent},
          {"below_percent", below_percent},
          {"above_percent", above_percent},
          {"low", low},
          {"high", high},
          {"histogram", bars}};
}

SizeFidelity size_fidelity(const ShellMesh& mesh, const SizingField& field) {
  std::vector<std::pair<std::pair<int, int>, int>> sides;  // nodes, face
  for (std::size_t quad = 0; quad < mesh.quads.size(); ++quad) {
    for (int k = 0; k < 4; ++k) {
      const int a = mesh.quads[quad][k], b = mesh.quads[quad][(k + 1) % 4];
      sides.push_back({{std::min(a, b), std::max(a, b)}, mesh.quad_faces[quad]});
    }
  }
  std::sort(sides.begin(), sides.end());
  sides.erase(std::unique(sides.begin(), sides.end(),
                          [](const auto& one, const auto& other) { return one.first == other.first; }),
              sides.end());
  std::stable_sort(sides.begin(), sides.end(),
                   [](const auto& one, const auto& other) { return one.second < other.second; });
  std::optional<SizingField::Sampler> size_at;
  int face = 0;
  std::vector<double> ratios;
  for (const auto& [nodes, on] : sides) {
    if (on != face) size_at.emplace(field, on - 1);
    face = on;
    const Vector3 &a = mesh.points[nodes.first], &b = mesh.points[nodes.second];
    ratios.push_back((b - a).norm() / (*size_at)(0.5 * (a + b)));
  }
  return summary(std::move(ratios));
}

}  // namespace quadrille
