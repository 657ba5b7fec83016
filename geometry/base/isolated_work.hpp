#pragma once
/// Work in a child process: a crash, lack of memory or an endless loop there does no harm here.

#include <cstddef>
#include <functional>
#include <ostream>
#include <string>

#include "geometry/base/execution_context.hpp"

namespace quadrille {

struct IsolatedWork {
  std::string subject;     ///< the file concerned
  std::string crashed;     ///< error message if the child ends without an answer
  std::string too_long;    ///< error message if it takes longer than the time limit
  double time_limit = 0;   ///< seconds; 0 = none
  std::size_t memory = 0;  ///< bytes that the child may take beyond what this process has; 0 = no limit
  ExecutionContext* context = nullptr;  ///< checked every few hundredths of a second; may be null
  Stage stage = Stage::read;            ///< the stage reported meanwhile
};

/// Runs `work` in a child process, a fork of this one, and returns what it wrote. What the child prints is
/// discarded. Throws the Error that `work` threw. Throws Error (failure) with one sentence when the child
/// crashed, ran out of memory or time, or could not be created. What the context throws ends the child at
/// once and is passed on.
std::string run_isolated(const IsolatedWork& options, const std::function<void(std::ostream&)>& work);

}  // namespace quadrille
