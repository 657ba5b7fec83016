#pragma once
/// Orienting faces that share edges alike. Internal.

#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Shape.hxx>
#include <vector>

namespace quadrille {

/// What was done so that normals point to one side.
struct Orientation {
  std::vector<int> turned;  ///< numbers of the faces that were reversed, ascending
  /// Numbers of the edges across which normals cannot agree, ascending: three or more faces meet there, or
  /// the surface is one-sided.
  std::vector<int> unlike;
};

/// For each face, by its number minus 1: whether it belongs to a solid of the shape.
std::vector<char> faces_in_solids(const TopoDS_Shape& shape, const TopTools_IndexedMapOfShape& faces);

/// Orients faces alike within each connected piece by reversing the fewer of them, unless the piece is
/// one-sided. Faces connect at edges that two of them share, and as pieces of one face where others meet it.
/// Edges are numbered in the order in which the faces have them. \param fixed by face: left alone, as if it
/// were not there. \param pieces for each face before a cut: its pieces, see Imprint::pieces.
Orientation orient_alike(std::vector<TopoDS_Shape>& faces, const std::vector<char>& fixed,
                         const std::vector<std::vector<int>>& pieces = {});

}  // namespace quadrille
