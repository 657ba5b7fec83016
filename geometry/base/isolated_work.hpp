#pragma once
/// Work in a child process: a crash, lack of memory or an endless loop there does no harm here. On Windows,
/// which cannot copy a process, the child is a program of its own, which gets the name of the work.

#include <cstddef>
#include <functional>
#include <istream>
#include <ostream>
#include <string>
#include <vector>

#include "geometry/base/execution_context.hpp"

namespace quadrille {

/// Work that the program `quadrille` does alone: `quadrille isolated NAME ARGUMENTS...` on Windows.
struct IsolatedTask {
  std::string name;                    ///< one that isolated_task() knows; empty = none
  std::vector<std::string> arguments;  ///< UTF-8
};

struct IsolatedWork {
  std::string subject;     ///< the file concerned
  std::string crashed;     ///< error message if the child ends without an answer
  std::string too_long;    ///< error message if it takes longer than the time limit
  double time_limit = 0;   ///< seconds; 0 = none
  std::size_t memory = 0;  ///< bytes that the child may take beyond what this process has; 0 = no limit
  ExecutionContext* context = nullptr;  ///< checked every few hundredths of a second; may be null
  Stage stage = Stage::read;            ///< the stage reported meanwhile
  IsolatedTask task;  ///< the same work by name; without one, it is done in this process on Windows
};

/// Runs `work` in a child process (a fork of this one; on Windows `task` in a new one) and passes what it
/// wrote to `take`. What the child prints is discarded. Throws the Error that `work` threw. Throws Error
/// (failure) with one sentence when the child crashed, ran out of memory or time, or could not be created.
/// What the context throws ends the child at once and is passed on.
void run_isolated(const IsolatedWork& options, const std::function<void(std::ostream&)>& work,
                  const std::function<void(std::istream&)>& take);

/// The bytes that `make` returns in a child process. Throws as run_isolated().
std::string isolated_bytes(const IsolatedWork& options, const std::function<std::string()>& make);

}  // namespace quadrille
