/// Runs the mesher's own steps up to the triangles on a plane face made of the domain's polygons.

#include "bench/field_aligned.hpp"

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <gp_Pln.hxx>
#include <memory>

#include "geometry/cad/cad_model.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/edges/edge_sampling.hpp"
#include "mesher/faces/face_boundary.hpp"
#include "mesher/faces/face_triangulation.hpp"
#include "mesher/faces/point_placement.hpp"
#include "mesher/options.hpp"

namespace quadrille::bench {

namespace {

double area_of(const Ring& ring) {
  double sum = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Vector2 &a = ring[k], &b = ring[(k + 1) % ring.size()];
    sum += (a.x() * b.y() - a.y() * b.x()) / 2;
  }
  return sum;
}

/// \param sign sign of the signed area: 1 = counter-clockwise, -1 = clockwise, for holes.
TopoDS_Wire wire_of(Ring ring, int sign) {
  if (area_of(ring) * sign < 0) std::reverse(ring.begin(), ring.end());
  BRepBuilderAPI_MakePolygon polygon;
  for (const Vector2& p : ring) polygon.Add(gp_Pnt(p.x(), p.y(), 0));
  polygon.Close();
  return polygon.Wire();
}

CadModel face_of(const std::vector<Ring>& rings) {
  BRepBuilderAPI_MakeFace face(gp_Pln(gp::Origin(), gp::DZ()), wire_of(rings.front(), 1));
  for (std::size_t hole = 1; hole < rings.size(); ++hole) face.Add(wire_of(rings[hole], -1));
  return CadModel(std::make_shared<CadShape>(face.Face(), "domain"));
}

}  // namespace

TriangleMesh triangulate_along_field(const std::vector<Ring>& rings, const Grading& grading) {
  const CadModel model = face_of(rings);
  const CadShape& shape = model.shape();
  MeshOptions options;
  options.strategy = Strategy::direct;
  options.sizing.size = grading.growth > 0 ? model.diagonal() / 10 : grading.boundary_size;
  if (grading.growth > 0) options.sizing.growth = grading.growth;
  options.sizing.size_min = grading.boundary_size;
  for (int edge = 1; edge <= model.edge_count(); ++edge)
    options.sizing.edge_sizes[edge] = grading.boundary_size;
  ExecutionContext context(1);
  const SizingField field = SizingField::build(model, options.sizing, context);
  const BoundaryNodes nodes =
      sample_edges(shape, field, stride(options.strategy), FaceFlags(1, 1), SamplingPlan(shape), context);
  const FaceId face = FaceId::from_index(0);
  const FaceSurface surface(shape.faces[face]);
  const FaceBoundary boundary = face_boundary(shape, face, shape.faces[face], surface, nodes);
  SizingField::Sampler size_at(field);
  const PlacedPoints placed =
      place_points(boundary, surface, enclosed_domain(boundary), size_at, {}, context);
  return triangulate_face(face, boundary, placed, surface).mesh;
}

}  // namespace quadrille::bench
