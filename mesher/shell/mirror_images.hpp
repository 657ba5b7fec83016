#pragma once
/// The mesh of a symmetric model from that of a part of it. Internal.

#include <optional>

#include "geometry/symmetry/model_part.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// The part's mesh and its mirror images as one mesh, with shared nodes on the planes and the whole model's
/// names. Nothing where the part's mesh does not end in the planes as its model does, since features were let
/// go there, or where one of those stands for another that the whole model does not have. Time: that of
/// sorting the quads' sides.
/// \param mesh of part.model, with all of its faces or some. \param whole the model that the part is of.
std::optional<ShellMesh> with_mirror_images(const ShellMesh& mesh, const ModelPart& part,
                                            const CadShape& whole);

}  // namespace quadrille
