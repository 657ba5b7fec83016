/// Derives the plan of a face from its outline, the counts on its edges and prescribed divisions.

#include "mesher/edges/face_plan.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "mesher/edges/edge_sampling.hpp"

namespace quadrille {

namespace {

/// The numbers of segments of the four sides of a face, in the order of its wire.
std::array<int, 4> segments_of(const CadFace& face, const FaceSides& sides, const BoundaryNodes& nodes) {
  const auto& coedges = face.wires[0].coedges;
  std::array<int, 4> result{};
  for (std::size_t side = 0; side < result.size(); ++side) {
    std::size_t i = sides.starts[side];
    do {
      result[side] += std::max(0, nodes.edges[coedges[i].edge].segments());
      i = (i + 1) % coedges.size();
    } while (static_cast<int>(i) != sides.starts[(side + 1) % result.size()]);
  }
  return result;
}

FacePlan plan_of(const CadFace& face, FaceSides sides, bool subdivided, const BoundaryNodes& nodes) {
  FacePlan plan;
  plan.stride = subdivided ? 2 : 1;
  for (const CadWire& wire : face.wires) {
    for (const Coedge& coedge : wire.coedges) {
      const BoundaryNodes::Edge& edge = nodes.edges[coedge.edge];
      if (edge.segments() % 2 == 1) plan.stride = 1;
      plan.has_kept_edge |= edge.kept;
      plan.has_divided_edge |= edge.divided;
    }
  }
  plan.is_filled = sides.is_filled();
  plan.keeps_rows = sides.is_filled() && plan.has_kept_edge;
  if (sides.has_four_sides()) {
    const std::array<int, 4> n = segments_of(face, sides, nodes);
    if (n[0] == n[2] && n[1] == n[3]) plan.grid_quads = n[0] * n[1];
  }
  plan.sides = std::move(sides);
  return plan;
}

}  // namespace

FacePlans plan_faces(const CadShape& shape, FaceOutlines sides, const SamplingPlan& sampling,
                     const BoundaryNodes& nodes) {
  for (const auto& [side, counts] : nodes.unused) sides[side.first].drop_grid();  // it ends before a tip
  FacePlans plans(shape.faces.size());
  for (const FaceId face : plans.ids()) {
    // An odd number of segments may lie on an edge beyond the rows that end there.
    const bool subdivided =
        (nodes.stride == 2 || sampling.subdivided[face] != 0) && !has_chain(sampling.rows.of_faces, face);
    plans[face] = plan_of(shape.faces[face], std::move(sides[face]), subdivided, nodes);
  }
  for (const auto& [face, lines] : sampling.rows.of_faces) plans[face].row_lines = lines;
  return plans;
}

}  // namespace quadrille
