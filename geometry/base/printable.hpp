#pragma once
/// Names of files, which may hold any byte but '/' and 0, in text that others read line by line.

#include <algorithm>
#include <string>

namespace quadrille {

/// The text with the stand-in for each control character: one line, whatever it is made of.
inline std::string printable(std::string text, char stand_in = '?') {
  constexpr unsigned char first = ' ', erase = 0x7f;
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < first || c == erase; }, stand_in);
  return text;
}

}  // namespace quadrille
