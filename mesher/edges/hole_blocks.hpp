#pragma once
/// Holes in grids: which cells make room for a hole. For plates with holes, whose mean q rises from 0.915 to
/// 0.962; no gain elsewhere (decision 75). Internal.

#include <optional>
#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/edges/count_table.hpp"
#include "mesher/edges/edge_counts.hpp"

namespace quadrille {

/// A hole's boundary as shares of the way between the facing sides of its face: x along the first one.
struct HoleShares {
  std::vector<Vector2> points, vertices;
};

/// The holes of a face that has four corners outside, by wire without the outline; empty if the outline has
/// no area.
std::vector<HoleShares> shares_of_holes(const CadShape& shape, const CadFace& face, const FaceSides& sides);

/// Where a hole lies in a grid: its bounding box, in cells counted from the first column and row.
struct HolePlace {
  Eigen::AlignedBox2d box;
  /// The hole has a vertex straight beside, above or below its center, so the block needs nodes there too.
  bool even = false;
};

/// Numbers of cells of a grid.
struct GridSize {
  int columns = 0, rows = 0;
};

/// The cells that a hole replaces. If the hole has as many nodes as the outline of the block, only the
/// corners of the block become irregular vertices.
struct HoleBlock {
  int column = 0, row = 0;    ///< first column and row
  int columns = 0, rows = 0;  ///< number of columns and rows

  int around() const { return 2 * (columns + rows); }  ///< number of nodes on the outline
};

/// The block for a hole: about one cell wider and higher than the hole, and centered near its center.
/// \param nodes number of nodes around the hole; 0 = as many as suit the block. \return nothing if no block
/// of that many nodes is larger than the hole by no more than a few cells.
std::optional<HoleBlock> block_of(const HolePlace& hole, int nodes, const GridSize& grid);

/// The place of a hole. \param cell_at turns shares into cells.
template <class CellAt>
HolePlace place_of(const HoleShares& hole, CellAt&& cell_at) {
  constexpr double straight = 0.05;  // distance from the axis over the hole's size
  HolePlace place;
  for (const Vector2& point : hole.points) place.box.extend(cell_at(point));
  for (const Vector2& vertex : hole.vertices) {
    const Vector2 off = (cell_at(vertex) - place.box.center()).cwiseQuotient(place.box.sizes());
    place.even |= off.cwiseAbs().minCoeff() < straight;
  }
  return place;
}

/// Whether at least one row of cells lies between any two blocks, and between blocks and the grid's outline.
bool keep_apart(const std::vector<HoleBlock>& blocks, const GridSize& grid);

/// Changes the wanted counts so that holes fit into the grids of faces with four corners. A hole's wanted
/// count is then the number of segments around its block, provided that segments of the hole's size are about
/// as long as those of the face's sides. The wanted counts of sides become two more or two fewer where that
/// centers the blocks better on the holes. \param sides as choose_counts() left them. \return whether
/// anything changed, so that counts must be chosen again.
bool fit_holes_to_grids(const CadShape& shape, const FaceOutlines& sides, const EdgeCounts& chosen,
                        const IdVector<EdgeId, CountTable>& tables, CountTargets& targets);

}  // namespace quadrille
