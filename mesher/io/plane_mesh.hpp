#pragma once
/// Meshes for plane and axisymmetric elements, which solvers take only in the plane z = 0. Internal.

#include <string>

#include "mesher/mesh/inp_element.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// A mesh in the plane z = 0, and how it came there.
struct PlaneMesh {
  ShellMesh mesh;    ///< all z are 0; elements are counter-clockwise
  std::string turn;  ///< which point of the model (x, y) is; empty if no node has moved
};

/// Rotates a plane mesh about the origin into the plane z = 0 and then shifts it along z. The x axis of the
/// result is the model's x axis projected to the plane (the y axis for the plane y-z); its y axis is the
/// model's z axis if the plane is upright. Elements that are then clockwise are reversed. For axisymmetric
/// elements x is the radius, y the axis. O(n).
/// \param name of the file, for messages. All nodes must exist and be finite.
/// Throws Error (usage, subject "element") if the mesh is not plane, or for axisymmetric elements if a node
/// has a negative radius, each by more than 1e-5 of the mesh's diagonal.
PlaneMesh in_plane(const ShellMesh& mesh, InpElement element, const std::string& name);

}  // namespace quadrille
