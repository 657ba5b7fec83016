/// Joins edges by BRepBuilderAPI_Sewing, orients connected faces, and finds coincident faces by inner points.

#include "geometry/cad/sewing.hpp"

#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepTools.hxx>
#include <BRepTopAdaptor_FClass2d.hxx>
#include <BRep_Tool.hxx>
#include <GeomAPI_ProjectPointOnSurf.hxx>
#include <Geom_Surface.hxx>
#include <Precision.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <map>
#include <optional>

#include "geometry/cad/face_exchange.hpp"

namespace quadrille {

namespace {

using Faces = std::vector<TopoDS_Shape>;

/// The edges that bound a face, by number, ascending: no seams, no poles.
std::vector<int> rim_of(const TopoDS_Shape& face, const TopTools_IndexedMapOfShape& edges) {
  std::map<int, int> uses;
  for (TopExp_Explorer edge(face, TopAbs_EDGE); edge.More(); edge.Next())
    if (!BRep_Tool::Degenerated(TopoDS::Edge(edge.Current()))) ++uses[edges.FindIndex(edge.Current())];
  std::vector<int> rim;
  for (const auto& [edge, times] : uses)
    if (times == 1) rim.push_back(edge);
  return rim;
}

/// A point inside a face: of a grid over its parameters, the one nearest the middle.
std::optional<gp_Pnt> inner_point(const TopoDS_Face& face) {
  double u0 = 0, u1 = 0, v0 = 0, v1 = 0;
  BRepTools::UVBounds(face, u0, u1, v0, v1);
  BRepTopAdaptor_FClass2d inside(face, Precision::PConfusion());
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  constexpr std::array<double, 9> shares{0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8, 0.1, 0.9};
  for (const double s : shares)
    for (const double t : shares) {
      const gp_Pnt2d uv(u0 + s * (u1 - u0), v0 + t * (v1 - v0));
      if (inside.Perform(uv) == TopAbs_IN) return surface->Value(uv.X(), uv.Y());
    }
  return std::nullopt;
}

/// Whether an inner point of one face lies within the tolerance on the other. Both faces have the same edges.
bool lies_on(const TopoDS_Face& face, const TopoDS_Face& other, double tolerance) {
  const std::optional<gp_Pnt> point = inner_point(face);
  if (!point) return false;
  GeomAPI_ProjectPointOnSurf foot(*point, BRep_Tool::Surface(other));
  if (foot.NbPoints() == 0 || foot.LowerDistance() > tolerance) return false;
  double u = 0, v = 0;
  foot.LowerDistanceParameters(u, v);
  return BRepTopAdaptor_FClass2d(other, Precision::PConfusion()).Perform(gp_Pnt2d(u, v)) != TopAbs_OUT;
}

std::vector<std::array<int, 2>> coincident_faces(const Faces& faces, const TopTools_IndexedMapOfShape& edges,
                                                 double tolerance) {
  std::map<std::vector<int>, std::vector<int>> by_rim;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    std::vector<int> rim = rim_of(faces[i], edges);
    if (!rim.empty()) by_rim[std::move(rim)].push_back(static_cast<int>(i));
  }
  std::vector<std::array<int, 2>> pairs;
  for (const auto& [rim, group] : by_rim)
    for (std::size_t i = 0; i < group.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (lies_on(TopoDS::Face(faces[group[j]]), TopoDS::Face(faces[group[i]]), tolerance))
          pairs.push_back({group[j] + 1, group[i] + 1});
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Orients faces outside solids consistently across edges that two faces share.
class Turning {
 public:
  Turning(Faces& faces, const TopTools_IndexedMapOfShape& edges, const std::vector<char>& fixed)
      : faces_(faces), fixed_(fixed), uses_(edges.Extent() + 1), uses_of_(faces.size()) {
    for (int face = 0; face < static_cast<int>(faces.size()); ++face)
      for (TopExp_Explorer it(faces[face], TopAbs_EDGE); it.More(); it.Next()) {
        const bool forward = it.Current().Orientation() == TopAbs_FORWARD;
        if (!forward && it.Current().Orientation() != TopAbs_REVERSED) continue;
        const int edge = edges.FindIndex(it.Current());
        uses_[edge].push_back({face, forward});
        uses_of_[face].push_back(edge);
      }
  }

  /// Returns the numbers of the faces that were reversed.
  std::vector<int> run() {
    std::vector<int> turned;
    std::vector<char> met(faces_.size(), 0);
    for (int seed = 0; seed < static_cast<int>(faces_.size()); ++seed) {
      if (met[seed]) continue;
      std::vector<int> piece{seed};
      std::map<int, bool> opposite{{seed, false}};
      bool one_sided = false;
      for (std::size_t at = 0; at < piece.size(); ++at) visit(piece[at], piece, opposite, one_sided);
      const auto movable = [&](int face) { return !fixed_[face]; };
      const bool free = std::all_of(piece.begin(), piece.end(), movable);
      for (const int face : piece) met[face] = 1;
      if (one_sided || !free) continue;
      const auto against = std::count_if(piece.begin(), piece.end(), [&](int f) { return opposite[f]; });
      const bool minority = 2 * against <= static_cast<std::ptrdiff_t>(piece.size());
      for (const int face : piece) {
        if (opposite[face] != minority) continue;
        faces_[face].Reverse();
        turned.push_back(face + 1);
      }
    }
    std::sort(turned.begin(), turned.end());
    return turned;
  }

 private:
  struct Use {
    int face;
    bool forward;
  };

  /// Adds the neighbors of a face to its piece, with their orientations.
  void visit(int face, std::vector<int>& piece, std::map<int, bool>& opposite, bool& one_sided) const {
    for (const int edge : uses_of_[face]) {
      const std::vector<Use>& uses = uses_[edge];
      if (uses.size() != 2 || uses[0].face == uses[1].face) continue;
      const int other = uses[0].face == face ? uses[1].face : uses[0].face;
      const bool alike = uses[0].forward != uses[1].forward;
      const auto [entry, fresh] = opposite.try_emplace(other, alike == opposite[face]);
      if (fresh)
        piece.push_back(other);
      else if (entry->second != (alike == opposite[face]))
        one_sided = true;
    }
  }

  Faces& faces_;
  const std::vector<char>& fixed_;
  std::vector<std::vector<Use>> uses_;
  std::vector<std::vector<int>> uses_of_;
};

}  // namespace

Sewn sew(const TopoDS_Shape& shape, double tolerance) {
  TopTools_IndexedMapOfShape faces, edges_before, edges_of_sewn, edges_after;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  TopExp::MapShapes(shape, TopAbs_EDGE, edges_before);
  BRepBuilderAPI_Sewing sewing(tolerance);
  sewing.SetNonManifoldMode(Standard_True);
  for (int i = 1; i <= faces.Extent(); ++i) sewing.Add(faces(i));
  sewing.Perform();
  // Sewn shells have their faces in another order. Exchanging the faces keeps the model's order and solids.
  Faces sewn;
  for (int i = 1; i <= faces.Extent(); ++i) {
    sewn.push_back(sewing.IsModified(faces(i)) ? sewing.Modified(faces(i)) : TopoDS_Shape(faces(i)));
    TopExp::MapShapes(sewn.back(), TopAbs_EDGE, edges_of_sewn);
  }
  Sewn result;
  const bool all_are_faces = std::all_of(sewn.begin(), sewn.end(), [](const TopoDS_Shape& face) {
    return !face.IsNull() && face.ShapeType() == TopAbs_FACE;
  });
  if (all_are_faces) {
    std::vector<char> in_solid(sewn.size(), 0);
    for (TopExp_Explorer solid(shape, TopAbs_SOLID); solid.More(); solid.Next())
      for (TopExp_Explorer face(solid.Current(), TopAbs_FACE); face.More(); face.Next())
        in_solid[faces.FindIndex(face.Current()) - 1] = 1;
    if (edges_of_sewn.Extent() < edges_before.Extent())
      result.turned = Turning(sewn, edges_of_sewn, in_solid).run();
    result.coincident = coincident_faces(sewn, edges_of_sewn, tolerance);
  }
  result.shape = with_faces(shape, faces, sewn);
  TopExp::MapShapes(result.shape, TopAbs_EDGE, edges_after);
  result.joined = edges_before.Extent() - edges_after.Extent();
  return result;
}

}  // namespace quadrille
