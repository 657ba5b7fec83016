/// Sends rays from samples through the material, pairs faces that see each other, and groups pairs to walls.

#include "geometry/midsurface/walls.hpp"

#include <GeomAdaptor_Surface.hxx>
#include <GeomLProp_SLProps.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "geometry/midsurface/fitted_middle.hpp"
#include "geometry/midsurface/matched_sides.hpp"
#include "geometry/midsurface/middle_geometry.hpp"

namespace quadrille {

namespace {

constexpr int samples_a_face = 24;
const double most_slope = std::cos(30 * M_PI / 180);  // cosine of the largest angle between sides
constexpr double least_share = 0.1;                   // share of the smaller face that must be paired

/// How large a part of each of two faces or surfaces faces the other.
struct Facing {
  std::array<double, 2> areas{0, 0};  ///< area of the samples on each face that meet the other
  double thickness_area = 0;          ///< sum of thickness times area over these samples
  double area() const { return areas[0] + areas[1]; }
  double thickness() const { return thickness_area / area(); }
};
using Facings = std::map<std::pair<int, int>, Facing>;

/// Whether a ball around the middle of a wall touches the wall's sides before anything else. It is looked at
/// beside its center as well: where the rims of two stiffeners face each other through a web, the center lies
/// in the web.
bool widest_across(const Skin& skin, const gp_Pnt& middle, const gp_Dir& across, double thickness) {
  const gp_Ax2 frame(middle, across);
  const gp_Vec aside(0.25 * thickness * gp_Vec(across));
  for (const double angle : {0.0, 0.25, 0.5, 0.75}) {
    const gp_Dir direction = frame.XDirection().Rotated(gp_Ax1(middle, across), angle * M_PI);
    if (skin.meets_face(middle, direction, 0.45 * thickness) ||
        skin.meets_face(middle.Translated(aside), direction, 0.25 * thickness) ||
        skin.meets_face(middle.Translated(-aside), direction, 0.25 * thickness))
      return false;
  }
  return true;
}

void look_through(const Skin& skin, int face, const FaceSample& sample, Facings& facings) {
  const auto outward = skin.faces()[face].outward(sample.uv);
  if (!outward) return;
  const auto hit = skin.first_hit(sample.point, outward->Reversed());
  if (!hit || hit->face == face) return;
  const auto opposite = skin.faces()[hit->face].outward(hit->uv);
  if (!opposite || opposite->Dot(outward->Reversed()) < most_slope) return;
  const gp_Pnt middle = sample.point.Translated(0.5 * gp_Vec(sample.point, hit->point));
  if (!widest_across(skin, middle, *outward, hit->distance)) return;
  const bool ordered = face < hit->face;
  Facing& facing = facings[std::minmax(face, hit->face)];
  facing.areas[ordered ? 0 : 1] += sample.area;
  facing.thickness_area += sample.area * hit->distance;
}

Facings look_through_all(const Skin& skin, const ExecutionContext& context) {
  Facings result;
  for (std::size_t face = 0; face < skin.faces().size(); ++face) {
    context.check();
    for (const FaceSample& sample : skin.faces()[face].samples(samples_a_face)) {
      look_through(skin, static_cast<int>(face), sample, result);
    }
  }
  return result;
}

void add_once(std::vector<int>& list, int value) {
  if (std::find(list.begin(), list.end(), value) == list.end()) list.push_back(value);
}

/// Two surfaces that face each other, the one with the lower number first.
struct SurfacePair {
  std::array<int, 2> surfaces{};
  std::array<std::vector<int>, 2> faces;
  Handle(Geom_Surface) middle;  ///< null if there is no exact one
  Facing facing{};
};

std::vector<SurfacePair> pair_surfaces(const Skin& skin, const std::vector<int>& surfaces,
                                       const Facings& facings) {
  std::map<std::pair<int, int>, std::size_t> indices;
  std::vector<SurfacePair> result;
  for (const auto& [faces, facing] : facings) {
    const SkinFace& a = skin.faces()[faces.first];
    const SkinFace& b = skin.faces()[faces.second];
    const double paired = std::max(facing.areas[0], facing.areas[1]);
    if (paired < least_share * std::min(a.area(), b.area())) continue;
    const auto key = std::minmax(surfaces[faces.first], surfaces[faces.second]);
    const auto [entry, is_new] = indices.try_emplace(key, result.size());
    if (is_new) result.push_back({{key.first, key.second}, {}, middle_surface(a, b, skin.size())});
    SurfacePair& pair = result[entry->second];
    const bool ordered = surfaces[faces.first] == key.first;
    add_once(pair.faces[0], ordered ? faces.first : faces.second);
    add_once(pair.faces[1], ordered ? faces.second : faces.first);
    pair.facing.thickness_area += facing.thickness_area;
    for (int side = 0; side < 2; ++side) pair.facing.areas[side] += facing.areas[ordered ? side : 1 - side];
  }
  return result;
}

/// Removes pairs whose surfaces lean to each other and both face another surface over more of their area:
/// between them lies no wall but the inside of a junction, as between two ribs that cross at an acute angle.
void drop_junctions(const Skin& skin, std::vector<SurfacePair>& pairs) {
  const double leaning = std::cos(5 * M_PI / 180);
  std::map<int, double> most;  // by surface: area that faces one other surface
  for (const SurfacePair& pair : pairs) {
    for (int side = 0; side < 2; ++side) {
      double& area = most[pair.surfaces[side]];
      area = std::max(area, pair.facing.areas[side]);
    }
  }
  std::erase_if(pairs, [&](const SurfacePair& pair) {
    const BRepAdaptor_Surface& a = skin.faces()[pair.faces[0].front()].surface();
    const BRepAdaptor_Surface& b = skin.faces()[pair.faces[1].front()].surface();
    return a.GetType() == GeomAbs_Plane && b.GetType() == GeomAbs_Plane &&
           std::abs(a.Plane().Axis().Direction().Dot(b.Plane().Axis().Direction())) < leaning &&
           pair.facing.areas[0] < most[pair.surfaces[0]] && pair.facing.areas[1] < most[pair.surfaces[1]];
  });
}

using Touching = std::set<std::pair<int, int>>;

/// The pairs of surfaces whose faces have an edge in common.
Touching touching_surfaces(const Skin& skin, const std::vector<int>& surfaces) {
  Touching result;
  for (std::size_t face = 0; face < surfaces.size(); ++face) {
    for (const auto& [edge, other] : skin.neighbors(skin.faces()[face]))
      result.insert({surfaces[face], surfaces[other]});
  }
  return result;
}

/// Indices of the pairs that have a surface in common with the starting pair and whose other surfaces are
/// connected through common edges. \param side of the starting pair whose surface is the common one.
std::vector<std::size_t> pairs_around(const std::vector<SurfacePair>& pairs, std::size_t start, int side,
                                      const Touching& touching) {
  const int center = pairs[start].surfaces[side];
  const auto other = [&](std::size_t i) {
    return pairs[i].surfaces[0] == center ? pairs[i].surfaces[1] : pairs[i].surfaces[0];
  };
  std::vector<std::size_t> result{start};
  for (std::size_t next = 0; next < result.size(); ++next) {
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (pairs[i].surfaces[0] != center && pairs[i].surfaces[1] != center) continue;
      if (std::find(result.begin(), result.end(), i) != result.end()) continue;
      if (touching.count({other(result[next]), other(i)}) != 0) result.push_back(i);
    }
  }
  return result;
}

/// The wall formed by pairs that share the surface `center`. Nothing if neither side is paired over three
/// quarters: a fillet at a junction faces the walls at its two ends, and between them the junction's inside.
std::optional<Wall> wall_of(const Skin& skin, const std::vector<SurfacePair>& pairs, int center) {
  constexpr double least_covered = 0.75;
  Wall wall{&skin};
  std::array<double, 2> covered{0, 0};
  for (const SurfacePair& pair : pairs) {
    const int first = pair.surfaces[0] == center ? 0 : 1;
    for (int side = 0; side < 2; ++side) {
      const int from = side == 0 ? first : 1 - first;
      for (const int face : pair.faces[from]) add_once(wall.sides[side], face);
      covered[side] += pair.facing.areas[from];
    }
    wall.thickness += pair.facing.thickness_area;
  }
  wall.thickness /= covered[0] + covered[1];
  for (int side = 0; side < 2; ++side) {
    double area = 0;
    for (const int face : wall.sides[side]) area += wall.face(face).area();
    if (covered[side] > least_covered * area) return wall;
  }
  return std::nullopt;
}

/// Whether the wall has two flat faces, as the corners of flat walls do.
bool has_two_flats(const Wall& wall) {
  const std::vector<int> faces = both_sides(wall);
  return std::count_if(faces.begin(), faces.end(),
                       [&](int face) { return wall.face(face).surface().GetType() == GeomAbs_Plane; }) > 1;
}

/// Whether a fitted middle is bent more tightly than half its thickness. No shell can be bent like that: its
/// skin inside the bend would turn over. Where both radii of a bend are equal, its middle is nearly a corner.
bool is_bent_too_tightly(const Wall& wall, const Handle(Geom_Surface) & middle) {
  constexpr double max_bend = 0.9;  // half the thickness over the radius
  const GeomAdaptor_Surface surface(middle);
  TColStd_Array1OfReal us(1, surface.NbUIntervals(GeomAbs_CN) + 1),
      vs(1, surface.NbVIntervals(GeomAbs_CN) + 1);
  surface.UIntervals(us, GeomAbs_CN);
  surface.VIntervals(vs, GeomAbs_CN);
  GeomLProp_SLProps at(middle, 2, 1e-9);
  const auto is_tight = [&](double u, double v) {
    at.SetParameters(u, v);
    if (!at.IsCurvatureDefined()) return false;
    const double curvature = std::max(std::abs(at.MaxCurvature()), std::abs(at.MinCurvature()));
    if (curvature * wall.thickness < max_bend) return false;  // spares the search where it is nearly flat
    return 0.5 * curvature * thickness_round(wall, at.Value()) > max_bend;
  };
  for (const double share : {0.25, 0.5, 0.75}) {
    const double u = (1 - share) * us.First() + share * us.Last();
    const double v = (1 - share) * vs.First() + share * vs.Last();
    for (int i = 1; i < us.Length(); ++i)
      if (is_tight(0.5 * (us(i) + us(i + 1)), v)) return true;
    for (int i = 1; i < vs.Length(); ++i)
      if (is_tight(u, 0.5 * (vs(i) + vs(i + 1)))) return true;
  }
  return false;
}

/// Makes walls of groups of pairs that share one surface, the largest first. That surface is the first side.
std::vector<Wall> group_pairs(const Skin& skin, std::vector<SurfacePair> pairs, const Touching& touching) {
  std::vector<Wall> walls;
  while (!pairs.empty()) {
    std::vector<std::size_t> best;
    int center = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      for (int side = 0; side < 2; ++side) {
        const auto group = pairs_around(pairs, i, side, touching);
        if (group.size() <= best.size()) continue;
        best = group;
        center = pairs[i].surfaces[side];
      }
    }
    std::sort(best.rbegin(), best.rend());
    std::vector<SurfacePair> group;
    for (const std::size_t i : best) {
      group.push_back(pairs[i]);
      pairs.erase(pairs.begin() + static_cast<std::ptrdiff_t>(i));
    }
    if (const auto wall = wall_of(skin, group, center)) walls.push_back(*wall);
  }
  return walls;
}

/// The pairs of two faces that face each other more than any other face.
std::vector<std::array<int, 2>> mutual_pairs(const std::vector<SurfacePair>& pairs) {
  std::map<int, std::size_t> best;  // by surface
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    for (const int surface : pairs[i].surfaces) {
      const auto [entry, is_new] = best.try_emplace(surface, i);
      if (!is_new && pairs[i].facing.area() > pairs[entry->second].facing.area()) entry->second = i;
    }
  }
  std::vector<std::array<int, 2>> result;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const bool mutual = best[pairs[i].surfaces[0]] == i && best[pairs[i].surfaces[1]] == i;
    if (mutual && pairs[i].faces[0].size() == 1 && pairs[i].faces[1].size() == 1)
      result.push_back({pairs[i].faces[0].front(), pairs[i].faces[1].front()});
  }
  return result;
}

void take_fitted(const NearMiddle& middle, Wall& wall) {
  wall.middle = middle.surface;
  wall.fitted = wall.ends = true;
  wall.off = middle.off;
}

/// The wall at an index of `chains`, with a fitted middle.
std::optional<Wall> chained_wall(const Skin& skin, const std::vector<MatchedSides>& chains, std::size_t index,
                                 double thickness, double tolerance, double margin) {
  const MatchedSides& own = chains[index];
  Wall wall{&skin};
  wall.sides = {std::vector<int>{own.faces[0]}, std::vector<int>{own.faces[1]}};
  wall.thickness = thickness;
  auto sides = wall.sides;
  // Past the end of the second side, the next wall's second side continues.
  for (const std::size_t next : own.next) add_once(sides[1], chains[next].faces[1]);
  const auto middle = fit_middle(skin, sides, tolerance * thickness, margin, own.beside);
  if (!middle) return std::nullopt;
  take_fitted(*middle, wall);
  return wall;
}

/// Moves the pairs in chains of free-form walls that continue into each other from `pairs` to `walls`. A pair
/// of faces from different walls of a chain is not a wall. \param margin see fit_middle().
void move_chains(const Skin& skin, const std::vector<int>& surfaces, double tolerance, double margin,
                 const ExecutionContext& context, std::vector<SurfacePair>& pairs, std::vector<Wall>& walls) {
  const std::vector<MatchedSides> chains = matched_sides(skin, mutual_pairs(pairs));
  std::map<std::pair<int, int>, double> thickness;  // by surfaces
  for (const SurfacePair& pair : pairs)
    thickness[std::minmax(pair.surfaces[0], pair.surfaces[1])] = pair.facing.thickness();
  std::set<int> chained;   // surfaces
  std::vector<int> index;  // of each wall of the chains in `walls`; -1 = it cannot be fitted
  for (std::size_t i = 0; i < chains.size(); ++i) {
    context.check();
    const auto [a, b] = std::minmax(surfaces[chains[i].faces[0]], surfaces[chains[i].faces[1]]);
    chained.insert({a, b});
    const auto wall = chained_wall(skin, chains, i, thickness.at({a, b}), tolerance, margin);
    index.push_back(wall ? static_cast<int>(walls.size()) : -1);
    if (wall) walls.push_back(*wall);
  }
  for (std::size_t i = 0; i < chains.size(); ++i) {
    for (const std::size_t next : chains[i].next) {
      if (index[i] >= 0 && index[next] >= 0) walls[index[i]].goes_on.push_back(index[next]);
    }
  }
  std::erase_if(pairs, [&](const SurfacePair& pair) {
    return chained.count(pair.surfaces[0]) != 0 && chained.count(pair.surfaces[1]) != 0;
  });
}

/// Removes walls that are thicker than wide if the material between their sides lies in a wall with larger
/// sides: what a pocket leaves of a plate along its rim is plate, not a wall that stands there.
void drop_stubs(std::vector<Wall>& walls) {
  const auto size_of = [&](const Wall& wall, auto&& size) {
    std::array<double, 2> sums{0, 0};
    for (int side = 0; side < 2; ++side)
      for (const int face : wall.sides[side]) sums[side] += size(wall.face(face));
    return std::min(sums[0], sums[1]);
  };
  std::vector<double> areas;
  areas.reserve(walls.size());
  for (const Wall& wall : walls)
    areas.push_back(size_of(wall, [](const SkinFace& face) { return face.area(); }));
  const auto is_stub = [&](std::size_t own) {
    const Wall& wall = walls[own];
    if (size_of(wall, [](const SkinFace& face) { return face.width(); }) >= wall.thickness) return false;
    for (const int face : both_sides(wall)) {
      for (const FaceSample& sample : wall.face(face).samples(samples_a_face)) {
        const auto outward = wall.face(face).outward(sample.uv);
        if (!outward) continue;
        const gp_Pnt middle = sample.point.Translated(-0.5 * wall.thickness * gp_Vec(*outward));
        if (!position_in(wall, middle)) continue;
        bool held = false;
        for (std::size_t other = 0; other < walls.size() && !held; ++other)
          held = areas[other] > areas[own] && position_in(walls[other], middle);
        if (!held) return false;
      }
    }
    return true;
  };
  std::vector<Wall> kept;
  for (std::size_t wall = 0; wall < walls.size(); ++wall)
    if (!is_stub(wall)) kept.push_back(walls[wall]);
  walls = std::move(kept);
}

}  // namespace

std::vector<int> surface_numbers(const Skin& skin) {
  const auto& faces = skin.faces();
  const double near = 1e-4 * skin.size();
  // From here the holes of a grid have different distances.
  const gp_Pnt aside = faces.front().box().CornerMin().Translated(skin.size() * gp_Vec(0.123, 0.457, 0.789));
  std::multimap<double, int> firsts;  // by its distance from `aside`: the first face on each surface
  std::vector<int> result(faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const double distance = faces[i].distance(aside);
    result[i] = static_cast<int>(i);
    for (auto it = firsts.lower_bound(distance - near); it != firsts.upper_bound(distance + near); ++it) {
      if (it->second < result[i] && on_one_surface(faces[i], faces[it->second], skin.size()))
        result[i] = it->second;
    }
    if (result[i] == static_cast<int>(i)) firsts.emplace(distance, result[i]);
  }
  return result;
}

std::vector<Wall> find_walls(const Skin& skin, const std::vector<int>& surfaces, double tolerance,
                             const ExecutionContext& context) {
  std::vector<SurfacePair> pairs = pair_surfaces(skin, surfaces, look_through_all(skin, context));
  drop_junctions(skin, pairs);
  std::vector<Wall> walls;
  double thickest = 0;
  for (SurfacePair& pair : pairs) {
    const double thickness = pair.facing.thickness();
    thickest = std::max(thickest, thickness);
    NearMiddle middle{pair.middle, 0};
    if (pair.middle.IsNull())
      middle = near_middle_surface(skin.faces()[pair.faces[0].front()], skin.faces()[pair.faces[1].front()],
                                   tolerance * thickness);
    if (middle.surface.IsNull()) continue;
    walls.push_back({&skin, pair.faces, middle.surface, thickness, pair.middle.IsNull(), false, middle.off});
    pair.middle = middle.surface;
  }
  drop_stubs(walls);
  std::erase_if(pairs, [](const SurfacePair& pair) { return !pair.middle.IsNull(); });
  move_chains(skin, surfaces, tolerance, 3 * thickest, context, pairs, walls);
  for (Wall& wall : group_pairs(skin, std::move(pairs), touching_surfaces(skin, surfaces))) {
    context.check();
    const auto middle = fit_middle(skin, wall.sides, tolerance * wall.thickness, 3 * thickest);
    if (!middle) continue;
    if (has_two_flats(wall) && is_bent_too_tightly(wall, middle->surface)) continue;
    take_fitted(*middle, wall);
    walls.push_back(wall);
  }
  return walls;
}

std::optional<WallPosition> position_in(const Wall& wall, const gp_Pnt& point) {
  WallPosition result;
  const Bnd_Box at(point, point);
  const double reach = 2.11 * wall.thickness;  // a foot farther away is rejected below
  for (int side = 0; side < 2; ++side) {
    bool found = false;
    for (const int face : wall.sides[side]) {
      if (wall.face(face).box().Distance(at) > reach) continue;
      const auto foot = wall.face(face).foot(point);
      if (!foot || (found && foot->Distance(point) >= result.feet[side].Distance(point))) continue;
      result.feet[side] = *foot;
      result.faces[side] = face;
      found = true;
    }
    if (!found) return std::nullopt;
  }
  const double around = result.feet[0].Distance(point) + result.feet[1].Distance(point);
  const double thickness = result.thickness();
  if (around > 1.05 * thickness + 1e-6 * wall.thickness || thickness > 2 * wall.thickness)
    return std::nullopt;
  return result;
}

double thickness_round(const Wall& wall, const gp_Pnt& point) {
  if (const auto position = position_in(wall, point)) return position->thickness();
  const auto [first, second] = distances_to_sides(wall, point, HUGE_VAL);
  return first + second;
}

std::array<double, 2> distances_to_sides(const Wall& wall, const gp_Pnt& point, double reach) {
  std::array<double, 2> result{wall.skin->size(), wall.skin->size()};
  const Bnd_Box at(point, point);
  for (int side = 0; side < 2; ++side) {
    for (const int face : wall.sides[side])
      if (wall.face(face).box().Distance(at) <= reach * wall.thickness)
        result[side] = std::min(result[side], wall.face(face).distance(point));
  }
  return result;
}

std::vector<int> both_sides(const Wall& wall) {
  std::vector<int> faces = wall.sides[0];
  faces.insert(faces.end(), wall.sides[1].begin(), wall.sides[1].end());
  return faces;
}

std::vector<int> walls_of_faces(const std::vector<Wall>& walls) {
  std::vector<int> result(walls.front().skin->faces().size(), -1);
  for (int wall = static_cast<int>(walls.size()) - 1; wall >= 0; --wall)
    for (const int face : both_sides(walls[wall])) result[face] = wall;
  return result;
}

}  // namespace quadrille
