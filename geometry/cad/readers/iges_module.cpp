/// The module libquadrille_iges.so: reads IGES.

#include <IGESControl_Reader.hxx>

#include "geometry/cad/readers/transfer.hpp"

QUADRILLE_EXPORT const char* quadrille_iges_version() {
  return QUADRILLE_VERSION;
}

QUADRILLE_EXPORT std::string quadrille_iges_read(const std::string& path, quadrille::NamedShape& read) {
  return quadrille::transfer<IGESControl_Reader>(path, "IGES", read,
                                                 [](const auto&...) { return quadrille::FaceNames(); });
}
