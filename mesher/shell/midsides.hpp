#pragma once
/// The midside nodes of second-order meshes, on the geometry. Internal.

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/edges/edge_sampling.hpp"
#include "mesher/mesh/mesh_types.hpp"
#include "mesher/shell/face_mesher.hpp"

namespace quadrille {

/// What a shell is put together from.
struct MeshedFaces {
  const CadShape& shape;
  const BoundaryNodes& nodes;
  const std::vector<std::optional<FaceMesh>>& faces;  ///< empty = not meshed

  /// What the parameters of the face's nodes refer to.
  std::shared_ptr<const FaceSurface> surface(std::size_t face) const {
    return faces[face]->surface ? faces[face]->surface
                                : std::make_shared<const FaceSurface>(shape.faces[face]);
  }
};

/// Where the parts of the faces are in the shell.
struct ShellNumbering {
  std::vector<int> nodes;                     ///< (boundary nodes) node of the shell, -1 = no quad uses it
  std::vector<std::size_t> first_quad;        ///< (faces and one more)
  std::vector<std::pair<int, int>> segments;  ///< (segments of the shell) CAD edge from 0, segment of it
};

/// The midside nodes of a shell: the last ones of its points, those on CAD edges before those inside faces.
struct Midsides {
  std::size_t first_inner = 0;      ///< node of the shell
  std::vector<Vector2> parameters;  ///< of those inside faces, on their face's surface
};

/// Adds the midside nodes to a first-order shell: those of CAD edges on their curves, as far from both ends,
/// others at the point of their face's surface next to the middle of the side. Linear in the mesh.
Midsides add_midsides(const MeshedFaces& meshed, const ShellNumbering& numbering, ShellMesh& mesh,
                      const ExecutionContext& context);

}  // namespace quadrille
