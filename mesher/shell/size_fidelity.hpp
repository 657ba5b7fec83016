#pragma once
/// How well a mesh matches the wanted sizes.

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "geometry/sizing/sizing_field.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// The ratios of the lengths of element sides to the sizes wanted at their middles.
struct SizeFidelity {
  static constexpr double low = 0.55, high = 1.6;  ///< the range of good ratios
  int sides = 0;                                   ///< number of sides
  double median = 0;                               ///< median ratio
  double within_percent = 0;                       ///< sides with a ratio from low to high
  double below_percent = 0;                        ///< sides with a ratio below low
  double above_percent = 0;                        ///< sides with a ratio above high

  nlohmann::ordered_json json() const;
};

/// Measures each side once, in its direction where sizes have one. \param field sizing field that the mesh
/// was made with, see MeshOptions::inspect \param shape of the model Time: linear in the sides, with one
/// lookup in the field for each.
SizeFidelity size_fidelity(const ShellMesh& mesh, const SizingField& field, const CadShape& shape);

/// The quads, ascending, with a side under half of ShellMesh::size_min where sizes below it are wanted, as
/// beside edges and faces that users give smaller sizes or segments. One lookup for each.
std::vector<int> finer_quads(const ShellMesh& mesh, const SizingField& field);

}  // namespace quadrille
