#pragma once
/// How well a mesh keeps the sizes that were asked for.

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "geometry/sizing/sizing_field.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// Lengths of element sides over the sizes wanted at their middles.
struct SizeFidelity {
  static constexpr double low = 0.55, high = 1.6;
  struct Bin {
    double from, to;
    int count;
  };
  int sides = 0;
  double median = 0;
  double within_percent = 0;   ///< of the sides, between low and high
  double below_percent = 0;    ///< shorter than low times what is wanted
  double above_percent = 0;    ///< longer than high times
  std::vector<Bin> histogram;  ///< four bins to a factor of two; the first and the last hold all beyond

  nlohmann::ordered_json json() const;
};

/// Each side once. \param field what the mesh was made with, see MeshOptions::inspect. Time: that of sorting
/// the sides, and a look-up each.
SizeFidelity size_fidelity(const ShellMesh& mesh, const SizingField& field);

}  // namespace quadrille
