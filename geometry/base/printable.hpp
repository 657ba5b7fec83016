#pragma once
/// File names, which may contain any byte except '/' and 0, made safe for text that is read line by line.

#include <algorithm>
#include <string>

namespace quadrille {

/// The text with every control character replaced by `stand_in`, so that it is always one line.
inline std::string printable(std::string text, char stand_in = '?') {
  constexpr unsigned char first = ' ', erase = 0x7f;
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < first || c == erase; }, stand_in);
  return text;
}

}  // namespace quadrille
