#pragma once
/// How many threads oneTBB's loops use. Internal.

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_scheduler_observer.h>

#include <utility>

namespace quadrille {

/// The number of threads that can run at once: as many as wanted (0 = all cores), but no more than there are
/// cores or than the system lets this process create (a limit on processes or memory), and at least one.
int usable_threads(int wanted);

/// How many of the wanted threads, including this one, the system lets this process have at once now.
int makeable_threads(int wanted);

/// From now on each thread that works for on_threads() calls `prepare` first. Null = nothing.
void prepare_threads(void (*prepare)());

/// Calls what prepare_threads() was given on each thread that enters an arena.
class ThreadPreparation : public oneapi::tbb::task_scheduler_observer {
 public:
  explicit ThreadPreparation(oneapi::tbb::task_arena& arena) : task_scheduler_observer(arena) {
    observe(true);
  }
  ~ThreadPreparation() override { observe(false); }
  ThreadPreparation(const ThreadPreparation&) = delete;
  ThreadPreparation& operator=(const ThreadPreparation&) = delete;
  void on_scheduler_entry(bool is_worker) override;
};

/// Calls `work` with oneTBB's loops limited to usable_threads(threads) threads.
template <class Work>
auto on_threads(int threads, Work&& work) {
  threads = usable_threads(threads);
  const oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism, threads);
  oneapi::tbb::task_arena arena(threads);
  const ThreadPreparation preparation(arena);
  return arena.execute(std::forward<Work>(work));
}

}  // namespace quadrille
