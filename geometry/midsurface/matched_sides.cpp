/// Walks along chains of free-form walls, across the edges that both sides have in common.

#include "geometry/midsurface/matched_sides.hpp"

#include <BRepTools.hxx>
#include <Geom2d_Curve.hxx>
#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/cad/shape_parts.hpp"
#include "geometry/midsurface/widths.hpp"

namespace quadrille {

namespace {

/// Whether two faces continue into each other at an edge: their normals differ little all along it.
bool is_smooth(const SkinFace& a, const SkinFace& b, const TopoDS_Edge& edge) {
  const double most_turn = std::cos(20 * M_PI / 180);
  const auto turns = [&](double share) {
    const gp_Pnt at = point_at(edge, share);
    const auto first = a.outward_at(at), second = b.outward_at(at);
    return !first || !second || first->Dot(*second) < most_turn;
  };
  return !turns(0.1) && !turns(0.5) && !turns(0.9);
}

/// The smooth edges that two faces have in common.
std::vector<TopoDS_Edge> smooth_edges(const SkinFace& a, const SkinFace& b) {
  const TopTools_IndexedMapOfShape others = map_of(b.face(), TopAbs_EDGE);
  std::vector<TopoDS_Edge> result = edges_of(a.face());
  std::erase_if(result,
                [&](const TopoDS_Edge& edge) { return !others.Contains(edge) || !is_smooth(a, b, edge); });
  return result;
}

/// The end of a face's parameters along which all of an edge lies: 0 low u, 1 high u, 2 low v, 3 high v.
std::optional<int> end_along(const TopoDS_Face& face, const TopoDS_Edge& edge) {
  constexpr double slack = 1e-5;  // over the range
  std::array<double, 4> bounds{};
  BRepTools::UVBounds(face, bounds[0], bounds[1], bounds[2], bounds[3]);
  double first = 0, last = 0;
  const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face, first, last);
  if (curve.IsNull()) return std::nullopt;
  for (int end = 0; end < 4; ++end) {
    const int across = end / 2;
    const double range = bounds[2 * across + 1] - bounds[2 * across];
    const double along = bounds[3 - 2 * across] - bounds[2 - 2 * across];
    const auto off = [&](double share) {
      const gp_Pnt2d uv = curve->Value((1 - share) * first + share * last);
      return std::abs(uv.Coord(across + 1) - bounds[end]) > slack * range;
    };
    const double length =
        std::abs(curve->Value(first).Coord(2 - across) - curve->Value(last).Coord(2 - across));
    if (!off(0) && !off(0.3) && !off(0.5) && !off(0.8) && !off(1) && length > (1 - slack) * along) return end;
  }
  return std::nullopt;
}

struct Chain {
  std::vector<MatchedSides> walls;
  std::vector<std::size_t> pairs;  ///< the index of each wall's pair
};

using Pairs = std::vector<std::array<int, 2>>;

/// The ends of the parameters of the first side of one wall at which it continues into another one.
std::vector<int> ends_between(const Skin& skin, const std::array<int, 2>& from,
                              const std::array<int, 2>& to) {
  const auto face = [&](int index) -> const SkinFace& { return skin.faces()[index]; };
  std::vector<int> result;
  for (const TopoDS_Edge& edge : smooth_edges(face(from[0]), face(to[0]))) {
    const auto own = end_along(face(from[0]).face(), edge), other = end_along(face(to[0]).face(), edge);
    if (own && other) result.push_back(*own);
  }
  if (result.empty() || smooth_edges(face(from[1]), face(to[1])).empty()) return {};
  return result;
}

void add(const Pairs& pairs, std::size_t pair, int first, Chain& chain) {
  chain.pairs.push_back(pair);
  chain.walls.push_back({{pairs[pair][first], pairs[pair][1 - first]}, {-1, -1, -1, -1}, {}});
}

/// Adds the other pair to the chain if a wall of the chain continues into it.
void go_on(const Skin& skin, const Pairs& pairs, std::size_t at, std::size_t other, Chain& chain) {
  const auto known = std::find(chain.pairs.begin(), chain.pairs.end(), other);
  const auto index = static_cast<std::size_t>(known - chain.pairs.begin());
  for (const int first : {0, 1}) {
    const std::array<int, 2> faces{pairs[other][first], pairs[other][1 - first]};
    if (known != chain.pairs.end() && chain.walls[index].faces != faces) continue;
    const std::vector<int> ends = ends_between(skin, chain.walls[at].faces, faces);
    if (ends.empty()) continue;
    if (known == chain.pairs.end()) add(pairs, other, first, chain);
    for (const int end : ends) chain.walls[at].beside[end] = faces[0];
    chain.walls[at].next.push_back(index);
    return;
  }
}

/// The chain that contains a pair, of those that are not done. \param side of that pair that becomes the
/// first one.
Chain chain_from(const Skin& skin, const Pairs& pairs, const std::vector<char>& done, std::size_t start,
                 int side) {
  Chain chain;
  add(pairs, start, side, chain);
  for (std::size_t at = 0; at < chain.walls.size(); ++at) {
    for (std::size_t other = 0; other < pairs.size(); ++other) {
      if (other != chain.pairs[at] && done[other] == 0) go_on(skin, pairs, at, other, chain);
    }
  }
  return chain;
}

}  // namespace

std::vector<MatchedSides> matched_sides(const Skin& skin, const std::vector<std::array<int, 2>>& pairs) {
  std::vector<MatchedSides> result;
  std::vector<char> done(pairs.size(), 0);
  for (std::size_t start = 0; start < pairs.size(); ++start) {
    if (done[start] != 0) continue;
    Chain chain = chain_from(skin, pairs, done, start, 0);
    if (Chain other = chain_from(skin, pairs, done, start, 1); other.walls.size() > chain.walls.size())
      chain = std::move(other);
    if (chain.walls.size() < 2) continue;
    for (const std::size_t pair : chain.pairs) done[pair] = 1;
    for (MatchedSides& wall : chain.walls) {
      for (std::size_t& next : wall.next) next += result.size();
    }
    result.insert(result.end(), chain.walls.begin(), chain.walls.end());
  }
  return result;
}

}  // namespace quadrille
