/// One CGAL AABB tree for the triangles of each patch.

#include "mesher/remesh/surface_locator.hpp"

#include <CGAL/AABB_tree.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/version.h>
// CGAL 6 has these classes for two and for three dimensions.
#if CGAL_VERSION_NR >= 1060000000
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#else
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>
#endif

namespace quadrille {

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
#if CGAL_VERSION_NR >= 1060000000
using Traits =
    CGAL::AABB_traits_3<Kernel, CGAL::AABB_triangle_primitive_3<Kernel, Triangles::const_iterator>>;
#else
using Traits = CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>>;
#endif

Kernel::Point_3 to_cgal(const Vector3& p) {
  return {p.x(), p.y(), p.z()};
}

}  // namespace

struct SurfaceLocator::Tree {
  Triangles triangles;
  std::vector<int> numbers;  ///< index of each triangle in the surface
  CGAL::AABB_tree<Traits> boxes;
};

SurfaceLocator::SurfaceLocator(const TriangleMesh& surface, const std::vector<int>& patches,
                               int patch_count) {
  trees_.reserve(patch_count);
  for (int patch = 0; patch < patch_count; ++patch) trees_.push_back(std::make_unique<Tree>());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    Tree& tree = *trees_[patches[t]];
    const auto& [a, b, c] = surface.triangles[t];
    tree.triangles.emplace_back(to_cgal(surface.points[a]), to_cgal(surface.points[b]),
                                to_cgal(surface.points[c]));
    tree.numbers.push_back(static_cast<int>(t));
  }
  for (const auto& tree : trees_) {
    tree->boxes.rebuild(tree->triangles.cbegin(), tree->triangles.cend());
    // Build now: on the first query the tree would be built under a lock.
    tree->boxes.build();
    tree->boxes.accelerate_distance_queries();
  }
}

SurfaceLocator::~SurfaceLocator() = default;

SurfaceLocator::Place SurfaceLocator::nearest(int patch, const Vector3& point) const {
  const Tree& tree = *trees_[patch];
  const auto found = tree.boxes.closest_point_and_primitive(to_cgal(point));
  return {{found.first.x(), found.first.y(), found.first.z()},
          tree.numbers[found.second - tree.triangles.cbegin()]};
}

}  // namespace quadrille
