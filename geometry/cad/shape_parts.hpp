#pragma once
/// The parts of OpenCASCADE's shapes, and shapes made of parts. Internal.

#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Iterator.hxx>
#include <vector>

namespace quadrille {

/// The faces, edges or other parts of a shape, each once, numbered in the order in which they are met.
inline TopTools_IndexedMapOfShape map_of(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind) {
  TopTools_IndexedMapOfShape parts;
  TopExp::MapShapes(shape, kind, parts);
  return parts;
}

/// The same for a list of shapes.
template <class Shape>
TopTools_IndexedMapOfShape map_of(const std::vector<Shape>& shapes, TopAbs_ShapeEnum kind) {
  TopTools_IndexedMapOfShape parts;
  for (const TopoDS_Shape& shape : shapes) TopExp::MapShapes(shape, kind, parts);
  return parts;
}

/// The parts of a shape as a list. For GCC 16, OpenCASCADE's iterators make no range.
inline std::vector<TopoDS_Shape> list_of(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind) {
  const TopTools_IndexedMapOfShape parts = map_of(shape, kind);
  return {parts.cbegin(), parts.cend()};
}

/// The edges of a shape that are no points, once for each use by a wire: a seam twice.
inline std::vector<TopoDS_Edge> edges_of(const TopoDS_Shape& shape) {
  std::vector<TopoDS_Edge> result;
  for (TopExp_Explorer it(shape, TopAbs_EDGE); it.More(); it.Next())
    if (const TopoDS_Edge& edge = TopoDS::Edge(it.Current()); !BRep_Tool::Degenerated(edge))
      result.push_back(edge);
  return result;
}

/// \param shapes faces, solids or others
template <class Shapes>
TopoDS_Compound compound_of(const Shapes& shapes) {
  const BRep_Builder builder;
  TopoDS_Compound compound;
  builder.MakeCompound(compound);
  for (const TopoDS_Shape& shape : shapes) builder.Add(compound, shape);
  return compound;
}

/// The same solids and shells, in the same order, built of other faces. \param faces the faces of the shape.
/// \param others the replacement of each face, oriented as that face is.
inline TopoDS_Shape with_faces(const TopoDS_Shape& shape, const TopTools_IndexedMapOfShape& faces,
                               const std::vector<TopoDS_Shape>& others) {
  if (shape.ShapeType() == TopAbs_FACE) {
    const int number = faces.FindIndex(shape);
    const bool turned = faces(number).Orientation() != shape.Orientation();
    return turned ? others[number - 1].Reversed() : others[number - 1];
  }
  if (shape.ShapeType() > TopAbs_FACE) return shape;
  TopoDS_Shape result = shape.EmptyCopied();
  result.Location(TopLoc_Location());  // the iterated parts already contain location and orientation
  result.Orientation(TopAbs_FORWARD);
  const BRep_Builder builder;
  for (TopoDS_Iterator part(shape); part.More(); part.Next())
    builder.Add(result, with_faces(part.Value(), faces, others));
  return result;
}

}  // namespace quadrille
