/// Decodes UTF-8 (RFC 3629) by character, since bytes of harmless characters look like control characters.

#include "geometry/base/printable.hpp"

#include <fmt/format.h>
#include <boost/locale/utf.hpp>

#include <cstddef>
#include <cstdint>

namespace quadrille {

namespace {

bool is_obeyed(std::uint32_t code) {
  const auto between = [&](std::uint32_t low, std::uint32_t high) { return code >= low && code <= high; };
  const bool controls = code < ' ' || between(0x7f, 0x9f), breaks = between(0x2028, 0x2029);
  const bool turns =
      between(0x200e, 0x200f) || between(0x202a, 0x202e) || between(0x2066, 0x2069) || code == 0x61c;
  return controls || breaks || turns;
}

}  // namespace

std::string printable(std::string_view text, std::string_view stand_in, char kept) {
  namespace utf = boost::locale::utf;
  std::string result;
  while (!text.empty()) {
    const char* next = text.data();
    const std::uint32_t code = utf::utf_traits<char>::decode(next, next + text.size());
    const bool is_utf8 = utf::is_valid_codepoint(code);
    const std::size_t bytes = is_utf8 ? static_cast<std::size_t>(next - text.data()) : 1;
    const bool stays = kept != 0 && text.front() == kept;
    if (stays || (is_utf8 && !is_obeyed(code)))
      result += text.substr(0, bytes);
    else if (!stand_in.empty())
      result += stand_in;
    else if (bytes == 1)
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(text.front()));
    else
      result += fmt::format("\\u{:04x}", code);
    text.remove_prefix(bytes);
  }
  return result;
}

}  // namespace quadrille
