#pragma once
/// The skins of a model's solids, in which walls are searched for. Internal.

#include <TopoDS_Shape.hxx>
#include <deque>

#include "geometry/base/execution_context.hpp"
#include "geometry/midsurface/skin.hpp"

namespace quadrille {

/// The solids of the shape, oriented with the material inside and triangulated for sampling. Their faces have
/// the numbers of the shape's faces. \param join fuse solids that touch, overlap or leave only a narrow gap.
/// The parts of a face that is cut keep its number; faces inside the material disappear. Throws Error
/// (failure) if OpenCASCADE cannot fuse the solids; looks at the context's time limit all the while.
std::deque<Skin> skins_of(const TopoDS_Shape& shape, bool join, const ExecutionContext& context);

}  // namespace quadrille
