/// Numbers the ring lines' nodes after those of the rest, and adds a row of quads between neighboring lines.

#include "mesher/quads/ring_quads.hpp"

#include <utility>
#include <vector>

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
      for (const auto& node : hole.lines.front()) add(node, true);
      whole_.nodes.insert(whole_.nodes.end(), hole.nodes.begin(), hole.nodes.end());
    }
    for (int i = 0; i < count; ++i) {
      if (renumbered_[i] < 0) copy(i, false);
    }
    for (auto quad : old.mesh.quads) {
      for (int& corner : quad) corner = renumbered_[corner];
      whole_.surface_mesh.mesh.quads.push_back(quad);
    }
    find_outermost();
    for (std::size_t i = 0; i < rings_.holes.size(); ++i) add_rings(i);
    return std::move(whole_);
  }

 private:
  int add(const HoleRings::Node& node, bool fixed) {
    return whole_.add(node.point, node.uv, surface_.normal(node.uv), fixed, false);
  }

  void copy(int i, bool fixed) {
    const auto& old = inside_.surface_mesh;
    renumbered_[i] =
        whole_.add(old.mesh.points[i], old.parameters[i], old.normals[i], fixed, inside_.pole[i]);
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
    const int n = static_cast<int>(hole.nodes.size()), rings = static_cast<int>(hole.lines.size()) - 1;
    std::vector<int> line(n), outer(n);
    for (int k = 0; k < n; ++k) line[k] = first_on_loop_[index] + k;
    for (int ring = 1; ring <= rings; ++ring) {
      for (int k = 0; k < n; ++k)
        outer[k] = ring == rings ? outermost_[hole.first + k] : add(hole.lines[ring][k], false);
      const bool outer_is_left = is_left(hole.lines[ring - 1], hole.lines[ring]);
      for (int k = 0; k < n; ++k) {
        const int next = (k + 1) % n;
        std::array<int, 4> quad{line[k], line[next], outer[next], outer[k]};
        if (!outer_is_left) std::swap(quad[1], quad[3]);
        whole_.surface_mesh.mesh.quads.push_back(quad);
      }
      line = outer;
    }
  }

  /// Whether `outer` lies to the left of `line` in the parameter plane.
  static bool is_left(const std::vector<HoleRings::Node>& line, const std::vector<HoleRings::Node>& outer) {
    double sum = 0;
    for (std::size_t k = 0; k < line.size(); ++k) {
      const Vector2 along = line[(k + 1) % line.size()].uv - line[k].uv, across = outer[k].uv - line[k].uv;
      sum += along.x() * across.y() - along.y() * across.x();
    }
    return sum > 0;
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
