#pragma once
/// How thick walls are: the way from one skin straight through the material to the other. Internal.

#include <memory>
#include <optional>

#include "geometry/base/execution_context.hpp"
#include "geometry/base/vector.hpp"
#include "geometry/cad/cad_shape.hpp"

namespace quadrille {

/// Rays through a model's triangles. Thread-safe once built.
class WallRays {
 public:
  /// \param narrowest thickness that is told to within some 10 %, millimeters. Models whose faces enclose a
  /// negative volume are taken to be inside out.
  WallRays(const CadShape& shape, double narrowest, const ExecutionContext& context);
  ~WallRays();

  /// The thickness at a point of the skin; none where there is no wall within `widest`. What faces the point
  /// within 40 degrees is the other skin; what the ray meets at other angles is none. \param inward unit
  /// vector into the material, as the face's orientation has it. Time: about that of the logarithm of the
  /// triangles.
  std::optional<double> thickness(const Vector3& point, const Vector3& inward, double widest) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace quadrille
