#pragma once
/// What the STEP and IGES modules share.

#include <IFSelect_ReturnStatus.hxx>
#include <Interface_Static.hxx>
#include <Standard_Failure.hxx>
#include <TopoDS_Shape.hxx>
#include <string>

#include <fmt/format.h>

#include "geometry/base/module_loader.hpp"

namespace quadrille {

/// Type of <prefix>_read: an empty string, or the sentence that says what went wrong.
using ExchangeReadFunction = std::string(const std::string& path, TopoDS_Shape& shape);

/// Type of <prefix>_write: an empty string, or the sentence that says what went wrong.
using ExchangeWriteFunction = std::string(const std::string& path, const TopoDS_Shape& shape);

template <class Reader>
std::string transfer(const std::string& path, const char* format, TopoDS_Shape& shape) {
  try {
    Reader reader;
    Interface_Static::SetCVal("xstep.cascade.unit", "MM");
    if (reader.ReadFile(path.c_str()) != IFSelect_RetDone) {
      return fmt::format("{} is not a readable {} file", path, format);
    }
    reader.TransferRoots();
    shape = reader.OneShape();
    return {};
  } catch (const Standard_Failure& problem) {
    return fmt::format("{} could not be read as {} ({})", path, format, problem.GetMessageString());
  }
}

}  // namespace quadrille
