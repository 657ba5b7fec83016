#pragma once
/// Holes in grids: which cells give way to a hole. Internal.

#include <optional>
#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/edges/count_table.hpp"
#include "mesher/edges/edge_counts.hpp"

namespace quadrille {

/// A hole in a grid, in cells: from the first column and row on.
struct HolePlace {
  Vector2 low{0, 0}, high{0, 0};
  /// It has a vertex straight beside, above or below its middle: the block is to have nodes there too.
  bool even = false;

  void include(const Vector2& cell) {
    low = low.cwiseMin(cell);
    high = high.cwiseMax(cell);
  }
};

/// Cells of a grid each way.
struct GridSize {
  int columns = 0, rows = 0;
};

/// The cells that a hole takes the place of. A hole with as many nodes as there are round the block needs no
/// irregular vertices but the block's corners.
struct HoleBlock {
  int column = 0, row = 0;    ///< the first
  int columns = 0, rows = 0;  ///< how many

  int around() const { return 2 * (columns + rows); }
};

/// The block of about a cell more than the hole each way, its middle near that of the hole. \param nodes
/// round the hole; 0 = as many as fit. Nothing where the nodes fit no block that is larger than the hole and
/// no more than a few cells wider.
std::optional<HoleBlock> block_of(const HolePlace& hole, int nodes, const GridSize& grid);

/// Whether blocks leave a row of cells between each other, and between them and the outline of the grid.
bool keep_apart(const std::vector<HoleBlock>& blocks, const GridSize& grid);

/// What the edges of holes want, so that they fit into the grids of faces with four corners: as many segments
/// as there are round the cells that they take the place of, where these are about as long as those of the
/// sides. The sides want two more or fewer than they have where the blocks' middles then are those of the
/// holes. \param sides as choose_counts() left them. \param tables (edges) \return whether anything was
/// changed, so that counts are to be chosen again.
bool fit_holes_to_grids(const CadShape& shape, const std::vector<FaceSides>& sides, const EdgeCounts& chosen,
                        const std::vector<CountTable>& tables, CountWishes& wishes);

}  // namespace quadrille
