/// Derives the plan of a face from its outline, the counts on its edges and prescribed divisions.

#include "mesher/edges/face_plan.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "mesher/edges/count_table.hpp"
#include "mesher/edges/edge_sampling.hpp"

namespace quadrille {

namespace {

using Side = std::vector<Vector3>;  // places of nodes

/// The four sides of a face from corner to corner, in the order of its outer wire.
std::array<Side, 4> sides_of(const CadFace& face, const FaceSides& sides, const BoundaryNodes& nodes) {
  const auto& coedges = face.wires[sides.outer].coedges;
  std::array<Side, 4> result;
  for (std::size_t side = 0; side < result.size(); ++side) {
    std::size_t i = sides.starts[side];
    do {
      const std::vector<int>& along = nodes.edges[coedges[i].edge].nodes;
      const std::size_t count = along.size();
      for (std::size_t k = result[side].empty() ? 0 : 1; k < count; ++k)
        result[side].push_back(nodes.points[along[coedges[i].forward ? k : count - 1 - k]]);
      i = (i + 1) % coedges.size();
    } while (static_cast<int>(i) != sides.starts[(side + 1) % result.size()]);
  }
  return result;
}

/// The number of cells between four sides; none if opposite ones have different numbers of segments.
GridSize size_of(const std::array<Side, 4>& sides) {
  if (std::ranges::any_of(sides, [](const Side& side) { return side.size() < 2; })) return {};
  if (sides[0].size() != sides[2].size() || sides[1].size() != sides[3].size()) return {};
  return {static_cast<int>(sides[0].size()) - 1, static_cast<int>(sides[1].size()) - 1};
}

/// The blocks that the holes replace, where all of them find room.
std::vector<HoleBlock> place_holes(const CadShape& shape, const CadFace& face, const FaceSides& sides,
                                   const std::array<Side, 4>& lines, const BoundaryNodes& nodes) {
  constexpr int fewest = 3;
  const GridSize grid = size_of(lines);
  if (grid.columns < fewest || grid.rows < fewest) return {};
  std::array<std::vector<double>, 4> shares;
  for (std::size_t k = 0; k < shares.size(); ++k)
    shares[k] = shares_along(k < 2 ? lines[k] : Side(lines[k].rbegin(), lines[k].rend()));
  const auto cells = [](const std::vector<double>& table, double share) {
    const auto [cell, part] = place_in(table, share);
    return static_cast<double>(cell) + part;
  };
  const auto cell_at = [&](const Vector2& p) {
    return Vector2((1 - p.y()) * cells(shares[0], p.x()) + p.y() * cells(shares[2], p.x()),
                   (1 - p.x()) * cells(shares[3], p.y()) + p.x() * cells(shares[1], p.y()));
  };
  std::vector<HoleBlock> blocks;
  std::size_t wire = 0;
  for (const HoleShares& hole : shares_of_holes(shape, face, sides)) {
    if (static_cast<int>(wire) == sides.outer) ++wire;
    int around = 0;
    for (const Coedge& coedge : face.wires[wire++].coedges)
      around += std::max(0, nodes.edges[coedge.edge].segments());
    const auto block = around > 0 ? block_of(place_of(hole, cell_at), around, grid) : std::nullopt;
    if (!block) return {};
    blocks.push_back(*block);
  }
  return keep_apart(blocks, grid) ? blocks : std::vector<HoleBlock>();
}

FacePlan plan_of(const CadShape& shape, const CadFace& face, FaceSides sides, bool subdivided,
                 const BoundaryNodes& nodes) {
  FacePlan plan;
  plan.stride = subdivided ? 2 : 1;
  for (const EdgeId id : face.edges()) {
    const BoundaryNodes::Edge& edge = nodes.edges[id];
    if (edge.segments() % 2 == 1) plan.stride = 1;
    plan.has_kept_edge |= edge.kept;
    plan.has_divided_edge |= edge.divided;
  }
  if (sides.has_four_sides()) {
    const GridSize grid = size_of(sides_of(face, sides, nodes));
    plan.grid_quads = grid.columns * grid.rows;
  }
  if (sides.has_holes())
    plan.hole_blocks = place_holes(shape, face, sides, sides_of(face, sides, nodes), nodes);
  plan.sides = std::move(sides);
  return plan;
}

}  // namespace

FacePlans plan_faces(const CadShape& shape, FaceOutlines sides, const SamplingPlan& sampling,
                     const BoundaryNodes& nodes) {
  FacePlans plans(shape.faces.size());
  for (const FaceId face : plans.ids()) {
    const bool subdivided = nodes.stride == 2 || sampling.subdivided[face] != 0;
    plans[face] = plan_of(shape, shape.faces[face], std::move(sides[face]), subdivided, nodes);
  }
  return plans;
}

}  // namespace quadrille
