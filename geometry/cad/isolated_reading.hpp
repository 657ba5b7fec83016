#pragma once
/// Reading CAD files in a child process, where a crash does no harm.

#include <functional>
#include <string>

#include "geometry/base/execution_context.hpp"
#include "geometry/cad/face_names.hpp"

namespace quadrille {

/// The error message for a file whose reading takes longer than `time_limit` seconds.
std::string reading_too_long(const std::string& name, double time_limit);

/// Runs `read` in a child process and returns its shape; composed placements may differ in their last digits.
/// Throws as run_isolated(). \param name of the file, for messages. \param context checked every few
/// hundredths of a second; may be null. \param time_limit seconds; 0 = none.
NamedShape read_isolated(const std::string& name, const std::function<NamedShape()>& read,
                         ExecutionContext* context, double time_limit = 0);

}  // namespace quadrille
