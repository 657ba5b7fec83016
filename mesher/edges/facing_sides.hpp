#pragma once
/// Sides of faces that run along each other. Internal.

#include <vector>

#include "geometry/cad/cad_shape.hpp"

namespace quadrille {

/// Two sides of a face that run along each other.
struct FacingSides {
  const Coedge *first, *second;
  double width;  ///< between them, at most, about
};

/// Whether the face's only wire has cracks or poles in it.
bool has_unusual_edges(const CadShape& shape, const CadFace& face);

/// The sides that face each other: both pairs of a face of four edges, poles among them, the longer two of a
/// wedge of three, the two of a crescent.
std::vector<FacingSides> facing_sides(const CadShape& shape, const CadFace& face);

/// A face is narrow where it is less wide than this, of a segment.
constexpr double narrow = 0.5;

/// A narrow face, one long side of which is one edge and the other several.
struct SplitStrip {
  int face;
  const Coedge* whole;
  std::vector<const Coedge*> parts;  ///< in the order of the wire
};

/// Length of an edge's segments, about.
double segment_length(const CadShape& shape, const std::vector<double>& wanted, int edge);

/// The strips of faces whose wire is two runs of long edges between short ones.
/// \param wanted (edges) number of segments
std::vector<SplitStrip> find_split_strips(const CadShape& shape, const std::vector<char>& used,
                                          const std::vector<double>& wanted);

}  // namespace quadrille
