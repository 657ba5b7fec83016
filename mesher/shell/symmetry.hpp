#pragma once
/// Chooses the part of a symmetric model to mesh, and the options for it. Internal.

#include <optional>
#include <string>

#include "geometry/symmetry/model_part.hpp"
#include "mesher/options.hpp"

namespace quadrille {

/// The part that is meshed in place of a symmetric model.
struct SymmetricJob {
  std::optional<ModelPart> part;  ///< nothing = the model is meshed as a whole
  MeshOptions options;  ///< options for the part: with its numbers, and the size limits of the whole model
  std::string note;     ///< why there is no part or planes were left out; may be empty
};

/// Finds the mirror planes of a model and cuts it at those for which the options are symmetric too.
SymmetricJob find_symmetry(const CadModel& model, const MeshOptions& options,
                           const ExecutionContext& context);

}  // namespace quadrille
