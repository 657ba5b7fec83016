/// Any bytes given to a mesh reader (read_msh or read_inp) make a mesh or one Error, nothing else.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "geometry/base/error.hpp"
#include "mesher/io/readers.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    quadrille::FUZZ_READER({reinterpret_cast<const char*>(data), size}, "fuzz");
  } catch (const quadrille::Error&) {
  }
  return 0;
}
