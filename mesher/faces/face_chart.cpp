/// Takes the face's own parameter plane, new curves in it, or a view from above its widest loop.

#include "mesher/faces/face_chart.hpp"

#include <Standard_Failure.hxx>

#include <fmt/format.h>

#include "geometry/cad/seams.hpp"
#include "geometry/cad/shape_completion.hpp"

namespace quadrille {

namespace {

/// The nodes, in order, of the wire that encloses the largest area.
std::vector<Vector3> widest_loop(const CadFace& face, const BoundaryNodes& nodes) {
  std::vector<Vector3> widest;
  double largest = 0;
  for (const CadWire& wire : face.wires) {
    std::vector<Vector3> loop;
    for (const Coedge& coedge : wire.coedges) {
      const auto& edge = nodes.edges[coedge.edge].nodes;
      // The last node is left out: it is the first of the next edge.
      for (std::size_t i = 0; i + 1 < edge.size(); ++i)
        loop.push_back(nodes.points[edge[coedge.forward ? i : edge.size() - 1 - i]]);
    }
    const double area = vector_area(loop).norm();
    if (area > largest) {
      largest = area;
      widest = loop;
    }
  }
  return widest;
}

FaceChart chart_of(const CadShape& shape, FaceId face, const BoundaryNodes& nodes, ChartKind kind) {
  FaceChart chart;
  chart.kind = kind;
  if (kind == ChartKind::new_curves)
    chart.other = std::make_shared<const CadFace>(with_new_curves(shape.faces[face]));
  const CadFace& cad_face = chart.other ? *chart.other : shape.faces[face];
  chart.surface = std::make_shared<const FaceSurface>(
      kind == ChartKind::view ? FaceSurface::seen_from_above(cad_face, widest_loop(cad_face, nodes))
                              : FaceSurface(cad_face));
  if (chart.surface->is_curve())
    throw FaceProblem(
        Cause::no_area, face,
        lacks_seam(cad_face.face)
            ? fmt::format("the boundary of Face{} runs once around its surface and bounds no area: "
                          "OpenCASCADE's reader has lost its pole and seam, as it does with "
                          "ellipsoids in STEP; export the part as BREP or IGES, or leave the face "
                          "out with `faces`",
                          face.number())
            : fmt::format("the surface of Face{} is a curve, without area: the file may be "
                          "damaged; `faces` can leave the face out",
                          face.number()));
  chart.boundary = face_boundary(shape, face, cad_face, *chart.surface, nodes);
  return chart;
}

}  // namespace

FaceChart make_chart(const CadShape& shape, FaceId face, const BoundaryNodes& nodes, ChartKind kind) {
  try {
    return chart_of(shape, face, nodes, kind);
  } catch (const FaceProblem&) {
    throw;
  } catch (const Error& problem) {
    if (problem.kind() != Error::Kind::failure) throw;
    throw FaceProblem(Cause::unusable_boundary, face, problem.what());
  } catch (const Standard_Failure& problem) {
    throw FaceProblem(
        Cause::unusable_boundary, face,
        fmt::format("Face{} cannot be evaluated ({})", face.number(), problem.GetMessageString()));
  }
}

}  // namespace quadrille
