#pragma once
/// Fills the gaps between solids that are to become one part. Internal.

#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopoDS_Shape.hxx>
#include <deque>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/midsurface/skin.hpp"

namespace quadrille {

/// Solids, and by face of them the number of the model's face that it is or extends.
struct NumberedSolids {  // NOLINT(bugprone-exception-escape): OpenCASCADE's maps do not say noexcept
  std::vector<TopoDS_Shape> solids;
  TopTools_DataMapOfShapeInteger numbers;
};

/// Makes solids that close the narrow gaps between other solids, so that a fuse makes one solid of all. A
/// face is extended to the face of the other solid opposite to it, and a quarter of the thickness into that
/// solid, as far as the two face each other. Flat faces are extended along the walls that end there. So are
/// curved ends of straight parts, such as a tube cut to fit around another. Other curved faces are extended
/// along their normals, except spheres around a pole and free-form faces. A gap is closed if it is not wider
/// than the thinner wall. Solids that touch need no filler. Time: a ray for each of about 24 points of every
/// face near another solid. Looks at the context's time limit.
NumberedSolids fill_gaps(const std::deque<Skin>& solids, const ExecutionContext& context);

}  // namespace quadrille
