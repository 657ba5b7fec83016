#pragma once
/// Work on each face, edge or vertex, on all threads. Internal.

#include <oneapi/tbb/parallel_for.h>

#include "geometry/cad/ids.hpp"

namespace quadrille {

/// Calls work(id) for each id of the values, in no order. Use it within on_threads().
template <class Id, class Value, class Work>
void for_each_id(const IdVector<Id, Value>& values, Work&& work) {
  oneapi::tbb::parallel_for(0, static_cast<int>(values.size()),
                            [&](int index) { work(Id::from_index(index)); });
}

}  // namespace quadrille
