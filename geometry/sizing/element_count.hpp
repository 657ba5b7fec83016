#pragma once
/// How many elements sizes give, told before any is made.

#include <functional>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/base/trimmed_domain.hpp"
#include "geometry/cad/cad_model.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "geometry/sizing/sizing_options.hpp"

namespace quadrille {

struct CadFace;

/// The region of a face's parameter plane, its edges as chords of a sixteenth of each.
TrimmedDomain coarse_domain(const CadShape& shape, const CadFace& face);

/// A point of a face.
struct FaceSample {
  Vector3 point;         ///< on the face
  double area = 0;       ///< that it stands for
  double curvature = 0;  ///< the larger principal one, 1 / length
};

/// Points on a grid over each face, some hundreds; none on the faces not used. \param used (faces) 1 =
/// wanted. One thread a face.
std::vector<std::vector<FaceSample>> sample_faces(const CadShape& shape, const std::vector<char>& used,
                                                  ExecutionContext& context);

/// The integral of 1 / size^2 over the samples of all faces: about the number of quads.
double count_elements(const std::vector<std::vector<FaceSample>>& samples,
                      const std::function<double(int face, const FaceSample&)>& size_at);

/// Throws Error (usage), with the number, where so many elements pass the budget or the memory that is free.
/// \param free bytes.
void hold_elements(double count, const Budget& budget, double free);

/// Holds a run to its budget, and its elements to the memory that is free. Where bounding boxes show that no
/// size asked for can pass it, nothing is measured.
class ElementBudget {
 public:
  /// Throws Error (usage), with the number, if the sizes asked for on faces, in regions and by curvature pass
  /// the budget, be it that of elements or that of the sizing field.
  /// \param used (faces) 1 = meshed.
  ElementBudget(const CadModel& model, const SizingOptions& options, const std::vector<char>& used,
                ExecutionContext& context);

  /// Throws Error (usage), with the number, if the field, which has grown from small sizes, passes it.
  void check(const SizingField& field) const;

 private:
  void hold_blocks(const SizingOptions& options, const SizeLimits& limits) const;

  Budget budget_;
  double free_;                                   ///< bytes
  std::vector<std::vector<FaceSample>> samples_;  ///< empty where the budget cannot be passed
};

}  // namespace quadrille
