#pragma once
/// Wall thickness: the straight distance from one skin through the material to the other. Internal.

#include <memory>
#include <optional>

#include "geometry/base/execution_context.hpp"
#include "geometry/base/vector.hpp"
#include "geometry/cad/cad_shape.hpp"

namespace quadrille {

/// Rays through a model's triangles. Thread-safe once built.
class WallRays {
 public:
  /// \param narrowest smallest thickness that is accurate to some 10 %, millimeters. Models whose faces
  /// enclose a negative volume are taken to be inside out.
  WallRays(const CadShape& shape, double narrowest, const ExecutionContext& context);
  ~WallRays();

  /// The thickness at a point of the skin; none if there is no wall within `widest`. The other skin must face
  /// the point within 40 degrees; what the ray meets at other angles is not a wall. \param inward unit vector
  /// into the material by the face's orientation. Time: about the logarithm of the number of triangles.
  std::optional<double> thickness(const Vector3& point, const Vector3& inward, double widest) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace quadrille
