#pragma once
/// A key for a side of a mesh, the same for both directions. Internal.

#include <algorithm>
#include <cstdint>

namespace quadrille {

inline std::uint64_t side_key(int a, int b) {
  return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | static_cast<std::uint32_t>(std::max(a, b));
}

}  // namespace quadrille
