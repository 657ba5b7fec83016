#pragma once
/// Makes the mesh of a symmetric model from the mesh of a part of it. Internal.

#include <optional>

#include "geometry/symmetry/model_part.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// Joins the part's mesh and its mirror images into one mesh, with shared nodes on the planes and the numbers
/// of the whole model. Returns nothing if the part's mesh does not end in the planes as its model does,
/// because features were let go there, or if an entity that stands for one that was let go is not in the
/// whole model. Time: that of sorting the sides of the quads.
/// \param mesh mesh of part.model, with all or some of its faces. \param whole the model that was cut.
std::optional<ShellMesh> with_mirror_images(const ShellMesh& mesh, const ModelPart& part,
                                            const CadShape& whole);

}  // namespace quadrille
