#pragma once
/// CPU time and memory that this process has used, and the memory that it may still take.

#include <cstdint>

namespace quadrille {

struct ProcessUsage {
  double cpu_seconds = 0;       ///< user and system time of all threads
  std::int64_t peak_bytes = 0;  ///< largest resident memory
};

/// The usage since the process began.
ProcessUsage process_usage();

/// Bytes: the least of the memory available on the machine, what the control group's limit leaves, and what
/// the limit on the address space (ulimit -v) leaves. Infinite where none of these is known.
double free_memory();

}  // namespace quadrille
