#pragma once
/// The model behind a mesh, as assembly and second order need it: a CAD shape, or a scan cut into faces.
/// Internal.

#include <memory>

#include "geometry/cad/cad_shape.hpp"
#include "geometry/surfaces/face_surface.hpp"
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

}  // namespace quadrille
