/// The `quadrille` command on Windows: arguments and output are UTF-8, files are read and written byte by
/// byte. As `quadrille isolated NAME ARGUMENTS...` it is the child that reads what may crash
/// (geometry/base/isolated_work_windows.cpp).

#include <windows.h>

#include <fcntl.h>
#include <io.h>
#include <shellapi.h>

#include <cstdio>
#include <ext/stdio_filebuf.h>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>
#include <vector>

#include "geometry/base/isolated_answer.hpp"
#include "geometry/cad/isolated_reading.hpp"
#include "geometry/sizing/size_file.hpp"
#include "geometry/sizing/vdb_module.hpp"
#include "mesher/command/command.hpp"

#undef _fmode
int _fmode = _O_BINARY;  // NOLINT: of all files that the C library opens

namespace {

std::vector<std::string> utf8_arguments() {
  int count = 0;
  wchar_t** const words = ::CommandLineToArgvW(::GetCommandLineW(), &count);
  std::vector<std::string> arguments;
  arguments.reserve(count);
  for (int i = 0; i < count; ++i) arguments.push_back(std::filesystem::path(words[i]).string());
  ::LocalFree(words);
  return arguments;
}

/// Answers on standard output, where nothing else that libraries print may get to.
int work_isolated(const std::string& name, const std::string& file) {
  ::SetErrorMode(SEM_FAILCRITICALERRORS | SEM_NOGPFAULTERRORBOX | SEM_NOOPENFILEERRORBOX);  // no boxes
  const int told = ::_dup(::_fileno(stdout)), nothing = ::_open("NUL", _O_WRONLY);
  ::_dup2(nothing, ::_fileno(stdout));
  ::_setmode(told, _O_BINARY);
  __gnu_cxx::stdio_filebuf<char> buffer(told, std::ios::out | std::ios::binary);
  std::ostream out(&buffer);
  quadrille::write_answer(
      file,
      [&](std::ostream& to) {
        if (name == "cad") quadrille::send_shape(file, to);
        if (name == "vdb") quadrille::opened_size_field(file);
      },
      out);
  return 0;
}

}  // namespace

int main() {
  for (std::FILE* stream : {stdin, stdout, stderr}) ::_setmode(::_fileno(stream), _O_BINARY);
  ::SetConsoleOutputCP(CP_UTF8);
  std::vector<std::string> arguments = utf8_arguments();
  if (arguments.size() == 4 && arguments[1] == "isolated") return work_isolated(arguments[2], arguments[3]);
  quadrille::command::tell_limits();
  std::vector<char*> words;
  words.reserve(arguments.size());
  for (std::string& argument : arguments) words.push_back(argument.data());
  return quadrille::command::run(static_cast<int>(words.size()), words.data());
}
