#pragma once
/// Work on each face, edge or vertex, on all threads. Internal.

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <atomic>
#include <cstddef>
#include <vector>

#include "geometry/cad/ids.hpp"

namespace quadrille {

/// Calls work(id) for each id of the values, in no order. Use it within on_threads().
template <class Id, class Value, class Work>
void for_each_id(const IdVector<Id, Value>& values, Work&& work) {
  oneapi::tbb::parallel_for(0, static_cast<int>(values.size()),
                            [&](int index) { work(Id::from_index(index)); });
}

/// Calls work(id) for each of the ids. Each thread takes the next one: if those with much work come first, no
/// thread waits long for another at the end. Use it within on_threads().
template <class Id, class Work>
void for_each_in_order(const std::vector<Id>& ids, Work&& work) {
  std::atomic<std::size_t> started{0};
  const auto next = [&] { return started.fetch_add(1, std::memory_order_relaxed); };
  oneapi::tbb::parallel_for(0, oneapi::tbb::this_task_arena::max_concurrency(), [&](int) {
    for (std::size_t i = next(); i < ids.size(); i = next()) work(ids[i]);
  });
}

}  // namespace quadrille
