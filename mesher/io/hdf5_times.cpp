#include "mesher/io/hdf5_times.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace quadrille {

namespace {

/// Numbers are stored with the least significant byte first.
std::uint64_t number_at(std::string_view bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

/// The checksum that HDF5 stores after its object headers. Based on: Bob Jenkins, lookup3, hashlittle().
std::uint32_t checksum(std::string_view bytes) {
  const auto initial = static_cast<std::uint32_t>(0xdeadbeef + bytes.size());
  std::uint32_t a = initial, b = initial, c = initial;
  const auto add = [&](std::string_view block) {
    std::array<char, 12> padded{};
    std::copy(block.begin(), block.end(), padded.begin());
    const std::string_view words(padded.data(), padded.size());
    a += static_cast<std::uint32_t>(number_at(words.substr(0, 4)));
    b += static_cast<std::uint32_t>(number_at(words.substr(4, 4)));
    c += static_cast<std::uint32_t>(number_at(words.substr(8, 4)));
  };
  for (; bytes.size() > 12; bytes.remove_prefix(12)) {
    add(bytes.substr(0, 12));
    a = (a - c) ^ std::rotl(c, 4), c += b;
    b = (b - a) ^ std::rotl(a, 6), a += c;
    c = (c - b) ^ std::rotl(b, 8), b += a;
    a = (a - c) ^ std::rotl(c, 16), c += b;
    b = (b - a) ^ std::rotl(a, 19), a += c;
    c = (c - b) ^ std::rotl(b, 4), b += a;
  }
  if (bytes.empty()) return c;
  add(bytes);
  c = (c ^ b) - std::rotl(b, 14);
  a = (a ^ c) - std::rotl(c, 11);
  b = (b ^ a) - std::rotl(a, 25);
  c = (c ^ b) - std::rotl(b, 16);
  a = (a ^ c) - std::rotl(c, 4);
  b = (b ^ a) - std::rotl(a, 14);
  return (c ^ b) - std::rotl(b, 24);
}

constexpr std::string_view signature = "OHDR";
constexpr std::size_t flags_at = 5, times_at = 6, length_of_times = 16, length_of_checksum = 4;

/// Length, without its checksum, of the object header at the start of the bytes; 0 = no header with times.
std::size_t header_length(std::string_view bytes) {
  constexpr unsigned has_times = 1 << 5, has_attribute_limits = 1 << 4;
  constexpr std::size_t longest_fixed_part = times_at + length_of_times + 4 + 8;
  if (bytes.size() < longest_fixed_part || bytes[signature.size()] != 2) return 0;
  const auto flags = static_cast<unsigned char>(bytes[flags_at]);
  if (!(flags & has_times)) return 0;
  const std::size_t size_at = times_at + length_of_times + (flags & has_attribute_limits ? 4 : 0);
  const std::size_t width = std::size_t{1} << (flags & 3);
  const std::uint64_t messages = number_at(bytes.substr(size_at, width));
  const std::size_t begin = size_at + width;
  return messages < bytes.size() && begin + messages + length_of_checksum <= bytes.size() ? begin + messages
                                                                                          : 0;
}

}  // namespace

void clear_times(std::string& file) {
  for (std::size_t at = 0; (at = file.find(signature, at)) != std::string::npos; at += signature.size()) {
    const std::string_view header(file.data() + at, header_length(std::string_view(file).substr(at)));
    if (header.empty()) continue;
    // The signature may also occur in data; a matching checksum rules that out.
    char* const end = file.data() + at + header.size();
    if (number_at({end, length_of_checksum}) != checksum(header)) continue;
    std::memset(file.data() + at + times_at, 0, length_of_times);
    std::uint32_t sum = checksum(header);
    for (std::size_t i = 0; i < length_of_checksum; ++i, sum >>= 8) end[i] = static_cast<char>(sum & 0xff);
  }
}

}  // namespace quadrille
