#pragma once
/// Divisions of edges that grids carry on as rows, layers among them. Internal.

#include <optional>
#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "geometry/sizing/edge_spacing.hpp"
#include "geometry/sizing/sizing_options.hpp"
#include "mesher/edges/edge_sampling.hpp"
#include "mesher/edges/face_sides.hpp"

namespace quadrille {

struct GridRows {
  /// (edges) what users prescribe, and the heights of layers on the edges that run away from theirs; empty =
  /// nothing at all.
  std::vector<std::optional<PrescribedEdge>> prescribed;
  /// (edges) 1 = prescribed, and all faces that it runs through, with what runs along it in them, are
  /// four-sided or rings: rows of flat quads keep it, and the sizes around need not follow.
  std::vector<char> divided;
  std::vector<char> layered;  ///< (edges) 1 = its layers are rows on all its faces
};

/// What of the options' divisions and layers on edges grids can carry. Layers become rows where all faces of
/// the edge have four sides of one edge each, the layers end before nine tenths of the sides beside it, which
/// have no other division, and what runs along those has no other number, four times as many or a quarter.
/// \param sides (faces) outlines \param prescribed (edges) what users prescribe \param size elsewhere.
GridRows find_grid_rows(const CadShape& shape, const std::vector<FaceSides>& sides,
                        std::vector<std::optional<PrescribedEdge>> prescribed, const SizingOptions& options,
                        double size);

/// Whether users ask for the spacing of an edge of the face (BoundaryNodes::Edge::kept).
bool has_kept_edge(const CadFace& face, const BoundaryNodes& nodes);

/// Whether users ask for the number of segments on an edge of the face (BoundaryNodes::Edge::divided).
bool has_divided_edge(const CadFace& face, const BoundaryNodes& nodes);

}  // namespace quadrille
