#pragma once
/// CPU time and memory that this process has used.

#include <cstdint>

namespace quadrille {

struct ProcessUsage {
  double cpu_seconds = 0;       ///< user and system time of all threads
  std::int64_t peak_bytes = 0;  ///< largest resident memory
};

/// The usage since the process began.
ProcessUsage process_usage();

}  // namespace quadrille
