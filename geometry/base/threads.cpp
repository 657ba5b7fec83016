/// Creates as many threads as may be wanted, once, to see how many the system allows.

#include "geometry/base/threads.hpp"

#include <algorithm>
#include <atomic>
#include <future>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

namespace quadrille {

namespace {

std::atomic<void (*)()> preparation_of_threads{nullptr};

}  // namespace

void prepare_threads(void (*prepare)()) {
  preparation_of_threads.store(prepare);
}

void ThreadPreparation::on_scheduler_entry(bool) {
  if (const auto prepare = preparation_of_threads.load()) prepare();
}

// oneTBB ends the program when it cannot create a thread, so creating them is tried here first.
int makeable_threads(int wanted) {
  std::promise<void> end;
  const std::shared_future<void> ended = end.get_future().share();
  std::vector<std::thread> others;
  others.reserve(wanted);
  try {
    while (static_cast<int>(others.size()) + 1 < wanted) others.emplace_back([ended] { ended.wait(); });
  } catch (const std::system_error&) {  // a limit on processes
  } catch (const std::bad_alloc&) {     // or on memory: count those created so far
  }
  end.set_value();
  for (std::thread& other : others) other.join();
  return static_cast<int>(others.size()) + 1;
}

int usable_threads(int wanted) {
  if (wanted == 1) return 1;
  static const int available = makeable_threads(std::max(1U, std::thread::hardware_concurrency()));
  return wanted > 0 ? std::min(wanted, available) : available;
}

}  // namespace quadrille
