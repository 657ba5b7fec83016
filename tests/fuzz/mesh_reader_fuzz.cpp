/// Any bytes given to a mesh reader (read_msh or read_inp) make a mesh or one Error, nothing else; any
/// options make quads of its triangles or one Error.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/base/error.hpp"
#include "geometry/base/execution_context.hpp"
#include "mesher/io/readers.hpp"
#include "mesher/shell/from_triangles.hpp"
#include "tests/fuzz/option_bytes.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace quadrille;
  const fuzz::OptionBytes input(data, size);
  ExecutionContext context(1);
  context.limit_time(5);
  std::vector<std::string> notes;
  try {
    const ShellMesh read = FUZZ_READER({reinterpret_cast<const char*>(input.data()), input.size()}, "fuzz");
    quads_from_triangles(read, input.recombining(), notes, context);
  } catch (const Error&) {
  }
  return 0;
}
