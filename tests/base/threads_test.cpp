/// That threads are prepared before they work.

#include <gtest/gtest.h>
#include <oneapi/tbb/parallel_for.h>

#include <atomic>
#include <thread>

#include "geometry/base/threads.hpp"

namespace quadrille {
namespace {

thread_local bool is_prepared = false;

TEST(Threads, ArePreparedBeforeTheyWork) {
  prepare_threads([] { is_prepared = true; });
  std::atomic<int> unprepared{0};
  const auto work = [&] {
    oneapi::tbb::parallel_for(0, 1000, [&](int) { unprepared += is_prepared ? 0 : 1; });
  };
  std::thread([&] { on_threads(0, work); }).join();
  prepare_threads(nullptr);
  EXPECT_EQ(unprepared, 0);
}

}  // namespace
}  // namespace quadrille
