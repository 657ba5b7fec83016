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

/// Grows patches around irregular nodes. A patch takes in the nearest irregular node outside, again and
/// again, until it has two to six corners and a filling with fewer irregular nodes exists for these
/// (polygon_filling.hpp). Where that fails, a second attempt takes in only nodes that bring the patch nearer
/// to four corners. The patch is refilled if its quads then lie nearer to the industry criteria on average,
/// or only a little farther away for each irregular node saved. The mesh around the patch stays: each node of
/// the outline keeps its number of quads. Only boundary nodes whose quads are all inside the patch get as
/// many quads as their angle requires.
///
/// Time: linear in the irregular nodes; a patch has at most 150 quads. Based on: Verma & Tautges, Jaal:
/// engineering a high quality all-quadrilateral mesh generator (2011), for convex patches around irregular
/// nodes.
///
/// \return the number of refilled patches.
int remesh_cavities(SurfaceMesh& mesh, const MeshSurface& surface, const ExecutionContext& context);

/// Moves the free nodes of inverted quads in space, where no place on the surface makes them valid: to the
/// mean of their neighbors, to where a quad becomes a parallelogram, then by a compass search, always to the
/// place where the worst quad around the node is best.
/// \param fixed (n) 1 = stays where it is
/// \param reach the largest distance that a node moves
/// \return (n) 1 = was moved. Quads may stay inverted if too many of their nodes are fixed. Linear in the
/// mesh for each of at most 20 rounds.
std::vector<char> unfold_in_space(const std::vector<std::array<int, 4>>& quads, std::vector<Vector3>& points,
                                  const std::vector<char>& fixed, double reach,
                                  const ExecutionContext& context);

}  // namespace quadrille
