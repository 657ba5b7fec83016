#pragma once
/// Where points lie on a triangulated surface. Internal.

#include <memory>
#include <vector>

#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// Finds the nearest places on the faces of a triangulated surface, by a tree of boxes for each.
class SurfaceLocator {
 public:
  struct Place {
    Vector3 point;      ///< on the surface
    int triangle = -1;  ///< that it lies on
  };

  /// \param patches (triangles) the face of each, from 0. O(n log n).
  SurfaceLocator(const TriangleMesh& surface, const std::vector<int>& patches, int patch_count);
  ~SurfaceLocator();
  SurfaceLocator(const SurfaceLocator&) = delete;
  SurfaceLocator& operator=(const SurfaceLocator&) = delete;

  /// The place on a face nearest to a point. Thread-safe. O(log n) in practice.
  Place nearest(int patch, const Vector3& point) const;

 private:
  struct Tree;
  std::vector<std::unique_ptr<Tree>> trees_;  // by patch
};

}  // namespace quadrille
