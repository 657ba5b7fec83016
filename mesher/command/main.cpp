/// The `quadrille` command: quadrille mesh | recombine | info | quality.

#include "mesher/command/command.hpp"

int main(int argc, char** argv) {
  quadrille::command::tell_limits();
  return quadrille::command::run(argc, argv);
}
