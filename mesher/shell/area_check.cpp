/// Compares areas face by face, less what flat elements lose by the angles at which they and the curves turn.

#include "mesher/shell/area_check.hpp"

#include <BRepAdaptor_Surface.hxx>
#include <BRepGProp.hxx>
#include <GProp_GProps.hxx>
#include <Standard_Failure.hxx>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "geometry/base/place_text.hpp"
#include "geometry/base/side_key.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/cad/parallel_ids.hpp"
#include "geometry/surfaces/edge_curve.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/mesh/joined_faces.hpp"
#include "mesher/mesh/quad_geometry.hpp"

namespace quadrille {

namespace {

/// The angle by which a CAD edge turns from end to end.
double turning_of(const CadEdge& edge) {
  constexpr int parts_of_edge = 32;
  const EdgeCurve curve(edge);
  double sum = 0;
  for (int i = 0; i < parts_of_edge; ++i) {
    const auto at = [&](int k) {
      return curve.derivative(edge.first + (edge.last - edge.first) * k / parts_of_edge);
    };
    sum += angle_between(at(i), at(i + 1));
  }
  return sum;
}

/// Estimates the area that faces lose because elements are flat and have straight sides, from the angles by
/// which elements and curves turn. Uses the ratio of a circular arc to its chord, to second order.
IdVector<FaceId, double> flat_losses(const CadShape& shape, const ShellMesh& mesh, const FaceFlags& faces) {
  std::unordered_map<std::uint64_t, int> edges;
  std::unordered_map<int, int> segments_of;
  for (const auto& segment : mesh.segments) {
    ++segments_of[segment.edge];
    edges.emplace(side_key(segment.nodes[0], segment.nodes[1]), segment.edge);
  }
  const auto key = [&](std::size_t quad, int k) {
    return side_key(mesh.quads[quad][k], mesh.quads[quad][(k + 1) % 4]);
  };
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> sides;
  for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
    if (!faces[FaceId::from_number(mesh.quad_faces[i])]) continue;
    for (int k = 0; k < 4; ++k) sides[key(i, k)].push_back(i);
  }
  std::unordered_map<int, double> turnings;  // along one segment of an edge, on average
  const auto loss_of = [&](std::size_t quad) {
    double loss = 0;
    double turning[2] = {0, 0};  // along sides 0 and 2, along sides 1 and 3
    const Vector3 normal = quad_area_vector(mesh.points, mesh.quads[quad]);
    for (int k = 0; k < 4; ++k) {
      for (const std::size_t other : sides[key(quad, k)]) {
        if (other == quad || mesh.quad_faces[other] != mesh.quad_faces[quad]) continue;
        double& across = turning[(k + 1) % 2];
        across = std::max(across, angle_between(normal, quad_area_vector(mesh.points, mesh.quads[other])));
      }
      const auto edge = edges.find(key(quad, k));
      if (edge == edges.end()) continue;
      const auto [along, is_new] = turnings.try_emplace(edge->second);
      if (is_new)
        along->second =
            turning_of(shape.edges[EdgeId::from_number(edge->second)]) / segments_of[edge->second];
      turning[k % 2] = std::max(turning[k % 2], along->second);
      const Vector3 side = mesh.points[mesh.quads[quad][(k + 1) % 4]] - mesh.points[mesh.quads[quad][k]];
      loss += side.squaredNorm() * along->second / 12;
    }
    return loss + normal.norm() * (turning[0] * turning[0] + turning[1] * turning[1]) / 24;
  };
  IdVector<FaceId, double> losses(faces.size());
  for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
    const FaceId face = FaceId::from_number(mesh.quad_faces[i]);
    if (faces[face]) losses[face] += loss_of(i);
  }
  return losses;
}

/// The area of a CAD face: of a plane one by its outline, which is a tenth of the work, else by OpenCASCADE.
double cad_area(const CadShape& shape, FaceId id, bool is_plane) {
  const CadFace& face = shape.faces[id];
  if (!is_plane) {
    // On many pieces, a rule that starts with few points takes a fortieth of the time of one for each piece.
    constexpr int few_pieces = 16;
    constexpr double accuracy = 1e-2;
    const BRepAdaptor_Surface surface(face.face, Standard_False);
    GProp_GProps properties;
    if (surface.NbUIntervals(GeomAbs_CN) * surface.NbVIntervals(GeomAbs_CN) <= few_pieces)
      BRepGProp::SurfaceProperties(face.face, properties);
    else
      BRepGProp::SurfaceProperties(face.face, properties, accuracy);
    return std::abs(properties.Mass());
  }
  constexpr int pieces_of_curve = 64;
  double twice = 0;
  for (const CadWire& wire : face.wires)
    for (const Coedge& coedge : wire.coedges) {
      const CadEdge& edge = shape.edges[coedge.edge];
      if (edge.degenerate || coedge.internal) continue;
      const int pieces = EdgeCurve(edge).straight() ? 1 : pieces_of_curve;
      Vector2 from = parametric_point(coedge, edge.first);
      for (int k = 1; k <= pieces; ++k) {
        const Vector2 to = parametric_point(coedge, edge.first + (edge.last - edge.first) * k / pieces);
        twice += (coedge.forward ? 1 : -1) * (from.x() * to.y() - from.y() * to.x());
        from = to;
      }
    }
  return 0.5 * std::abs(twice);
}

}  // namespace

std::vector<AreaDifference> area_differences(const CadModel& model, const ShellMesh& mesh,
                                             AreasChecked checked) {
  constexpr double largest = 0.03, of_loss = 2;
  const bool planes_only = checked == AreasChecked::planes;
  const CadShape& shape = model.shape();
  IdVector<FaceId, double> areas(shape.faces.size());
  for (std::size_t i = 0; i < mesh.quads.size(); ++i)
    areas[FaceId::from_number(mesh.quad_faces[i])] += quad_area_vector(mesh.points, mesh.quads[i]).norm();
  const JoinedFaces joined(mesh);
  IdVector<FaceId, double> integrals(areas.size());
  FaceFlags planes(areas.size());  // 1 = plane, and shares no quads
  for_each_id(areas, [&](FaceId face) {
    integrals[face] = areas[face];
    const bool is_joined = joined.contains(face.number());
    if (is_joined ? planes_only : !(areas[face] > 0)) return;
    try {
      const bool is_plane = FaceSurface(shape.faces[face]).planar();
      planes[face] = is_plane && !is_joined;
      if (is_plane || !planes_only) integrals[face] = cad_area(shape, face, is_plane);
    } catch (const Standard_Failure&) {
      return;  // no integral to compare with
    }
  });
  // Faces that share quads are compared together, at the first of them.
  const auto first = [&](FaceId face) { return FaceId::from_number(joined.first(face.number())); };
  for (const FaceId face : areas.ids()) {
    if (first(face) == face) continue;
    areas[first(face)] += std::exchange(areas[face], 0);
    integrals[first(face)] += std::exchange(integrals[face], 0);
  }
  for (const ShellMesh::Face& face : mesh.faces)
    integrals[first(FaceId::from_number(face.face))] += face.filled_area;
  const auto difference = [&](FaceId face) { return std::abs(areas[face] - integrals[face]); };
  FaceFlags differ(areas.size());
  for (const FaceId face : areas.ids())
    differ[face] =
        (planes[face] || !planes_only) && difference(first(face)) > largest * integrals[first(face)];
  std::vector<AreaDifference> result;
  if (std::none_of(differ.begin(), differ.end(), [](char d) { return d != 0; })) return result;
  IdVector<FaceId, double> losses = flat_losses(shape, mesh, differ);
  for (const FaceId face : areas.ids())
    if (first(face) != face) losses[first(face)] += losses[face];
  // What is narrower than the reach is left to the neighbors.
  IdVector<FaceId, double> shifts(areas.size());
  for (const CadEdge& edge : shape.edges)
    for (const FaceId face : edge.faces) shifts[first(face)] += 0.5 * mesh.size_min * edge.length;
  constexpr double large = 0.01;
  double whole = 0;  // the same whatever is checked
  for (const FaceId face : areas.ids()) whole += planes[face] ? integrals[face] : areas[face];
  for (const FaceId face : areas.ids()) {
    if (!differ[face] ||
        difference(face) <= largest * integrals[face] + of_loss * losses[face] + shifts[face])
      continue;
    result.push_back(
        {fmt::format("Face{}{} has an area of {} in the mesh and of {} in the CAD model: the size may be too "
                     "coarse for its shape, or the file or the integral may be wrong",
                     face.number(),
                     joined.contains(face.number()) ? " with the faces that share quads with it" : "",
                     number_text(areas[face], integrals[face]), number_text(integrals[face], areas[face])),
         planes[face] && difference(face) > large * whole});
  }
  return result;
}

}  // namespace quadrille
