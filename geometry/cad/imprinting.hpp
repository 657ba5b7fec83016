#pragma once
/// Cutting parts that touch or cross so that they share faces, edges and vertices. Internal: users see
/// CadModel::imprinted().

#include <TopoDS_Shape.hxx>
#include <string>
#include <vector>

#include "geometry/cad/orientation.hpp"

namespace quadrille {

/// A shape whose parts share what they have in common.
struct Imprint {
  TopoDS_Shape shape;
  /// For each face of the shape before: the numbers of the faces that it became, ascending.
  std::vector<std::vector<int>> pieces;
  /// The same for edges and vertices; empty for those that the fuse has dropped.
  std::vector<std::vector<int>> edge_pieces, vertex_pieces;
  Orientation orientation;  ///< of the faces outside solids, where there are several parts
};

/// OpenCASCADE's general fuse of the solids, shells and faces of a shape. A face keeps its number, or one of
/// its pieces does; further pieces are numbered after all faces, and a number that is left over is taken by
/// the last face. Edges and vertices get new numbers. Faces outside solids are oriented alike, see
/// orient_alike(), and shells become the faces that they consist of. Throws Standard_Failure with the reason
/// where OpenCASCADE cannot do it. \param tolerance in the model's unit: parts no farther apart touch; 0 =
/// the tolerances of the shape alone.
Imprint imprint(const TopoDS_Shape& shape, double tolerance);

/// The faces that changed, one entry each: "Face2 became Face2, Face13", "Face9 became Face3 (shared)".
/// \param pieces see Imprint::pieces.
std::vector<std::string> changes_of_faces(const std::vector<std::vector<int>>& pieces);

}  // namespace quadrille
