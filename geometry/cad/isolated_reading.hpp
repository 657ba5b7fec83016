#pragma once
/// Reading CAD files in a child process, where a crash does no harm.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <ostream>
#include <string>

#include "geometry/base/execution_context.hpp"
#include "geometry/base/isolated_work.hpp"
#include "geometry/cad/face_names.hpp"

namespace quadrille {

/// The error message for a file whose reading takes longer than `time_limit` seconds.
std::string reading_too_long(const std::string& name, double time_limit);

/// Runs `read` in a child process and returns its shape; composed placements may differ in their last digits.
/// Throws as run_isolated(). \param name of the file, for messages. \param context checked every few
/// hundredths of a second; may be null. \param time_limit seconds; 0 = none. \param memory bytes that the
/// child may take beyond what this process has; 0 = no limit. \param task see IsolatedWork.
NamedShape read_isolated(const std::string& name, const std::function<NamedShape()>& read,
                         ExecutionContext* context, double time_limit = 0, std::size_t memory = 0,
                         const IsolatedTask& task = {});

/// The task "cad": reads the file and writes its shape and names as read_isolated() expects it. Throws as
/// CadModel::read().
void send_shape(const std::filesystem::path& path, std::ostream& out);

}  // namespace quadrille
