#pragma once
/// Compares meshes of one face: which of the candidates is delivered, and which need not be tried. Internal.

#include "geometry/base/execution_context.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "mesher/shell/face_mesher.hpp"

namespace quadrille {

/// Judges meshes of one face.
class FaceJudge {
 public:
  FaceJudge(const SizingField& field, FaceId face, const FaceSurface& surface,
            const ExecutionContext& context)
      : size_at_(field, face), surface_(surface), context_(context) {}

  /// Whether other meshes than this grid are worth trying.
  bool is_doubtful(const FaceMesh& grid, const FacePlan& plan);
  /// Whether another mesh is to replace the grid that is_doubtful() saw last.
  bool replaces_grid(const FaceMesh& other, const FaceMesh& grid) const;

  /// Whether a mesh of quads cut in four is to be compared with one of quads of the final size.
  bool is_doubtful(const FaceMesh& cut);
  /// Whether quads of the final size are better than quads cut in four.
  bool replaces_cut(const FaceMesh& direct, const FaceMesh& cut) const;

 private:
  bool wastes_quads(const FaceMesh& mesh, double most);

  SizingField::Sampler size_at_;
  const FaceSurface& surface_;
  const ExecutionContext& context_;
  double outside_ = 0;  // of the grid, as far as it counts
  bool wasteful_ = false;
  bool cut_wastes_ = false;  // of the quads cut in four
};

}  // namespace quadrille
