#pragma once
/// Pairs of faces or edges that get the same nodes (periodic meshes). Internal.

#include <vector>

#include "geometry/base/rigid_motion.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/sizing/sizing_options.hpp"

namespace quadrille {

/// An edge that a motion maps onto another one.
struct MatchedEdge {
  EdgeId from, to;
  bool reversed = false;  ///< the moved edge runs against the other one
  RigidMotion motion;
};

/// A face that a motion maps onto another one.
struct MatchedFace {
  FaceId from, to;
  bool flips = false;  ///< the moved face has the opposite normal in the model
  RigidMotion motion;
  std::vector<MatchedEdge> edges;  ///< all of the first face's edges, also those that stay in place
};

/// A pair that users requested, and how far its nodes may lie from the moved ones.
struct MatchLink {
  MatchedPair pair;
  double tolerance = 0;  ///< the model's own, model units
  MatchedFace found;     ///< for edges no faces, but the pieces of the edges
};

struct Matches {
  std::vector<MatchLink> links;    ///< as requested
  std::vector<MatchedEdge> edges;  ///< in the order in which nodes are copied: an edge is copied to once
  std::vector<MatchedFace> faces;  ///< likewise
  FaceFlags copied_faces;          ///< 1 = has the mesh of another face

  /// The vertices of the edges in some pair, or on the boundary of a face in some pair, ascending.
  std::vector<VertexId> vertices(const CadShape& shape) const;
};

/// Finds the motion of each pair: it maps the vertices and edges of the first onto those of the second, and
/// the surface too. If several do, a translation is preferred to a rotation; then one that leaves in place
/// what both faces share; then one that takes the outside of the first face to the inside of the second, so
/// that the part continues there; then the smallest angle. \param used 1 = the face is meshed. Throws Error
/// (usage, subject "match") if there is no such motion, or one of the pair is not meshed.
Matches find_matches(const CadShape& shape, const std::vector<MatchedPair>& pairs, const FaceFlags& used);

/// The motion that takes the points to others as closely as possible (least squares); of several, the one
/// that turns least. \param tolerance rotations and translations by less count as none
RigidMotion fit_motion(const std::vector<Vector3>& from, const std::vector<Vector3>& to, double tolerance);

}  // namespace quadrille
