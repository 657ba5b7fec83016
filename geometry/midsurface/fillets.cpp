/// Adds the material of fillets, which lies beside the corners of middle surfaces, to the thickness of strips
/// along these corners. For the stiffness the amount matters, and hardly its distribution over a strip:
/// material in a corner keeps both walls from bending and twisting, but as thickness of one wall it has less
/// effect. So the thinner wall gets more material than there is, up to a bound, which is reported as counted
/// twice. Closed sections resist twisting by their walls' areas, and get the actual amount.

#include <BOPAlgo_Builder.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

#include "geometry/midsurface/checks.hpp"
#include "geometry/midsurface/fusing.hpp"
#include "geometry/midsurface/joining.hpp"
#include "geometry/midsurface/widths.hpp"

namespace quadrille {

namespace {

/// The volume that a fillet adds to the corner between its walls; 0 if it is none. Its section is taken as an
/// arc, which is a line if the fillet turns nowhere but at its borders: the triangle between its chord and
/// the corner, without what lies between chord and arc.
double volume_of(const SkinFace& fillet, const std::vector<Wall>& walls,
                 const std::vector<FilletBorder>& borders) {
  const FilletBorder& first = borders.front();
  const FilletBorder* second = &first;
  double turn = 0, length = 0, thickness = 0;
  for (const FilletBorder& border : borders) {
    if (border.outward.Angle(first.outward) > turn) second = &border;
    turn = std::max(turn, border.outward.Angle(first.outward));
    length += border.length / static_cast<double>(borders.size());
    thickness = std::max(thickness, walls[border.wall].thickness);
  }
  constexpr double least_turn = 0.1, most_turn = 3;  // radians; outside of this range it is not a corner
  if (turn < least_turn || turn > most_turn) return 0;
  const double width = fillet.area() / length, arc = turn - first.turn - second->turn;
  double chord = width, segment = 0;
  if (std::abs(arc) > 1e-3) {
    const double radius = width / arc;
    chord = 2 * radius * std::sin(0.5 * arc);
    segment = 0.5 * radius * radius * (arc - std::sin(arc));
  }
  const double a = std::sin(first.turn + 0.5 * arc), b = std::sin(second->turn + 0.5 * arc);
  if (a <= 0 || b <= 0) return 0;
  // The end of a gusset is not a fillet, and neither is the inclined side of a block.
  constexpr double longest_leg = 4;  // over the thickness
  const bool strip = first.turn == 0 ||
                     (width < length && chord * std::max(a, b) < longest_leg * thickness * std::sin(turn));
  return strip ? std::max(0.0, 0.5 * chord * chord * a * b / std::sin(turn) - segment) * length : 0;
}

/// The walls of a fillet's corner.
std::set<int> walls_of(const std::vector<FilletBorder>& borders) {
  std::set<int> result;
  for (const FilletBorder& border : borders) result.insert(border.wall);
  return result;
}

double shell_volume(const std::vector<JoinedFace>& faces) {
  double volume = 0;
  for (const JoinedFace& face : faces) volume += face.step ? 0 : area_of(face.face) * face.coverage.mean;
  return volume;
}

/// The faces, cut where the fillets begin. \param strips set to 1 for each face of the result that lies along
/// a corner, where its wall has no side; to 0 for others.
std::vector<JoinedFace> cut_faces(const BOPAlgo_Builder& fuse, const Skin& skin,
                                  const std::vector<Wall>& walls, const std::vector<JoinedFace>& faces,
                                  std::vector<char>& strips) {
  constexpr double least_share = 0.25;
  std::vector<JoinedFace> result;
  for (const JoinedFace& whole : faces) {
    const TopTools_ListOfShape pieces = images(fuse, whole.face);
    for (const TopoDS_Shape& piece : pieces) {
      JoinedFace part = whole;
      part.face = TopoDS::Face(piece);
      bool strip = false;
      if (pieces.Extent() > 1 && !whole.step) {
        triangulate_middle(part.face, walls[whole.wall].thickness);
        const Coverage coverage = coverage_of(part.face, walls[whole.wall], skin);
        strip = coverage.share < least_share;
        if (!strip) {
          part.coverage = coverage;
        } else if (!walls[whole.wall].fitted && whole.coverage.thickest > 1.001 * whole.coverage.thinnest) {
          part.coverage = coverage_past_sides(part.face, walls[whole.wall], skin);
          part.coverage.faces = whole.coverage.faces;
        }
      }
      result.push_back(part);
      strips.push_back(strip ? 1 : 0);
    }
  }
  return result;
}

bool touches(const TopoDS_Face& face, const TopTools_MapOfShape& edges) {
  for (TopExp_Explorer it(face, TopAbs_EDGE); it.More(); it.Next()) {
    if (edges.Contains(it.Current())) return true;
  }
  return false;
}

/// The strips, by index into `faces`, of the border's wall that end at the border.
std::vector<std::size_t> strips_at(const BOPAlgo_Builder& fuse, const FilletBorder& border,
                                   const std::vector<JoinedFace>& faces, const std::vector<char>& strips) {
  TopTools_MapOfShape edges;
  for (const TopoDS_Shape& image : images(fuse, border.fence)) {
    for (TopExp_Explorer it(image, TopAbs_EDGE); it.More(); it.Next()) edges.Add(it.Current());
  }
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (strips[i] != 0 && faces[i].wall == border.wall && touches(faces[i].face, edges)) result.push_back(i);
  }
  return result;
}

/// (pairs of walls) that share an edge.
std::set<std::pair<int, int>> neighbors_of(const std::vector<JoinedFace>& faces) {
  TopTools_IndexedMapOfShape edges;
  std::vector<std::set<int>> walls;
  for (const JoinedFace& face : faces) {
    for (TopExp_Explorer it(face.face, TopAbs_EDGE); it.More(); it.Next()) {
      const int edge = edges.Add(it.Current());
      walls.resize(edges.Extent());
      walls[edge - 1].insert(face.wall);
    }
  }
  std::set<std::pair<int, int>> result;
  for (const std::set<int>& around : walls) {
    for (const int from : around) {
      for (const int to : around) {
        if (from != to) result.emplace(from, to);
      }
    }
  }
  return result;
}

/// Whether the walls of a corner hang together elsewhere too, as those of a closed section do.
bool is_closed(const std::set<int>& corner, const std::set<std::pair<int, int>>& neighbors) {
  std::vector<int> reached = {*corner.begin()};
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const int from = reached[i];
    for (auto it = neighbors.lower_bound({from, -1}); it != neighbors.end() && it->first == from; ++it) {
      const int to = it->second;
      if (corner.count(from) != 0 && corner.count(to) != 0) continue;
      if (corner.count(to) != 0 && to != reached.front()) return true;
      if (std::find(reached.begin(), reached.end(), to) == reached.end()) reached.push_back(to);
    }
  }
  return false;
}

/// Where a fillet ends at a wall.
struct Place {
  double thickness = 0;             ///< of the wall
  std::vector<std::size_t> strips;  ///< indices of faces
};

/// Distributes volumes as additional thickness: `once` over the strips of all places, `again` over those of
/// the thinnest walls. \return what was added.
double thicken(const std::vector<Place>& places, double once, double again, int fillet,
               std::vector<JoinedFace>& faces) {
  if (places.empty()) return 0;
  double thinnest = places.front().thickness;
  for (const Place& place : places) thinnest = std::min(thinnest, place.thickness);
  const auto thin = [&](const Place& place) { return place.thickness < 1.001 * thinnest; };
  const auto thin_places = static_cast<double>(std::count_if(places.begin(), places.end(), thin));
  for (const Place& place : places) {
    const double volume = once / static_cast<double>(places.size()) + (thin(place) ? again / thin_places : 0);
    double area = 0;
    for (const std::size_t i : place.strips) area += area_of(faces[i].face);
    for (const std::size_t i : place.strips) {
      Coverage& coverage = faces[i].coverage;
      for (double* of : {&coverage.mean, &coverage.thinnest, &coverage.thickest, &coverage.added})
        *of += volume / area;
      coverage.faces.insert(fillet);
    }
  }
  return once + again;
}

}  // namespace

Fillets add_fillets(const Skin& skin, const std::vector<Wall>& walls, double volume,
                    const ExecutionContext& context, std::vector<JoinedFace>& faces) {
  constexpr double worth_it = 0.01, most_twice = 0.02, most_off = 0.75;
  std::map<int, std::vector<FilletBorder>> fillets = find_fillet_borders(skin, walls);
  Fillets result;
  auto& beside = result.beside;
  double held = 0;
  for (auto it = fillets.begin(); it != fillets.end();) {
    const double each = volume_of(skin.faces()[it->first], walls, it->second);
    if (each > 0) {
      beside[walls_of(it->second)] += each;
      held += each;
    }
    it = each > 0 ? std::next(it) : fillets.erase(it);
  }
  const auto missing = [&](const std::vector<JoinedFace>& from) {
    return volume - shell_volume(from) + counted_twice(skin, walls, from, result);
  };
  if (held < 0.5 * worth_it * volume || missing(faces) < worth_it * volume) return result;
  BOPAlgo_Builder fuse;
  fuse.SetNonDestructive(Standard_True);
  fuse.SetUseOBB(Standard_True);
  for (const JoinedFace& face : faces) fuse.AddArgument(face.face);
  for (const auto& [fillet, borders] : fillets) {
    for (const FilletBorder& border : borders) fuse.AddArgument(border.fence);
  }
  perform(fuse, context);
  if (fuse.HasErrors()) return result;  // the faces stay as they are
  std::vector<char> strips;
  std::vector<JoinedFace> cut = cut_faces(fuse, skin, walls, faces, strips);
  // Of a wall that tapers, the strips alone may hold more or less than they did as parts of it.
  const double share = std::clamp(missing(cut) / held, 0.0, 1.0);
  const double again = std::min(share, most_twice * volume / held);
  const std::set<std::pair<int, int>> neighbors = neighbors_of(cut);
  for (const auto& [fillet, borders] : fillets) {
    // A border that ends inside a wall cuts nothing off, and has no strips.
    std::vector<Place> places;
    for (const FilletBorder& border : borders) {
      Place place{walls[border.wall].thickness, strips_at(fuse, border, cut, strips)};
      if (!place.strips.empty()) places.push_back(std::move(place));
    }
    const double whole = volume_of(skin.faces()[fillet], walls, borders);
    const std::set<int> corner = walls_of(borders);
    const double more = is_closed(corner, neighbors) ? 0 : again * whole;
    if (more > 0 && again < most_off * share) result.soft.insert(fillet);
    beside[corner] -= thicken(places, share * whole, more, fillet, cut);
  }
  drop_traces(cut);
  orient_alike(cut);
  faces = std::move(cut);
  return result;
}

}  // namespace quadrille
