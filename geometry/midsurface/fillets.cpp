/// Adds the material of fillets, which lies beside the corners of middle surfaces, to the thickness of strips
/// along these corners. The material in a corner resists the bending and twisting of each of its walls, so
/// each gets all of it: the strips then resist them as the corner does, but hold its material more than once,
/// which is reported. Where that would make the section as a whole too stiff, as in the flanges of an I-beam,
/// each gets less. Closed sections resist by their walls' areas, and get the actual amount.

#include <BOPAlgo_Builder.hxx>
#include <BRepGProp.hxx>
#include <GProp_GProps.hxx>
#include <GProp_PrincipalProps.hxx>
#include <TopTools_MapOfShape.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "geometry/cad/shape_parts.hpp"
#include "geometry/midsurface/checks.hpp"
#include "geometry/midsurface/edge_uses.hpp"
#include "geometry/midsurface/fusing.hpp"
#include "geometry/midsurface/joining.hpp"
#include "geometry/midsurface/widths.hpp"

namespace quadrille {

namespace {

/// A fillet in a corner between walls.
struct Fillet {
  std::vector<FilletBorder> borders;
  double volume = 0;     ///< that it adds to the corner
  double leg = 0;        ///< the longer one: how far it reaches from the corner
  double thickness = 0;  ///< of the thickest wall
  bool closed = false;   ///< in a closed section
};
using FilletsByFace = std::map<int, Fillet>;  ///< by index into Skin::faces()

/// Its volume is 0 if it is none. Its section is taken as an arc, which is a line if the fillet turns nowhere
/// but at its borders: the triangle between its chord and the corner, without what lies between chord and
/// arc.
Fillet fillet_of(const SkinFace& face, const std::vector<Wall>& walls, std::vector<FilletBorder> borders) {
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
  if (turn < least_turn || turn > most_turn) return {};
  const double width = face.area() / length, arc = turn - first.turn - second->turn;
  double chord = width, segment = 0;
  if (std::abs(arc) > 1e-3) {
    const double radius = width / arc;
    chord = 2 * radius * std::sin(0.5 * arc);
    segment = 0.5 * radius * radius * (arc - std::sin(arc));
  }
  const double a = std::sin(first.turn + 0.5 * arc), b = std::sin(second->turn + 0.5 * arc);
  if (a <= 0 || b <= 0) return {};
  // The end of a gusset is not a fillet, and neither is the inclined side of a block.
  constexpr double longest_leg = 4;  // over the thickness
  const double leg = chord * std::max(a, b) / std::sin(turn);
  if (first.turn > 0 && (width >= length || leg >= longest_leg * thickness)) return {};
  const double volume = std::max(0.0, 0.5 * chord * chord * a * b / std::sin(turn) - segment) * length;
  return {std::move(borders), volume, leg, thickness};
}

/// The walls of a fillet's corner.
std::set<int> walls_of(const std::vector<FilletBorder>& borders) {
  std::set<int> result;
  for (const FilletBorder& border : borders) result.insert(border.wall);
  return result;
}

double shell_volume(const std::vector<JoinedFace>& faces) {
  double volume = 0;
  for (const JoinedFace& face : faces) volume += area_of(face.face) * face.coverage.mean;
  return volume;
}

/// The faces, cut where the fillets begin. \param strips set to 1 for each face of the result that lies along
/// a corner, where its wall has no side; to 0 for others.
std::vector<JoinedFace> cut_faces(const BOPAlgo_Builder& fuse, const std::vector<Wall>& walls,
                                  const std::vector<JoinedFace>& faces, std::vector<char>& strips) {
  constexpr double least_share = 0.25;
  std::vector<JoinedFace> result;
  for (const JoinedFace& whole : faces) {
    const TopTools_ListOfShape pieces = images(fuse, whole.face);
    for (const TopoDS_Shape& piece : pieces) {
      JoinedFace part = whole;
      part.face = TopoDS::Face(piece);
      bool strip = false;
      if (pieces.Extent() > 1 && !whole.step) {
        const Coverage coverage = coverage_of(part.face, walls[whole.wall]);
        strip = coverage.share < least_share;
        if (!strip) {
          part.coverage = coverage;
        } else if (!walls[whole.wall].fitted && whole.coverage.thickest > 1.001 * whole.coverage.thinnest) {
          part.coverage = coverage_of(part.face, walls[whole.wall], true);
          part.coverage.faces = whole.coverage.faces;
        }
      }
      result.push_back(part);
      strips.push_back(strip ? 1 : 0);
    }
  }
  return result;
}

/// The strips, by index into `faces`, of the border's wall that end at the border.
std::vector<std::size_t> strips_at(const BOPAlgo_Builder& fuse, const FilletBorder& border,
                                   const std::vector<JoinedFace>& faces, const std::vector<char>& strips) {
  TopTools_MapOfShape edges;
  for (const TopoDS_Shape& image : images(fuse, border.fence))
    for (const TopoDS_Edge& edge : edges_of(image)) edges.Add(edge);
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (strips[i] == 0 || faces[i].wall != border.wall) continue;
    const std::vector<TopoDS_Edge> own = edges_of(faces[i].face);
    if (std::any_of(own.begin(), own.end(), [&](const TopoDS_Edge& edge) { return edges.Contains(edge); }))
      result.push_back(i);
  }
  return result;
}

/// (pairs of walls) that share an edge.
std::set<std::pair<int, int>> neighbors_of(const std::vector<JoinedFace>& faces) {
  std::set<std::pair<int, int>> result;
  for (const auto& [edge, around] : EdgeUses(faces)) {
    for (const EdgeUses::Use& from : around) {
      for (const EdgeUses::Use& to : around) {
        const int wall = faces[from.face].wall, other = faces[to.face].wall;
        if (wall != other) result.emplace(wall, other);
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

/// How much stiffer fillets make the walls beside them where these bend or twist, for which the cube of the
/// thickness counts: what they add as thickness of the strips from their borders to the corner, over what the
/// walls have as a whole.
double stiffening(const FilletsByFace& fillets, const std::vector<Wall>& walls,
                  const std::vector<JoinedFace>& faces) {
  /// The strips of one wall beside fillets on its first side and on the other one, which may share a strip.
  struct Strips {
    gp_Dir outward;
    std::array<double, 2> areas{};
    double volume = 0;
  };
  std::map<int, Strips> beside;
  for (const auto& [face, fillet] : fillets) {
    for (const FilletBorder& border : fillet.borders) {
      Strips& strips = beside.try_emplace(border.wall, Strips{border.outward}).first->second;
      const std::size_t side = border.outward.Dot(strips.outward) > 0 ? 0 : 1;
      strips.areas[side] += border.length * (fillet.leg + 0.5 * fillet.thickness);
      strips.volume += fillet.volume * border.share;
    }
  }
  const auto cube = [](double x) { return x * x * x; };
  double added = 0, whole = 0;
  for (const auto& [wall, strips] : beside) {
    const double area = std::max(strips.areas[0], strips.areas[1]), thickness = walls[wall].thickness;
    added += area * (cube(thickness + strips.volume / area) - cube(thickness));
  }
  for (const JoinedFace& face : faces) {
    if (!face.step && beside.count(face.wall) != 0)
      whole += area_of(face.face) * cube(face.coverage.mean - face.coverage.added);
  }
  return whole > 0 ? added / whole : 0;
}

/// The integrals of the squared distance from the centroid of the solid, along its two principal axes in
/// which it is slim: a beam's second moments of area times its length. \param of the solid, or a shell.
std::array<double, 2> second_moments(const GProp_GProps& solid, const GProp_GProps& of) {
  const GProp_PrincipalProps axes = solid.PrincipalProperties();
  const std::array<gp_Vec, 3> axis{axes.FirstAxisOfInertia(), axes.SecondAxisOfInertia(),
                                   axes.ThirdAxisOfInertia()};
  const auto along = [&](const GProp_GProps& body, int which) {
    double result = 0;
    for (int i = 0; i < 3; ++i)
      result += (i == which ? -0.5 : 0.5) * body.MomentOfInertia({solid.CentreOfMass(), axis[i]});
    return result;
  };
  std::array<std::pair<double, double>, 3> result;  // of the solid and of the other one
  for (int i = 0; i < 3; ++i) result[i] = {along(solid, i), along(of, i)};
  std::sort(result.begin(), result.end());
  return {result[0].second, result[1].second};
}

/// Area times thickness of all faces, as a body.
GProp_GProps body_of(const std::vector<JoinedFace>& faces) {
  GProp_GProps result;
  for (const JoinedFace& face : faces) {
    GProp_GProps own;
    BRepGProp::SurfaceProperties(face.face, own);
    result.Add(own, face.coverage.mean);
  }
  return result;
}

/// Adds a volume to the thickness of strips.
void thicken(const std::vector<std::size_t>& strips, double volume, int fillet,
             std::vector<JoinedFace>& faces) {
  double area = 0;
  for (const std::size_t i : strips) area += area_of(faces[i].face);
  for (const std::size_t i : strips) {
    Coverage& coverage = faces[i].coverage;
    for (double* of : {&coverage.mean, &coverage.thinnest, &coverage.thickest, &coverage.added})
      *of += volume / area;
    coverage.faces.insert(fillet);
  }
}

/// The largest share of its volume, up to 1, that each fillet may add to each of its walls: what is counted
/// twice by that must not raise the second moments of the solid much. \param thin the shell without fillets.
/// \param thick with all of them in each wall. \param held volume of the fillets. \param twice what junctions
/// count twice, which lies where the fillets are.
double share_for(const TopoDS_Solid& solid, const GProp_GProps& thin, const GProp_GProps& thick, double held,
                 double twice) {
  constexpr double most_stiff = 0.025;
  GProp_GProps body;
  BRepGProp::VolumeProperties(solid, body);
  const auto whole = second_moments(body, body), least = second_moments(body, thin),
             most = second_moments(body, thick);
  const double added = thick.Mass() - thin.Mass();
  double result = 1;
  for (std::size_t i = 0; i < whole.size() && added > 0; ++i) {
    const double each = (most[i] - least[i]) / added;  // of a unit of volume
    if (each > 0) result = std::min(result, (most_stiff * whole[i] / each + held - twice) / added);
  }
  return std::max(0.0, result);
}

/// The fillets between walls. \param faces not cut yet.
FilletsByFace find_fillets(const Skin& skin, const std::vector<Wall>& walls,
                           const std::vector<JoinedFace>& faces) {
  FilletsByFace result;
  const std::set<std::pair<int, int>> neighbors = neighbors_of(faces);
  for (auto& [face, borders] : find_fillet_borders(skin, walls)) {
    if (walls_of(borders).size() < 2) continue;
    Fillet fillet = fillet_of(skin.faces()[face], walls, std::move(borders));
    if (fillet.volume == 0) continue;
    fillet.closed = is_closed(walls_of(fillet.borders), neighbors);
    std::map<int, double> lengths;  // by wall
    for (const FilletBorder& border : fillet.borders) lengths[border.wall] += border.length;
    for (FilletBorder& border : fillet.borders) border.share = border.length / lengths[border.wall];
    result.emplace(face, std::move(fillet));
  }
  return result;
}

}  // namespace

Fillets add_fillets(const Skin& skin, const std::vector<Wall>& walls, double volume,
                    const ExecutionContext& context, std::vector<JoinedFace>& faces) {
  constexpr double worth_volume = 0.01, worth_stiffness = 0.02;
  FilletsByFace open = find_fillets(skin, walls, faces), closed;
  Fillets result;
  if (open.empty()) return result;
  auto& beside = result.beside;
  double held = 0, held_closed = 0;
  for (const auto& [face, fillet] : open) held += fillet.volume;
  const auto missing = [&](const std::vector<JoinedFace>& from) {
    return volume - shell_volume(from) + counted_twice(walls, from, result).sum();
  };
  // The rounding outside of a bend takes off what the one inside adds.
  const double left_over = std::clamp(missing(faces) / held, 0.0, 1.0);
  for (auto it = open.begin(); it != open.end();) {
    const auto entry = it++;
    Fillet& fillet = entry->second;
    beside[walls_of(fillet.borders)] += fillet.volume;
    if (fillet.closed) {
      held_closed += fillet.volume;
      closed.insert(open.extract(entry));
    } else {
      fillet.volume *= left_over;
    }
  }
  if (stiffening(open, walls, faces) < worth_stiffness) open.clear();
  if (held_closed < 0.5 * worth_volume * volume || missing(faces) < worth_volume * volume) closed.clear();
  if (open.empty() && closed.empty()) return result;
  BOPAlgo_Builder fuse;
  for (const JoinedFace& face : faces) fuse.AddArgument(face.face);
  for (const FilletsByFace* fillets : {&open, &closed}) {
    for (const auto& [face, fillet] : *fillets) {
      for (const FilletBorder& border : fillet.borders) fuse.AddArgument(border.fence);
    }
  }
  perform(fuse, context);
  std::vector<char> strips;
  std::vector<JoinedFace> cut;
  if (!fuse.HasErrors()) cut = cut_faces(fuse, walls, faces, strips);  // else the faces stay as they are
  /// Adds a share of the volume of each fillet to each of its walls. \return the borders that cut no strip
  /// off.
  const auto add = [&](const FilletsByFace& fillets, double share) {
    FilletsByFace left;
    for (const auto& [face, fillet] : fillets) {
      const std::set<int> corner = walls_of(fillet.borders);
      const double each = fillet.closed ? share / static_cast<double>(corner.size()) : share;
      for (const FilletBorder& border : fillet.borders) {
        const std::vector<std::size_t> along = strips_at(fuse, border, cut, strips);
        if (along.empty()) {
          const Fillet whole{{}, fillet.volume, fillet.leg, fillet.thickness};
          left.try_emplace(face, whole).first->second.borders.push_back(border);
          continue;
        }
        thicken(along, each * border.share * fillet.volume, face, cut);
        beside[corner] -= each * border.share * fillet.volume;
      }
    }
    return left;
  };
  const GProp_GProps thin = body_of(cut);
  FilletsByFace left = add(open, 1);
  double open_held = 0;
  for (const auto& [face, fillet] : open) open_held += fillet.volume;
  const double share =
      share_for(skin.solid(), thin, body_of(cut), open_held, counted_twice(walls, cut, {}).junctions);
  if (share < 1) add(open, share - 1);
  result.softer = stiffening(left, walls, faces) + (1 - share) * stiffening(open, walls, faces);
  if (result.softer < worth_stiffness) result.softer = 0;
  if (share < 1) left.insert(open.begin(), open.end());
  for (const auto& [face, fillet] : left) result.left_out.insert(face);
  if (cut.empty()) return result;
  // Of a wall that tapers, the strips alone may hold more or less than they did as parts of it.
  if (!closed.empty()) add(closed, std::clamp(missing(cut) / held_closed, 0.0, 1.0));
  drop_traces(cut);
  orient_alike(cut);
  faces = std::move(cut);
  return result;
}

}  // namespace quadrille
