#pragma once
/// Improving quads: topological clean-up and smoothing on a surface.

#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/base/vector.hpp"
#include "mesher/mesh/mesh_types.hpp"
#include "mesher/quads/improve_options.hpp"

namespace quadrille {

/// The surface that nodes are kept on while they move.
class SmoothingSurface {
 public:
  virtual ~SmoothingSurface() = default;
  /// Moves a point of the surface towards a target in space, and keeps it on the surface.
  /// \param uv in: parameters of the point; out: of the new point (meaning is the surface's own).
  /// \return the point of the surface near `target`; its unit normal (the side that quads are
  /// counter-clockwise seen from) goes to `normal`.
  virtual Vector3 move(Vector2& uv, const Vector3& target, Vector3& normal) const = 0;
};

/// The plane z = 0, or any set of points in it.
class PlanarSurface : public SmoothingSurface {
 public:
  Vector3 move(Vector2& uv, const Vector3& target, Vector3& normal) const override {
    uv = {target.x(), target.y()};
    normal = {0, 0, 1};
    return {target.x(), target.y(), 0};
  }
};

/// A quad mesh of one face while it is improved.
struct SurfaceMesh {
  QuadMesh mesh;
  std::vector<Vector2> parameters;  ///< (n) surface parameters of each point
  std::vector<Vector3> normals;     ///< (n) unit surface normals at each point
  std::vector<char> fixed;          ///< (n) 1 = on the boundary: never moved, merged or removed
  /// (n) or empty: angle (radians) that the face fills at a boundary point, between the tangents of its
  /// curves; 0 = measure it between the sides. On a coarse mesh that is to be split, curves turn between its
  /// nodes: a corner that looks like 120 degrees on a circle of 6 sides is straight in the end, and only this
  /// tells. clean_up() uses it.
  std::vector<double> boundary_angles;
};

struct ImproveReport {
  int quad_vertex_merges = 0;
  int doublet_collapses = 0;
  int valence_moves = 0;  ///< other topological moves that lowered the valence deviation
  int cavities = 0;       ///< large patches filled anew
  int bad_elements = 0;   ///< elements that still have a scaled Jacobian <= 0
};

/// Topological clean-up: doublets collapsed, quads with a diagonal better closed merged (quad-vertex merge),
/// sides rotated where the valence deviation falls. Boundary nodes and sides stay. Unused points are removed
/// and the arrays renumbered with the fixed points first in their old order. The desired valence of an
/// interior node is 4; of a boundary node, from the boundary angle: one quad per 90 degrees.
void clean_up(SurfaceMesh& surface_mesh, const SmoothingSurface& surface, const ImproveOptions& options,
              ImproveReport& report, ExecutionContext& context);

/// Moves the free nodes on the surface: Laplacian sweeps that accept a move only if the worst element around
/// the node does not get worse (or stays above a floor), elements with non-positive Jacobian untangled first,
/// then the worst elements node by node.
void smooth(SurfaceMesh& surface_mesh, const SmoothingSurface& surface, const ImproveOptions& options,
            ImproveReport& report, ExecutionContext& context);

}  // namespace quadrille
