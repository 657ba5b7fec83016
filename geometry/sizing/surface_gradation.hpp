#pragma once
/// Gradation along faces, and from face to face over the edges that they share. Internal.

#include <memory>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/sizing/size_cascade.hpp"

namespace quadrille {

/// (faces) the sizes on each face.
using FaceCascades = std::vector<std::unique_ptr<SizeCascade>>;

/// Lets the sizes of all faces grow: within a face through the voxels about it, from face to face through the
/// voxels that an edge of both passes, by at most `slope` per length up to `most`. Voxels of all faces are of
/// one lattice, so that what passes over an edge is exact; what lies across a gap or a wall is not met. Faces
/// that only touch at a vertex meet over those between them.
void grade_on_surface(const CadShape& shape, FaceCascades& cascades, double slope, double most,
                      BlockCount& blocks, const ExecutionContext& context);

}  // namespace quadrille
