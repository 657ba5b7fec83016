#pragma once
/// Places the midside nodes of second-order meshes on the geometry. Internal.

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "mesher/edges/edge_sampling.hpp"
#include "mesher/mesh/mesh_types.hpp"
#include "mesher/shell/shell_geometry.hpp"

namespace quadrille {

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
  /// The first quad of a face in the shell, and the one after its last.
  std::pair<std::size_t, std::size_t> quads_of(FaceId face) const {
    return {first_quad[face.index()], first_quad[face.index() + 1]};
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

}  // namespace quadrille
