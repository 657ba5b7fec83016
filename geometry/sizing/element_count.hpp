#pragma once
/// Estimates the number of elements before any is made.

#include <functional>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/cad/cad_model.hpp"
#include "geometry/cad/ids.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "geometry/sizing/sizing_options.hpp"

namespace quadrille {

/// A sample point of a face.
struct FaceSample {
  Vector3 point;         ///< on the face
  double area = 0;       ///< area that the sample represents
  double curvature = 0;  ///< largest absolute principal curvature, 1 / length
};

/// The sample points of each face.
using FaceSamples = IdVector<FaceId, std::vector<FaceSample>>;

/// Points on a grid over each used face, some hundreds. One thread per face.
FaceSamples sample_faces(const CadShape& shape, const FaceFlags& used, ExecutionContext& context);

/// The integral of 1 / size^2 over all faces by their samples: about the number of quads.
double count_elements(const FaceSamples& samples,
                      const std::function<double(FaceId face, const FaceSample&)>& size_at);

/// Throws Error (usage), with the number, if the elements exceed the budget or the memory. \param free bytes.
void hold_elements(double count, const Budget& budget, double free);

/// Checks a run against its budget, and its elements against the free memory. Where bounding boxes show that
/// no requested size can exceed them, nothing is measured.
class ElementBudget {
 public:
  /// Throws Error (usage), with the number, if the sizes requested on faces, in regions and by curvature
  /// exceed the budget of elements or that of the sizing field.
  ElementBudget(const CadModel& model, const SizingOptions& options, const FaceFlags& used,
                ExecutionContext& context);

  /// Throws Error (usage), with the number, if the graded field requests more elements than allowed.
  void check(const SizingField& field) const;

 private:
  Budget budget_;
  double free_;          ///< free memory, bytes
  FaceSamples samples_;  ///< empty if the budget cannot be exceeded
};

}  // namespace quadrille
