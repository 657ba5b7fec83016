/// The `quadrille` command. Its subcommands are added in run.cpp.

#include "mesher/command/command.hpp"

int main(int argc, char** argv) {
  quadrille::command::tell_limits();
  return quadrille::command::run(argc, argv);
}
