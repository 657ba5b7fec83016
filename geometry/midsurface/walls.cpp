#include "geometry/midsurface/walls.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "geometry/midsurface/middle_geometry.hpp"

namespace quadrille {

namespace {

constexpr int samples_a_face = 24;
const double most_slope = std::cos(30 * M_PI / 180);  // between the sides of a wall
constexpr double least_share = 0.1;                   // of the smaller face that must be paired

/// What was seen of the faces `first` and `second` facing each other.
struct Facing {
  std::array<double, 2> areas{0, 0};  ///< of the samples on either face that meet the other
  double thickness_area = 0;
};
using Facings = std::map<std::pair<int, int>, Facing>;

/// Whether the ball round the middle of a wall touches the wall's sides before anything else.
bool widest_across(const Skin& skin, const gp_Pnt& middle, const gp_Dir& across, double thickness) {
  const gp_Ax2 frame(middle, across);
  for (const double angle : {0.0, 0.25, 0.5, 0.75}) {
    const gp_Dir direction = frame.XDirection().Rotated(gp_Ax1(middle, across), angle * M_PI);
    if (skin.meets_face(middle, direction, 0.45 * thickness)) return false;
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

}  // namespace

std::vector<int> surface_numbers(const Skin& skin) {
  const auto& faces = skin.faces();
  std::vector<int> result(faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    result[i] = static_cast<int>(i);
    for (std::size_t j = 0; j < i; ++j) {
      if (result[j] != static_cast<int>(j) || !on_one_surface(faces[i], faces[j], skin.size())) continue;
      result[i] = static_cast<int>(j);
      break;
    }
  }
  return result;
}

std::vector<Wall> find_walls(const Skin& skin, const std::vector<int>& surfaces,
                             const ExecutionContext& context) {
  std::map<std::pair<int, int>, std::size_t> indices;
  std::vector<Wall> walls;
  std::vector<double> areas;
  for (const auto& [pair, facing] : look_through_all(skin, context)) {
    const SkinFace& a = skin.faces()[pair.first];
    const SkinFace& b = skin.faces()[pair.second];
    const double paired = std::max(facing.areas[0], facing.areas[1]);
    if (paired < least_share * std::min(a.area(), b.area())) continue;
    const auto key = std::minmax(surfaces[pair.first], surfaces[pair.second]);
    const auto [entry, is_new] = indices.try_emplace(key, walls.size());
    if (is_new) {
      walls.push_back({{}, middle_surface(a, b, skin.size()), 0});
      areas.push_back(0);
    }
    Wall& wall = walls[entry->second];
    const bool ordered = surfaces[pair.first] == key.first;
    add_once(wall.sides[0], ordered ? pair.first : pair.second);
    add_once(wall.sides[1], ordered ? pair.second : pair.first);
    wall.thickness += facing.thickness_area;
    areas[entry->second] += facing.areas[0] + facing.areas[1];
  }
  for (std::size_t i = 0; i < walls.size(); ++i) walls[i].thickness /= areas[i];
  std::erase_if(walls, [](const Wall& wall) { return wall.middle.IsNull(); });
  return walls;
}

std::optional<WallPosition> position_in(const Wall& wall, const Skin& skin, const gp_Pnt& point) {
  WallPosition result;
  for (int side = 0; side < 2; ++side) {
    bool found = false;
    for (const int face : wall.sides[side]) {
      const auto foot = skin.faces()[face].foot(point);
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

std::vector<int> both_sides(const Wall& wall) {
  std::vector<int> faces = wall.sides[0];
  faces.insert(faces.end(), wall.sides[1].begin(), wall.sides[1].end());
  return faces;
}

}  // namespace quadrille
