#pragma once
/// The quads of a face while patches of them are replaced; not part of the public interface.

#include <span>
#include <vector>

#include "mesher/quads/improve.hpp"
#include "mesher/quads/quad_topology.hpp"

namespace quadrille {

/// A surface mesh with its topology. write_back() puts the mesh in order again.
class EditedMesh {
 public:
  using Quad = QuadTopology::Quad;

  EditedMesh(SurfaceMesh& mesh, const ExecutionContext& context);

  int node_count() const { return static_cast<int>(mesh_.mesh.points.size()); }
  const Vector3& point(int node) const { return mesh_.mesh.points[node]; }
  const Vector3& normal(int node) const { return mesh_.normals[node]; }
  /// Whether quads close round a node that may move.
  bool inner(int node) const { return topology_.closed(node) && may_move(node); }
  /// \return the least scaled Jacobian; negative where a quad is folded.
  double worst(std::span<const Quad> quads) const;
  /// Whether some side is longer than every one before, and far longer than these are in the mean.
  bool too_long(std::span<const Quad> before, std::span<const Quad> quads) const;

 protected:
  bool may_move(int node) const { return !mesh_.fixed[node] && !on_triangle_[node]; }
  /// A new free node at the place of another; returns its number.
  int add_node_like(int donor);
  /// The fixed points first, in their old order, then the free ones still used, in theirs.
  /// \return the old number of each point that is left.
  std::vector<int> write_back();

  SurfaceMesh& mesh_;
  const ExecutionContext& context_;
  QuadTopology topology_;
  std::vector<char> on_triangle_;
  /// (nodes) radians: the angle that the quads of a node fill that is not inner, in the mean of its fans; the
  /// mesh's own boundary angles where it has them.
  std::vector<double> angles_;

 private:
  void measure_boundary();
};

}  // namespace quadrille
