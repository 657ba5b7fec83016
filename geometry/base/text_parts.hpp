#pragma once
/// Parts of texts from files and from users: words, fields, numbers. Internal.

#include <cctype>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace quadrille {

/// The text without blanks at its ends.
inline std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

inline std::string upper(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return result;
}

/// What stands between commas; one part more than there are commas.
inline std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> parts;
  for (std::size_t comma; (comma = text.find(',')) != std::string_view::npos; text.remove_prefix(comma + 1))
    parts.push_back(text.substr(0, comma));
  parts.push_back(text);
  return parts;
}

/// What stands before and after the first '='; the second is empty if there is none.
inline std::pair<std::string_view, std::string_view> sides_of_equals(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos) return {text, {}};
  return {text.substr(0, equals), text.substr(equals + 1)};
}

/// The number that the whole text is, without a plus sign; nothing if it is none.
template <class Number>
std::optional<Number> exactly(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// The same, with or without a plus sign.
template <class Number>
std::optional<Number> parsed(std::string_view text) {
  return exactly<Number>(!text.empty() && text.front() == '+' ? text.substr(1) : text);
}

}  // namespace quadrille
