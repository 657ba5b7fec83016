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

using Pair = std::array<int, 2>;
using Chain = std::vector<MatchedSides>;

/// The index of the wall in a chain that a pair of faces makes; the chain's size if there is none.
std::size_t index_in(const Chain& chain, const Pair& pair) {
  const auto known = std::find_if(chain.begin(), chain.end(), [&](const MatchedSides& wall) {
    return wall.faces == pair || wall.faces == Pair{pair[1], pair[0]};
  });
  return static_cast<std::size_t>(known - chain.begin());
}

/// The ends of the parameters of the first side of one wall at which it continues into another one.
std::vector<int> ends_between(const Skin& skin, const Pair& from, const Pair& to) {
  const auto face = [&](int index) -> const SkinFace& { return skin.faces()[index]; };
  std::vector<int> result;
  for (const TopoDS_Edge& edge : smooth_edges(face(from[0]), face(to[0]))) {
    const auto own = end_along(face(from[0]).face(), edge), other = end_along(face(to[0]).face(), edge);
    if (own && other) result.push_back(*own);
  }
  if (result.empty() || smooth_edges(face(from[1]), face(to[1])).empty()) return {};
  return result;
}

/// Adds a pair to the chain if the wall at an index of the chain continues into it.
void go_on(const Skin& skin, std::size_t at, const Pair& pair, Chain& chain) {
  const std::size_t index = index_in(chain, pair);
  if (index == at) return;
  for (const Pair& faces : {pair, Pair{pair[1], pair[0]}}) {
    if (index < chain.size() && chain[index].faces != faces) continue;
    const std::vector<int> ends = ends_between(skin, chain[at].faces, faces);
    if (ends.empty()) continue;
    if (index == chain.size()) chain.push_back({.faces = faces, .next = {}});
    for (const int end : ends) chain[at].beside[end] = faces[0];
    chain[at].next.push_back(index);
    return;
  }
}

/// The chain that a pair is in. \param start the pair, the face on the first side first.
Chain chain_from(const Skin& skin, const std::vector<Pair>& pairs, const Pair& start) {
  Chain chain{{.faces = start, .next = {}}};
  for (std::size_t at = 0; at < chain.size(); ++at)
    for (const Pair& pair : pairs) go_on(skin, at, pair, chain);
  return chain;
}

}  // namespace

std::vector<MatchedSides> matched_sides(const Skin& skin, std::vector<std::array<int, 2>> pairs) {
  std::vector<MatchedSides> result;
  while (!pairs.empty()) {
    const auto [first, second] = pairs.front();
    Chain chain = chain_from(skin, pairs, {first, second});
    if (Chain other = chain_from(skin, pairs, {second, first}); other.size() > chain.size())
      chain = std::move(other);
    std::erase_if(pairs, [&](const Pair& pair) { return index_in(chain, pair) < chain.size(); });
    if (chain.size() < 2) continue;
    for (MatchedSides& wall : chain) {
      for (std::size_t& next : wall.next) next += result.size();
    }
    result.insert(result.end(), chain.begin(), chain.end());
  }
  return result;
}

}  // namespace quadrille
