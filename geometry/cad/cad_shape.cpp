/// Topology tables of a shape, numbered as FreeCAD does (the order of TopExp::MapShapes).

#include "geometry/cad/cad_shape.hpp"

#include <BRepBuilderAPI_Copy.hxx>
#include <BRepTools.hxx>
#include <BRepTools_WireExplorer.hxx>
#include <GCPnts_AbscissaPoint.hxx>
#include <Precision.hxx>
#include <ShapeAnalysis_Surface.hxx>
#include <Standard_Failure.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>

#include <fmt/format.h>

#include "geometry/cad/bounding_box.hpp"
#include "geometry/cad/curve_ends.hpp"
#include "geometry/cad/seams.hpp"
#include "geometry/cad/shape_completion.hpp"
#include "geometry/cad/shape_parts.hpp"

namespace quadrille {

CadShape::CadShape(const TopoDS_Shape& source, std::string shape_name)
    : name(std::move(shape_name)), shape(with_all_curves(source, problems)) {
  read_topology();
  trust_curve_ends(*this);
  const Eigen::AlignedBox3d box = bounding_box(*this);
  box_min = box.min();
  box_max = box.max();
}

void CadShape::read_topology() {
  TopTools_IndexedMapOfShape face_map = map_of(shape, TopAbs_FACE);
  const bool seams_lack = std::any_of(face_map.cbegin(), face_map.cend(), [](const TopoDS_Shape& face) {
    return lacks_seam(without_idle_wires(TopoDS::Face(face)));
  });
  if (seams_lack) {
    shape = BRepBuilderAPI_Copy(shape, Standard_True).Shape();
    face_map = map_of(shape, TopAbs_FACE);
  }
  solids = map_of(shape, TopAbs_SOLID).Extent();
  shells = map_of(shape, TopAbs_SHELL).Extent();
  std::vector<TopoDS_Face> sources;
  for (int i = 1; i <= face_map.Extent(); ++i) {
    const TopoDS_Face face = without_idle_wires(TopoDS::Face(face_map(i)));
    if (!face.IsSame(face_map(i)))
      problems.push_back(
          fmt::format("a wire of Face{} runs back along itself: it encloses no area and is left out", i));
    sources.push_back(with_natural_bounds(face));
    if (!sources.back().IsSame(face))
      problems.push_back(fmt::format("Face{} has no wire: the natural bounds of its surface are used", i));
  }
  TopTools_IndexedMapOfShape edge_map = map_of(shape, TopAbs_EDGE);
  TopTools_IndexedMapOfShape vertex_map = map_of(shape, TopAbs_VERTEX);
  const int own_edges = edge_map.Extent(), own_vertices = vertex_map.Extent();
  std::vector<EdgePiece> pieces;
  if (seams_lack) pieces = add_seams(sources, problems);
  // New edges and vertices come after the model's own ones, whose numbers stay the same.
  for (const TopoDS_Face& face : sources) {
    TopExp::MapShapes(face, TopAbs_EDGE, edge_map);
    TopExp::MapShapes(face, TopAbs_VERTEX, vertex_map);
  }
  for (int i = 1; i <= vertex_map.Extent(); ++i) {
    const TopoDS_Vertex& vertex = TopoDS::Vertex(vertex_map(i));
    vertices.push_back(to_vector(BRep_Tool::Pnt(vertex)));
    vertex_tolerances.push_back(BRep_Tool::Tolerance(vertex));
  }
  read_edges(edge_map, vertex_map, vertex_ids(vertex_map, own_vertices, sources));
  for (const EdgePiece& piece : pieces) {
    const int index = edge_map.FindIndex(piece.piece);
    if (index > own_edges) edges[EdgeId::from_number(index)].number = edge_map.FindIndex(piece.whole);
  }
  faces.resize(face_map.Extent());
  for (const FaceId face : faces.ids()) read_face(face, sources[face.index()], edge_map, vertex_map);
  measure_edges();
}

IdVector<VertexId, VertexId> CadShape::vertex_ids(const TopTools_IndexedMapOfShape& vertex_map,
                                                  int own_vertices,
                                                  const std::vector<TopoDS_Face>& sources) const {
  IdVector<VertexId, VertexId> ids(vertices.size());
  for (const VertexId vertex : vertices.ids()) ids[vertex] = vertex;
  if (own_vertices == vertex_map.Extent()) return ids;
  const TopTools_IndexedMapOfShape used = map_of(sources, TopAbs_VERTEX);
  for (auto place = ids.begin() + own_vertices; place != ids.end(); ++place) {
    VertexId& added = *place;
    for (const VertexId own : IdRange<VertexId>(own_vertices)) {
      if (used.Contains(vertex_map(own.number()))) continue;
      const double reach = std::max(vertex_tolerances[own], vertex_tolerances[added]);
      if ((vertices[own] - vertices[added]).norm() > reach) continue;
      added = own;
      break;
    }
  }
  return ids;
}

void CadShape::read_edges(const TopTools_IndexedMapOfShape& edge_map,
                          const TopTools_IndexedMapOfShape& vertex_map,
                          const IdVector<VertexId, VertexId>& ids) {
  const auto id_of = [&](const TopoDS_Vertex& vertex) {
    return vertex.IsNull() ? VertexId() : ids[VertexId::from_number(vertex_map.FindIndex(vertex))];
  };
  edges.resize(edge_map.Extent());
  for (const EdgeId id : edges.ids()) {
    CadEdge& edge = edges[id];
    edge.number = id.number();
    edge.edge = TopoDS::Edge(edge_map(edge.number).Oriented(TopAbs_FORWARD));
    edge.degenerate = BRep_Tool::Degenerated(edge.edge);
    edge.tolerance = BRep_Tool::Tolerance(edge.edge);
    TopoDS_Vertex first, last;
    TopExp::Vertices(edge.edge, first, last);
    edge.first_vertex = id_of(first);
    edge.last_vertex = id_of(last);
    BRep_Tool::Range(edge.edge, edge.first, edge.last);
  }
}

void CadShape::measure_edges() {
  for (CadEdge& edge : edges) {
    std::sort(edge.faces.begin(), edge.faces.end());
    if (edge.degenerate || edge.faces.empty()) continue;
    try {
      const BRepAdaptor_Curve curve(edge.edge);
      edge.length = GCPnts_AbscissaPoint::Length(curve, edge.first, edge.last);
    } catch (const Standard_Failure&) {
      problems.push_back(fmt::format("Edge{} has no usable curve", edge.number));
    }
  }
}

namespace {

/// The edges of a wire, one entry per use, in the order of the wire if one can be found.
std::vector<TopoDS_Edge> ordered_edges(const TopoDS_Wire& wire, const TopoDS_Face& face, bool& ordered) {
  std::vector<TopoDS_Edge> plain;
  for (TopoDS_Iterator it(wire); it.More(); it.Next()) {
    if (it.Value().ShapeType() == TopAbs_EDGE) plain.push_back(TopoDS::Edge(it.Value()));
  }
  std::vector<TopoDS_Edge> result;
  for (BRepTools_WireExplorer it(wire, face); it.More() && result.size() <= plain.size(); it.Next()) {
    result.push_back(it.Current());
  }
  ordered = result.size() == plain.size();
  return ordered ? result : plain;
}

/// The point of a vertex in the parameter plane of a face.
Vector2 parameters_on(const TopoDS_Face& face, const TopoDS_Vertex& vertex) {
  ShapeAnalysis_Surface surface(BRep_Tool::Surface(face));
  const gp_Pnt2d uv = surface.ValueOfUV(BRep_Tool::Pnt(vertex), Precision::Confusion());
  return {uv.X(), uv.Y()};
}

}  // namespace

void CadShape::read_face(FaceId id, const TopoDS_Face& source, const TopTools_IndexedMapOfShape& edge_map,
                         const TopTools_IndexedMapOfShape& vertex_map) {
  CadFace& face = faces[id];
  face.reversed = source.Orientation() == TopAbs_REVERSED;
  face.face = TopoDS::Face(source.Oriented(TopAbs_FORWARD));
  face.tolerance = BRep_Tool::Tolerance(face.face);
  BRepTools::UVBounds(face.face, face.u_min, face.u_max, face.v_min, face.v_max);
  for (TopoDS_Iterator it(face.face); it.More(); it.Next()) {
    if (it.Value().ShapeType() == TopAbs_VERTEX) {
      const TopoDS_Vertex& vertex = TopoDS::Vertex(it.Value());
      face.inner_vertices.push_back(
          {VertexId::from_number(vertex_map.FindIndex(vertex)), parameters_on(face.face, vertex)});
    }
    if (it.Value().ShapeType() != TopAbs_WIRE) continue;
    CadWire wire;
    for (const TopoDS_Edge& edge : ordered_edges(TopoDS::Wire(it.Value()), face.face, wire.ordered)) {
      Coedge coedge;
      coedge.edge = EdgeId::from_number(edge_map.FindIndex(edge));
      coedge.source = edge;
      coedge.internal = edge.Orientation() == TopAbs_INTERNAL || edge.Orientation() == TopAbs_EXTERNAL;
      coedge.forward = edge.Orientation() != TopAbs_REVERSED;
      double first = 0, last = 0;
      coedge.parametric_curve = BRep_Tool::CurveOnSurface(edge, face.face, first, last);
      if (coedge.parametric_curve.IsNull()) {
        problems.push_back(
            fmt::format("Edge{} has no parametric curve on Face{}", edges[coedge.edge].number, id.number()));
        continue;
      }
      CadEdge& cad_edge = edges[coedge.edge];
      cad_edge.faces.push_back(id);
      if (coedge.internal) cad_edge.faces.push_back(id);  // the face lies on both sides
      wire.coedges.push_back(coedge);
    }
    if (!wire.coedges.empty()) face.wires.push_back(std::move(wire));
  }
}

TrimmedDomain coarse_domain(const CadShape& shape, const CadFace& face) {
  constexpr int intervals = 16;
  std::vector<TrimmedDomain::Segment> segments;
  for (const CadWire& wire : face.wires) {
    for (const Coedge& coedge : wire.coedges) {
      if (coedge.internal) continue;
      const CadEdge& edge = shape.edges[coedge.edge];
      Vector2 from = parametric_point(coedge, edge.first);
      for (int i = 1; i <= intervals; ++i) {
        const Vector2 to = parametric_point(coedge, edge.first + (edge.last - edge.first) * i / intervals);
        segments.push_back({from, to});
        from = to;
      }
    }
  }
  return TrimmedDomain(std::move(segments));
}

}  // namespace quadrille
