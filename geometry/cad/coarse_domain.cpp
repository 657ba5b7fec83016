/// Replaces the parametric curve of each edge by sixteen straight segments.

#include "geometry/cad/coarse_domain.hpp"

#include <utility>
#include <vector>

namespace quadrille {

TrimmedDomain coarse_domain(const CadShape& shape, const CadFace& face) {
  constexpr int intervals = 16;
  std::vector<TrimmedDomain::Segment> segments;
  for (const CadWire& wire : face.wires) {
    for (const Coedge& coedge : wire.coedges) {
      if (coedge.internal) continue;
      const CadEdge& edge = shape.edges[coedge.edge];
      Vector2 from = parametric_point(coedge, edge.first);
      for (int i = 1; i <= intervals; ++i) {
        const Vector2 to = parametric_point(coedge, edge.first + (edge.last - edge.first) * i / intervals);
        segments.push_back({from, to});
        from = to;
      }
    }
  }
  return TrimmedDomain(std::move(segments));
}

}  // namespace quadrille
