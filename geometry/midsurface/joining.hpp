#pragma once
/// Joins the middle surfaces of walls where they meet. Internal.

#include <BOPAlgo_Builder.hxx>
#include <TopTools_ListOfShape.hxx>
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

/// What an argument of a fuse has become.
TopTools_ListOfShape images(const BOPAlgo_Builder& fuse, const TopoDS_Shape& face);

/// Leaves out edges inside one face that no other face uses.
void drop_traces(std::vector<JoinedFace>& faces);

/// Turns faces so that across each edge with two faces they show the same side, as far as that can be.
void orient_alike(std::vector<JoinedFace>& faces);

/// Where the fillets in corners hold more of the volume than the middle surfaces count twice there, by more
/// than a hundredth of it, their material is given to strips of the walls beside the corner, as thickness:
/// the faces are cut where the fillets begin. \param volume of the solid.
void add_fillets(const Skin& skin, const std::vector<Wall>& walls, double volume,
                 std::vector<JoinedFace>& faces);

/// Number of the connected part that each face belongs to, from 0.
std::vector<int> connected_parts(const std::vector<JoinedFace>& faces);

}  // namespace quadrille
