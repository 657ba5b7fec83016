#pragma once
/// Estimates how many quads a size gives, without meshing.

#include <map>
#include <vector>

#include "geometry/base/api.hpp"
#include "geometry/base/execution_context.hpp"
#include "geometry/cad/cad_model.hpp"
#include "geometry/sizing/element_count.hpp"
#include "mesher/options.hpp"

namespace quadrille {

/// Estimates how many quads the options give on a model, from the sizing field at some hundred points per
/// face and from the segments on edges. Takes the time to build the sizing field and to sample the edges.
/// Accurate within a factor of 1.25 on nearly all models measured (bench/expected_counts.py).
class QUADRILLE_API QuadEstimate {
 public:
  /// Keeps a reference to the model.
  QuadEstimate(const CadModel& model, ExecutionContext& context);

  /// Infinity if the sizes exceed the budget. Throws Error as mesh() does for invalid options.
  double quads(const MeshOptions& options);

  /// The same by face; 0 for faces that are not meshed. Throws Error as mesh() does for invalid options or
  /// sizes that exceed the budget.
  std::vector<double> quads_by_face(const MeshOptions& options);

  /// A size, rounded to three digits, and the number of quads that it gives. This is more than requested if
  /// the model's own edges need more at any size.
  struct Suggestion {
    double size = 0;   ///< millimeters
    double quads = 0;  ///< estimated number at this size
  };
  /// The size that gives about this number of quads with the other options. Starts from the sizes that
  /// earlier calls tried, which must have had the same options.
  Suggestion size_for(double quads, MeshOptions options = {});

 private:
  const CadModel& model_;
  ExecutionContext& context_;
  FaceSamples samples_;
  std::map<double, double> tried_;  ///< quads by size, as size_for() found them
};

}  // namespace quadrille
