#pragma once
/// How each face is to be meshed, decided once the segments of its edges are counted. Internal.

#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/edges/face_sides.hpp"
#include "mesher/edges/hole_blocks.hpp"

namespace quadrille {

struct BoundaryNodes;
struct SamplingPlan;

/// How a face is meshed between the nodes on its edges. What comes after sampling reads this, and does not
/// look at the outline again.
struct FacePlan {
  FaceSides sides;  ///< of its grid, with facing sides whose counts match
  /// Segments of the final mesh for each segment of the mesh that is recombined: 2 for faces that are
  /// subdivided, unless one of their edges has an odd number of segments; else 1.
  int stride = 1;
  int grid_quads = 0;                  ///< of a grid between four sides; 0 for other faces
  std::vector<HoleBlock> hole_blocks;  ///< cells that holes replace, by wire without that of the outline
  bool has_kept_edge = false;          ///< users prescribe the spacing of one of its edges
  bool has_divided_edge = false;       ///< users prescribe the number of segments on one of its edges

  /// A grid fills the face, so that its sides need no room between them.
  bool is_filled() const { return sides.is_filled(); }
  /// The rows of its grid follow a prescribed spacing.
  bool keeps_rows() const { return is_filled() && has_kept_edge; }
};

using FacePlans = IdVector<FaceId, FacePlan>;

/// Decides how faces are meshed. \param sides as choose_counts() left them \param nodes with all nodes in
/// place
FacePlans plan_faces(const CadShape& shape, FaceOutlines sides, const SamplingPlan& sampling,
                     const BoundaryNodes& nodes);

}  // namespace quadrille
