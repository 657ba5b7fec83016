/// Any bytes given as a .vdb size field make a sizing field or one Error, nothing else.

#include "geometry/base/error.hpp"
#include "geometry/base/execution_context.hpp"
#include "geometry/cad/cad_model.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "tests/fuzz/memory_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace quadrille;
  static fuzz::MemoryFile file(".vdb");
  static const CadModel model = CadModel::read(QUADRILLE_SOURCE_DIR "/examples/models/box.brep");
  file.fill(data, size);
  SizingOptions options;
  options.size = 4;
  options.size_field = file.path();
  ExecutionContext context(1);
  context.limit_time(5);
  try {
    SizingField::build(model, options, context);
  } catch (const Error&) {
  }
  return 0;
}
