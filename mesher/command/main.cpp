/// The `quadrille` command: quadrille mesh | recombine | info | quality.

#include <csignal>

#include "mesher/command/command.hpp"

int main(int argc, char** argv) {
  // A reader that goes away, and a limit on the size of files, show as a failed write, with its sentence.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  return quadrille::command::run(argc, argv);
}
