/// Any bytes given as a CAD file make a model or one Error, nothing else, when read in a child process; any
/// options make a mesh of it or one Error. With QUADRILLE_FUZZ_DIRECT=1 files are read in this process: then
/// OpenCASCADE's own crashes end the fuzzer.

#include <cstdlib>

#include "geometry/base/error.hpp"
#include "geometry/base/execution_context.hpp"
#include "geometry/cad/cad_model.hpp"
#include "mesher/quadrille.hpp"
#include "tests/fuzz/memory_file.hpp"
#include "tests/fuzz/option_bytes.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace quadrille;
  static fuzz::MemoryFile file(FUZZ_ENDING);
  static const bool direct = std::getenv("QUADRILLE_FUZZ_DIRECT") != nullptr;
  const fuzz::OptionBytes input(data, size);
  file.fill(input.data(), input.size());
  ExecutionContext context(1);
  context.limit_time(5);
  try {
    mesh(CadModel::read(file.path(), {!direct, &context}), input.meshing(), context);
  } catch (const Error&) {
  }
  return 0;
}
