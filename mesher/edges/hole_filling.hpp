#pragma once
/// Small holes, pockets and bosses that are left out: the faces around them are meshed as if they were not
/// there. Internal.

#include <vector>

#include "geometry/cad/cad_model.hpp"
#include "geometry/cad/ids.hpp"
#include "geometry/sizing/sizing_options.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// A model without the holes that are filled. Faces, edges and vertices keep their
/// numbers.
struct FilledModel {
  CadModel model;                            ///< what is left out has no edges that any face uses
  FaceFlags gone;                            ///< 1 = a face of a filled hole
  std::vector<ShellMesh::FilledHole> holes;  ///< ascending by the first face they lie in
  IdVector<FaceId, double> areas;            ///< area of the filled holes in each face, millimeters^2
  /// The faces among these that are left.
  FaceFlags left(FaceFlags faces) const {
    for (const FaceId face : faces.ids())
      if (gone[face]) faces[face] = 0;
    return faces;
  }
};

/// Fills each hole that is a loop of its own inside one face, or one at each of its two ends, if no point of
/// the loop is farther than `diameter` from another and no point of the hole farther from its axis. A boss is
/// removed in the same way if it is no higher than that. What the sizes name stays: edges, vertices and faces
/// with sizes, layers, segments, or kept. The model itself where there is nothing to fill. Complexity: linear
/// in edges, for each hole inside a hole again.
FilledModel fill_holes(const CadModel& model, const FaceFlags& used, const SizingOptions& sizing,
                       double diameter);

}  // namespace quadrille
