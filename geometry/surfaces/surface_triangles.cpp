/// Based on: longest-side refinement (Rivara 1984), with all marked sides of a triangle divided at once.

#include "geometry/surfaces/surface_triangles.hpp"

#include <BRepBuilderAPI_Copy.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <Standard_Failure.hxx>

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

/// One round of dividing sides.
class Round {
 public:
  Round(SurfaceTriangles& surface, const std::function<double(FaceId, const Vector3&)>& longest)
      : surface_(surface) {
    for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
      for (int k = 0; k < 3; ++k) {
        const auto [a, b] = side(i, k);
        const auto [found, is_new] = middles_.try_emplace(side_key(a, b));
        SharedSide& own = found->second;
        if (!is_new) {
          own.triangles[1] = static_cast<int>(i);
          continue;
        }
        own.triangles[0] = static_cast<int>(i);
        const Vector3 middle = 0.5 * (surface.points[a] + surface.points[b]);
        if (length(a, b) > longest(surface.faces[i], middle)) mark(own);
      }
    }
  }

  bool any() const { return !divided_.empty(); }

  void divide() {
    close();
    std::vector<std::array<int, 3>> triangles;
    std::vector<FaceId> faces;
    for (std::size_t i = 0; i < surface_.triangles.size(); ++i) {
      const std::size_t before = triangles.size();
      cut(i, triangles);
      faces.insert(faces.end(), triangles.size() - before, surface_.faces[i]);
    }
    std::vector<SurfaceTriangles::Line> lines;
    for (const SurfaceTriangles::Line& line : surface_.lines) {
      const auto found = middles_.find(side_key(line.points[0], line.points[1]));
      if (found == middles_.end() || found->second.middle < 0) {
        lines.push_back(line);
        continue;
      }
      lines.push_back({{line.points[0], found->second.middle}, line.edge, line.face});
      lines.push_back({{found->second.middle, line.points[1]}, line.edge, line.face});
    }
    surface_.triangles = std::move(triangles);
    surface_.faces = std::move(faces);
    surface_.lines = std::move(lines);
  }

 private:
  static constexpr int whole = -1, to_divide = -2;

  struct SharedSide {
    int middle = whole;  // index of its midpoint, or one of the states above
    std::array<int, 2> triangles{-1, -1};
  };

  void mark(SharedSide& side) {
    side.middle = to_divide;
    divided_.push_back(&side);
  }

  std::pair<int, int> side(std::size_t triangle, int k) const {
    return {surface_.triangles[triangle][k], surface_.triangles[triangle][(k + 1) % 3]};
  }
  double length(int a, int b) const { return (surface_.points[a] - surface_.points[b]).norm(); }
  int longest_side(std::size_t triangle) const {
    int best = 0;
    for (int k = 1; k < 3; ++k) {
      const auto [a, b] = side(triangle, k);
      const auto [c, d] = side(triangle, best);
      if (length(a, b) > length(c, d)) best = k;
    }
    return best;
  }

  /// Marks the longest side of every triangle that has a marked side. This keeps angles from degenerating.
  void close() {
    while (!divided_.empty()) {
      const SharedSide& side = *divided_.back();
      divided_.pop_back();
      for (const int triangle : side.triangles) {
        if (triangle < 0) continue;
        SharedSide& longest = side_of(triangle, longest_side(triangle));
        if (longest.middle == whole) mark(longest);
      }
    }
  }

  SharedSide& side_of(std::size_t triangle, int k) {
    const auto [a, b] = side(triangle, k);
    return middles_.at(side_key(a, b));
  }

  /// The midpoint of a side that is to be divided; negative for the others.
  int point_of(std::size_t triangle, int k) {
    int& point = side_of(triangle, k).middle;
    if (point != to_divide) return point;
    const auto [a, b] = side(triangle, k);
    point = static_cast<int>(surface_.points.size());
    surface_.points.push_back(0.5 * (surface_.points[a] + surface_.points[b]));
    surface_.uv.push_back(0.5 * (surface_.uv[a] + surface_.uv[b]));
    surface_.point_faces.push_back(surface_.faces[triangle]);
    return point;
  }

  void cut(std::size_t triangle, std::vector<std::array<int, 3>>& out) {
    const int k = longest_side(triangle);
    const auto& nodes = surface_.triangles[triangle];
    // Cut from the middle of the longest side to the opposite corner. Each half may have one more such side.
    const int a = nodes[k], b = nodes[(k + 1) % 3], c = nodes[(k + 2) % 3];
    const int ab = point_of(triangle, k);
    if (ab < 0) {
      out.push_back(nodes);
      return;
    }
    const int bc = point_of(triangle, (k + 1) % 3), ca = point_of(triangle, (k + 2) % 3);
    if (bc < 0) {
      out.push_back({ab, b, c});
    } else {
      out.push_back({ab, b, bc});
      out.push_back({ab, bc, c});
    }
    if (ca < 0) {
      out.push_back({ab, c, a});
    } else {
      out.push_back({ab, c, ca});
      out.push_back({ab, ca, a});
    }
  }

  SurfaceTriangles& surface_;
  std::unordered_map<std::uint64_t, SharedSide> middles_;
  std::vector<SharedSide*> divided_;  // marked sides whose triangles still have to be checked
};

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
  constexpr int most_rounds = 40;
  for (int round = 0; round < most_rounds && surface.triangles.size() < most; ++round) {
    context.check();
    Round next(surface, longest);
    if (!next.any()) return;
    next.divide();
  }
}

}  // namespace quadrille
