#pragma once
/// How many threads oneTBB's loops use. Internal.

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <utility>

namespace quadrille {

/// The number of threads that can run at once: as many as wanted (0 = all cores), but no more than there are
/// cores or than the system lets this process create (a limit on processes or memory), and at least one.
int usable_threads(int wanted);

/// How many of the wanted threads, including this one, the system lets this process have at once now.
int makeable_threads(int wanted);

/// Calls `work` with oneTBB's loops limited to usable_threads(threads) threads.
template <class Work>
auto on_threads(int threads, Work&& work) {
  threads = usable_threads(threads);
  const oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism, threads);
  oneapi::tbb::task_arena arena(threads);
  return arena.execute(std::forward<Work>(work));
}

}  // namespace quadrille
