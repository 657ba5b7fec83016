#pragma once
/// Which part of a symmetric model is meshed, and with which options. Internal.

#include <optional>
#include <string>

#include "geometry/symmetry/model_part.hpp"
#include "mesher/options.hpp"

namespace quadrille {

/// What stands for a model that is meshed by its part.
struct SymmetricJob {
  std::optional<ModelPart> part;  ///< nothing = the model is meshed as a whole
  MeshOptions options;            ///< for the part: its own numbers, and the sizes that suit the whole model
  std::string note;               ///< why there is no part, or fewer planes; empty if there is nothing to say
};

/// Finds the planes of a model and cuts it there, as far as the options are symmetric.
SymmetricJob find_symmetry(const CadModel& model, const MeshOptions& options,
                           const ExecutionContext& context);

}  // namespace quadrille
