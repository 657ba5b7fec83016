/// Writes the trouble models and the thin ones as BREP files into a folder, for other programs to read.

#include <BRepTools.hxx>
#include <Standard_Failure.hxx>
#include <cstdio>
#include <functional>

#include "tests/models/thin_models.hpp"
#include "tests/models/trouble_models.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: write_models FOLDER\n", stderr);
    return 2;
  }
  int failed = 0;
  const auto write = [&](const std::string& name, const std::function<TopoDS_Shape()>& make) {
    const std::string path = std::string(argv[1]) + "/" + name + ".brep";
    try {
      if (BRepTools::Write(make(), path.c_str())) return;
      std::fprintf(stderr, "cannot write %s\n", path.c_str());
    } catch (const Standard_Failure& problem) {
      std::fprintf(stderr, "%s: %s\n", name.c_str(), problem.GetMessageString());
    }
    ++failed;
  };
  for (const quadrille::TroubleModel& model : quadrille::trouble_models()) write(model.name, model.make);
  for (const quadrille::ThinModel& model : quadrille::thin_models()) write("thin_" + model.name, model.make);
  for (const quadrille::CantileverModel& model : quadrille::cantilevers()) {
    write("section_" + model.name, [&] { return quadrille::section(model.outlines); });
    write("cantilever_" + model.name, [&] { return quadrille::profile(model.outlines, model.length); });
  }
  write("thick_block", quadrille::thick_block);
  write("plate_on_block", [] { return quadrille::plate_on_block(); });
  write("ribbed_plate_200", [] { return quadrille::ribbed_plate(6); });
  return failed == 0 ? 0 : 1;
}
