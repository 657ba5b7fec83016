#pragma once
/// Edges treated as points and slivers treated as edges. Internal.

#include <set>
#include <utility>
#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/edges/slivers.hpp"

namespace quadrille {

/// What is left out of the mesh because it is too small.
struct TinyFeatures {
  IdVector<VertexId, VertexId> vertices;       ///< the vertex whose node this one shares; usually itself
  EdgeFlags collapsed_edges;                   ///< 1 = the edge has no segments
  IdVector<EdgeId, EdgeId> edges;              ///< the edge whose nodes this one shares; usually itself
  EdgeFlags reversed_edges;                    ///< 1 = it runs in the opposite direction to that edge
  FaceFlags merged_faces;                      ///< 1 = the face vanishes
  std::set<std::pair<FaceId, EdgeId>> folded;  ///< the edge lies at a spike of the face, which ends before it

  /// Whether there are segments of an edge on the boundary of a face that uses it.
  bool has(FaceId face, EdgeId edge) const {
    return !collapsed_edges[edge] && !folded.contains({face, edge});
  }
  /// Whether the face vanishes, or a part of it.
  bool cuts(FaceId face) const {
    const auto found = folded.lower_bound({face, EdgeId()});
    return merged_faces[face] || (found != folded.end() && found->first == face);
  }

  /// Whether both ends of an edge share a node.
  bool closed(const CadEdge& edge) const { return end(edge.first_vertex) == end(edge.last_vertex); }
  /// Whether the wire runs along the edge whose nodes the coedge's edge has.
  bool forward(const Coedge& coedge) const { return coedge.forward != (reversed_edges[coedge.edge] != 0); }
  /// The vertex whose node a vertex shares; none for none.
  VertexId end(VertexId vertex) const { return vertex.exists() ? vertices[vertex] : VertexId(); }
};

/// The coedges of a wire of a face along which there are segments, in order; none if the wire has cracks or
/// poles, or no order.
std::vector<const Coedge*> coedges_left(const CadShape& shape, const TinyFeatures& tiny, FaceId face,
                                        const CadWire& wire);

/// Which faces become edges besides those narrower than the given length.
struct SliverChoice {
  std::vector<Sliver> slivers;
  FaceFlags kept;  ///< 1 = must not become an edge; empty = any may
  EdgeFlags own;   ///< 1 = keeps its nodes: others may share them; empty = any may share
};

/// How often the faces that are left use the nodes of each edge; 0 for edges that have those of another.
/// \param used 1 = the face is meshed
IdVector<EdgeId, int> uses_of_nodes(const CadShape& shape, const FaceFlags& used, const TinyFeatures& tiny);

/// Steps along an edge where its course matters, not each place on it.
constexpr int steps_of_edge = 16;

/// Points on an edge at even steps of its parameter, both ends included. \param forward whether they begin at
/// the edge's start
std::vector<Vector3> points_along(const CadEdge& edge, int steps = steps_of_edge, bool forward = true);

/// Points on the edges of a wire, all around it, with `steps_of_edge` on each.
std::vector<Vector3> points_around(const CadShape& shape, const CadWire& wire);

/// The length of a wire.
double length_of(const CadShape& shape, const CadWire& wire);

/// The distance of a point from a polyline; infinite from one without segments.
double distance_to_line(const Vector3& point, const std::vector<Vector3>& line);

/// The farthest that an edge's curve lies from another one's, at samples between its ends.
double distance_between(const CadEdge& edge, const CadEdge& other);

/// Whether an edge runs from vertex to vertex, and is no pole.
inline bool has_ends(const CadEdge& edge) {
  return !edge.degenerate && edge.first_vertex.exists() && edge.last_vertex.exists();
}

/// Whether all points of an edge lie within `reach` of each other, by samples.
bool is_small(const CadEdge& edge, double reach);

/// Marked edges and edges shorter than `length` become points. Then a face left with two edges that have the
/// same ends and are less than `length` apart becomes an edge, and a face left with no edges vanishes, as
/// does a sliver without pairs. An edge that then lies inside a single face, where a rib or a groove was, has
/// no segments. \param used 1 = the face is meshed. \param collapse 1 = marked \param length model units; 0 =
/// marked edges only. \param slivers further faces that become edges, if the short edges at their ends become
/// points.
TinyFeatures find_tiny_features(const CadShape& shape, const FaceFlags& used, const EdgeFlags& collapse,
                                double length, const SliverChoice& slivers = {});

}  // namespace quadrille
