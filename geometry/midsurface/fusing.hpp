#pragma once
/// OpenCASCADE's general fuse under a time limit. Internal.

#include <BOPAlgo_Builder.hxx>

#include "geometry/base/execution_context.hpp"

namespace quadrille {

/// Performs the fuse, which must have its arguments and options. Throws Error when the context is cancelled
/// or its time is over, soon after that.
void perform(BOPAlgo_Builder& fuse, const ExecutionContext& context);

}  // namespace quadrille
