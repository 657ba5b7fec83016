#pragma once
/// Joining faces that touch but do not share their edges. Internal: users see CadModel::sewn().

#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <array>
#include <vector>

#include "geometry/cad/orientation.hpp"

namespace quadrille {

/// A shape whose faces share the edges at which they touch.
struct Sewn {
  TopoDS_Shape shape;
  int joined = 0;           ///< number of edges that were joined to others
  Orientation orientation;  ///< of the faces outside solids, where edges were joined
  /// Numbers of coincident faces with the same edges, the lower number first.
  std::vector<std::array<int, 2>> coincident;
};

/// Whether an inner point of one face lies within the tolerance on the other: for faces with the same edges,
/// whether they coincide.
bool lies_on(const TopoDS_Face& face, const TopoDS_Face& other, double tolerance);

/// Sews the faces of a shape (BRepBuilderAPI_Sewing, non-manifold edges allowed). The faces keep their order,
/// and so their numbers, and form the same solids; edges and vertices are renumbered. Where edges were
/// joined, faces outside solids are oriented alike, see orient_alike(). Throws Standard_Failure where
/// OpenCASCADE does. \param tolerance in the model's unit: edges no farther apart become one.
Sewn sew(const TopoDS_Shape& shape, double tolerance);

}  // namespace quadrille
