#pragma once
/// The model behind a mesh, a CAD shape or a scan cut into faces, and the midside nodes that second-order
/// meshes have on it, or beside it where elements would fold. Internal.

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/edges/edge_sampling.hpp"
#include "mesher/mesh/mesh_types.hpp"
#include "mesher/shell/face_mesh.hpp"

namespace quadrille {

/// The faces and edges that meshed faces and boundary nodes belong to. Calls from several threads are
/// allowed.
class ShellGeometry {
 public:
  virtual ~ShellGeometry() = default;
  /// The surface that the uv of a mesh of the face refer to.
  virtual std::shared_ptr<const MeshSurface> surface(FaceId face, const FaceMesh& mesh) const = 0;
  /// The point of an edge that is equally far from the nodes at two parameters.
  virtual Vector3 middle(EdgeId edge, double from, double to, const Vector3& first,
                         const Vector3& last) const = 0;
  virtual int number(FaceId face) const = 0;  ///< number of the face in the shell, from 1
  virtual int number(EdgeId edge) const = 0;  ///< number of the edge in the shell, from 1
};

/// A CAD shape.
class CadGeometry : public ShellGeometry {
 public:
  explicit CadGeometry(const CadShape& shape) : shape_(shape) {}
  std::shared_ptr<const MeshSurface> surface(FaceId face, const FaceMesh& mesh) const override {
    return mesh.surface ? mesh.surface : std::make_shared<const FaceSurface>(shape_.faces[face]);
  }
  Vector3 middle(EdgeId edge, double from, double to, const Vector3& first,
                 const Vector3& last) const override;
  int number(FaceId face) const override { return face.number(); }
  int number(EdgeId edge) const override { return shape_.edges[edge].number; }

 private:
  const CadShape& shape_;
};

/// The parts from which a shell is assembled.
struct MeshedFaces {
  const ShellGeometry& geometry;
  const BoundaryNodes& nodes;
  const FaceMeshes& faces;

  /// The surface that the uv of the face's nodes refer to.
  std::shared_ptr<const MeshSurface> surface(FaceId face) const {
    return geometry.surface(face, *faces[face]);
  }
};

/// The numbering that maps nodes, faces and segments to the shell.
struct ShellNumbering {
  std::vector<int> nodes;                        ///< (boundary nodes) node of the shell; -1 = no quad uses it
  std::vector<std::size_t> first_quad;           ///< (faces + 1) first quad of each face in the shell
  std::vector<std::pair<EdgeId, int>> segments;  ///< (segments) CAD edge, and index of the segment on it

  /// The face of a quad of the shell.
  FaceId face_of(std::size_t quad) const {
    const auto next = std::upper_bound(first_quad.begin(), first_quad.end(), quad);
    return FaceId::from_index(next - first_quad.begin() - 1);
  }
};

/// The midside nodes of a shell. They are its last points, those on CAD edges before those inside faces.
struct Midsides {
  std::size_t first_inner = 0;      ///< node of the shell: first midside node inside a face
  std::vector<Vector2> parameters;  ///< uv of the nodes inside faces, on the face's surface
};

/// Adds the midside nodes to a first-order shell. Those on CAD edges lie on the curve, equally far from both
/// ends. The others lie on the face's surface, nearest to the middle of the side. Linear in the mesh.
Midsides add_midsides(const MeshedFaces& meshed, const ShellNumbering& numbering, ShellMesh& mesh,
                      const ExecutionContext& context);

/// Moves midside nodes until no element folds (see second_order.hpp): toward the middle of the straight side,
/// by as little as helps, those inside faces first, then those on CAD edges, for all faces that share them.
/// Nodes off the geometry are listed in `mesh.off_geometry`. With straight sides an element with a positive
/// scaled Jacobian does not fold, so only inverted quads and quads without area still fold in the end.
/// \return the quads that still fold, ascending. Linear in the mesh and in the number of elements that fold.
std::vector<std::size_t> unfold(const MeshedFaces& meshed, const ShellNumbering& numbering,
                                const Midsides& midsides, ShellMesh& mesh, const ExecutionContext& context);

}  // namespace quadrille
