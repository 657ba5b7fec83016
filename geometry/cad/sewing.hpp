#pragma once
/// Joining faces that touch but do not share their edges. Internal: users see CadModel::sewn().

#include <TopoDS_Shape.hxx>

namespace quadrille {

/// Sews the faces of a shape (BRepBuilderAPI_Sewing, non-manifold edges allowed). The faces keep their order,
/// and so their numbers, and form the same solids; edges and vertices are renumbered. Throws Standard_Failure
/// where OpenCASCADE does. \param tolerance in the model's unit: edges no farther apart become one.
/// \param joined returns the number of edges that were joined to others.
TopoDS_Shape sew(const TopoDS_Shape& shape, double tolerance, int& joined);

}  // namespace quadrille
