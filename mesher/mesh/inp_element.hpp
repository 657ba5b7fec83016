#pragma once
/// The types of elements that .inp files (Abaqus, CalculiX) can give to quads.

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

namespace quadrille {

/// Element type of the quads in .inp files.
enum class InpElement {
  shell,  ///< S4, at second order S8R
  s8r,
  s8,
  s4,
  s4r,
  cps4,
  cps4r,
  cps8,
  cps8r,
  cpe4,
  cpe4r,
  cpe8,
  cpe8r,
  cax4,
  cax4r,
  cax8,
  cax8r,
  m3d4,
  m3d4r,
  m3d8,
  m3d8r
};

/// What an element stands for.
enum class InpFamily { shell, plane_stress, plane_strain, axisymmetric, membrane };

/// The types with their names, which are those of the files but for `shell`.
inline constexpr std::pair<InpElement, std::string_view> inp_elements[] = {
    {InpElement::shell, "shell"}, {InpElement::s8r, "S8R"},     {InpElement::s8, "S8"},
    {InpElement::s4, "S4"},       {InpElement::s4r, "S4R"},     {InpElement::cps4, "CPS4"},
    {InpElement::cps4r, "CPS4R"}, {InpElement::cps8, "CPS8"},   {InpElement::cps8r, "CPS8R"},
    {InpElement::cpe4, "CPE4"},   {InpElement::cpe4r, "CPE4R"}, {InpElement::cpe8, "CPE8"},
    {InpElement::cpe8r, "CPE8R"}, {InpElement::cax4, "CAX4"},   {InpElement::cax4r, "CAX4R"},
    {InpElement::cax8, "CAX8"},   {InpElement::cax8r, "CAX8R"}, {InpElement::m3d4, "M3D4"},
    {InpElement::m3d4r, "M3D4R"}, {InpElement::m3d8, "M3D8"},   {InpElement::m3d8r, "M3D8R"}};

/// The name of a type, such as "CPS8".
inline std::string_view name_of(InpElement element) {
  return std::find_if(std::begin(inp_elements), std::end(inp_elements),
                      [&](const auto& pair) { return pair.first == element; })
      ->second;
}

/// The order that the mesh must have: 1 or 2; 0 = any.
inline int order_of(InpElement element) {
  if (element == InpElement::shell) return 0;
  return name_of(element).find('8') == std::string_view::npos ? 1 : 2;
}

/// The kind of analysis that a type of elements is for.
inline InpFamily family_of(InpElement element) {
  const std::string_view name = name_of(element);
  if (name.starts_with("CPS")) return InpFamily::plane_stress;
  if (name.starts_with("CPE")) return InpFamily::plane_strain;
  if (name.starts_with("CAX")) return InpFamily::axisymmetric;
  return name.starts_with("M3D") ? InpFamily::membrane : InpFamily::shell;
}

/// Whether solvers take the element only in the plane z = 0.
inline bool lies_in_plane(InpElement element) {
  const InpFamily family = family_of(element);
  return family != InpFamily::shell && family != InpFamily::membrane;
}

}  // namespace quadrille
