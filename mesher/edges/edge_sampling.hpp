#pragma once
/// Nodes on CAD edges: each edge once, by the sizing field, with counts that make every face even. Internal.

#include <optional>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/sizing/edge_spacing.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "mesher/edges/face_sides.hpp"
#include "mesher/edges/tiny_features.hpp"

namespace quadrille {

/// The nodes of the model's vertices and edges, shared by all faces.
struct BoundaryNodes {
  struct Edge {
    std::vector<double> parameters;  ///< of each node, ascending, both ends included; empty = edge not used
    std::vector<int> nodes;          ///< indices into `points`; the ends are the vertices' nodes
    int stride = 1;                  ///< segments to one of the mesh that is recombined
    bool borrowed = false;           ///< the nodes are those of another edge (TinyFeatures)
    bool divided = false;            ///< users ask for its number, or for that of an edge it runs along with
    bool kept = false;               ///< they ask for its spacing: its nodes stay where they are
    int segments() const { return static_cast<int>(nodes.size()) - 1; }
  };
  std::vector<Vector3> points;
  std::vector<int> vertex_nodes;  ///< CAD vertex (from 1) minus 1 -> node, -1 = not used
  std::vector<Edge> edges;        ///< CAD edge (from 1) minus 1
  /// Segments of the final mesh to one segment of the mesh that is recombined: 2 with Strategy::subdivide,
  /// else 1, but for the faces that follow.
  int stride = 1;
  std::vector<char> subdivided;  ///< (faces) 1 = recombined at twice the size, whatever the stride
  std::vector<FaceSides> sides;  ///< (faces) outlines whose facing sides have as many segments
  std::vector<int> odd_faces;  ///< faces whose count could not be made even; empty in all but odd topologies
};

/// A part of a CAD edge on which at least so many segments (of the mesh that is recombined) are wanted.
struct EdgeStretch {
  int edge = 0;             ///< CAD edge, from 1
  double from = 0, to = 0;  ///< of its parameter, from < to
  int segments = 0;
};

/// How edges are sampled where faces failed with what the sizing field asks for.
struct SamplingPlan {
  explicit SamplingPlan(const CadShape& shape);  ///< as the field asks
  std::vector<int> factor;                       ///< (edges) on the number of segments
  std::vector<EdgeStretch> finer;
  std::vector<char> bare;  ///< (edges) 1 = by length alone, though the curve turns: it may have loops in it
  std::vector<char> unaligned;   ///< (faces) 1 = nodes need not face each other across gaps in it
  std::vector<char> subdivided;  ///< (faces) 1 = its edges get even numbers: BoundaryNodes::subdivided
  TinyFeatures tiny;
  std::vector<std::optional<PrescribedEdge>> prescribed;  ///< (edges) that users divide; may be empty
};

/// Samples the edges of the faces used by true arc length and the sizing field.
/// \param stride BoundaryNodes::stride, which see.
/// \param used (faces) 1 = the face is meshed; none that plan.tiny merges.
BoundaryNodes sample_edges(const CadShape& shape, const SizingField& field, int stride,
                           const std::vector<char>& used, const SamplingPlan& plan,
                           ExecutionContext& context);

}  // namespace quadrille
