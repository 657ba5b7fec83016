#pragma once
/// Nodes on CAD edges: each edge is sampled once, with counts that make every face even. Internal.

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/sizing/edge_spacing.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "mesher/edges/count_table.hpp"
#include "mesher/edges/face_plan.hpp"
#include "mesher/edges/tiny_features.hpp"

namespace quadrille {

/// The nodes of the model's vertices and edges, shared by all faces.
struct BoundaryNodes {
  struct Edge {
    std::vector<double> parameters;  ///< one per node, ascending, both ends included; empty = edge not used
    std::vector<int> nodes;          ///< indices into `points`; the ends are the vertices' nodes
    bool divided = false;            ///< users prescribe the number of segments on its chord
    bool kept = false;               ///< users prescribe the spacing of its chord: the nodes stay in place
    bool borrows = false;            ///< its nodes are those of another edge (TinyFeatures)
    int segments() const { return static_cast<int>(nodes.size()) - 1; }
  };
  std::vector<Vector3> points;
  IdVector<VertexId, int> vertex_nodes;  ///< indices into `points`; -1 = not used
  IdVector<EdgeId, Edge> edges;
  std::set<std::pair<FaceId, EdgeId>> left_out;  ///< the face ends before the edge (TinyFeatures::folded)
  /// Segments of the final mesh for each segment of the mesh that is recombined: 2 with Strategy::subdivide,
  /// else 1. Faces may differ (FacePlan).
  int stride = 1;
  FacePlans plans;

  /// How far nodes lie off their edges, because quads would be inverted with them there; by node.
  std::map<int, double> off;

  /// The middles, on the surface, of sides between two nodes that quads of several faces share where they
  /// cross a smooth edge; by side_key().
  std::unordered_map<std::uint64_t, Vector3> middles;

  /// (points) the number of edges that a node lies inside; 2 = more than one, or a vertex. Linear in the
  /// nodes.
  std::vector<char> edges_at_nodes() const {
    std::vector<char> result(points.size(), 0);
    for (const Edge& edge : edges)
      for (std::size_t k = 1; k + 1 < edge.nodes.size(); ++k)
        result[edge.nodes[k]] += result[edge.nodes[k]] < 2;
    for (const int node : vertex_nodes)
      if (node >= 0) result[node] = 2;
    return result;
  }
};

/// A part of a CAD edge that needs a least number of segments in the mesh that is recombined.
struct EdgeStretch {
  EdgeId edge;
  double from = 0, to = 0;  ///< range of the edge's parameter, from < to
  int segments = 0;         ///< least number
};

/// How the sampling of edges departs from the sizing field: where faces failed, for tiny features, and where
/// users divide edges.
struct SamplingPlan {
  /// By the sizing field alone. \param below see below_size_min; empty = none
  explicit SamplingPlan(const CadShape& shape, EdgeFlags below = {});
  IdVector<EdgeId, int> factor;  ///< multiplies the number of segments
  std::vector<EdgeStretch> finer;
  double shortest_segment = 0;  ///< that `finer` may ask for, model units; 0 = any
  EdgeFlags below_size_min;     ///< 1 = sizes given by name below SizeLimits::size_min may reach the edge
  EdgeFlags ignore_curvature;   ///< 1 = ignore how the curve turns, it may have loops
  FaceFlags subdivided;  ///< 1 = recombined at twice the size in any case: the face's edges get even numbers
  TinyFeatures tiny;
  PrescribedEdges prescribed;  ///< user divisions; may be empty

  bool prescribes(EdgeId edge) const { return !prescribed.empty() && prescribed[edge].has_value(); }
  /// Whether the nodes of an edge lie near equal parts of its chord.
  bool along_chord(EdgeId id, const CadEdge& edge) const {
    return ignore_curvature[id] && !tiny.closed(edge);
  }
};

/// The tables of edges by the sizing field alone, as far as they are known.
using EdgeTables = IdVector<EdgeId, CountTable>;

/// Samples the edges of the used faces, by true arc length and the sizing field.
/// \param stride see BoundaryNodes::stride
/// \param used 1 = the face is meshed; 0 for all faces that plan.tiny merges.
/// \param known of the same shape and field; filled in, so that sampling again takes less
BoundaryNodes sample_edges(const CadShape& shape, const SizingField& field, int stride, const FaceFlags& used,
                           const SamplingPlan& plan, ExecutionContext& context, EdgeTables* known = nullptr);

}  // namespace quadrille
