#pragma once
/// Gradation along faces, and from face to face across the edges that they share. Internal.

#include <memory>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/sizing/size_cascade.hpp"

namespace quadrille {

/// The sizes on each face, by its index; or one cascade for all faces.
using FaceCascades = std::vector<std::unique_ptr<SizeCascade>>;

/// Lets the sizes of all faces grow by at most `slope` per unit of length: within a face through the voxels
/// around it, and between faces through the voxels along their common edges. The voxels of all faces lie on
/// one lattice, so sizes pass over an edge exactly. Sizes do not pass across a gap or through a wall. Faces
/// that touch only at a vertex influence each other through the faces between them.
void grade_on_surface(const CadShape& shape, FaceCascades& cascades, double slope, BlockCount& blocks,
                      const ExecutionContext& context);

}  // namespace quadrille
