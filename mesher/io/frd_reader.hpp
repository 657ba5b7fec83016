#pragma once
/// Results of CalculiX: .frd files as text.

#include <string>
#include <string_view>
#include <vector>

#include "geometry/base/vector.hpp"

namespace quadrille {

/// The mesh that a solver used, and how it moved in the last step.
struct FrdResult {
  struct Element {
    int number = 0;          ///< as in the file
    int type = 0;            ///< 1: eight nodes, 4: twenty nodes, others as the format has them
    std::vector<int> nodes;  ///< indices of `points`
  };
  std::vector<Vector3> points;
  std::vector<Vector3> displacements;  ///< (points)
  std::vector<Element> elements;       ///< ascending by number
};

/// Parses a .frd file. \param name used in error messages. Throws Error (failure) with one sentence that
/// names the line at fault, or says what the file lacks.
FrdResult read_frd(std::string_view bytes, const std::string& name);

}  // namespace quadrille
