#pragma once
/// Parts of a model that touch or cross without sharing anything: their meshes would not be joined.

#include <array>
#include <string>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/cad/cad_shape.hpp"

namespace quadrille {

/// Where parts touch. A part is a solid, or faces that share edges or vertices.
struct Contacts {
  /// Numbers of two faces for each two parts that touch, the lower number first, ascending.
  std::vector<std::array<int, 2>> faces;
  int edges = 0;  ///< pairs of edges of different parts that lie on each other
  bool free_edges =
      false;  ///< those edges have one face each and all parts touch along them: sewing joins them
  bool all_tested = true;  ///< false: there were too many faces near each other to test all
  /// "2 pairs of parts touch or cross without sharing ...", with the setting that joins them; empty if none.
  std::string sentence() const;
};

/// The parts that come within the larger of their tolerances and 1e-7 of the diagonal. A part that enters
/// another without meeting an edge, as a ball in a plate, is missed. Time: nothing for a model of one part;
/// else about a tenth of a millisecond, on splines milliseconds, for each edge near a face of another part.
Contacts contacts(const CadShape& shape, const ExecutionContext& context = {});

}  // namespace quadrille
