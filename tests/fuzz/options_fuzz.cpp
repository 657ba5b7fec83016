/// Any arguments (one a line) given to the command end in an exit code, nothing else.

#include <fcntl.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "mesher/command/command.hpp"

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  // What the command prints goes nowhere; the fuzzer and the sanitizers keep their own way to the terminal.
  const int nowhere = ::open("/dev/null", O_WRONLY);
  ::dup2(nowhere, STDOUT_FILENO);
  // Nothing there to read or to spoil.
  std::string folder = "/dev/shm/quadrille-fuzz-XXXXXX";
  if (::mkdtemp(folder.data()) == nullptr || ::chdir(folder.c_str()) != 0) std::abort();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::string> arguments{"quadrille", ""};
  for (std::size_t i = 0; i < size; ++i) {
    if (data[i] == '\n') {
      arguments.emplace_back();
    } else if (data[i] != 0 && data[i] != '/') {  // no path out of the folder
      arguments.back().push_back(static_cast<char>(data[i]));
    }
  }
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  const int code = quadrille::command::run(static_cast<int>(arguments.size()), argv.data());
  if (code < 0 || code > 2) std::abort();
  return 0;
}
