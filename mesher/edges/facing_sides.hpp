#pragma once
/// Facing sides of faces, and narrow faces. Internal.

#include <vector>

#include "geometry/cad/cad_shape.hpp"

namespace quadrille {

/// Two sides of a face that face each other.
struct FacingSides {
  const Coedge *first, *second;
  double width;  ///< largest distance between them, approximately
};

/// Whether the first wire of the face contains cracks or poles.
bool has_unusual_edges(const CadShape& shape, const CadFace& face);

/// The sides that face each other: both pairs of a face with four edges (poles count as edges), the longer
/// two of a wedge with three edges, the two of a crescent. Empty for other faces.
std::vector<FacingSides> facing_sides(const CadShape& shape, const CadFace& face);

/// A face is narrow if its width is less than this share of a segment's length.
constexpr double narrow = 0.5;

/// A narrow face with one long side of one edge and another one of several edges.
struct SplitStrip {
  FaceId face;
  const Coedge* whole;
  std::vector<const Coedge*> parts;  ///< in the order of the wire
};

/// Approximate length of an edge's segments.
double segment_length(const CadShape& shape, const IdVector<EdgeId, double>& wanted, EdgeId edge);

/// The narrow faces whose only wire has two runs of long edges, one of them a single edge, between short
/// ones. \param wanted number of segments
std::vector<SplitStrip> find_split_strips(const CadShape& shape, const FaceFlags& used,
                                          const IdVector<EdgeId, double>& wanted);

}  // namespace quadrille
