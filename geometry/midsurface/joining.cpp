/// Cuts the pieces of all walls at each other, keeps what bounds material, and merges faces of one wall.

#include "geometry/midsurface/joining.hpp"

#include <BOPAlgo_Builder.hxx>
#include <BRepTools_ReShape.hxx>
#include <Precision.hxx>
#include <ShapeUpgrade_UnifySameDomain.hxx>
#include <Standard_Failure.hxx>
#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS_Shell.hxx>
#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "geometry/base/error.hpp"
#include "geometry/cad/shape_parts.hpp"
#include "geometry/midsurface/checks.hpp"
#include "geometry/midsurface/edge_uses.hpp"
#include "geometry/midsurface/fusing.hpp"
#include "geometry/midsurface/widths.hpp"

namespace quadrille {

namespace {

/// The pieces, cut at each other.
struct Images {
  std::vector<JoinedFace> between;    ///< faces between the sides of their wall
  std::vector<JoinedFace> hung_over;  ///< faces past the sides of their wall, inside other walls
};

Images cut_pieces(const BOPAlgo_Builder& fuse, const std::vector<Wall>& walls,
                  const std::vector<std::vector<TopoDS_Face>>& pieces, const ExecutionContext& context) {
  constexpr double least_share = 0.25;
  Images result;
  for (std::size_t wall = 0; wall < walls.size(); ++wall) {
    for (const TopoDS_Face& piece : pieces[wall]) {
      for (const TopoDS_Shape& image : images(fuse, piece)) {
        context.check();
        const TopoDS_Face& face = TopoDS::Face(image);
        const Coverage coverage = coverage_of(face, walls[wall]);
        (coverage.share < least_share ? result.hung_over : result.between)
            .push_back({face, static_cast<int>(wall), false, coverage});
      }
    }
  }
  return result;
}

Coverage whole_coverage(int wall, const std::vector<Wall>& walls) {
  const double t = walls[wall].thickness;
  const std::vector<int> sides = both_sides(walls[wall]);
  return {1, t, t, t, {sides.begin(), sides.end()}};
}

/// Faces that may be added together: a piece that hangs over, or the pieces of fences at steps in one place.
using Strip = std::vector<JoinedFace>;

/// The pieces of fences at steps. Those that only other fences separate are one strip: there may be several
/// fences in one place, each a little higher than the step that it was made for.
std::vector<Strip> fences_at_steps(const BOPAlgo_Builder& fuse, const std::vector<WallEnd>& ends,
                                   const Images& cut) {
  std::vector<JoinedFace> pieces;
  TopTools_MapOfShape taken;
  for (const WallEnd& end : ends) {
    if (!end.step) continue;
    for (const TopoDS_Shape& image : images(fuse, end.fence))
      if (taken.Add(image)) pieces.push_back({TopoDS::Face(image), end.wall, true, {}});
  }
  const EdgeUses uses(pieces), between(cut.between), hung_over(cut.hung_over);
  boost::disjoint_sets_with_storage<> together(pieces.size());
  for (const auto& [edge, around] : uses) {
    if (around.size() != 2 || between.find(edge) != nullptr || hung_over.find(edge) != nullptr) continue;
    const gp_Vec first = fan_at(edge, pieces[around[0].face].face, 0.5).normal;
    if (std::abs(first.Dot(fan_at(edge, pieces[around[1].face].face, 0.5).normal)) > 0.999)
      together.union_set(around[0].face, around[1].face);
  }
  std::map<std::size_t, Strip> strips;  // by the piece that stands for it
  for (std::size_t i = 0; i < pieces.size(); ++i) strips[together.find_set(i)].push_back(pieces[i]);
  std::vector<Strip> result;
  result.reserve(strips.size());
  for (const auto& [piece, strip] : strips) result.push_back(strip);
  return result;
}

/// What a strip that may be added meets.
struct Contact {
  std::set<int> ended, met;  ///< walls that end inside the material there, and all walls
  int thinnest = -1;         ///< wall among them, rather not of a strip that was added
  double length = 0;         ///< of the edges at which they end
  std::vector<Fan> on_skin;  ///< the edges that would be free, on the skin
  double loose = 0;          ///< length of the longest edge that it would leave open
};

/// Lets walls that end inside the material grow up to the next one, along narrow strips: the part of a fence
/// between the two middles of a step, or what hangs over. Where a beam is flush with a thicker column, a
/// strip of the column's wall joins the beam's side; that side itself grows past where only a wall that hangs
/// over has cut it. \param strips those that may be added
void grow_to_others(const Skin& skin, const std::vector<Wall>& walls, const std::vector<WallEnd>& ends,
                    const std::vector<Strip>& strips, std::vector<JoinedFace>& faces) {
  std::set<std::pair<int, int>> steps;  // walls between which the thickness steps
  for (const WallEnd& end : ends) {
    if (end.step) steps.insert(std::minmax(end.wall, end.next));
  }
  std::vector<JoinedFace> pieces;
  for (const Strip& strip : strips) pieces.insert(pieces.end(), strip.begin(), strip.end());
  const EdgeUses among(pieces);
  TopTools_DataMapOfShapeInteger off_skin;  // by edge
  const auto is_off_skin = [&](const TopoDS_Edge& edge, double thickness) {
    if (const int* known = off_skin.Seek(edge)) return *known != 0;
    const bool off = skin.faces_at(point_at(edge, 0.5), 1e-3 * thickness).empty();
    off_skin.Bind(edge, off ? 1 : 0);
    return off;
  };
  bool bridges = false;  // first what belongs to a wall that ends, or to a step
  for (bool changed = true; changed || !bridges;) {
    bridges = bridges || !changed;
    changed = false;
    const EdgeUses uses(faces);
    TopTools_MapOfShape closed;  // edges at which a strip has just been added
    const auto ends_inside = [&](const TopoDS_Edge& edge, const std::vector<EdgeUses::Use>& around) {
      const EdgeUses::Use& use = around.front();
      return around.size() == 1 && use.orientation != TopAbs_INTERNAL &&
             is_off_skin(edge, walls[faces[use.face].wall].thickness);
    };
    const auto contact_of = [&](const Strip& strip) {
      Contact result;
      // A strip has the thickness of a wall of its step, not of a rib that crosses it; of a strip only if
      // need be.
      std::tuple<bool, bool, double> best;
      std::vector<TopoDS_Edge> loose;
      TopTools_MapOfShape met_vertices;
      for (const auto& [edge, own_uses] : EdgeUses(strip)) {
        const JoinedFace& piece = strip[own_uses.front().face];
        if (closed.Contains(edge)) return Contact();
        const std::vector<EdgeUses::Use>* around = uses.find(edge);
        if (around == nullptr) {
          const TopAbs_Orientation orientation = own_uses.front().orientation;
          if (among.find(edge)->size() > 1 || orientation == TopAbs_INTERNAL) continue;
          const bool off = is_off_skin(edge, walls[piece.wall].thickness);
          if (off && piece.step && !skin.in_material(point_at(edge, 0.5))) return Contact();
          if (off || piece.step) loose.push_back(edge);
          if (!off)
            result.on_skin.push_back(fan_at(TopoDS::Edge(edge.Oriented(orientation)), piece.face, 0.5));
          continue;
        }
        for (TopoDS_Iterator it(edge); it.More(); it.Next()) met_vertices.Add(it.Value());
        const bool ended = ends_inside(edge, *around);
        if (ended) result.length += length_of(edge);
        for (const EdgeUses::Use& use : *around) {
          const JoinedFace& face = faces[use.face];
          if (piece.step && use.orientation == TopAbs_INTERNAL) continue;  // only the fence has cut it
          result.met.insert(face.wall);
          if (ended) result.ended.insert(face.wall);
          const bool crosses =
              piece.step && face.wall != piece.wall && steps.count(std::minmax(piece.wall, face.wall)) == 0;
          const std::tuple order(crosses, face.step, walls[face.wall].thickness);
          if (result.thinnest >= 0 && best <= order) continue;
          result.thinnest = face.wall;
          best = order;
        }
      }
      for (const TopoDS_Edge& edge : loose) {
        // What is open at the end of a stretch of a step starts at a middle surface; other edges lie beside
        // it.
        const bool at_end = met_vertices.Contains(TopExp::FirstVertex(edge)) ||
                            met_vertices.Contains(TopExp::LastVertex(edge));
        result.loose = std::max(result.loose, strip.front().step && !at_end ? skin.size() : length_of(edge));
      }
      return result;
    };
    for (const Strip& strip : strips) {
      const Contact contact = contact_of(strip);
      if (contact.ended.empty() || contact.met.size() < 2) continue;
      const int wall = strip.front().wall;
      const bool step = strip.front().step;
      double area = 0;
      for (const JoinedFace& piece : strip) area += area_of(piece.face);
      if (area > walls[wall].thickness * contact.length) continue;
      if (contact.loose > walls[wall].thickness) continue;
      const bool own = !step && contact.ended.count(wall) != 0;
      if (!bridges && !own && !step) continue;
      const int joins = own ? wall : contact.thinnest;
      if (std::any_of(contact.on_skin.begin(), contact.on_skin.end(),
                      [&](const Fan& fan) { return leaves_through_side(walls, joins, fan); }))
        continue;
      for (const JoinedFace& piece : strip) {
        faces.push_back(own ? piece : JoinedFace{piece.face, joins, true, whole_coverage(joins, walls)});
        for (const TopoDS_Edge& edge : edges_of(piece.face)) closed.Add(edge);
      }
      changed = true;
    }
  }
}

/// Merges the faces of one wall, or those with its thickness at its steps, across edges that no other uses.
void merge_wall(int wall, bool steps, const std::vector<Wall>& walls, const std::vector<JoinedFace>& all,
                const TopTools_MapOfShape& kept_edges, std::vector<JoinedFace>& merged) {
  TopoDS_Shell shell;
  const BRep_Builder builder;
  builder.MakeShell(shell);
  std::vector<JoinedFace> own;
  for (const JoinedFace& face : all) {
    if (face.wall != wall || face.step != steps) continue;
    builder.Add(shell, face.face);
    own.push_back(face);
  }
  ShapeUpgrade_UnifySameDomain unify(shell, Standard_False, Standard_True, Standard_False);
  unify.KeepShapes(kept_edges);
  bool several = own.size() > 1;
  try {
    if (several) unify.Build();
  } catch (const Standard_Failure&) {  // as at some seams; the faces are right as they are
    several = false;
  }
  if (!several) {
    merged.insert(merged.end(), own.begin(), own.end());
    return;
  }
  for (const TopoDS_Shape& unified : list_of(unify.Shape(), TopAbs_FACE)) {  // the shell has some twice
    const TopoDS_Face& face = TopoDS::Face(unified);
    merged.push_back({face, wall, steps, coverage_of(face, walls[wall])});
    if (steps || merged.back().coverage.share == 0) merged.back().coverage = whole_coverage(wall, walls);
  }
}

std::vector<JoinedFace> merged_faces(const std::vector<Wall>& walls, const std::vector<JoinedFace>& faces,
                                     const ExecutionContext& context) {
  TopTools_MapOfShape kept_edges;
  for (const auto& [edge, around] : EdgeUses(faces)) {
    const JoinedFace& first = faces[around.front().face];
    for (const EdgeUses::Use& use : around)
      if (faces[use.face].wall != first.wall || faces[use.face].step != first.step) kept_edges.Add(edge);
  }
  std::vector<JoinedFace> result;
  for (const bool steps : {false, true}) {
    for (int wall = 0; wall < static_cast<int>(walls.size()); ++wall) {
      context.check();
      merge_wall(wall, steps, walls, faces, kept_edges, result);
    }
  }
  return result;
}

/// Cuts all pieces, and the fences that join steps, at each other. \param fuzzy distance within which shapes
/// count as touching. \return whether OpenCASCADE succeeded.
bool fuse_pieces(const std::vector<WallEnd>& ends, const std::vector<std::vector<TopoDS_Face>>& pieces,
                 double fuzzy, const ExecutionContext& context, BOPAlgo_Builder& fuse) {
  fuse.Clear();
  fuse.SetFuzzyValue(fuzzy);
  for (const auto& of_wall : pieces) {
    if (!of_wall.empty()) fuse.AddArgument(compound_of(of_wall));
  }
  for (const WallEnd& end : ends) {
    if (end.step) fuse.AddArgument(end.fence);
  }
  if (fuse.Arguments().Extent() > 1) perform(fuse, context);
  return !fuse.HasErrors();
}

}  // namespace

// Such edges remain where pieces that hung over were dropped.
void drop_traces(std::vector<JoinedFace>& faces) {
  BRepTools_ReShape traces;
  for (const auto& [edge, around] : EdgeUses(faces)) {
    const bool inside =
        std::all_of(around.begin(), around.end(), [face = around.front().face](const EdgeUses::Use& use) {
          return use.face == face && use.orientation == TopAbs_INTERNAL;
        });
    if (inside) traces.Remove(edge);
  }
  for (JoinedFace& face : faces) face.face = TopoDS::Face(traces.Apply(face.face));
}

void orient_alike(std::vector<JoinedFace>& faces) {
  std::vector<std::vector<std::pair<int, bool>>> neighbors(faces.size());  // and whether one must be reversed
  for (const auto& [edge, around] : EdgeUses(faces)) {
    if (around.size() != 2 || around[0].face == around[1].face) continue;
    const bool differ = around[0].orientation == around[1].orientation;
    neighbors[around[0].face].emplace_back(around[1].face, differ);
    neighbors[around[1].face].emplace_back(around[0].face, differ);
  }
  std::map<int, bool> turned;
  for (std::size_t start = 0; start < faces.size(); ++start) {
    std::vector<int> open{static_cast<int>(start)};
    turned.try_emplace(open.front(), false);
    while (!open.empty()) {
      const int face = open.back();
      open.pop_back();
      for (const auto& [next, differ] : neighbors[face])
        if (turned.try_emplace(next, differ != turned[face]).second) open.push_back(next);
    }
    if (turned[static_cast<int>(start)]) faces[start].face.Reverse();
  }
}

std::vector<std::vector<std::size_t>> connected_parts(const std::vector<JoinedFace>& faces,
                                                      const std::vector<int>& group) {
  boost::disjoint_sets_with_storage<> together(faces.size());
  for (const auto& [edge, around] : EdgeUses(faces))
    for (const EdgeUses::Use& from : around)
      for (const EdgeUses::Use& to : around)
        if (group.empty() || group[faces[from.face].wall] == group[faces[to.face].wall])
          together.union_set(from.face, to.face);
  std::map<std::size_t, std::size_t> index;  // of the part, by the face that stands for it
  std::vector<std::vector<std::size_t>> result;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const auto [entry, is_new] = index.try_emplace(together.find_set(i), result.size());
    if (is_new) result.emplace_back();
    result[entry->second].push_back(i);
  }
  return result;
}

std::vector<JoinedFace> join_walls(const Skin& skin, const std::vector<Wall>& walls,
                                   const std::vector<WallEnd>& ends,
                                   const std::vector<std::vector<TopoDS_Face>>& pieces, double tolerance,
                                   const ExecutionContext& context) {
  double fuzzy = Precision::Confusion();
  for (const Wall& wall : walls) {
    // The ends of two fitted surfaces are apart by the errors of both. Allow at least what fitting aims at.
    if (wall.fitted) fuzzy = std::max({fuzzy, 4 * wall.off, tolerance * wall.thickness});
  }
  BOPAlgo_Builder fuse;
  bool fused = false;
  // Where surfaces are nearly tangent OpenCASCADE may fail at one tolerance and succeed at the next.
  for (int attempt = 0; attempt < 3 && !fused; ++attempt, fuzzy *= 2)
    fused = fuse_pieces(ends, pieces, fuzzy, context, fuse);
  if (!fused) throw failure("", "the middle surfaces could not be joined where they meet");
  Images cut = cut_pieces(fuse, walls, pieces, context);
  std::vector<Strip> strips = fences_at_steps(fuse, ends, cut);
  for (const JoinedFace& piece : cut.hung_over) strips.push_back({piece});
  std::vector<JoinedFace> faces = std::move(cut.between);
  grow_to_others(skin, walls, ends, strips, faces);
  drop_traces(faces);
  faces = merged_faces(walls, faces, context);
  orient_alike(faces);
  return faces;
}

}  // namespace quadrille
