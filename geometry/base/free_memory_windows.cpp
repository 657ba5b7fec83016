/// What GlobalMemoryStatusEx counts: physical memory, and what can still be committed with the paging file.

#include <windows.h>

#include <algorithm>
#include <limits>

#include "geometry/base/free_memory.hpp"

namespace quadrille {

double free_memory() {
  MEMORYSTATUSEX status{};
  status.dwLength = sizeof status;
  if (!::GlobalMemoryStatusEx(&status)) return std::numeric_limits<double>::infinity();
  return static_cast<double>(
      std::min({status.ullAvailPhys, status.ullAvailPageFile, status.ullAvailVirtual}));
}

}  // namespace quadrille
