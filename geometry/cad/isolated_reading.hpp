#pragma once
/// Reading CAD files in a child process, which may crash without harm.

#include <TopoDS_Shape.hxx>
#include <cstddef>
#include <functional>
#include <string>

namespace quadrille {

class ExecutionContext;

/// Runs `read` in a child process (a fork of this one) and gives the shape that it returned; composed
/// placements may differ in their last digits.
/// \param name of the file, for messages.
/// \param context asked every few hundredths of a second whether to go on; may be null.
/// \param memory bytes that the child may take beyond what this process has; 0 = no limit.
/// Throws the Error that `read` threw; Error (failure) with one sentence when the child crashed or ran out of
/// memory; what the context throws, and then the child is ended at once.
TopoDS_Shape read_isolated(const std::string& name, const std::function<TopoDS_Shape()>& read,
                           ExecutionContext* context, std::size_t memory = 0);

}  // namespace quadrille
