#pragma once
/// Parts of a model that touch or cross without sharing anything: their meshes would not be joined.

#include <array>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/cad/cad_shape.hpp"

namespace quadrille {

/// What to do about parts that lie on each other: "`sew` joins ...", or what is left to do if that setting
/// has been tried. \param remedy "sew", "imprint" or "keep_features". \param tried names of settings.
std::string advice(std::string_view remedy, const std::set<std::string_view>& tried);

/// Where parts touch. A part is a solid, or faces that share edges or vertices.
struct Contacts {
  /// Numbers of two faces for each two parts that touch, the lower number first, ascending.
  std::vector<std::array<int, 2>> faces;
  int edges = 0;  ///< pairs of edges of different parts that lie on each other
  bool free_edges =
      false;  ///< those edges have one face each and all parts touch along them: sewing joins them
  bool all_tested = true;  ///< false: there were too many faces near each other to test all
  /// The name of the setting that joins them, "sew" or "imprint"; empty if there are none.
  std::string_view remedy() const;
  /// "2 pairs of parts touch or cross without sharing ...", with advice(); empty if none.
  std::string sentence(const std::set<std::string_view>& tried = {}) const;
};

/// The parts that come within the larger of their tolerances and 1e-7 of the diagonal. A part that enters
/// another without meeting an edge, as a ball in a plate, is missed. Time: nothing for a model of one part;
/// else about a tenth of a millisecond, on splines milliseconds, for each edge near a face of another part.
Contacts contacts(const CadShape& shape, const ExecutionContext& context = {});

}  // namespace quadrille
