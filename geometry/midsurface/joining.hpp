#pragma once
/// Joins the middle surfaces of walls where they meet. Internal.

#include <TopoDS_Face.hxx>
#include <vector>

#include "geometry/midsurface/wall_pieces.hpp"

namespace quadrille {

/// A face of the result.
struct JoinedFace {
  TopoDS_Face face;
  int wall = 0;
  bool step = false;  ///< stands across the wall and joins it to the next one, whose middle lies elsewhere
  Coverage coverage;
};

/// Cuts the pieces of all walls at each other, so that they share edges, leaves out what hangs over, and
/// makes faces one again that were cut for nothing. Faces that meet two by two are oriented alike. \param
/// pieces of each wall. Throws Error (failure) where OpenCASCADE cannot intersect them.
std::vector<JoinedFace> join_walls(const Skin& skin, const std::vector<Wall>& walls,
                                   const std::vector<WallEnd>& ends,
                                   const std::vector<std::vector<TopoDS_Face>>& pieces);

/// Number of the connected part that each face belongs to, from 0.
std::vector<int> connected_parts(const std::vector<JoinedFace>& faces);

}  // namespace quadrille
