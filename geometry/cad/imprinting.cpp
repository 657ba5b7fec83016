/// Makes swept surfaces elementary, closes seams that are two edges, runs OpenCASCADE's general fuse on the
/// parts, numbers the pieces so that faces keep theirs, and orients those outside solids.

#include "geometry/cad/imprinting.hpp"

#include <BOPAlgo_Builder.hxx>
#include <BOPTools_AlgoTools.hxx>
#include <BRepAdaptor_Curve.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepTools_Modifier.hxx>
#include <Precision.hxx>
#include <ShapeCustom_SweptToElementary.hxx>
#include <Standard_Failure.hxx>
#include <TopTools_DataMapOfShapeShape.hxx>
#include <TopTools_MapOfShape.hxx>
#include <algorithm>
#include <iterator>
#include <map>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "geometry/cad/shape_parts.hpp"

namespace quadrille {

namespace {

/// The solids, the connected faces outside solids, and single faces, in the order of the shape. OpenCASCADE
/// looks for contacts between arguments only, and files put plates that cross into one shell.
std::vector<TopoDS_Shape> parts_of(const TopoDS_Shape& shape) {
  TopTools_IndexedMapOfShape parts;
  for (TopExp_Explorer part(shape, TopAbs_SOLID); part.More(); part.Next()) parts.Add(part.Current());
  for (TopExp_Explorer part(shape, TopAbs_SHELL, TopAbs_SOLID); part.More(); part.Next()) {
    TopTools_ListOfShape pieces;
    BOPTools_AlgoTools::MakeConnexityBlocks(part.Current(), TopAbs_EDGE, TopAbs_FACE, pieces);
    if (pieces.Size() < 2)
      parts.Add(part.Current());
    else
      for (const TopoDS_Shape& piece : pieces) parts.Add(piece);
  }
  for (TopExp_Explorer part(shape, TopAbs_FACE, TopAbs_SHELL); part.More(); part.Next())
    parts.Add(part.Current());
  return {parts.cbegin(), parts.cend()};
}

/// A curve's ends and middle.
struct Course {
  gp_Pnt first, middle, last;
  double tolerance;

  explicit Course(const TopoDS_Edge& edge) : tolerance(BRep_Tool::Tolerance(edge)) {
    const BRepAdaptor_Curve curve(edge);
    const double from = curve.FirstParameter(), to = curve.LastParameter();
    first = curve.Value(from);
    middle = curve.Value((from + to) / 2);
    last = curve.Value(to);
  }
  bool lies_on(const Course& other, double near) const {
    near = std::max({near, tolerance, other.tolerance});
    const auto meet = [&](const gp_Pnt& a, const gp_Pnt& b) { return a.Distance(b) <= near; };
    return meet(middle, other.middle) && ((meet(first, other.first) && meet(last, other.last)) ||
                                          (meet(first, other.last) && meet(last, other.first)));
  }
};

/// Whether two edges of a face lie on each other, as the seams in IGES files do. The fuse makes them one
/// edge, but gives it one parametric curve and loses the face.
bool has_open_seam(const TopoDS_Shape& face, double tolerance) {
  std::vector<Course> courses;
  for (const TopoDS_Shape& part : list_of(face, TopAbs_EDGE)) {
    const TopoDS_Edge& edge = TopoDS::Edge(part);
    if (BRep_Tool::Degenerated(edge) || BRep_Tool::IsClosed(edge, TopoDS::Face(face))) continue;
    const Course course(edge);
    if (std::any_of(courses.begin(), courses.end(),
                    [&](const Course& other) { return course.lies_on(other, tolerance); }))
      return true;
    courses.push_back(course);
  }
  return false;
}

/// Asked for the curve of an edge on a face that is not made yet, which BRepTools_Modifier does where it only
/// wants a vertex's tolerance, OpenCASCADE crashes.
class SweptToElementary : public ShapeCustom_SweptToElementary {
 public:
  Standard_Boolean NewCurve2d(const TopoDS_Edge& edge, const TopoDS_Face& face, const TopoDS_Edge& new_edge,
                              const TopoDS_Face& new_face, Handle(Geom2d_Curve) & curve,
                              Standard_Real& tolerance) override {
    return !new_face.IsNull() &&
           ShapeCustom_SweptToElementary::NewCurve2d(edge, face, new_edge, new_face, curve, tolerance);
  }
};

/// The general fuse of a model's parts with elementary surfaces and closed seams.
class Fuse {
 public:
  Fuse(const TopoDS_Shape& shape, double tolerance) : parts_(parts_of(elementary(shape))) {
    for (TopoDS_Shape& part : parts_)
      if (part.ShapeType() != TopAbs_SOLID) close_seams(part, tolerance);
    if (parts_.size() < 2) return;
    for (const TopoDS_Shape& part : parts_) builder_.AddArgument(part);
    builder_.SetNonDestructive(Standard_True);
    builder_.SetRunParallel(Standard_False);
    if (tolerance > 0) builder_.SetFuzzyValue(tolerance);
    builder_.Perform();
    if (builder_.HasErrors()) throw Standard_Failure(reason().c_str());
  }

  const std::vector<TopoDS_Shape>& parts() const { return parts_; }

  /// Whether there is nothing to join.
  bool is_idle() const { return parts_.size() < 2 && !sewn_; }

  /// What a solid, face, edge or vertex of the model became; itself if no other part met it.
  std::vector<TopoDS_Shape> images_of(const TopoDS_Shape& original) {
    TopoDS_Shape part = original;
    while (const TopoDS_Shape* instead = instead_.Seek(part)) part = *instead;
    std::vector<TopoDS_Shape> images;
    for (const TopoDS_Shape& image : builder_.Modified(part)) images.push_back(image);
    if (images.empty() && !builder_.IsDeleted(part)) images.push_back(part);
    return images;
  }

 private:
  /// The shape with cylinders, cones and tori where it has swept lines and circles, as IGES files do. Where
  /// such surfaces graze each other, the fuse may take minutes.
  TopoDS_Shape elementary(const TopoDS_Shape& shape) {
    BRepTools_Modifier modifier(shape);
    modifier.Perform(new SweptToElementary);
    const TopoDS_Shape result = modifier.ModifiedShape(shape).Oriented(shape.Orientation());
    TopTools_IndexedMapOfShape before, after;
    TopExp::MapShapes(shape, before);
    TopExp::MapShapes(result, after);
    if (before.Extent() != after.Extent()) return shape;
    for (int i = 1; i <= before.Extent(); ++i) replace(before(i), after(i));
    return result;
  }

  void replace(const TopoDS_Shape& part, const TopoDS_Shape& other) {
    if (!other.IsNull() && !part.IsSame(other)) instead_.Bind(part, other);
  }

  /// Sews a part with itself, if need be.
  void close_seams(TopoDS_Shape& part, double tolerance) {
    const TopTools_IndexedMapOfShape faces = map_of(part, TopAbs_FACE);
    if (std::none_of(faces.cbegin(), faces.cend(),
                     [&](const TopoDS_Shape& face) { return has_open_seam(face, tolerance); }))
      return;
    BRepBuilderAPI_Sewing sewing(std::max(tolerance, Precision::Confusion()), true, true, false, true);
    for (int i = 1; i <= faces.Extent(); ++i) sewing.Add(faces(i));
    sewing.Perform();
    std::vector<TopoDS_Shape> sewn;
    for (int i = 1; i <= faces.Extent(); ++i) sewn.push_back(sewing.ModifiedSubShape(faces(i)));
    if (std::any_of(sewn.begin(), sewn.end(), [](const TopoDS_Shape& face) {
          return face.IsNull() || face.ShapeType() != TopAbs_FACE;
        }))
      return;
    TopTools_IndexedMapOfShape all;
    TopExp::MapShapes(part, all);
    for (int i = 1; i <= all.Extent(); ++i) replace(all(i), sewing.ModifiedSubShape(all(i)));
    sewn_ = true;
    part = with_faces(part, faces, sewn);
  }

  std::string reason() const {
    std::ostringstream text;
    builder_.DumpErrors(text);
    const std::string first = text.str().substr(0, text.str().find('\n'));
    return first.empty() ? "no reason given" : first;
  }

  TopTools_DataMapOfShapeShape instead_;  // what replaces parts of the model, or what replaced them
  bool sewn_ = false;
  BOPAlgo_Builder builder_;
  std::vector<TopoDS_Shape> parts_;
};

/// For each face, edge or vertex of the shape before: the numbers of those that it became, ascending.
std::vector<std::vector<int>> numbers_of_pieces(Fuse& fuse, const TopoDS_Shape& before,
                                                const TopoDS_Shape& after, TopAbs_ShapeEnum kind) {
  const TopTools_IndexedMapOfShape numbers = map_of(after, kind);
  std::vector<std::vector<int>> pieces;
  for (const TopoDS_Shape& old : list_of(before, kind)) {
    std::vector<int>& found = pieces.emplace_back();
    for (const TopoDS_Shape& piece : fuse.images_of(old))
      if (const int number = numbers.FindIndex(piece); number > 0) found.push_back(number);
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
  }
  return pieces;
}

/// The pieces of the faces in the order in which they are numbered.
std::vector<TopoDS_Shape> numbered(const std::vector<std::vector<TopoDS_Shape>>& images) {
  std::vector<TopoDS_Shape> place(images.size());
  TopTools_MapOfShape taken;
  const auto is_free = [&](const TopoDS_Shape& piece) { return taken.Add(piece); };
  // Faces of one piece come first: a face that others cut can take another of its pieces.
  for (const bool whole : {true, false}) {
    for (std::size_t i = 0; i < images.size(); ++i) {
      if ((images[i].size() == 1) != whole) continue;
      const auto free = std::find_if(images[i].begin(), images[i].end(), is_free);
      if (free != images[i].end()) place[i] = *free;
    }
  }
  for (const std::vector<TopoDS_Shape>& own : images)
    std::copy_if(own.begin(), own.end(), std::back_inserter(place), is_free);
  for (std::size_t i = 0; i < place.size();) {
    if (!place[i].IsNull()) {
      ++i;
      continue;
    }
    place[i] = place.back();
    place.pop_back();
  }
  return place;
}

/// The solids after the fuse, each once. Shells have no images of their own: their faces have.
TopoDS_Compound solids_of(Fuse& fuse) {
  std::vector<TopoDS_Shape> solids;
  TopTools_MapOfShape added;
  for (const TopoDS_Shape& part : fuse.parts()) {
    if (part.ShapeType() != TopAbs_SOLID) continue;
    for (const TopoDS_Shape& image : fuse.images_of(part))
      if (added.Add(image)) solids.push_back(image);
  }
  return compound_of(solids);
}

}  // namespace

Imprint imprint(const TopoDS_Shape& shape, double tolerance) {
  Fuse fuse(shape, tolerance);
  if (fuse.is_idle()) {
    const auto all_of = [&](TopAbs_ShapeEnum kind) {
      std::vector<std::vector<int>> same(map_of(shape, kind).Extent());
      for (std::size_t i = 0; i < same.size(); ++i) same[i] = {static_cast<int>(i) + 1};
      return same;
    };
    return {shape, all_of(TopAbs_FACE), all_of(TopAbs_EDGE), all_of(TopAbs_VERTEX), {}};
  }
  std::vector<std::vector<TopoDS_Shape>> pieces;
  for (const TopoDS_Shape& face : list_of(shape, TopAbs_FACE)) {
    pieces.push_back(fuse.images_of(face));
    if (pieces.back().empty()) throw Standard_Failure(fmt::format("Face{} is lost", pieces.size()).c_str());
  }
  std::vector<TopoDS_Shape> faces = numbered(pieces);
  const TopoDS_Compound solids = solids_of(fuse);
  TopTools_IndexedMapOfShape numbers;
  for (const TopoDS_Shape& face : faces) numbers.Add(face);
  TopExp::MapShapes(solids, TopAbs_FACE, numbers);
  if (numbers.Extent() != static_cast<int>(faces.size()))
    throw Standard_Failure("faces appear that are not pieces of the model's faces");
  Imprint result;
  result.pieces = numbers_of_pieces(fuse, shape, compound_of(faces), TopAbs_FACE);
  result.orientation = orient_alike(faces, faces_in_solids(solids, numbers), result.pieces);
  // Faces are numbered in the order in which they are met. So they come first, before the solids made of
  // them.
  const TopoDS_Compound all = compound_of(std::vector{compound_of(faces), solids});
  result.shape = all;
  result.edge_pieces = numbers_of_pieces(fuse, shape, all, TopAbs_EDGE);
  result.vertex_pieces = numbers_of_pieces(fuse, shape, all, TopAbs_VERTEX);
  return result;
}

std::vector<std::string> changes_of_faces(const std::vector<std::vector<int>>& pieces) {
  std::map<int, int> sources;
  for (const std::vector<int>& own : pieces)
    for (const int number : own) ++sources[number];
  std::vector<std::string> changes;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const int face = static_cast<int>(i) + 1;
    const std::vector<int>& own = pieces[i];
    if (own == std::vector<int>{face} && sources[face] == 1) continue;
    std::vector<std::string> names;
    names.reserve(own.size());
    for (const int number : own)
      names.push_back(fmt::format("Face{}{}", number, sources[number] > 1 ? " (shared)" : ""));
    changes.push_back(fmt::format("Face{} became {}", face, fmt::join(names, ", ")));
  }
  return changes;
}

}  // namespace quadrille
