#pragma once
/// What this process has used of the machine.

#include <cstdint>

namespace quadrille {

struct ProcessUsage {
  double cpu_seconds = 0;       ///< of all threads, in the program and in the system for it
  std::int64_t peak_bytes = 0;  ///< the most memory that was resident at a time
};

/// Since the process began.
ProcessUsage process_usage();

}  // namespace quadrille
