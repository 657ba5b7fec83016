/// Writes the trouble models as BREP files into a folder, for other programs to read.

#include <BRepTools.hxx>
#include <Standard_Failure.hxx>
#include <cstdio>

#include "tests/models/trouble_models.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: write_models FOLDER\n", stderr);
    return 2;
  }
  int failed = 0;
  for (const quadrille::TroubleModel& model : quadrille::trouble_models()) {
    const std::string path = std::string(argv[1]) + "/" + model.name + ".brep";
    try {
      if (BRepTools::Write(model.make(), path.c_str())) continue;
      std::fprintf(stderr, "cannot write %s\n", path.c_str());
    } catch (const Standard_Failure& problem) {
      std::fprintf(stderr, "%s: %s\n", model.name.c_str(), problem.GetMessageString());
    }
    ++failed;
  }
  return failed == 0 ? 0 : 1;
}
