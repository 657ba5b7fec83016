#pragma once
/// How many threads oneTBB's loops use. Internal.

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <utility>

namespace quadrille {

/// The threads that can work at once here: as many as asked for (0 = all cores), no more than there are cores
/// or than the system lets this process make (a limit on processes or memory), and one at least.
int usable_threads(int wanted);

/// How many of so many threads, this one among them, the system lets this process have at once now.
int makeable_threads(int wanted);

/// Calls `work` where oneTBB's loops use so many threads, or as many as there can be; 0 = all cores.
template <class Work>
auto on_threads(int threads, Work&& work) {
  threads = usable_threads(threads);
  const oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism, threads);
  oneapi::tbb::task_arena arena(threads);
  return arena.execute(std::forward<Work>(work));
}

}  // namespace quadrille
