#pragma once
/// Work in a child process, which may crash, run out of memory or never end without harm.

#include <cstddef>
#include <functional>
#include <istream>
#include <ostream>
#include <string>

#include "geometry/base/execution_context.hpp"

namespace quadrille {

struct IsolatedWork {
  std::string subject;     ///< the file concerned
  std::string crashed;     ///< the sentence for a child that ends without an answer
  std::string too_long;    ///< the sentence for one that takes longer than the time limit
  double time_limit = 0;   ///< seconds; 0 = none
  std::size_t memory = 0;  ///< bytes that the child may take beyond what this process has; 0 = no limit
  ExecutionContext* context =
      nullptr;                ///< asked every few hundredths of a second whether to go on; may be null
  Stage stage = Stage::read;  ///< reported meanwhile
};

/// Runs `work` in a child process (a fork of this one) and gives what it has written to `take`. What the
/// child prints goes nowhere. Throws the Error that `work` threw; Error (failure) with one sentence when the
/// child crashed, ran out of memory or time, or could not be made; what the context throws, and then the
/// child is ended at once.
void run_isolated(const IsolatedWork& options, const std::function<void(std::ostream&)>& work,
                  const std::function<void(std::istream&)>& take);

/// The bytes that `make` gives in a child process, as run_isolated().
std::string isolated_bytes(const IsolatedWork& options, const std::function<std::string()>& make);

}  // namespace quadrille
