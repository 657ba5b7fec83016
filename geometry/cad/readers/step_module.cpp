/// The module libquadrille_step.so: reads STEP.

#include <STEPControl_Reader.hxx>

#include "geometry/cad/readers/exchange_module.hpp"

QUADRILLE_EXPORT const char* quadrille_step_version() {
  return QUADRILLE_VERSION;
}

QUADRILLE_EXPORT std::string quadrille_step_read(const std::string& path, TopoDS_Shape& shape) {
  return quadrille::transfer<STEPControl_Reader>(path, "STEP", shape);
}
