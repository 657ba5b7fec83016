/// Finds the chains from vertex to vertex, and replaces each by a polyline, in space and in its faces.

#include "mesher/edges/facet_edges.hpp"

#include <BRepAdaptor_Surface.hxx>
#include <BRep_Builder.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom_BSplineCurve.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <TopExp.hxx>
#include <TopoDS.hxx>

#include <algorithm>

#include "geometry/cad/cad_shape.hpp"
#include "geometry/surfaces/edge_curve.hpp"
#include "mesher/edges/tiny_features.hpp"

namespace quadrille {

namespace {

/// The polyline through poles at these parameters.
template <class Curve, class Poles>
Handle(Curve) polyline(const Poles& poles, const std::vector<double>& parameters) {
  const int count = poles.Length();
  const TColStd_Array1OfReal knots(parameters.front(), 1, count);
  TColStd_Array1OfInteger multiplicities(1, count);
  multiplicities.Init(1);
  multiplicities.ChangeFirst() = multiplicities.ChangeLast() = 2;
  return new Curve(poles, knots, multiplicities, 1);
}

class FacetEdges {
 public:
  FacetEdges(CadShape& shape, const FaceFlags& joined, const SizingOptions& sizing, SimplifiedModel& model)
      : shape_(shape),
        joined_(joined),
        sizing_(sizing),
        model_(model),
        ends_(shape.vertices.size()),
        inside_(shape.vertices.size()) {
    for (const EdgeId id : shape_.edges.ids()) {
      const CadEdge& edge = shape_.edges[id];
      if (edge.faces.empty()) continue;
      for (const VertexId end : {edge.first_vertex, edge.last_vertex})
        if (end.exists()) ends_[end].push_back(id);
    }
    for (const VertexId vertex : ends_.ids()) inside_[vertex] = is_inside_chain(vertex) ? 1 : 0;
  }

  void run() {
    for (const VertexId vertex : ends_.ids()) {
      if (inside_[vertex]) continue;
      for (const EdgeId first : ends_[vertex]) {
        const std::vector<EdgeId> chain = chain_from(vertex, first);
        // Each is found from both of its ends.
        if (chain.size() > 1 && chain.front() < chain.back()) replace(vertex, chain);
      }
    }
  }

 private:
  VertexId other_end(EdgeId edge, VertexId end) const {
    const CadEdge& e = shape_.edges[edge];
    return e.first_vertex == end ? e.last_vertex : e.first_vertex;
  }

  bool may_be_joined(EdgeId id) const {
    const CadEdge& edge = shape_.edges[id];
    const auto is_plane = [&](FaceId face) {
      return BRepAdaptor_Surface(shape_.faces[face].face, false).GetType() == GeomAbs_Plane;
    };
    return edge.faces.size() == 2 && edge.faces[0] != edge.faces[1] && !edge.degenerate &&
           !sizing_.names_edge(edge.number) && (joined_[edge.faces[0]] || joined_[edge.faces[1]]) &&
           EdgeCurve(edge).straight() && std::all_of(edge.faces.begin(), edge.faces.end(), is_plane);
  }

  bool is_inside_chain(VertexId vertex) const {
    const auto& ends = ends_[vertex];
    if (ends.size() != 2 || ends[0] == ends[1] || sizing_.names_vertex(vertex.number())) return false;
    if (shape_.edges[ends[0]].faces != shape_.edges[ends[1]].faces) return false;
    if (!may_be_joined(ends[0]) || !may_be_joined(ends[1])) return false;
    const Vector3 in = shape_.vertices[vertex] - shape_.vertices[other_end(ends[0], vertex)];
    const Vector3 out = shape_.vertices[other_end(ends[1], vertex)] - shape_.vertices[vertex];
    return in.dot(out) > facet_cosine * in.norm() * out.norm();
  }

  std::vector<EdgeId> chain_from(VertexId vertex, EdgeId first) const {
    std::vector<EdgeId> chain{first};
    for (VertexId at = other_end(first, vertex); at.exists() && at != vertex && inside_[at];) {
      chain.push_back(ends_[at][0] == chain.back() ? ends_[at][1] : ends_[at][0]);
      at = other_end(chain.back(), at);
    }
    return chain;
  }

  void replace(VertexId start, const std::vector<EdgeId>& chain) {
    std::vector<VertexId> vertices{start};
    std::vector<double> parameters{0};
    for (const EdgeId edge : chain) {
      vertices.push_back(other_end(edge, vertices.back()));
      parameters.push_back(parameters.back() + shape_.edges[edge].length);
    }
    CadEdge whole = joined_edge(chain, vertices, parameters);
    for (const FaceId face : whole.faces) replace_in(shape_.faces[face], chain, whole, parameters);
    for (const EdgeId id : chain) {
      if (id == chain.front()) continue;
      CadEdge& edge = shape_.edges[id];
      model_.inner.push_back(crossed_edge(edge, 1));
      edge.faces.clear();
    }
    shape_.edges[chain.front()] = std::move(whole);
  }

  CadEdge joined_edge(const std::vector<EdgeId>& chain, const std::vector<VertexId>& vertices,
                      const std::vector<double>& parameters) const {
    CadEdge result = shape_.edges[chain.front()];
    const auto vertex_of = [&](EdgeId id, VertexId vertex) {
      const CadEdge& edge = shape_.edges[id];
      return edge.first_vertex == vertex ? TopExp::FirstVertex(edge.edge) : TopExp::LastVertex(edge.edge);
    };
    TColgp_Array1OfPnt poles(1, static_cast<int>(vertices.size()));
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const Vector3& point = shape_.vertices[vertices[i]];
      poles.SetValue(static_cast<int>(i) + 1, {point.x(), point.y(), point.z()});
    }
    for (const EdgeId edge : chain)
      result.tolerance = std::max(result.tolerance, shape_.edges[edge].tolerance);
    const BRep_Builder builder;
    builder.MakeEdge(result.edge, polyline<Geom_BSplineCurve>(poles, parameters), result.tolerance);
    builder.Add(result.edge, vertex_of(chain.front(), vertices.front()).Oriented(TopAbs_FORWARD));
    builder.Add(result.edge, vertex_of(chain.back(), vertices.back()).Oriented(TopAbs_REVERSED));
    builder.Range(result.edge, parameters.front(), parameters.back());
    result.first_vertex = vertices.front();
    result.last_vertex = vertices.back();
    result.first = parameters.front();
    result.last = result.length = parameters.back();
    return result;
  }

  void replace_in(CadFace& face, const std::vector<EdgeId>& chain, const CadEdge& whole,
                  const std::vector<double>& parameters) const {
    const auto is_in_chain = [&](const Coedge& coedge) {
      return std::find(chain.begin(), chain.end(), coedge.edge) != chain.end();
    };
    for (CadWire& wire : face.wires) {
      auto& coedges = wire.coedges;
      const auto outside = std::find_if_not(coedges.begin(), coedges.end(), is_in_chain);
      std::rotate(coedges.begin(), outside, coedges.end());  // so that the chain does not pass the end
      const auto first = std::find_if(coedges.begin(), coedges.end(), is_in_chain);
      if (first == coedges.end()) continue;
      const auto last = std::find_if_not(first, coedges.end(), is_in_chain);
      const bool forward = first->edge == chain.front();
      TColgp_Array1OfPnt2d poles(1, static_cast<int>(parameters.size()));
      const auto end_of = [&](const Coedge& coedge, bool at_start) {
        const CadEdge& edge = shape_.edges[coedge.edge];
        const Vector2 uv = parametric_point(coedge, at_start == coedge.forward ? edge.first : edge.last);
        return gp_Pnt2d(uv.x(), uv.y());
      };
      const int count = poles.Length();
      int at = forward ? 1 : count;
      poles.SetValue(at, end_of(*first, true));
      for (auto coedge = first; coedge != last; ++coedge)
        poles.SetValue(at += forward ? 1 : -1, end_of(*coedge, false));
      Coedge joined = *first;
      joined.edge = chain.front();
      joined.forward = forward;
      joined.parametric_curve = polyline<Geom2d_BSplineCurve>(poles, parameters);
      const BRep_Builder builder;
      builder.UpdateEdge(whole.edge, joined.parametric_curve, face.face, whole.tolerance);
      joined.source = TopoDS::Edge(whole.edge.Oriented(forward ? TopAbs_FORWARD : TopAbs_REVERSED));
      *first = std::move(joined);
      coedges.erase(first + 1, last);
      return;
    }
  }

  CadShape& shape_;
  const FaceFlags& joined_;
  const SizingOptions& sizing_;
  SimplifiedModel& model_;
  IdVector<VertexId, std::vector<EdgeId>> ends_;  // edges that begin or end there
  VertexFlags inside_;                            // 1 = inside a chain
};

}  // namespace

void join_edges_of_facets(CadShape& shape, const FaceFlags& joined, const SizingOptions& sizing,
                          SimplifiedModel& model) {
  FacetEdges(shape, joined, sizing, model).run();
}

}  // namespace quadrille
