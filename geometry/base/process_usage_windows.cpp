/// What GetProcessTimes and GetProcessMemoryInfo count for this process.

#include <windows.h>

#include <psapi.h>

#include "geometry/base/process_usage.hpp"

namespace quadrille {

namespace {

double seconds_of(const FILETIME& time) {
  constexpr double tick = 1e-7, high = 4294967296.0;
  return tick * (high * time.dwHighDateTime + time.dwLowDateTime);
}

}  // namespace

ProcessUsage process_usage() {
  FILETIME begun{}, ended{}, kernel{}, user{};
  PROCESS_MEMORY_COUNTERS memory{};
  ::GetProcessTimes(::GetCurrentProcess(), &begun, &ended, &kernel, &user);
  ::GetProcessMemoryInfo(::GetCurrentProcess(), &memory, sizeof memory);
  return {seconds_of(kernel) + seconds_of(user), static_cast<std::int64_t>(memory.PeakWorkingSetSize)};
}

}  // namespace quadrille
