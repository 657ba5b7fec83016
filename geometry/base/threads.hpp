#pragma once
/// How many threads oneTBB's loops use. Internal.

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <thread>
#include <utility>

namespace quadrille {

/// Calls `work` where oneTBB's loops use so many threads; 0 = all cores.
template <class Work>
auto on_threads(int threads, Work&& work) {
  if (threads <= 0) threads = static_cast<int>(std::thread::hardware_concurrency());
  // Without it oneTBB warns when more threads are asked for than there are cores.
  const oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism, threads);
  oneapi::tbb::task_arena arena(threads);
  return arena.execute(std::forward<Work>(work));
}

}  // namespace quadrille
