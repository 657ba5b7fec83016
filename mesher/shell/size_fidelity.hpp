#pragma once
/// How well a mesh keeps the sizes that were asked for.

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/cad/cad_model.hpp"
#include "geometry/sizing/sizing_options.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// Lengths of element sides over the sizes wanted at their middles.
struct SizeFidelity {
  static constexpr double low = 0.55, high = 1.6;
  struct Bin {
    double from, to;
    int count;
  };
  int sides = 0;
  double median = 0;
  double within_percent = 0;   ///< of the sides, between low and high
  std::vector<Bin> histogram;  ///< four bins to a factor of two; the first and the last hold all beyond

  nlohmann::ordered_json json() const;
};

/// Each side once. Builds the sizing field again, without what the mesh has let go. Time: that of the field
/// and a look-up a side.
SizeFidelity size_fidelity(const ShellMesh& mesh, const CadModel& model, const SizingOptions& options,
                           ExecutionContext& context);

}  // namespace quadrille
