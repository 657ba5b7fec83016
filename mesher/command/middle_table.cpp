/// Formats a line for each face, and the sum of area times thickness beside the volume.

#include "mesher/command/middle_table.hpp"

#include <fmt/format.h>

#include <string_view>

namespace quadrille::command {

namespace {

/// "1 part", "2 parts".
std::string counted(int number, std::string_view name) {
  return fmt::format("{} {}{}", number, name, number == 1 ? "" : "s");
}

}  // namespace

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
