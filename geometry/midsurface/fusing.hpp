#pragma once
/// OpenCASCADE's long work under a time limit. Internal.

#include <BOPAlgo_Builder.hxx>
#include <Message_ProgressRange.hxx>
#include <functional>

#include "geometry/base/execution_context.hpp"

namespace quadrille {

/// Runs work that takes a progress range of OpenCASCADE. Throws Error soon after the context is cancelled or
/// reaches its time limit.
void under_limit(const ExecutionContext& context,
                 const std::function<void(const Message_ProgressRange&)>& work);

/// Performs the fuse, which must have its arguments and options, under_limit().
void perform(BOPAlgo_Builder& fuse, const ExecutionContext& context);

}  // namespace quadrille
