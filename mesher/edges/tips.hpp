#pragma once
/// Ends faces where they narrow towards a tip: a fifth fewer quads outside the limits on thirty models, 3 %
/// on real parts (decision 75). Internal.

#include <vector>

#include "geometry/cad/cad_shape.hpp"

namespace quadrille {

struct BoundaryNodes;
struct TinyFeatures;

/// A vertex towards which a face gets narrow: a cusp, the end of a fillet that runs out.
struct Tip {
  /// One of the two edges that meet there.
  struct Flank {
    EdgeId edge;
    bool at_end = false;   ///< the tip is the edge's last vertex
    double parameter = 0;  ///< of the edge, where the other one is as far away as the width
  };
  FaceId face;
  Flank before, after;  ///< the boundary runs to the tip along the first, and away along the second
};

/// The tips of the used faces: vertices at which two edges of a face, of one wire or of two that touch, stay
/// closer than `width` over more than 2.5 times that length, on less than half of either edge. Edges that
/// became points are not seen, and tips beside edges that share the nodes of others are left out. \param used
/// 1 = the face is meshed, and not merged by `tiny` \param width model units; 0 = none is found
std::vector<Tip> find_tips(const CadShape& shape, const FaceFlags& used, const TinyFeatures& tiny,
                           double width);

/// Ends faces early at their tips: the edges beside a tip share the nodes that lie closer together than the
/// width of find_tips(), and the face ends at the last of them. Elements beyond would be smaller than that,
/// and have the angle of the tip. Suppressed edges, edges that borrow nodes and edges whose divisions users
/// prescribe stay as they are. \param nodes changed: places of nodes, BoundaryNodes::unused
void end_faces_at_tips(const CadShape& shape, const std::vector<Tip>& tips, const TinyFeatures& tiny,
                       BoundaryNodes& nodes);

}  // namespace quadrille
