#pragma once
/// Why a face cannot be meshed as it is, and where. Internal.

#include <string>
#include <utility>
#include <vector>

#include "geometry/base/error.hpp"
#include "geometry/base/vector.hpp"
#include "mesher/edges/edge_sampling.hpp"

namespace quadrille {

/// What the table of remedies (remedies.hpp) is asked with.
enum class Cause {
  no_area,               ///< its surface is a curve
  unusable_boundary,     ///< no boundary in the parameter plane, or one that runs to infinity
  coarse_segments,       ///< boundary segments cross where the curves that they stand for do not
  narrow_gaps,           ///< curves come nearer to each other than they leave their segments
  looped_edge,           ///< segments of one edge cross, however fine: its curve has a loop
  stray_curves,          ///< segments cross, and the parametric curves lie away from their edges
  crossing_curves,       ///< segments of two edges cross or touch, however fine
  inverted_inside,       ///< the mesh was made, and has quads turned over, some at nodes inside the face
  inverted_at_boundary,  ///< the same, all at nodes of the boundary
  odd_boundary,          ///< a triangle is left over, which only subdivision can cut up
  no_mesh,               ///< a stage gave up
  out_of_work,           ///< the face has used up its share of work
  out_of_time            ///< the time limit, or the face's share of it, is over
};

/// `what()` is a sentence for the user that names the face, edges and the place.
class FaceProblem : public Error {
 public:
  FaceProblem(Cause cause, int face, const std::string& sentence)
      : Error(Kind::failure, "Face" + std::to_string(face), sentence), cause_(cause), face_(face) {}

  Cause cause() const noexcept { return cause_; }
  int face() const noexcept { return face_; }  ///< CAD face, from 1

  std::vector<EdgeStretch> stretches;  ///< where on its edges, with the segments that would do there
  std::vector<int> edges;              ///< the CAD edges concerned, from 1, ascending

 private:
  Cause cause_;
  int face_;
};

}  // namespace quadrille
