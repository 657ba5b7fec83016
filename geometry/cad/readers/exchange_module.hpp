#pragma once
/// The functions of the STEP and IGES modules.

#include <TopoDS_Shape.hxx>
#include <ostream>
#include <string>

#include "geometry/cad/face_names.hpp"

namespace quadrille {

/// Type of <prefix>_read. Returns an empty string, or a sentence that says what went wrong.
using ExchangeReadFunction = std::string(const std::string& path, NamedShape& read);

/// Type of <prefix>_write. Returns an empty string, or a sentence that says what went wrong.
using ExchangeWriteFunction = std::string(const TopoDS_Shape& shape, std::ostream& out);

}  // namespace quadrille
