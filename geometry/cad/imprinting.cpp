/// Runs OpenCASCADE's general fuse on a model's parts, then numbers the pieces so that faces keep theirs.

#include "geometry/cad/imprinting.hpp"

#include <BOPAlgo_Builder.hxx>
#include <BRep_Builder.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Shell.hxx>
#include <algorithm>
#include <map>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace quadrille {

namespace {

/// The pieces of a shell that share no edges; the shell itself if it is in one piece. OpenCASCADE looks for
/// contacts between arguments only, and files put plates that cross into one shell.
std::vector<TopoDS_Shape> pieces_of(const TopoDS_Shape& shell) {
  TopTools_IndexedMapOfShape faces;
  TopTools_IndexedDataMapOfShapeListOfShape faces_of;
  TopExp::MapShapes(shell, TopAbs_FACE, faces);
  TopExp::MapShapesAndAncestors(shell, TopAbs_EDGE, TopAbs_FACE, faces_of);
  std::vector<char> met(faces.Extent() + 1, 0);
  std::vector<TopoDS_Shape> pieces;
  const BRep_Builder builder;
  for (int seed = 1; seed <= faces.Extent(); ++seed) {
    if (met[seed]) continue;
    TopoDS_Shell piece;
    builder.MakeShell(piece);
    std::vector<int> work{seed};
    met[seed] = 1;
    for (std::size_t i = 0; i < work.size(); ++i) {
      const TopoDS_Shape& face = faces(work[i]);
      builder.Add(piece, face);
      for (TopExp_Explorer edge(face, TopAbs_EDGE); edge.More(); edge.Next())
        for (const TopoDS_Shape& neighbor : faces_of.FindFromKey(edge.Current())) {
          const int number = faces.FindIndex(neighbor);
          if (met[number]) continue;
          met[number] = 1;
          work.push_back(number);
        }
    }
    if (static_cast<int>(work.size()) == faces.Extent()) return {shell};
    pieces.push_back(work.size() > 1 ? TopoDS_Shape(piece) : faces(seed));
  }
  return pieces;
}

/// The solids, the connected faces outside solids, and single faces, in the order of the shape.
std::vector<TopoDS_Shape> parts_of(const TopoDS_Shape& shape) {
  TopTools_IndexedMapOfShape parts;
  for (TopExp_Explorer part(shape, TopAbs_SOLID); part.More(); part.Next()) parts.Add(part.Current());
  for (TopExp_Explorer part(shape, TopAbs_SHELL, TopAbs_SOLID); part.More(); part.Next())
    for (const TopoDS_Shape& piece : pieces_of(part.Current())) parts.Add(piece);
  for (TopExp_Explorer part(shape, TopAbs_FACE, TopAbs_SHELL); part.More(); part.Next())
    parts.Add(part.Current());
  std::vector<TopoDS_Shape> list;  // one by one: for GCC 16, OpenCASCADE's iterators make no range
  for (int i = 1; i <= parts.Extent(); ++i) list.push_back(parts(i));
  return list;
}

/// What a part of the model became; itself if no other part met it.
std::vector<TopoDS_Shape> images_of(BOPAlgo_Builder& fuse, const TopoDS_Shape& part) {
  std::vector<TopoDS_Shape> images;
  for (const TopoDS_Shape& image : fuse.Modified(part)) images.push_back(image);
  if (images.empty() && !fuse.IsDeleted(part)) images.push_back(part);
  return images;
}

std::string reason_of(const BOPAlgo_Builder& fuse) {
  std::ostringstream text;
  fuse.DumpErrors(text);
  std::string reason = text.str();
  reason = reason.substr(0, reason.find('\n'));
  return reason.empty() ? "no reason given" : reason;
}

/// For each face, edge or vertex of the shape before: the numbers of those that it became, ascending.
std::vector<std::vector<int>> numbers_of_pieces(BOPAlgo_Builder& fuse, const TopoDS_Shape& before,
                                                const TopoDS_Shape& after, TopAbs_ShapeEnum kind) {
  TopTools_IndexedMapOfShape old, numbers;
  TopExp::MapShapes(before, kind, old);
  TopExp::MapShapes(after, kind, numbers);
  std::vector<std::vector<int>> pieces;
  for (int i = 1; i <= old.Extent(); ++i) {
    std::vector<int>& found = pieces.emplace_back();
    for (const TopoDS_Shape& piece : images_of(fuse, old(i)))
      if (const int number = numbers.FindIndex(piece); number > 0) found.push_back(number);
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
  }
  return pieces;
}

/// The pieces of the faces in the order in which they are numbered.
class Numbering {
 public:
  explicit Numbering(const std::vector<std::vector<TopoDS_Shape>>& images) {
    // Faces of one piece come first: a face that others cut can take another of its pieces.
    place_.resize(images.size());
    for (std::size_t i = 0; i < images.size(); ++i)
      if (images[i].size() == 1) take(i, images[i]);
    for (std::size_t i = 0; i < images.size(); ++i)
      if (images[i].size() > 1) take(i, images[i]);
    for (const std::vector<TopoDS_Shape>& own : images)
      for (const TopoDS_Shape& piece : own)
        if (taken_.Add(piece)) place_.push_back(piece);
    for (std::size_t i = 0; i < place_.size();) {
      if (!place_[i].IsNull()) {
        ++i;
        continue;
      }
      place_[i] = place_.back();
      place_.pop_back();
    }
  }

  const std::vector<TopoDS_Shape>& faces() const { return place_; }

 private:
  void take(std::size_t face, const std::vector<TopoDS_Shape>& pieces) {
    const auto free = std::find_if(pieces.begin(), pieces.end(),
                                   [&](const TopoDS_Shape& piece) { return taken_.Add(piece); });
    if (free != pieces.end()) place_[face] = *free;
  }

  std::vector<TopoDS_Shape> place_;
  TopTools_MapOfShape taken_;
};

}  // namespace

Imprint imprint(const TopoDS_Shape& shape, double tolerance) {
  const std::vector<TopoDS_Shape> parts = parts_of(shape);
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  if (parts.size() < 2) {
    const auto all_of = [&](TopAbs_ShapeEnum kind) {
      TopTools_IndexedMapOfShape all;
      TopExp::MapShapes(shape, kind, all);
      std::vector<std::vector<int>> same;
      for (int i = 1; i <= all.Extent(); ++i) same.push_back({i});
      return same;
    };
    return {shape, all_of(TopAbs_FACE), all_of(TopAbs_EDGE), all_of(TopAbs_VERTEX)};
  }
  BOPAlgo_Builder fuse;
  for (const TopoDS_Shape& part : parts) fuse.AddArgument(part);
  fuse.SetNonDestructive(Standard_True);
  fuse.SetRunParallel(Standard_False);
  if (tolerance > 0) fuse.SetFuzzyValue(tolerance);
  fuse.Perform();
  if (fuse.HasErrors()) throw Standard_Failure(reason_of(fuse).c_str());
  std::vector<std::vector<TopoDS_Shape>> pieces;
  for (int i = 1; i <= faces.Extent(); ++i) {
    pieces.push_back(images_of(fuse, faces(i)));
    if (pieces.back().empty()) throw Standard_Failure(fmt::format("Face{} is lost", i).c_str());
  }
  const Numbering numbering(pieces);

  // Faces are numbered in the order in which they are met. So they come first, before the parts made of them.
  const BRep_Builder builder;
  TopoDS_Compound all, skin;
  builder.MakeCompound(all);
  builder.MakeCompound(skin);
  for (const TopoDS_Shape& face : numbering.faces()) builder.Add(skin, face);
  builder.Add(all, skin);
  TopTools_MapOfShape added;
  for (const TopoDS_Shape& part : parts) {
    if (part.ShapeType() == TopAbs_FACE) continue;
    for (const TopoDS_Shape& image : images_of(fuse, part))
      if (added.Add(image)) builder.Add(all, image);
  }
  TopTools_IndexedMapOfShape numbers;
  TopExp::MapShapes(all, TopAbs_FACE, numbers);
  if (numbers.Extent() != static_cast<int>(numbering.faces().size()))
    throw Standard_Failure("faces appear that are not pieces of the model's faces");

  return {all, numbers_of_pieces(fuse, shape, all, TopAbs_FACE),
          numbers_of_pieces(fuse, shape, all, TopAbs_EDGE),
          numbers_of_pieces(fuse, shape, all, TopAbs_VERTEX)};
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
