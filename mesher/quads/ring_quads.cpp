/// Numbers the rings' nodes after those of the rest, and adds their quads.

#include <utility>
#include <vector>

#include "geometry/surfaces/face_surface.hpp"
#include "mesher/faces/hole_rings.hpp"
#include "mesher/mesh/sides.hpp"
#include "mesher/quads/face_quads.hpp"

namespace quadrille {

namespace {

class RingJoiner {
 public:
  RingJoiner(const FaceQuads& inside, const HoleRings& rings, const FaceSurface& surface)
      : inside_(inside), rings_(rings), surface_(surface) {}

  FaceQuads run() {
    const auto& old = inside_.surface_mesh;
    const int count = static_cast<int>(old.mesh.points.size()),
              fixed = static_cast<int>(inside_.nodes.size());
    renumbered_.assign(count, -1);
    // Fixed points come first.
    for (int i = 0; i < fixed; ++i) {
      if (inside_.nodes[i] < 0) continue;
      copy(i, true);
      whole_.nodes.push_back(inside_.nodes[i]);
    }
    for (const auto& hole : rings_.holes) {
      first_on_loop_.push_back(static_cast<int>(whole_.pole.size()));
      for (std::size_t k = 0; k < hole.nodes.size(); ++k) add(hole.points[k], true);
      whole_.nodes.insert(whole_.nodes.end(), hole.nodes.begin(), hole.nodes.end());
    }
    for (int i = 0; i < count; ++i) {
      if (renumbered_[i] < 0) copy(i, false);
    }
    find_outermost();
    for (const auto& quad : old.mesh.quads)
      whole_.surface_mesh.mesh.quads.push_back(with_numbers(quad, renumbered_));
    for (std::size_t i = 0; i < rings_.holes.size(); ++i) add_rings(i);
    return std::move(whole_);
  }

 private:
  int add(const HoleRings::Node& node, bool fixed) {
    return whole_.add({node.point, surface_.normal(node.uv), node.uv}, fixed, false);
  }

  void copy(int i, bool fixed) {
    renumbered_[i] = whole_.add(inside_.surface_mesh.place_of(i), fixed, inside_.pole[i] != 0);
  }

  /// Finds the point of each node on the outermost lines, by its number in HoleRings.
  void find_outermost() {
    std::size_t nodes = 0;
    for (const auto& hole : rings_.holes) nodes += hole.nodes.size();
    outermost_.assign(nodes, -1);
    for (std::size_t i = 0; i < inside_.nodes.size(); ++i) {
      if (inside_.nodes[i] < 0) outermost_[HoleRings::number(inside_.nodes[i])] = renumbered_[i];
    }
  }

  void add_rings(std::size_t index) {
    const HoleRings::Hole& hole = rings_.holes[index];
    std::vector<int> number(hole.points.size(), -1);
    for (std::size_t k = 0; k < hole.nodes.size(); ++k) {
      number[k] = first_on_loop_[index] + static_cast<int>(k);
      number[hole.outer(k)] = outermost_[hole.first + k];
    }
    for (std::size_t i = 0; i < number.size(); ++i)
      if (number[i] < 0) number[i] = add(hole.points[i], false);
    const bool clockwise = area_of(hole) < 0;
    for (const auto& inside : hole.quads) {
      auto& quad = whole_.surface_mesh.mesh.quads.emplace_back(with_numbers(inside, number));
      if (clockwise) std::swap(quad[1], quad[3]);
    }
  }

  /// The area of all quads in the parameter plane, positive if they are counter-clockwise.
  static double area_of(const HoleRings::Hole& hole) {
    double sum = 0;
    for (const auto& [a, b, c, d] : hole.quads) {
      const Vector2 one = hole.points[c].uv - hole.points[a].uv,
                    other = hole.points[d].uv - hole.points[b].uv;
      sum += one.x() * other.y() - one.y() * other.x();
    }
    return sum;
  }

  const FaceQuads& inside_;
  const HoleRings& rings_;
  const FaceSurface& surface_;
  FaceQuads whole_;
  std::vector<int> renumbered_, first_on_loop_, outermost_;
};

}  // namespace

void add_ring_quads(FaceQuads& quads, const HoleRings& rings, const FaceSurface& surface) {
  quads = RingJoiner(quads, rings, surface).run();
}

}  // namespace quadrille
