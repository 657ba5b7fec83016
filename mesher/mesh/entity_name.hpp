#pragma once
/// FreeCAD's names of vertices (dimension 0), edges (1) and faces (2): "Face3". Internal.

#include <string>
#include <string_view>

#include "geometry/base/text_parts.hpp"

namespace quadrille {

inline constexpr std::string_view entity_kinds[] = {"Vertex", "Edge", "Face"};

inline std::string entity_name(int dimension, int number) {
  return std::string(entity_kinds[dimension]) + std::to_string(number);
}

struct NamedEntity {
  int dimension = -1;  ///< -1 = the name is none of an entity
  int number = 0;      ///< from 1
};

/// The entity of that name.
inline NamedEntity entity_of(std::string_view name) {
  for (int dimension = 0; dimension < 3; ++dimension) {
    const std::string_view kind = entity_kinds[dimension];
    if (!name.starts_with(kind)) continue;
    const std::optional<int> number = exactly<int>(name.substr(kind.size()));
    if (number && *number > 0) return {dimension, *number};
  }
  return {};
}

}  // namespace quadrille
