#pragma once
/// Improving quads: topological clean-up and smoothing on a surface.

#include <array>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/base/vector.hpp"
#include "geometry/surfaces/mesh_surface.hpp"
#include "mesher/mesh/mesh_types.hpp"
#include "mesher/mesh/quad_geometry.hpp"
#include "mesher/quads/improve_options.hpp"

namespace quadrille {

/// A plane of constant z, seen from above, or any set of points in it.
class PlanarSurface : public MeshSurface {
 public:
  explicit PlanarSurface(double z = 0) : z_(z) {}
  Vector3 move(Vector2& uv, const Vector3& target, Vector3& normal) const override {
    uv = {target.x(), target.y()};
    normal = {0, 0, 1};
    return {target.x(), target.y(), z_};
  }

 private:
  double z_;
};

/// Where a node is on its surface.
struct SurfacePlace {
  Vector3 point, normal;
  Vector2 uv;
};

/// A quad mesh of one face while it is improved.
struct SurfaceMesh {
  QuadMesh mesh;                    ///< without tags
  std::vector<Vector2> parameters;  ///< (n) surface parameters of each point
  std::vector<Vector3> normals;     ///< (n) unit surface normals at each point
  std::vector<char> fixed;          ///< (n) 1 = on the boundary: never moved, merged or removed
  /// (n) or empty: angle (radians) that the face fills at a boundary point, between the tangents of its
  /// curves; 0 = measure it between the sides. On a coarse mesh that will be split, curves turn between the
  /// nodes: on a circle of 6 sides, a corner that looks like 120 degrees turns out straight. For clean_up().
  std::vector<double> boundary_angles;

  SurfacePlace place_of(int node) const { return {mesh.points[node], normals[node], parameters[node]}; }
  void add(const SurfacePlace& place, bool is_fixed) {
    mesh.points.push_back(place.point);
    normals.push_back(place.normal);
    parameters.push_back(place.uv);
    fixed.push_back(is_fixed);
  }
  void put(int node, const SurfacePlace& place) {
    mesh.points[node] = place.point;
    normals[node] = place.normal;
    parameters[node] = place.uv;
  }
  /// The scaled Jacobian of a quad, negative where it is folded against the normals at its corners.
  double quality(const std::array<int, 4>& quad) const {
    const auto& [a, b, c, d] = quad;
    const auto& p = mesh.points;
    return folded_scaled_jacobian(p[a], p[b], p[c], p[d], normals[a] + normals[b] + normals[c] + normals[d]);
  }
  /// The place nearest to a target, searched from a node's place.
  SurfacePlace moved(const MeshSurface& surface, int node, const Vector3& target) const {
    SurfacePlace place = place_of(node);
    place.point = surface.move(place.uv, target, place.normal);
    return place;
  }
};

/// Topological clean-up: refills small patches, then large ones, where that lowers the
/// valence deviation. Boundary nodes and sides stay. Unused points are removed and the arrays renumbered,
/// with the fixed points first in their old order. The desired valence is 4 for an interior node, and one
/// quad per 90 degrees of the boundary angle for a boundary node.
void clean_up(SurfaceMesh& surface_mesh, const MeshSurface& surface, const ImproveOptions& options,
              ExecutionContext& context);

/// Moves the free nodes on the surface. First come elements with a non-positive Jacobian, which are
/// untangled. Then Laplacian sweeps accept a move only if the worst element around the node does not get
/// worse (or stays above a floor), and keep the first row along arcs that are cut out of the face no thicker
/// than its quads are long. Last come the worst elements, node by node.
void smooth(SurfaceMesh& surface_mesh, const MeshSurface& surface, const ImproveOptions& options,
            ExecutionContext& context);

}  // namespace quadrille
