#pragma once
/// Makes the sum of the counts around every face even. Internal.

#include <functional>
#include <vector>

#include "geometry/cad/ids.hpp"

namespace quadrille {

/// An edge of the parity problem: the faces that change parity with the edge's count.
struct ParityEdge {
  std::vector<FaceId> faces;  ///< faces that use the edge an odd number of times
  double cost = 0;            ///< cost of changing the edge's count by one; infinite = must not change
};

/// Chooses a cheap set of edges to change by one so that every odd face becomes even (a T-join): no edge of
/// the set costs more than it must. Edges may have any number of faces. Faces that cannot be made even are
/// added to `left_odd`. Time: edges x faces squared at worst. \param check called once for each edge; may
/// throw \return 1 = change the edge's count.
EdgeFlags make_even(
    const IdVector<EdgeId, ParityEdge>& edges, const FaceFlags& odd, std::vector<FaceId>& left_odd,
    const std::function<void()>& check = [] {});

}  // namespace quadrille
