#pragma once
/// Finds nearest points on a triangulated surface. Internal.

#include <memory>
#include <vector>

#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// Finds the nearest points on the faces of a triangulated surface. Each face has its own tree of boxes.
class SurfaceLocator {
 public:
  struct Place {
    Vector3 point;      ///< point on the surface
    int triangle = -1;  ///< triangle that the point lies on
  };

  /// \param patches (triangles) the face of each triangle, from 0. O(n log n).
  SurfaceLocator(const TriangleMesh& surface, const std::vector<int>& patches, int patch_count);
  ~SurfaceLocator();
  SurfaceLocator(const SurfaceLocator&) = delete;
  SurfaceLocator& operator=(const SurfaceLocator&) = delete;

  /// The point of a face nearest to a given point. Thread-safe. O(log n) in practice.
  Place nearest(int patch, const Vector3& point) const;

 private:
  struct Tree;
  std::vector<std::unique_ptr<Tree>> trees_;  // by patch
};

}  // namespace quadrille
