/// Projects the middles of sides to their patch, and straightens sides where elements would fold.

#include "mesher/remesh/surface_midsides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <unordered_map>

#include "geometry/base/place_text.hpp"
#include "geometry/base/side_key.hpp"
#include "mesher/mesh/second_order.hpp"

namespace quadrille {

namespace {

/// Straightens the sides of elements that fold until none does. Straightening may make neighbors fold, but
/// each round adds straight sides, and an element with four of them does not fold: inverted quads were
/// refused.
void straighten(ShellMesh& mesh, std::vector<std::string>& notes) {
  std::map<int, double> off;  // node -> distance
  for (bool any = true; any;) {
    any = false;
    for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
      if (!folds(curved_quad(mesh, q))) continue;
      for (int k = 0; k < 4; ++k) {
        const int node = mesh.midsides[q][k];
        const Vector3 straight =
            0.5 * (mesh.points[mesh.quads[q][k]] + mesh.points[mesh.quads[q][(k + 1) % 4]]);
        const double distance = (mesh.points[node] - straight).norm();
        if (!(distance > 0)) continue;
        off.try_emplace(node, distance);
        mesh.points[node] = straight;
        any = true;
      }
    }
  }
  double largest = 0;
  for (const auto& [node, distance] : off) {
    mesh.off_geometry.push_back({node, distance});
    largest = std::max(largest, distance);
  }
  if (!off.empty())
    notes.push_back(
        fmt::format("{} midside nodes lie on straight sides, up to {} off the surface, so that no "
                    "element folds",
                    off.size(), number_text(largest)));
}

}  // namespace

void add_surface_midsides(ShellMesh& mesh, const std::vector<PatchQuads>& patches,
                          const std::vector<CurveStretch>& stretches, const PatchSurface& on,
                          std::vector<std::string>& notes) {
  std::unordered_map<std::uint64_t, int> middles;
  const auto add = [&](const Vector3& place) {
    mesh.points.push_back(place);
    return static_cast<int>(mesh.points.size()) - 1;
  };
  for (std::size_t s = 0; s < mesh.segments.size(); ++s) {
    ShellMesh::Segment& segment = mesh.segments[s];
    segment.middle = add(stretches[s].middle);
    middles[side_key(segment.nodes[0], segment.nodes[1])] = segment.middle;
  }
  for (const PatchQuads& patch : patches) {
    const PatchOfSurface surface(on, patch.patch);
    for (const auto& quad : patch.quads) {
      std::array<int, 4>& midsides = mesh.midsides.emplace_back();
      for (int k = 0; k < 4; ++k) {
        const int a = quad[k], b = quad[(k + 1) % 4];
        const auto [found, is_new] = middles.try_emplace(side_key(patch.nodes[a], patch.nodes[b]), -1);
        if (is_new) {
          Vector2 place = patch.places[a];
          Vector3 normal;
          found->second = add(surface.move(place, 0.5 * (patch.points[a] + patch.points[b]), normal));
        }
        midsides[k] = found->second;
      }
    }
  }
  mesh.order = 2;
  straighten(mesh, notes);
}

}  // namespace quadrille
