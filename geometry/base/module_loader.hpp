#pragma once
/// Shared objects of ours that are opened on demand, since loading the libraries behind them costs more time
/// than meshing a small part.

#include <string>

#include "geometry/base/error.hpp"

/// Makes a module's function visible.
#define QUADRILLE_EXPORT extern "C" __attribute__((visibility("default")))

namespace quadrille {

/// An open module. It stays open until the program ends: VTK and HDF5 do not survive being unloaded.
class Module {
 public:
  /// Opens lib<prefix>.so of the folder of the program or library that holds this code or, where it is not
  /// there, of the folder that modules are installed to: never from the current folder. The environment
  /// variable QUADRILLE_MODULES, a whole path, names another folder, which is then the only one. Throws Error
  /// (failure) when it is missing or of another version.
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

/// Each module exports <prefix>_version of this type; it gives the QUADRILLE_VERSION that it was built with.
using ModuleVersionFunction = const char*();

}  // namespace quadrille
