#pragma once
/// Why and where a face cannot be meshed. Internal.

#include <string>
#include <vector>

#include "geometry/base/error.hpp"
#include "mesher/edges/edge_sampling.hpp"

namespace quadrille {

/// The causes that the table of remedies (remedies.hpp) distinguishes.
enum class Cause {
  no_area,            ///< its surface is a curve
  unusable_boundary,  ///< no boundary in the parameter plane, or one that runs to infinity
  coarse_segments,    ///< boundary segments cross where the curves that they approximate do not
  narrow_gaps,        ///< gaps between curves are narrower than the curves bulge from their segments
  looped_edge,        ///< segments of one edge cross, however fine: its curve has a loop
  stray_curves,       ///< segments cross or quads are inverted, and parametric curves lie off their edges
  crossing_curves,    ///< segments of two edges cross or touch, however fine
  inverted,           ///< the finished mesh has inverted quads
  odd_boundary,       ///< a triangle is left over, which only subdivision can turn into quads
  no_mesh,            ///< a stage gave up
  out_of_work,        ///< the face has used up its share of work
  out_of_time         ///< the time limit, or the face's share of it, is used up
};

/// `what()` is a sentence for the user that names the face, the edges and the place.
class FaceProblem : public Error {
 public:
  FaceProblem(Cause cause, FaceId face, const std::string& sentence)
      : Error(Kind::failure, "Face" + std::to_string(face.number()), sentence), cause_(cause), face_(face) {}

  Cause cause() const noexcept { return cause_; }
  FaceId face() const noexcept { return face_; }

  std::vector<EdgeStretch> stretches;  ///< parts of edges, with the numbers of segments that would suffice
  std::vector<EdgeId> edges;           ///< the CAD edges concerned, ascending

 private:
  Cause cause_;
  FaceId face_;
};

}  // namespace quadrille
