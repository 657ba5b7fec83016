/// Triangulates faces with OpenCASCADE. Whether a side is divided depends on the side alone, not on its
/// triangle, so that triangles on both sides of it stay conforming.

#include "geometry/surfaces/surface_triangles.hpp"

#include <BRepBuilderAPI_Copy.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <Standard_Failure.hxx>

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include "geometry/base/side_key.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/cad/shape_parts.hpp"

namespace quadrille {

namespace {

/// Adds the triangles of a face. \return false if it has none.
bool add_face(const CadShape& shape, FaceId id, const TopoDS_Face& face, SurfaceTriangles& surface) {
  TopLoc_Location place;
  const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, place);
  if (mesh.IsNull() || mesh->NbTriangles() == 0) return false;
  const int first = static_cast<int>(surface.points.size()) - 1;  // OpenCASCADE counts nodes from 1
  const CadFace& cad = shape.faces[id];
  for (int i = 1; i <= mesh->NbNodes(); ++i) {
    surface.points.push_back(to_vector(mesh->Node(i).Transformed(place.Transformation())));
    const gp_Pnt2d uv = mesh->HasUVNodes() ? mesh->UVNode(i) : gp_Pnt2d();
    surface.uv.emplace_back(uv.X(), uv.Y());
    surface.point_faces.push_back(id);
  }
  for (int i = 1; i <= mesh->NbTriangles(); ++i) {
    std::array<int, 3> nodes{};
    mesh->Triangle(i).Get(nodes[0], nodes[1], nodes[2]);
    if (cad.reversed) std::swap(nodes[1], nodes[2]);
    surface.triangles.push_back({first + nodes[0], first + nodes[1], first + nodes[2]});
    surface.faces.push_back(id);
  }
  return true;
}

/// \param edge of the triangulated face. \param first index of the face's first point.
void add_lines(const TopoDS_Edge& edge, const TopoDS_Face& face, SurfaceTriangles::Line line, int first,
               SurfaceTriangles& surface) {
  TopLoc_Location place;
  const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, place);
  const Handle(Poly_PolygonOnTriangulation) polygon = BRep_Tool::PolygonOnTriangulation(edge, mesh, place);
  if (polygon.IsNull()) return;
  for (int i = 2; i <= polygon->NbNodes(); ++i) {
    line.points = {first + polygon->Node(i - 1) - 1, first + polygon->Node(i) - 1};
    if (line.points[0] != line.points[1]) surface.lines.push_back(line);
  }
}

}  // namespace

SurfaceTriangles triangulate_surface(const CadShape& shape, double deflection, double turn,
                                     const FaceFlags& used, const ExecutionContext& context) {
  SurfaceTriangles surface;
  context.check();
  std::vector<TopoDS_Shape> parts;
  for (const FaceId id : shape.faces.ids()) {
    if (used[id]) parts.push_back(shape.faces[id].face);
  }
  const TopoDS_Compound faces = compound_of(parts);
  // A copy is triangulated, so that the model itself stays without triangles.
  BRepBuilderAPI_Copy copy(faces, Standard_False);
  try {
    BRepMesh_IncrementalMesh(copy.Shape(), deflection, Standard_False, turn, Standard_False);
  } catch (const Standard_Failure&) {
    // Keep the faces that were triangulated before the failure.
  }
  context.check();
  const TopTools_IndexedMapOfShape own_edges = map_of(faces, TopAbs_EDGE);
  for (const FaceId id : shape.faces.ids()) {
    if (!used[id]) continue;
    const int first = static_cast<int>(surface.points.size());
    const TopoDS_Face face = TopoDS::Face(copy.ModifiedShape(shape.faces[id].face));
    if (!add_face(shape, id, face, surface)) {
      surface.missing.push_back(id);
      continue;
    }
    for (const CadWire& wire : shape.faces[id].wires) {
      for (const Coedge& coedge : wire.coedges) {
        const CadEdge& edge = shape.edges[coedge.edge];
        // The outlines of faces that were joined may have edges that OpenCASCADE's faces have not.
        if (edge.degenerate || !own_edges.Contains(coedge.source)) continue;
        // A seam has one polygon for each side, selected by its orientation.
        const TopoDS_Shape copied = copy.ModifiedShape(coedge.source).Oriented(coedge.source.Orientation());
        add_lines(TopoDS::Edge(copied), face, {{-1, -1}, edge.number, id}, first, surface);
      }
    }
  }
  return surface;
}

void divide_sides(SurfaceTriangles& surface,
                  const std::function<double(FaceId face, const Vector3&)>& longest, std::size_t most,
                  const ExecutionContext& context) {
  using Piece = std::pair<FaceId, std::array<int, 3>>;
  std::vector<Vector3>& points = surface.points;
  std::unordered_map<std::uint64_t, int> middles;  // of the divided sides
  std::vector<Piece> left, done;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i)
    left.emplace_back(surface.faces[i], surface.triangles[i]);
  while (!left.empty() && left.size() + done.size() < most) {
    context.check();
    std::vector<Piece> halves;
    for (const Piece& piece : left) {
      const auto& [face, nodes] = piece;
      double length = 0;
      int a = -1, b = -1, c = -1;  // corners, if the first two have a side to be divided
      for (int k = 0; k < 3; ++k) {
        const Vector3 &from = points[nodes[k]], &to = points[nodes[(k + 1) % 3]];
        const double own = (to - from).norm();
        if (!(own > length) || !(own > longest(face, 0.5 * (from + to)))) continue;
        length = own;
        a = nodes[k], b = nodes[(k + 1) % 3], c = nodes[(k + 2) % 3];
      }
      if (a < 0) {
        done.push_back(piece);
        continue;
      }
      const auto [middle, is_new] = middles.try_emplace(side_key(a, b), static_cast<int>(points.size()));
      if (is_new) {
        points.push_back(Vector3(0.5 * (points[a] + points[b])));
        surface.uv.push_back(Vector2(0.5 * (surface.uv[a] + surface.uv[b])));
        surface.point_faces.push_back(face);
      }
      halves.emplace_back(face, std::array{middle->second, b, c});
      halves.emplace_back(face, std::array{middle->second, c, a});
    }
    left = std::move(halves);
  }
  done.insert(done.end(), left.begin(), left.end());
  std::stable_sort(done.begin(), done.end(),
                   [](const Piece& a, const Piece& b) { return a.first < b.first; });
  surface.triangles.clear();
  surface.faces.clear();
  for (const auto& [face, nodes] : done) {
    surface.triangles.push_back(nodes);
    surface.faces.push_back(face);
  }
  for (std::size_t i = 0; i < surface.lines.size();) {
    SurfaceTriangles::Line& line = surface.lines[i];
    const auto middle = middles.find(side_key(line.points[0], line.points[1]));
    if (middle == middles.end()) {
      ++i;
      continue;
    }
    SurfaceTriangles::Line half = line;
    half.points[0] = line.points[1] = middle->second;
    surface.lines.push_back(half);
  }
}

}  // namespace quadrille
