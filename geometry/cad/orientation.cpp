/// Visits connected faces across the edges that they share and reverses those against the majority.

#include "geometry/cad/orientation.hpp"

#include <algorithm>
#include <map>

#include "geometry/cad/shape_parts.hpp"

namespace quadrille {

namespace {

class Turning {
 public:
  Turning(std::vector<TopoDS_Shape>& faces, const std::vector<char>& fixed)
      : faces_(faces), fixed_(fixed), links_(faces.size()) {
    const TopTools_IndexedMapOfShape edges = map_of(faces, TopAbs_EDGE);
    uses_.resize(edges.Extent() + 1);
    for (int face = 0; face < static_cast<int>(faces.size()); ++face) {
      if (fixed_[face]) continue;
      for (TopExp_Explorer it(faces[face], TopAbs_EDGE); it.More(); it.Next()) {
        const bool forward = it.Current().Orientation() == TopAbs_FORWARD;
        if (!forward && it.Current().Orientation() != TopAbs_REVERSED) continue;
        uses_[edges.FindIndex(it.Current())].push_back({face, forward});
      }
    }
    for (const std::vector<Use>& uses : uses_)
      if (uses.size() == 2) link(uses[0].face, uses[1].face, uses[0].forward != uses[1].forward);
  }

  /// Adds that two faces are alike, or opposite.
  void link(int face, int other, bool alike) {
    if (face == other || fixed_[face] || fixed_[other]) return;
    links_[face].push_back({other, alike});
    links_[other].push_back({face, alike});
  }

  Orientation run() {
    Orientation result;
    std::vector<char> met = fixed_, turned(faces_.size(), 0);
    for (int seed = 0; seed < static_cast<int>(faces_.size()); ++seed) {
      if (met[seed]) continue;
      std::vector<int> piece{seed};
      std::map<int, bool> opposite{{seed, false}};
      bool one_sided = false;
      for (std::size_t at = 0; at < piece.size(); ++at) {
        for (const auto& [other, alike] : links_[piece[at]]) {
          const bool is_opposite = alike == opposite[piece[at]];
          const auto [entry, fresh] = opposite.try_emplace(other, is_opposite);
          if (fresh) piece.push_back(other);
          one_sided |= entry->second != is_opposite;
        }
      }
      for (const int face : piece) met[face] = 1;
      if (one_sided) continue;
      const auto against = std::count_if(piece.begin(), piece.end(), [&](int f) { return opposite[f]; });
      const bool minority = 2 * against <= static_cast<std::ptrdiff_t>(piece.size());
      for (const int face : piece) turned[face] = opposite[face] == minority;
    }
    for (std::size_t face = 0; face < faces_.size(); ++face) {
      if (!turned[face]) continue;
      faces_[face].Reverse();
      result.turned.push_back(static_cast<int>(face) + 1);
    }
    for (std::size_t edge = 0; edge < uses_.size(); ++edge)
      if (is_unlike(uses_[edge], turned)) result.unlike.push_back(static_cast<int>(edge));
    return result;
  }

 private:
  struct Use {
    int face;
    bool forward;
  };
  struct Link {
    int other;
    bool alike;
  };

  static bool is_unlike(const std::vector<Use>& uses, const std::vector<char>& turned) {
    if (uses.size() != 2) return uses.size() > 2;
    const auto forward = [&](const Use& use) { return use.forward != (turned[use.face] != 0); };
    return uses[0].face != uses[1].face && forward(uses[0]) == forward(uses[1]);
  }

  std::vector<TopoDS_Shape>& faces_;
  const std::vector<char>& fixed_;
  std::vector<std::vector<Use>> uses_;  // by edge
  std::vector<std::vector<Link>> links_;
};

}  // namespace

std::vector<char> faces_in_solids(const TopoDS_Shape& shape, const TopTools_IndexedMapOfShape& faces) {
  std::vector<char> in_solid(faces.Extent(), 0);
  for (TopExp_Explorer solid(shape, TopAbs_SOLID); solid.More(); solid.Next())
    for (TopExp_Explorer face(solid.Current(), TopAbs_FACE); face.More(); face.Next())
      in_solid[faces.FindIndex(face.Current()) - 1] = 1;
  return in_solid;
}

Orientation orient_alike(std::vector<TopoDS_Shape>& faces, const std::vector<char>& fixed,
                         const std::vector<std::vector<int>>& pieces) {
  Turning turning(faces, fixed);
  std::vector<int> sources(faces.size() + 1, 0);
  for (const std::vector<int>& own : pieces)
    for (const int piece : own) ++sources[piece];
  for (const std::vector<int>& own : pieces) {
    int before = 0;
    for (const int piece : own) {
      if (sources[piece] > 1) continue;
      if (before > 0) turning.link(before - 1, piece - 1, true);
      before = piece;
    }
  }
  return turning.run();
}

}  // namespace quadrille
