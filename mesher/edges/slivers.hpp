#pragma once
/// Faces so narrow that they become edges, whatever the number of their own edges. Internal.

#include <array>
#include <limits>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "geometry/cad/cad_shape.hpp"

namespace quadrille {

/// Slivers and spikes are at least this many times as long as they are wide: between straight edges, an angle
/// of 23 degrees.
constexpr double least_slenderness = 2.5;

/// A place on a curve, and its distance from a point.
struct CurvePlace {
  double distance = std::numeric_limits<double>::infinity();
  double parameter = 0;
  Vector3 point{0, 0, 0};
};

/// A curve as a polyline.
struct CurveSamples {
  std::vector<double> parameters;
  std::vector<Vector3> points;

  CurvePlace nearest(const Vector3& point) const;
};

/// A place on an edge where it is to be divided.
struct EdgeCut {
  EdgeId edge;
  double parameter = 0;
  Vector3 point{0, 0, 0};
};

/// A face that is narrower than a given width everywhere, as two chains of edges that lie along each other: a
/// loop between two ends, or the two loops of a ring. A tube along a seam has no such chains; it vanishes. Or
/// a spike: a part of a face between two edges that meet.
struct Sliver {
  /// Edges that lie along each other from end to end.
  struct Pair {
    EdgeId edge;    ///< keeps its nodes
    EdgeId other;   ///< shares them
    bool reversed;  ///< the two run in opposite directions
  };
  FaceId face;
  std::vector<Pair> pairs;
  std::vector<std::array<VertexId, 2>> ties;  ///< vertices inside the chains that face each other
  /// Vertices at the two sides of short edges, which must share a node for the pairs to fit.
  std::vector<std::array<VertexId, 2>> joints;
  std::vector<EdgeId> rims;  ///< edges at the ends of a tube, which must become points
  bool is_spike = false;     ///< the rest of the face stays, and no longer uses the edges of the pair
};

/// Ends of edges; true = the last vertex.
using EdgeEnds = std::set<std::pair<EdgeId, bool>>;

/// The spikes of a face: parts between two edges that meet, of one wire or of two that touch, as long as
/// these stay closer than `width`, over more than 2.5 times their distance. Cusps, and ends of fillets that
/// run out. Without them an eighth fewer quads are outside the limits on real parts (decision 67).
/// Edges shorter than the width are passed over, and corners between edges of this face alone.
/// \param used 1 = the face is meshed \param width model units; 0 = none is found \param taken ends of edges
/// at spikes of other faces, which none of this one has; those found are added \param cuts gets the places
/// that have to be divided first, so that a spike lies between two whole edges
std::vector<Sliver> find_spikes(const CadShape& shape, const FaceFlags& used, FaceId face, double width,
                                EdgeEnds& taken, std::vector<EdgeCut>& cuts);

/// The slivers among the used faces whose vertices all face each other, see divided_at_slivers(), and the
/// spikes of the other faces, see find_spikes().
/// \param width model units. Edges shorter than this count as short.
std::vector<Sliver> find_slivers(const CadShape& shape, const FaceFlags& used, double width);

/// A copy of the shape whose slivers have vertices that face each other: where a vertex of one chain faces
/// the inside of an edge, that edge is in two pieces, and so are edges where spikes begin. Pieces keep the
/// number of the edge; the new vertices come after the model's own. Null if there is nothing to divide.
std::shared_ptr<const CadShape> divided_at_slivers(const CadShape& shape, const FaceFlags& used,
                                                   double width);

}  // namespace quadrille
