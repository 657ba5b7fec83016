#pragma once
/// Our own shared objects, opened on demand: loading their libraries takes longer than meshing a small part.

#include <string>

#include "geometry/base/api.hpp"
#include "geometry/base/error.hpp"

/// Exports a function of a module.
#define QUADRILLE_EXPORT extern "C" QUADRILLE_API

namespace quadrille {

/// An open module. It stays open until the program ends, since VTK and HDF5 cannot be unloaded safely.
class Module {
 public:
  /// Opens lib<prefix>.so in the folder of the program or library that contains this code. If it is not
  /// there, opens it in the folder that modules are installed to, never in the current folder. The
  /// environment variable QUADRILLE_MODULES, an absolute path, names another folder, which is then the only
  /// one searched. Throws Error (failure) when the module is missing or of another version.
  explicit Module(const std::string& prefix);

  /// The function <prefix><name>, exported with C linkage. Throws Error (failure) when the module lacks it.
  template <class Function>
  Function* function(const std::string& name) const {
    return reinterpret_cast<Function*>(symbol(name));
  }

 private:
  void* symbol(const std::string& name) const;
  Error mismatch() const;

  std::string prefix_, file_;
  void* handle_ = nullptr;
};

/// Each module exports <prefix>_version of this type. It returns the QUADRILLE_VERSION of the module's build.
using ModuleVersionFunction = const char*();

}  // namespace quadrille
