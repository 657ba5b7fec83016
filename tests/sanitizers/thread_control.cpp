/// What the thread sanitizer must see before its silence means anything: two threads in a parallel loop, with
/// a race between them that it must report (`race`), or with nothing but what the start and the end of the
/// loop order (`order`).

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

int main(int argc, char** argv) {
  const bool race = argc > 1 && std::string(argv[1]) == "race";
  constexpr int threads = 2;
  const oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism, threads);
  oneapi::tbb::task_arena arena(threads);
  int shared = 0;
  for (int round = 0; round < 50; ++round) {
    std::vector<int> given(threads, round), made(threads, 0);
    std::atomic<int> arrived{0};
    arena.execute([&] {
      oneapi::tbb::parallel_for(
          0, threads,
          [&](int i) {
            // Each waits for the other, so that they are two threads; relaxed, which orders nothing.
            arrived.fetch_add(1, std::memory_order_relaxed);
            const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(3);
            while (arrived.load(std::memory_order_relaxed) < threads) {
              if (std::chrono::steady_clock::now() > end) return;
              std::this_thread::yield();
            }
            made[i] = given[i] + 1;
            if (race) ++shared;
          },
          oneapi::tbb::simple_partitioner());
    });
    if (made != std::vector<int>(threads, round + 1)) {
      std::fprintf(stderr, "the loop never ran on %d threads\n", threads);
      return 1;
    }
  }
  return shared < 0;
}
