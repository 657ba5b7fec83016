#include "geometry/midsurface/solids.hpp"

#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBndLib.hxx>
#include <BRepClass3d_SolidClassifier.hxx>
#include <Precision.hxx>
#include <TopExp.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>

#include "geometry/base/error.hpp"
#include "geometry/midsurface/gaps.hpp"

namespace quadrille {

namespace {

/// Solids, and the numbers of their faces.
struct Solids {
  TopTools_IndexedMapOfShape solids;
  TopTools_DataMapOfShapeInteger numbers;
};

/// The same solid with the material inside.
TopoDS_Solid right_way_out(const TopoDS_Shape& shape) {
  TopoDS_Solid solid = TopoDS::Solid(shape);
  BRepClass3d_SolidClassifier classifier(solid);
  classifier.PerformInfinitePoint(Precision::Confusion());
  if (classifier.State() == TopAbs_IN) solid.Reverse();
  return solid;
}

Solids solids_of(const TopoDS_Shape& shape) {
  Solids result;
  TopTools_IndexedMapOfShape faces, solids;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  TopExp::MapShapes(shape, TopAbs_SOLID, solids);
  for (int i = 1; i <= faces.Extent(); ++i) result.numbers.Bind(faces(i), i);
  for (int i = 1; i <= solids.Extent(); ++i) result.solids.Add(right_way_out(solids(i)));
  return result;
}

std::deque<Skin> skins_of(const Solids& solids) {
  std::deque<Skin> result;
  for (int i = 1; i <= solids.solids.Extent(); ++i) {
    const TopoDS_Solid solid = right_way_out(solids.solids(i));
    Bnd_Box box;
    BRepBndLib::Add(solid, box, Standard_False);
    triangulate(solid, 1e-3 * std::sqrt(box.SquareExtent()));
    result.emplace_back(solid, solids.numbers);
  }
  return result;
}

/// Adds what closes the gaps to the solids.
void close_gaps(Solids& solids) {
  const GapFillers fillers = fill_gaps(skins_of(solids));
  for (const TopoDS_Shape& filler : fillers.solids) solids.solids.Add(right_way_out(filler));
  for (TopTools_DataMapOfShapeInteger::Iterator it(fillers.numbers); it.More(); it.Next())
    solids.numbers.Bind(it.Key(), it.Value());
}

Solids fused(const Solids& apart) {
  TopTools_ListOfShape first, others;
  for (int i = 1; i <= apart.solids.Extent(); ++i) (i == 1 ? first : others).Append(apart.solids(i));
  BRepAlgoAPI_Fuse fuse;
  fuse.SetArguments(first);
  fuse.SetTools(others);
  fuse.SetNonDestructive(Standard_True);
  fuse.Build();
  if (fuse.HasErrors()) throw failure("", "the solids cannot be joined to one");
  Solids result;
  TopExp::MapShapes(fuse.Shape(), TopAbs_SOLID, result.solids);
  for (TopTools_DataMapOfShapeInteger::Iterator it(apart.numbers); it.More(); it.Next()) {
    TopTools_ListOfShape parts = fuse.Modified(it.Key());
    if (parts.IsEmpty()) parts.Append(it.Key());
    for (const TopoDS_Shape& part : parts) {
      // Where two lie in one place the lower number counts, whatever the order of the map.
      if (!result.numbers.IsBound(part) || result.numbers.Find(part) > it.Value())
        result.numbers.Bind(part, it.Value());
    }
  }
  return result;
}

}  // namespace

std::deque<Skin> skins_of(const TopoDS_Shape& shape, bool join) {
  Solids solids = solids_of(shape);
  if (join && solids.solids.Extent() > 1) {
    close_gaps(solids);
    solids = fused(solids);
  }
  return skins_of(solids);
}

}  // namespace quadrille
