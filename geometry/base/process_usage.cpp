/// What getrusage(2) counts. The least of /proc/meminfo's available memory, what cgroup limits leave, and
/// what RLIMIT_AS leaves.

#include "geometry/base/process_usage.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace quadrille {

namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();

/// The number that a file holds; `unknown` if it holds none.
double number_in(const std::string& path) {
  double number = 0;
  return std::ifstream(path) >> number ? number : unknown;
}

double available_on_machine() {
  std::ifstream file("/proc/meminfo");
  for (std::string name; file >> name; file.ignore(std::numeric_limits<std::streamsize>::max(), '\n')) {
    double kilobytes = 0;
    if (name == "MemAvailable:" && file >> kilobytes) return 1024 * kilobytes;
  }
  return unknown;
}

/// What the memory limits of the process's control group and of its parent groups leave (cgroup version 2; a
/// container sees its own group as the root).
double left_in_group() {
  std::string group;
  std::ifstream file("/proc/self/cgroup");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("0::/", 0) == 0) group = line.substr(4);
  }
  double left = unknown;
  for (;;) {
    const std::string folder = "/sys/fs/cgroup/" + group + "/";
    const double most = number_in(folder + "memory.max"), used = number_in(folder + "memory.current");
    if (most < unknown && used < unknown) left = std::min(left, std::max(0.0, most - used));
    if (group.empty()) return left;
    const std::size_t slash = group.rfind('/');
    group.resize(slash == std::string::npos ? 0 : slash);
  }
}

double left_of_address_space() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unknown;
  const double used = number_in("/proc/self/statm") * static_cast<double>(::sysconf(_SC_PAGESIZE));
  return std::max(0.0, static_cast<double>(limit.rlim_cur) - used);
}

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

double free_memory() {
  return std::min({available_on_machine(), left_in_group(), left_of_address_space()});
}

ProcessUsage process_usage() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return {seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime),
          static_cast<std::int64_t>(usage.ru_maxrss) * 1024};  // Linux counts KiB
}

}  // namespace quadrille
