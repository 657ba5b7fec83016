#pragma once
/// The quads of a face while patches of them are replaced; not part of the public interface.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include <boost/container/small_vector.hpp>
#include <boost/container/static_vector.hpp>

#include "mesher/quads/improve.hpp"
#include "mesher/quads/patch_templates.hpp"
#include "mesher/quads/quad_topology.hpp"

namespace quadrille {

/// A patch of quads as a polygon with nodes inside.
struct Outline {  // NOLINT(bugprone-exception-escape): moves may allocate
  using List = boost::container::small_vector<int, PatchTemplate::max_sides>;

  List ring;    ///< nodes, counter-clockwise
  List sides;   ///< side of the patch from each node of the ring to the next
  List uses;    ///< quads of the patch at each node of the ring
  List inside;  ///< nodes

  int length() const { return static_cast<int>(ring.size()); }
  int inside_count() const { return static_cast<int>(inside.size()); }
};

/// Quads that are tried as one patch.
struct SmallPatch {
  static constexpr std::size_t max_quads = 8, max_inside = 4;  ///< quads, and nodes inside
  boost::container::static_vector<int, max_quads> quads;

  std::span<const int> span() const { return {quads.data(), quads.size()}; }
  bool contains(int quad) const { return std::find(quads.begin(), quads.end(), quad) != quads.end(); }
  bool add(int quad) {
    if (quad < 0) return false;
    if (contains(quad)) return true;
    if (quads.size() == max_quads) return false;
    quads.push_back(quad);
    return true;
  }
};

/// A template laid into an outline: the places of its corners and the nodes that they stand for.
struct Filling {
  static constexpr int max_corners = PatchTemplate::max_sides + PatchTemplate::max_interior;
  const PatchTemplate& filling;
  std::array<Vector3, max_corners> x;
  std::array<int, max_corners> nodes;  ///< of the mesh; -1 = new
  Vector3 normal;                      ///< the sum of the normals at the outline's nodes
  /// The least scaled Jacobian, negative where a quad is folded.
  double worst() const;
};

/// A surface mesh with its topology. write_back() brings the mesh up to date.
class EditedMesh {
 public:
  using Quad = QuadTopology::Quad;

  EditedMesh(SurfaceMesh& mesh, const ExecutionContext& context);

  QuadTopology& topology() { return topology_; }
  int node_count() const { return static_cast<int>(mesh_.mesh.points.size()); }
  const std::vector<Vector3>& points() const { return mesh_.mesh.points; }
  const Vector3& point(int node) const { return mesh_.mesh.points[node]; }
  const Vector3& normal(int node) const { return mesh_.normals[node]; }
  /// Whether the node may move and its quads close around it.
  bool inner(int node) const { return topology_.closed(node) && may_move(node); }
  std::vector<Quad> corners_of(std::span<const int> quads) const;
  /// \return the least scaled Jacobian; negative where a quad is folded.
  double worst(std::span<const Quad> quads) const;
  /// Whether a new side is longer than every side before, and far longer than their mean.
  bool too_long(std::span<const Quad> before, std::span<const Quad> quads) const;

  static double inner_cost(int quads) { return quads < 3 ? 20 : (quads - 4) * (quads - 4); }

  /// The valence cost of a node with `quads` quads: how far that is from what its angle asks for.
  double node_cost(int node, int quads) const {
    if (inner(node)) return inner_cost(quads);
    if (quads < 1) return 1e9;
    const double angle = angles_[node] * 180 / std::numbers::pi;
    const double wanted = std::max(1.0, std::round(angle / 90));
    // Smoothing cannot change the mean angle at a boundary node, so its cost rises fast beyond 130 degrees.
    // Opening a straight corner costs two or three irregular nodes inside. It pays from 150 degrees on.
    const double mean = angle / quads;
    const double flat = std::max(0.0, mean - 130) / 15, sharp = std::max(0.0, 40 - mean) / 20;
    return (quads - wanted) * (quads - wanted) + 3 * flat * flat + 3 * sharp * sharp;
  }
  /// Finds the polygon around a patch. False if the patch is not a disc, or nodes inside it must stay.
  /// \param outline empty
  bool trace(std::span<const int> quads, Outline& outline);
  /// The same; also false if the outline is too long, or has too many nodes inside.
  bool trace(const SmallPatch& patch, Outline& outline) {
    return trace(patch.span(), outline) && outline.ring.size() <= PatchTemplate::max_sides &&
           outline.inside.size() <= SmallPatch::max_inside;
  }
  /// Sets `costs.uses`, the valence costs around a patch with any filling. \return the present valence cost.
  double find_costs(const Outline& outline, FillingCosts& costs) const;
  /// Lays a template into an outline, with its inner nodes at the mean of their neighbors.
  Filling laid(const Outline& outline, const PatchTemplate& filling) const;
  bool may_move(int node) const { return !mesh_.fixed[node] && !on_triangle_[node]; }
  /// A new free node at the place of another; returns its number.
  int add_node_like(int donor);
  /// Rebuilds the mesh: first the fixed points, then the free ones that are still used, each in their old
  /// order. \return the old number of each point that is left.
  std::vector<int> write_back();

 protected:
  SurfaceMesh& mesh_;
  const ExecutionContext& context_;
  QuadTopology topology_;
  std::vector<char> on_triangle_;
  /// (nodes) radians: the angle that the quads of a node fill, for nodes that are not inner; the mean if it
  /// has several fans. Where it has one, SurfaceMesh::boundary_angles takes precedence.
  std::vector<double> angles_;

 private:
  int traces_ = 0;           ///< calls of trace()
  std::vector<int> traced_;  ///< by quad: the last trace of a patch that holds it
  std::vector<int> met_;     ///< by node: the last trace that met it
};

}  // namespace quadrille
