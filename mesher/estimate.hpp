#pragma once
/// How many quads a size gives, without meshing.

#include <vector>

#include "geometry/base/api.hpp"
#include "geometry/base/execution_context.hpp"
#include "geometry/cad/cad_model.hpp"
#include "geometry/sizing/element_count.hpp"
#include "mesher/options.hpp"

namespace quadrille {

/// Tells for a model how many quads options give: from the sizing field at some hundred points a face, and
/// from the segments of its edges. Time is that of the sizing field and of sampling the edges; within a
/// factor of 1.5 on the models measured.
class QUADRILLE_API QuadEstimate {
 public:
  /// Keeps a reference to the model.
  QuadEstimate(const CadModel& model, ExecutionContext& context);

  /// Infinite where the options pass their budget. Throws Error as mesh() for options that make no sense.
  double quads(const MeshOptions& options);

  /// The largest size, rounded to three digits, that gives about so many quads, and how many that are: more
  /// where the model's own edges take more at any size.
  struct Suggestion {
    double size = 0;   ///< millimeters
    double quads = 0;  ///< that it gives
  };
  Suggestion size_for(double quads);  ///< the size that gives about so many

 private:
  const CadModel& model_;
  ExecutionContext& context_;
  std::vector<std::vector<FaceSample>> samples_;
};

}  // namespace quadrille
