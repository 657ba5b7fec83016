#pragma once
/// The model that is meshed: small holes are filled, and coplanar faces joined. Internal.

#include <vector>

#include "geometry/cad/cad_model.hpp"
#include "geometry/cad/ids.hpp"
#include "geometry/sizing/sizing_options.hpp"
#include "mesher/edges/tiny_features.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// An edge between two faces that are meshed as one. \param pieces see points_along()
inline ShellMesh::CrossedEdge crossed_edge(const CadEdge& edge, int pieces) {
  return {edge.number, {edge.faces.front().number(), edge.faces.back().number()}, points_along(edge, pieces)};
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

}  // namespace quadrille
