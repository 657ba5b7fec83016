/// Splits entries at commas and signs with std::string_view, and writes options back as the same text.

#include "mesher/size_entries.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <regex>
#include <set>
#include <stdexcept>
#include <string_view>
#include <type_traits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "geometry/base/number_rule.hpp"
#include "geometry/cad/face_names.hpp"
#include "mesher/mesh/entity_name.hpp"

namespace quadrille {

namespace {

using Shape = SizeRegion::Shape;

struct ShapeForm {
  Shape shape;
  std::string_view name;
  std::size_t numbers;
};
constexpr std::array<ShapeForm, 4> shape_forms{{{Shape::box, "box", 6},
                                                {Shape::sphere, "sphere", 4},
                                                {Shape::cylinder, "cylinder", 7},
                                                {Shape::half_space, "halfspace", 6}}};

[[noreturn]] void refuse(const std::string& what, const std::string& entry) {
  throw std::invalid_argument(fmt::format("takes {}, not '{}'", what, entry));
}

std::optional<double> number(std::string_view text) {
  const std::optional<double> value = exactly<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

/// Numbers separated by commas; empty if one of them is not a number.
std::vector<double> numbers(std::string_view text) {
  std::vector<double> values;
  for (const std::string_view part : split(text)) {
    const auto value = number(part);
    if (!value) return {};
    values.push_back(*value);
  }
  return values;
}

SizeRegion region(const std::string& entry) {
  constexpr const char* what =
      "box:x,y,z,x,y,z=SIZE, sphere:x,y,z,r=SIZE, cylinder:x,y,z,x,y,z,r=SIZE or "
      "halfspace:x,y,z,nx,ny,nz=SIZE, "
      "with an optional ,TRANSITION after SIZE";
  const std::size_t colon = entry.find(':'), equals = entry.find('=');
  if (colon == std::string::npos || equals == std::string::npos || equals < colon) refuse(what, entry);
  const std::string_view text = entry;
  const auto form = std::find_if(shape_forms.begin(), shape_forms.end(),
                                 [&](const ShapeForm& known) { return known.name == text.substr(0, colon); });
  const std::vector<double> place = numbers(text.substr(colon + 1, equals - colon - 1));
  const std::vector<double> sizes = numbers(text.substr(equals + 1));
  if (form == shape_forms.end() || place.size() != form->numbers || sizes.empty() || sizes.size() > 2)
    refuse(what, entry);
  if (!(sizes[0] > 0) || (sizes.size() == 2 && !(sizes[1] >= 0))) refuse("positive sizes", entry);
  SizeRegion result{form->shape, Vector3(place.data())};
  result.size = sizes[0];
  if (sizes.size() == 2) result.transition = sizes[1];
  if (form->numbers >= 6) result.b = Vector3(place.data() + 3);
  if (form->numbers != 6) result.radius = place.back();
  if (result.shape == Shape::box) {
    const Vector3 low = result.a.cwiseMin(result.b);
    result.b = result.a.cwiseMax(result.b);
    result.a = low;
  }
  if (form->numbers != 6 && !(result.radius > 0)) refuse("positive radii", entry);
  if (result.shape == Shape::cylinder && result.a == result.b) refuse("cylinders whose ends differ", entry);
  if (result.shape == Shape::half_space && result.b.isZero()) refuse("half-spaces with a direction", entry);
  return result;
}

std::string text_of(const SizeRegion& region) {
  const ShapeForm& form = shape_forms[static_cast<std::size_t>(region.shape)];
  std::vector<double> place{region.a.x(), region.a.y(), region.a.z()};
  if (form.numbers >= 6) place.insert(place.end(), {region.b.x(), region.b.y(), region.b.z()});
  if (form.numbers != 6) place.push_back(region.radius);
  const std::string text = fmt::format("{}:{}={}", form.name, fmt::join(place, ","), region.size);
  return region.transition > 0 ? text + fmt::format(",{}", region.transition) : text;
}

}  // namespace

void set_regions(SizingOptions& sizing, const Entries& entries) {
  sizing.regions.clear();
  for (const std::string& entry : entries) sizing.regions.push_back(region(entry));
}

Entries regions_of(const SizingOptions& sizing) {
  Entries entries;
  for (const SizeRegion& region : sizing.regions) entries.push_back(text_of(region));
  return entries;
}

void set_kept(SizingOptions& sizing, const Entries& entries) {
  sizing.kept_faces.clear();
  sizing.kept_edges.clear();
  for (const std::string& entry : entries) {
    for (const std::string_view name : split(entry)) {
      const auto [dimension, number] = entity_of(name);
      if (dimension < 1) refuse("faces and edges such as Edge7,Face3", entry);
      (dimension == 2 ? sizing.kept_faces : sizing.kept_edges).insert(number);
    }
  }
}

Entries kept_of(const SizingOptions& sizing) {
  Entries entries;
  for (const int face : sizing.kept_faces) entries.push_back(entity_name(2, face));
  for (const int edge : sizing.kept_edges) entries.push_back(entity_name(1, edge));
  return entries;
}

template <auto place>
void set_spacings(SizingOptions& sizing, const Entries& entries) {
  using Number = std::decay_t<decltype(EdgeSpacing().*place)>;
  constexpr bool counts = std::is_same_v<Number, int>;
  constexpr NumberRule rule = counts ? NumberRule{1, 1e6, false, true} : NumberRule{0.1, 10};
  constexpr const char* what = counts ? "whole numbers from 1 to a million such as Edge4=20"
                                      : "ratios between 0.1 and 10 such as Edge4=1.2";
  for (auto& [edge, spacing] : sizing.spacings) spacing.*place = EdgeSpacing().*place;
  std::set<int> names;
  for (const std::string& entry : entries) {
    for (const std::string_view part : split(entry)) {
      const auto [name, text] = sides_of_equals(part);
      const auto [dimension, edge] = entity_of(name);
      const auto value = number(text);
      if (dimension != 1 || !value || !rule.allows(*value)) refuse(what, std::string(part));
      if (!names.insert(edge).second) throw std::invalid_argument(fmt::format("names Edge{} twice", edge));
      sizing.spacings[edge].*place = static_cast<Number>(*value);
    }
  }
  std::erase_if(sizing.spacings, [](const auto& item) {  // those that prescribe nothing
    return item.second.segments == 0 && item.second.bias == 1 && item.second.bias_both == 1;
  });
}
template void set_spacings<&EdgeSpacing::segments>(SizingOptions&, const Entries&);
template void set_spacings<&EdgeSpacing::bias>(SizingOptions&, const Entries&);
template void set_spacings<&EdgeSpacing::bias_both>(SizingOptions&, const Entries&);

template <auto place>
Entries spacings_of(const SizingOptions& sizing) {
  Entries entries;
  for (const auto& [edge, spacing] : sizing.spacings)
    if (spacing.*place != EdgeSpacing().*place)
      entries.push_back(fmt::format("Edge{}={}", edge, spacing.*place));
  return entries;
}
template Entries spacings_of<&EdgeSpacing::segments>(const SizingOptions&);
template Entries spacings_of<&EdgeSpacing::bias>(const SizingOptions&);
template Entries spacings_of<&EdgeSpacing::bias_both>(const SizingOptions&);

void set_nodes(SizingOptions& sizing, const Entries& entries) {
  static const std::regex form("[A-Za-z][A-Za-z0-9_-]{0,59}");
  std::set<std::string> names;
  std::vector<NodePlace> nodes;
  for (const std::string& entry : entries) {
    const std::size_t place = entry.find('=') + 1;  // 0 if there is none
    const std::string name = entry.substr(0, place == 0 ? 0 : place - 1);
    const std::vector<double> at = numbers(std::string_view(entry).substr(place));
    if (at.size() != 3) refuse("places such as 10,0,2.5 or Tip=10,0,2.5", entry);
    if (place > 0 && (!std::regex_match(name, form) || is_own_group(name)))
      refuse("names of letters, digits, _ and - that no other group can have", name);
    if (!name.empty() && !names.insert(upper(name)).second)  // CalculiX ignores case
      throw std::invalid_argument(fmt::format("names {} twice", name));
    nodes.push_back({name, Vector3(at[0], at[1], at[2])});
  }
  sizing.nodes = std::move(nodes);
}

Entries nodes_of(const SizingOptions& sizing) {
  Entries entries;
  for (const auto& [name, point] : sizing.nodes)
    entries.push_back(
        fmt::format("{}{}{},{},{}", name, name.empty() ? "" : "=", point.x(), point.y(), point.z()));
  return entries;
}

void set_chord_error(SizingOptions& sizing, const std::string& text) {
  std::string_view digits = text;
  const bool share = !digits.empty() && digits.back() == '%';
  if (share) digits.remove_suffix(1);
  const auto value = number(digits);
  if (!value || !(*value > 0))
    refuse("a positive length such as 0.05 or a share of the size such as 2%", text);
  sizing.chord_error = share ? ChordError{0, 0.01 * *value} : ChordError{*value, 0};
}

std::string chord_error_of(const SizingOptions& sizing) {
  if (sizing.chord_error.share > 0) return fmt::format("{}%", 100 * sizing.chord_error.share);
  return sizing.chord_error.length > 0 ? fmt::format("{}", sizing.chord_error.length) : std::string();
}

}  // namespace quadrille
