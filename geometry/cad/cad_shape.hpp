#pragma once
/// The OpenCASCADE side of a CAD model: topology tables and handles. Internal: users see CadModel.

#include <BRepAdaptor_Curve.hxx>
#include <Geom2d_Curve.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <algorithm>
#include <string>
#include <vector>

#include "geometry/base/trimmed_domain.hpp"
#include "geometry/base/vector.hpp"
#include "geometry/cad/face_names.hpp"
#include "geometry/cad/ids.hpp"

namespace quadrille {

/// \param p a point, vector or direction of OpenCASCADE.
template <class Triple>
Vector3 to_vector(const Triple& p) {
  return {p.X(), p.Y(), p.Z()};
}

/// A CAD edge: a curve between two vertices.
struct CadEdge {
  TopoDS_Edge edge;       ///< oriented forward: its parameter runs from `first` to `last`
  int number = 0;         ///< number in the CAD file; a piece of a split edge has that of the whole edge
  VertexId first_vertex;  ///< vertex at the parameter `first`; none on an edge without vertices
  VertexId last_vertex;
  double first = 0, last = 0;
  double length = 0;
  double tolerance = 0;
  bool degenerate = false;  ///< a single point in space (pole, apex)
  bool closed() const { return first_vertex == last_vertex; }
  std::vector<FaceId> faces;  ///< faces that use the edge, ascending; a seam's face twice

  /// Whether one of these faces uses the edge.
  bool is_used(const FaceFlags& used) const {
    return std::any_of(faces.begin(), faces.end(), [&](FaceId face) { return used[face] != 0; });
  }
  /// Whether one of these faces, other than the given one, uses the edge.
  bool is_used_beside(FaceId face, const FaceFlags& used) const {
    return std::any_of(faces.begin(), faces.end(),
                       [&](FaceId other) { return other != face && used[other] != 0; });
  }
};

/// The use of an edge by a face.
struct Coedge {
  EdgeId edge;
  bool forward = true;                    ///< the wire runs in the direction of the edge's parameter
  bool internal = false;                  ///< the edge is a crack: the face lies on both sides of it
  Handle(Geom2d_Curve) parametric_curve;  ///< same parameter as the edge's curve
  TopoDS_Edge source;                     ///< the edge with its orientation in the wire
};

/// The point of a coedge in the parameter plane at the edge's parameter t.
inline Vector2 parametric_point(const Coedge& coedge, double t) {
  const gp_Pnt2d p = coedge.parametric_curve->Value(t);
  return {p.X(), p.Y()};
}

struct CadWire {
  std::vector<Coedge> coedges;  ///< in order: each ends where the next one starts
  bool ordered = true;          ///< false where no such order was found
};

/// A vertex inside a face, on none of its edges.
struct InnerVertex {
  VertexId vertex;
  Vector2 uv{0, 0};
};

struct CadFace {
  TopoDS_Face face;       ///< oriented forward: its normal is the surface's
  bool reversed = false;  ///< the model uses the face with the opposite normal
  std::vector<CadWire> wires;
  std::vector<InnerVertex> inner_vertices;
  double u_min = 0, u_max = 0, v_min = 0, v_max = 0;  ///< bounds of the trimmed face in the parameter plane
  double tolerance = 0;

  /// The edges of all wires in their order; a seam's edge twice.
  std::vector<EdgeId> edges() const {
    std::vector<EdgeId> result;
    for (const CadWire& wire : wires)
      for (const Coedge& coedge : wire.coedges) result.push_back(coedge.edge);
    return result;
  }
};

/// Immutable once built.
class CadShape {
 public:
  CadShape(const TopoDS_Shape& shape, std::string name);

  std::string name;
  std::vector<std::string> problems;  ///< found while reading, one sentence each
  TopoDS_Shape shape;
  IdVector<FaceId, CadFace> faces;
  IdVector<EdgeId, CadEdge> edges;
  IdVector<VertexId, Vector3> vertices;
  IdVector<VertexId, double> vertex_tolerances;
  int solids = 0, shells = 0;
  FaceNames face_names;  ///< see CadModel::face_names()
  /// See CadModel::pieces(), edge_pieces(), vertex_pieces().
  std::vector<std::vector<int>> face_pieces, edge_pieces, vertex_pieces;
  Vector3 box_min, box_max;

  double diagonal() const { return (box_max - box_min).norm(); }
  /// The vertex at which the wire enters a coedge; none on an edge without vertices.
  VertexId start_of(const Coedge& coedge) const {
    return coedge.forward ? edges[coedge.edge].first_vertex : edges[coedge.edge].last_vertex;
  }
  /// The vertex at which the wire leaves a coedge; none on an edge without vertices.
  VertexId end_of(const Coedge& coedge) const {
    return coedge.forward ? edges[coedge.edge].last_vertex : edges[coedge.edge].first_vertex;
  }

 private:
  void read_topology();
  /// (vertices in the map) their ids. A new vertex that replaces one of the model's own vertices gets the id
  /// of that vertex.
  IdVector<VertexId, VertexId> vertex_ids(const TopTools_IndexedMapOfShape& vertex_map, int own_vertices,
                                          const std::vector<TopoDS_Face>& sources) const;
  void read_edges(const TopTools_IndexedMapOfShape& edge_map, const TopTools_IndexedMapOfShape& vertex_map,
                  const IdVector<VertexId, VertexId>& ids);
  void measure_edges();
  void read_face(FaceId id, const TopoDS_Face& face, const TopTools_IndexedMapOfShape& edge_map,
                 const TopTools_IndexedMapOfShape& vertex_map);
};

/// The region of a face in its parameter plane, with each edge approximated by 16 chords.
TrimmedDomain coarse_domain(const CadShape& shape, const CadFace& face);

}  // namespace quadrille
