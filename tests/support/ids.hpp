#pragma once
/// Ids by the numbers that FreeCAD shows.

#include "geometry/cad/ids.hpp"

namespace quadrille {

inline FaceId face_id(int number) {
  return FaceId::from_number(number);
}
inline EdgeId edge_id(int number) {
  return EdgeId::from_number(number);
}
inline VertexId vertex_id(int number) {
  return VertexId::from_number(number);
}

}  // namespace quadrille
