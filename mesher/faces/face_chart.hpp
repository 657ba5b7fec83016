#pragma once
/// A face in its parameter plane: what it is evaluated with, and its boundary there. Internal.

#include <memory>
#include <optional>

#include "geometry/cad/cad_shape.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/edges/edge_sampling.hpp"
#include "mesher/faces/face_boundary.hpp"
#include "mesher/faces/face_problem.hpp"

namespace quadrille {

/// The plane that a face is triangulated in.
enum class ChartKind {
  own,         ///< the parameters of its surface, by its own parametric curves
  new_curves,  ///< the same, by curves made anew by projection of its edges
  view         ///< the face as it is seen from above, along the normal of its outer loop
};

struct FaceChart {
  std::shared_ptr<const CadFace> other;        ///< the face with curves made anew; null for other kinds
  std::shared_ptr<const FaceSurface> surface;  ///< what the boundary's uv are parameters of
  FaceBoundary boundary;
};

/// \param face from 0. Throws FaceProblem where there is no such chart.
FaceChart make_chart(const CadShape& shape, int face, const BoundaryNodes& nodes, ChartKind kind);

}  // namespace quadrille
