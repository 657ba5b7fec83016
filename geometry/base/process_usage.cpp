/// What getrusage(2) counts for this process.

#include "geometry/base/process_usage.hpp"

#include <sys/resource.h>

namespace quadrille {

namespace {

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

ProcessUsage process_usage() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return {seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime),
          static_cast<std::int64_t>(usage.ru_maxrss) * 1024};  // Linux counts KiB
}

}  // namespace quadrille
