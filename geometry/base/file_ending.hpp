#pragma once
/// The ending of a file name, which determines the file's format.

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace quadrille {

/// The ending in lower case: ".msh" for "PART.MSH".
inline std::string lower_ending(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

}  // namespace quadrille
