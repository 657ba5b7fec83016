#pragma once
/// OpenCASCADE's long work under a time limit, and its fuses. Internal.

#include <BOPAlgo_Builder.hxx>
#include <BRepBuilderAPI_MakeShape.hxx>
#include <Message_ProgressRange.hxx>
#include <TopTools_ListOfShape.hxx>
#include <functional>

#include "geometry/base/execution_context.hpp"

namespace quadrille {

/// Runs work that takes a progress range of OpenCASCADE. Throws Error soon after the context is cancelled or
/// reaches its time limit.
void under_limit(const ExecutionContext& context,
                 const std::function<void(const Message_ProgressRange&)>& work);

/// Performs the fuse, which must have its arguments, under_limit(). The arguments stay as they are.
void perform(BOPAlgo_Builder& fuse, const ExecutionContext& context);

/// The parts into which a fuse has cut one of its arguments; the argument itself if it was not cut.
TopTools_ListOfShape images(const BOPAlgo_Builder& fuse, const TopoDS_Shape& face);
TopTools_ListOfShape images(BRepBuilderAPI_MakeShape& made, const TopoDS_Shape& part);

}  // namespace quadrille
