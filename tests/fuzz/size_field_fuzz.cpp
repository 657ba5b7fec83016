/// Any bytes given as a .vdb size field make a sizing field or one Error, nothing else, with any options.

#include "geometry/base/error.hpp"
#include "geometry/base/execution_context.hpp"
#include "geometry/cad/cad_model.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "tests/fuzz/memory_file.hpp"
#include "tests/fuzz/option_bytes.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace quadrille;
  static fuzz::MemoryFile file(".vdb");
  static const CadModel model = CadModel::read(QUADRILLE_SOURCE_DIR "/examples/models/box.brep");
  const fuzz::OptionBytes input(data, size);
  file.fill(input.data(), input.size());
  SizingOptions options = input.sizing();
  options.size_field = file.path();
  ExecutionContext context(1);
  context.limit_time(5);
  try {
    SizingField::build(model, options, context);
  } catch (const Error&) {
  }
  return 0;
}
