/// Chooses the names of a CAD file that are worth a group, and makes them safe for all formats.

#include "geometry/cad/face_names.hpp"

#include <algorithm>
#include <boost/algorithm/string.hpp>
#include <cctype>
#include <regex>

#include "geometry/base/printable.hpp"

namespace quadrille {

namespace {

bool says_something(const std::string& name) {
  constexpr std::size_t longest = 80;
  const bool has_letter = std::any_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalpha(c) != 0 || c >= 0x80;  // or a letter beyond ASCII
  });
  return has_letter && name.size() <= longest && !boost::iequals(name, "none") &&
         !name.starts_with("Open CASCADE ");
}

}  // namespace

bool is_own_group(const std::string& name) {
  static const std::regex own("(Face|Edge|Vertex|SolidFace|Thickness)[0-9].*", std::regex::icase);
  return std::regex_match(name, own);
}

FaceNames names_of_groups(const FaceNames& in_file) {
  FaceNames result;
  for (const auto& [written, faces] : in_file) {
    std::string name = boost::trim_copy(printable(written, "_"));
    std::replace(name.begin(), name.end(), '"', '_');  // ends a name in .msh
    if (!says_something(name)) continue;
    if (is_own_group(name)) name.insert(0, "CAD_");
    result[name].insert(faces.begin(), faces.end());
  }
  return result;
}

}  // namespace quadrille
