/// Decodes UTF-8 (RFC 3629) by character, since bytes of harmless characters look like control characters.

#include "geometry/base/printable.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

#include <fmt/format.h>

namespace quadrille {

namespace {

struct Character {
  std::uint32_t code = 0;
  std::size_t bytes = 0;  ///< 0 = not UTF-8
};

/// The first character of a text that is not empty.
Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 0x80) return {byte(0), 1};
  constexpr std::array<std::uint32_t, 5> least_code{0, 0, 0x80, 0x800, 0x10000};  // by number of bytes
  const std::size_t bytes = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : 2;
  if (byte(0) < 0xc0 || byte(0) > 0xf7 || text.size() < bytes) return {};
  std::uint32_t code = byte(0) & (0x7fU >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xc0U) != 0x80) return {};
    code = code << 6U | (byte(i) & 0x3fU);
  }
  const bool is_surrogate = code >= 0xd800 && code <= 0xdfff;
  if (code < least_code[bytes] || code > 0x10ffff || is_surrogate) return {};
  return {code, bytes};
}

bool is_obeyed(std::uint32_t code) {
  const auto between = [&](std::uint32_t low, std::uint32_t high) { return code >= low && code <= high; };
  const bool controls = code < ' ' || between(0x7f, 0x9f), breaks = between(0x2028, 0x2029);
  const bool turns =
      between(0x200e, 0x200f) || between(0x202a, 0x202e) || between(0x2066, 0x2069) || code == 0x61c;
  return controls || breaks || turns;
}

}  // namespace

std::string printable(std::string_view text, std::string_view stand_in, char kept) {
  std::string result;
  while (!text.empty()) {
    const Character character = first_character(text);
    const std::size_t bytes = character.bytes == 0 ? 1 : character.bytes;
    const bool stays = kept != 0 && text.front() == kept;
    if (stays || (character.bytes > 0 && !is_obeyed(character.code)))
      result += text.substr(0, bytes);
    else if (!stand_in.empty())
      result += stand_in;
    else if (bytes == 1)
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(text.front()));
    else
      result += fmt::format("\\u{:04x}", character.code);
    text.remove_prefix(bytes);
  }
  return result;
}

}  // namespace quadrille
