#pragma once
/// A face in its parameter plane: the surface that evaluates it, and its boundary there. Internal.

#include <memory>

#include "geometry/cad/cad_shape.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/edges/edge_sampling.hpp"
#include "mesher/faces/face_boundary.hpp"
#include "mesher/faces/face_problem.hpp"

namespace quadrille {

/// The plane that a face is triangulated in.
enum class ChartKind {
  own,         ///< the surface's parameters, with the face's own parametric curves
  new_curves,  ///< the surface's parameters, with new parametric curves projected from the edges
  view         ///< the face as seen from above, along the normal of its outer loop
};

struct FaceChart {
  ChartKind kind = ChartKind::own;
  std::shared_ptr<const CadFace> other;        ///< the face with new parametric curves; null for other kinds
  std::shared_ptr<const FaceSurface> surface;  ///< the surface that the boundary's uv refer to
  FaceBoundary boundary;
};

/// Throws FaceProblem if the face has no such chart.
FaceChart make_chart(const CadShape& shape, FaceId face, const BoundaryNodes& nodes, ChartKind kind);

}  // namespace quadrille
