/// Splits each quad and triangle at its center and the middles of its sides, on the surface.

#include "mesher/quads/face_quads.hpp"

#include <algorithm>
#include <span>
#include <unordered_map>

#include "geometry/base/side_key.hpp"
#include "mesher/mesh/quad_geometry.hpp"
#include "mesher/mesh/sides.hpp"

namespace quadrille {

namespace {

constexpr double good = 0.3;  ///< scaled Jacobian above which a part of a split element is good enough

/// Least scaled Jacobian of the parts into which an element is split; negative if a part is inverted.
template <std::size_t n>
double worst_part(const std::array<Vector3, n>& corners, const std::array<Vector3, n>& middles,
                  const Vector3& center, const Vector3& normal) {
  double worst = 1;
  for (std::size_t k = 0; k < n; ++k)
    worst = std::min(
        worst, folded_scaled_jacobian(corners[k], middles[k], center, middles[(k + n - 1) % n], normal));
  return worst;
}

class Subdivider {
 public:
  Subdivider(const FaceQuads& coarse, const MeshSurface& surface, const ExecutionContext& context)
      : coarse_(coarse), surface_(surface), check_(context, 256) {}

  FaceQuads run(const std::vector<FaceBoundary::Segment>& segments) {
    const int fixed = static_cast<int>(coarse_.nodes.size());
    const auto& old = coarse_.surface_mesh;
    const int count = static_cast<int>(old.mesh.points.size());
    renumbered_.assign(count, -1);
    for (int i = 0; i < fixed; ++i) copy_point(i);
    fine_.nodes = coarse_.nodes;
    middles_.reserve(2 * old.mesh.quads.size() + segments.size());
    for (const auto& segment : segments) add_boundary_middle(segment);
    for (int i = fixed; i < count; ++i) copy_point(i);
    for (const auto& quad : old.mesh.quads) split(quad);
    for (const auto& triangle : old.mesh.triangles) split(triangle);
    return std::move(fine_);
  }

 private:
  void copy_point(int i) {
    const SurfaceMesh& old = coarse_.surface_mesh;
    renumbered_[i] = fine_.add(old.place_of(i), old.fixed[i] != 0, coarse_.pole[i] != 0);
  }

  void add_boundary_middle(const FaceBoundary::Segment& segment) {
    Vector2 uv = segment.middle_uv;
    Vector3 normal;
    surface_.move(uv, segment.middle_point, normal);
    const int point = fine_.add({segment.middle_point, normal, segment.middle_uv}, true, false);
    fine_.nodes.push_back(segment.middle_node);
    middles_.emplace(side_key(segment.a, segment.b), point);
  }

  /// Adds the surface point near a target, searched from between some parameters.
  int add_near(const Vector3& target, std::span<const Vector2> from) {
    SurfacePlace place{target, Vector3::Zero(), surface_.between(from)};
    place.point = surface_.move(place.uv, target, place.normal);
    return fine_.add(place, false, false);
  }

  int add_middle(int a, int b) {
    const auto& old = coarse_.surface_mesh;
    const Vector2 &of_a = old.parameters[a], &of_b = old.parameters[b];
    const std::array from{coarse_.pole[a] && !coarse_.pole[b] ? of_b : of_a,
                          coarse_.pole[b] && !coarse_.pole[a] ? of_a : of_b};
    return add_near(0.5 * (old.mesh.points[a] + old.mesh.points[b]), from);
  }

  /// The surface point near the mean of the middles of an element's sides. At curved boundaries that lies
  /// further inside than the mean of the corners.
  template <std::size_t n>
  int add_center(const std::array<int, n>& middles) {
    const auto& fine = fine_.surface_mesh;
    Vector3 target = Vector3::Zero();
    std::array<Vector2, n> from;
    for (std::size_t k = 0; k < n; ++k) {
      target += fine.mesh.points[middles[k]] / static_cast<double>(n);
      from[k] = fine.parameters[middles[k]];
    }
    return add_near(target, from);
  }

  /// Between two boundaries that bend alike (a narrow ring, the tip of a wedge), the center belongs where a
  /// Coons patch or a second-order triangle has it, beyond the mean of the middles. Moves it there if that
  /// improves the worst part.
  template <std::size_t n>
  void improve_center(const std::array<int, n>& element, const std::array<int, n>& middles, int center) {
    const int fixed = static_cast<int>(fine_.nodes.size());
    if (std::none_of(middles.begin(), middles.end(), [&](int i) { return i < fixed; })) return;
    SurfaceMesh& fine = fine_.surface_mesh;
    std::array<Vector3, n> corner, middle;
    for (std::size_t k = 0; k < n; ++k) {
      corner[k] = fine.mesh.points[renumbered_[element[k]]];
      middle[k] = fine.mesh.points[middles[k]];
    }
    const auto worst = [&](const Vector3& at) {
      return worst_part(corner, middle, at, fine.normals[center]);
    };
    const double before = worst(fine.mesh.points[center]);
    if (before > good) return;
    Vector3 target = Vector3::Zero();
    constexpr double of_middle = n == 4 ? 0.5 : 4.0 / 9, of_corner = n == 4 ? -0.25 : -1.0 / 9;
    for (std::size_t k = 0; k < n; ++k) target += of_middle * middle[k] + of_corner * corner[k];
    const SurfacePlace place = fine.moved(surface_, center, target);
    if (worst(place.point) > before) fine.put(center, place);
  }

  int middle(int a, int b) {
    const auto [it, is_new] = middles_.emplace(side_key(a, b), -1);
    if (is_new) it->second = add_middle(a, b);
    return it->second;
  }

  template <std::size_t n>
  void split(const std::array<int, n>& element) {
    check_();
    std::array<int, n> middles;
    for (std::size_t k = 0; k < n; ++k) middles[k] = middle(element[k], element[(k + 1) % n]);
    const int center = add_center(middles);
    improve_center(element, middles, center);
    for (std::size_t k = 0; k < n; ++k) {
      fine_.surface_mesh.mesh.quads.push_back(
          {renumbered_[element[k]], middles[k], center, middles[(k + n - 1) % n]});
    }
  }

  const FaceQuads& coarse_;
  const MeshSurface& surface_;
  SparseCheck check_;
  FaceQuads fine_;
  std::vector<int> renumbered_;
  std::unordered_map<std::uint64_t, int> middles_;
};

/// The middles of sides: the edges' own nodes on boundary sides, the halfway points elsewhere.
class SideMiddles {
 public:
  SideMiddles(const std::vector<Vector3>& points, const std::vector<FaceBoundary::Segment>& segments)
      : points_(points) {
    middles_.reserve(segments.size());
    on_boundary_.assign(points.size(), 0);
    for (const auto& segment : segments) {
      middles_.emplace(side_key(segment.a, segment.b), segment.middle_point);
      on_boundary_[segment.a] = on_boundary_[segment.b] = 1;
    }
  }

  /// \return true where a boundary segment lies between two points.
  bool on_boundary(int a, int b) const { return find(a, b) != middles_.end(); }

  Vector3 between(int a, int b) const {
    const auto middle = find(a, b);
    return middle != middles_.end() ? middle->second : Vector3(0.5 * (points_[a] + points_[b]));
  }

 private:
  using Middles = std::unordered_map<std::uint64_t, Vector3>;

  Middles::const_iterator find(int a, int b) const {
    return on_boundary_[a] && on_boundary_[b] ? middles_.find(side_key(a, b)) : middles_.end();
  }

  const std::vector<Vector3>& points_;
  Middles middles_;
  std::vector<char> on_boundary_;
};

}  // namespace

int FaceQuads::add(const SurfacePlace& place, bool fixed, bool is_pole) {
  surface_mesh.add(place, fixed);
  pole.push_back(is_pole);
  return static_cast<int>(pole.size()) - 1;
}

void tie_across_gaps(TriangleMesh& mesh, const std::vector<Vector3>& normals,
                     const std::vector<FaceBoundary::Segment>& segments) {
  const auto& p = mesh.points;
  int count = 0;
  for (const auto& segment : segments) count = std::max({count, segment.a + 1, segment.b + 1});
  std::vector<int> between;  // triangles with all corners on the boundary
  for (int i = 0; i < static_cast<int>(mesh.triangles.size()); ++i) {
    const auto& t = mesh.triangles[i];
    if (t[0] < count && t[1] < count && t[2] < count) between.push_back(i);
  }
  if (between.size() < 2) return;
  const SideMiddles middles(p, segments);
  const auto on_boundary = [&](int a, int b) { return middles.on_boundary(a, b); };
  std::unordered_map<std::uint64_t, Side> open;  // inner sides of triangles at the boundary
  struct Pair {
    double worst;
    int first, second;
  };
  std::vector<Pair> pairs;
  const auto try_pair = [&](Side here, Side there) {
    const auto &t = mesh.triangles[element_of(here)], &u = mesh.triangles[element_of(there)];
    const int i = index_of(here), j = index_of(there);
    const std::array quad{t[i], u[(j + 2) % 3], t[(i + 1) % 3], t[(i + 2) % 3]};
    for (int k = 0; k < 2; ++k) {
      const int a = quad[k], b = quad[k + 1], c = quad[k + 2], d = quad[(k + 3) % 4];
      if (!on_boundary(a, b) || !on_boundary(c, d)) continue;
      const double shorter = std::min((p[b] - p[a]).norm(), (p[d] - p[c]).norm());
      const double one = (p[c] - p[b]).norm(), other = (p[a] - p[d]).norm();
      if (!(std::min(one, other) < widest_gap * shorter && std::max(one, other) < shorter)) continue;
      std::array<Vector3, 4> corner, middle;
      Vector3 center = Vector3::Zero();
      for (int at = 0; at < 4; ++at) {
        corner[at] = p[quad[at]];
        middle[at] = middles.between(quad[at], quad[(at + 1) % 4]);
        center += middle[at] / 4;
      }
      const double worst =
          worst_part(corner, middle, center, normals[a] + normals[b] + normals[c] + normals[d]);
      if (worst > good) pairs.push_back({worst, element_of(here), element_of(there)});
    }
  };
  for (const int i : between) {
    const auto& t = mesh.triangles[i];
    if (!on_boundary(t[0], t[1]) && !on_boundary(t[1], t[2]) && !on_boundary(t[2], t[0])) continue;
    for (int k = 0; k < 3; ++k) {
      const auto [at, is_new] = open.try_emplace(side_key(t[k], t[(k + 1) % 3]), make_side(i, k));
      if (!is_new) try_pair(at->second, make_side(i, k));
    }
  }
  if (pairs.empty()) return;
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.worst > b.worst; });
  mesh.tags.assign(mesh.triangles.size(), 0);
  int tag = 0;
  for (const Pair& pair : pairs) {
    int &first = mesh.tags[pair.first], &second = mesh.tags[pair.second];
    if (first == 0 && second == 0) first = second = ++tag;
  }
}

FaceQuads subdivide(const FaceQuads& coarse, const std::vector<FaceBoundary::Segment>& segments,
                    const MeshSurface& surface, const ExecutionContext& context) {
  return Subdivider(coarse, surface, context).run(segments);
}

}  // namespace quadrille
