/// Formats what is known of meshes and middle surfaces with fmt.

#include "mesher/command/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "geometry/base/place_text.hpp"
#include "geometry/base/whole_number.hpp"

namespace quadrille::command {

namespace {

/// "1 part", "2 parts".
std::string counted(int number, std::string_view name) {
  return fmt::format("{} {}{}", number, name, number == 1 ? "" : "s");
}

}  // namespace

std::string quality_table(const QualitySummary& summary) {
  std::string text;
  const auto line = [&](std::string_view label, const std::string& value) {
    text += fmt::format("{:<18} {}\n", label, value);
  };
  line("nodes", std::to_string(summary.nodes));
  line("quads", std::to_string(summary.quads));
  line("triangles", std::to_string(summary.triangles));
  line("q", fmt::format("min {:.3f}   mean {:.3f}", summary.q_min, summary.q_mean));
  line("scaled Jacobian", fmt::format("min {:.3f}   mean {:.3f}", summary.sj_min, summary.sj_mean));
  line("Jacobian / mean", fmt::format("min {:.3f}", summary.jacobian_min));
  line("inverted", std::to_string(summary.inverted));
  line("irregular nodes", fmt::format("{:.2f} %", summary.irregular_percent));
  line("aspect", fmt::format("mean {:.3f}   max {:.3f}", summary.aspect_mean, summary.aspect_max));
  line("warping", fmt::format("max {:.2f} degrees", summary.warping_max_degrees));
  line("edge length", fmt::format("min {:.4g}   median {:.4g}   max {:.4g}", summary.edge_min,
                                  summary.edge_median, summary.edge_max));
  return text;
}

std::string quality_histogram(const QualitySummary& summary) {
  constexpr int width = 50;
  const auto& bins = summary.q_histogram;
  const int largest = std::max(1, *std::max_element(bins.begin(), bins.end()));
  std::string text = "q           quads\n";
  for (std::size_t i = 0; i < bins.size(); ++i) {
    const double bin = 1.0 / static_cast<double>(bins.size());
    const double low = static_cast<double>(i) * bin;
    const int bar = round_to_int(static_cast<double>(bins[i]) * width / largest);
    text += fmt::format("{:.2f}-{:.2f} {:>10}", low, low + bin, bins[i]);
    text += bar > 0 ? fmt::format(" {:#<{}}\n", "", bar) : "\n";
  }
  return text;
}

std::string criteria_table(const CriteriaSummary& summary, const CriteriaLimits& limits) {
  const auto share = [&](int failing) {
    return fmt::format("{:>8} {:>8.3f} %", failing, 100.0 * failing / std::max(summary.quads, 1));
  };
  std::string text = fmt::format("{:<16} {:>8} {:>8} {:>10}\n", "criterion", "limit", "failing", "share");
  for (std::size_t i = 0; i < criterion_count; ++i) {
    const CriterionInfo& info = criteria_info[i];
    if (!std::isnan(limits.values[i]))
      text += fmt::format("{:<16} {:>8g} {}\n", info.name, limits.values[i], share(summary.failing_by[i]));
  }
  text += fmt::format("{:<25} {}\n{:<25} {}\n", "any", share(summary.failing), "outside: but warp, size",
                      share(summary.outside));
  for (const std::string& name : limits.not_measured) text += fmt::format("not measured: {}\n", name);
  if (summary.failing == 0) return text;
  text += "\nface          quads  failing\n";
  for (const auto& face : summary.faces)
    text += fmt::format("{:<11} {:>7} {:>8}\n", fmt::format("Face{}", face.face), face.quads, face.failing);
  text += "\nworst quads\n";
  for (const auto& quad : summary.worst) {
    const CriterionInfo& info = criteria_info[static_cast<std::size_t>(quad.criterion)];
    text += fmt::format("quad {} on Face{} at {}: {} {}\n", quad.quad + 1, quad.face, place_text(quad.center),
                        info.name, number_text(quad.value));
  }
  return text;
}

std::string valence_table(const QualitySummary& summary) {
  std::string text = "valence     nodes\n";
  for (std::size_t valence = 0; valence < summary.valence_counts.size(); ++valence)
    if (summary.valence_counts[valence] > 0)
      text += fmt::format("{:<9} {:>10}\n", valence, summary.valence_counts[valence]);
  return text;
}

std::string middle_table(const MidSurface& middle) {
  std::string text = fmt::format("{:<8} {:>12} {:>20}  {}\n", "face", "area", "thickness", "between");
  for (std::size_t i = 0; i < middle.faces.size(); ++i) {
    const MiddleFace& face = middle.faces[i];
    std::string thickness = fmt::format("{:.6g}", face.thickness);
    if (varies(face))
      thickness = fmt::format("{:.4g}..{:.4g} ({:.4g})", face.thinnest, face.thickest, face.thickness);
    text += fmt::format("Face{:<4} {:>12.6g} {:>20} ", i + 1, face.area, thickness);
    if (face.step) text += " a step between";
    for (const int number : face.solid_faces) text += fmt::format(" Face{}", number);
    if (face.fitted) text += fmt::format(", fitted within {:.2g}", face.off);
    text += "\n";
  }
  text += fmt::format(
      "area x thickness {:.6g} mm3, {:.2f} % of the volume ({:.2f} % without what counts twice where walls "
      "meet); {} of {}, {}\n",
      middle.shell_volume, 100 * middle.shell_volume / middle.volume,
      100 * (middle.shell_volume - middle.counted_twice) / middle.volume, counted(middle.parts, "part"),
      counted(middle.solids, "solid"), counted(middle.free_edges, "free edge"));
  if (!middle.unpaired.empty()) {
    text += "neither side nor rim of a wall:";
    for (const int number : middle.unpaired) text += fmt::format(" Face{}", number);
    text += "\n";
  }
  return text;
}

}  // namespace quadrille::command
