#pragma once
/// Nodes at places that users choose. Internal.

#include <memory>
#include <string>
#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "geometry/sizing/sizing_options.hpp"

namespace quadrille {

/// A place that gets a node, as a vertex of the shape.
struct PlacedNode {
  std::string name;  ///< as given, else "Node1", "Node2", ...
  VertexId vertex;   ///< of the model, or one that was added at the place's projection
};

/// A shape with vertices at all places.
struct PlacedNodes {
  std::shared_ptr<const CadShape> shape;  ///< null if no vertex had to be added; new ones come last
  std::vector<PlacedNode> nodes;          ///< (places)
};

/// The distance up to which a place belongs to the model, as a share of the global size. A larger tolerance
/// of the model's own counts too.
inline constexpr double place_tolerance_share = 1e-3;

/// Finds the vertex at each place. A place inside an edge divides the edge; one inside a face becomes a
/// vertex inside the face. \param used 1 = the face is meshed. \param size global size, model units. Throws
/// Error (usage, subject "nodes_at") naming the place, for one that is too far from the faces that are
/// meshed, and for one inside an edge whose division the options prescribe. Time: the bounding boxes of the
/// faces once, then some projections for each place.
PlacedNodes place_nodes(const CadShape& shape, const FaceFlags& used, const SizingOptions& sizing,
                        double size);

}  // namespace quadrille
