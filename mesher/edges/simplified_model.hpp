#pragma once
/// The model that is meshed: small holes are filled, and coplanar faces joined. Internal.

#include <vector>

#include "geometry/cad/cad_model.hpp"
#include "geometry/cad/ids.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "geometry/sizing/sizing_options.hpp"
#include "mesher/edges/tiny_features.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// An edge between two faces that are meshed as one, with a line to be drawn.
inline ShellMesh::CrossedEdge crossed_edge(const CadEdge& edge) {
  constexpr int steps = 32;
  return {edge.number, {edge.faces.front().number(), edge.faces.back().number()}, points_along(edge, steps)};
}

/// Whether a setting names an edge or one of its vertices.
inline bool is_named(const CadEdge& edge, const SizingOptions& sizing) {
  return sizing.names_edge(edge.number) || sizing.names_vertex(edge.first_vertex.number()) ||
         sizing.names_vertex(edge.last_vertex.number());
}

/// A model without what need not be meshed. Faces, edges and vertices keep their numbers.
struct SimplifiedModel {
  CadModel model;                             ///< what is left out has no edges that any face uses
  FaceFlags gone;                             ///< 1 = a face of a filled hole, or one that another one took
  std::vector<ShellMesh::FilledHole> holes;   ///< ascending by the first face they lie in
  IdVector<FaceId, double> areas;             ///< area of the filled holes in each face, millimeters^2
  IdVector<FaceId, FaceId> taken_by;          ///< the face that each one is part of, if it was joined
  std::vector<ShellMesh::CrossedEdge> inner;  ///< the edges inside joined faces

  /// The model as it is.
  explicit SimplifiedModel(const CadModel& source)
      : model(source), gone(source.face_count()), areas(source.face_count()), taken_by(source.face_count()) {}
  /// The faces among these that are left.
  FaceFlags left(FaceFlags faces) const {
    for (const FaceId face : faces.ids())
      if (gone[face]) faces[face] = 0;
    return faces;
  }
};

/// Fills each hole that is a loop of its own inside one face, or one at each of its two ends, if no point of
/// the loop is farther than `diameter` from another and no point of the hole farther from its axis. A boss is
/// removed in the same way if it is no higher than that. What the sizes name stays: edges, vertices and faces
/// with sizes, segments, or kept. The model itself where there is nothing to fill. Complexity: linear in
/// edges, for each hole inside a hole again.
SimplifiedModel fill_holes(const CadModel& model, const FaceFlags& used, const SizingOptions& sizing,
                           double diameter);

/// Makes one face of six or more coplanar faces, facets of a program rather than a partition that somebody
/// drew, divided by edges that do harm: the edge is shorter than the least size, or one of the two faces is
/// narrower than the global size or has a corner below 40 degrees at an end of the edge, or the outline would
/// touch itself there. What was joined before counts as one face, so that a face stays once the parts beside
/// it are wide enough. The first face has the outline of all and keeps its number; the others are gone, and
/// the edges between them belong to no face. Faces and edges that the sizes name stay, and so do edges at
/// other than two faces, and faces whose common outline would touch itself. O(n log n) in edges.
void join_coplanar_faces(SimplifiedModel& model, const FaceFlags& used, const SizingOptions& sizing,
                         const SizeLimits& limits);

}  // namespace quadrille
