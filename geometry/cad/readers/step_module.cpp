/// The module libquadrille_step.so: reads and writes STEP.

#include <STEPControl_Reader.hxx>
#include <STEPControl_Writer.hxx>

#include "geometry/cad/readers/transfer.hpp"

QUADRILLE_EXPORT const char* quadrille_step_version() {
  return QUADRILLE_VERSION;
}

QUADRILLE_EXPORT std::string quadrille_step_read(const std::string& path, TopoDS_Shape& shape) {
  return quadrille::transfer<STEPControl_Reader>(path, "STEP", shape);
}

QUADRILLE_EXPORT std::string quadrille_step_write(const std::string& path, const TopoDS_Shape& shape) {
  try {
    STEPControl_Writer writer;
    Interface_Static::SetCVal("write.step.unit", "MM");
    if (writer.Transfer(shape, STEPControl_AsIs) == IFSelect_RetDone &&
        writer.Write(path.c_str()) == IFSelect_RetDone)
      return {};
    return fmt::format("{} could not be written as STEP", path);
  } catch (const Standard_Failure& problem) {
    return fmt::format("{} could not be written as STEP ({})", path, problem.GetMessageString());
  }
}
