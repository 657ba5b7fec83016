#include "mesher/area_check.hpp"

#include <BRepGProp.hxx>
#include <GProp_GProps.hxx>
#include <Standard_Failure.hxx>

#include <oneapi/tbb/parallel_for.h>

#include <cmath>

#include <fmt/format.h>

#include "geometry/cad_shape.hpp"

namespace quadrille {

std::vector<std::string> area_differences(const CadModel& model, const ShellMesh& mesh) {
  constexpr double largest = 0.03;
  const CadShape& shape = model.shape();
  std::vector<double> areas(shape.faces.size(), 0);
  for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
    const auto [a, b, c, d] = mesh.quads[i];
    const auto& p = mesh.points;
    areas[mesh.quad_faces[i] - 1] += 0.5 * (p[c] - p[a]).cross(p[d] - p[b]).norm();
  }
  std::vector<double> integrals(areas.size(), 0);
  oneapi::tbb::parallel_for(std::size_t{0}, areas.size(), [&](std::size_t face) {
    integrals[face] = areas[face];
    if (!(areas[face] > 0)) return;
    try {
      GProp_GProps properties;
      BRepGProp::SurfaceProperties(shape.faces[face].face, properties);
      integrals[face] = std::abs(properties.Mass());
    } catch (const Standard_Failure&) {
      return;  // no integral to compare with
    }
  });
  std::vector<std::string> result;
  for (std::size_t face = 0; face < areas.size(); ++face) {
    const double area = integrals[face];
    if (std::abs(areas[face] - area) <= largest * area) continue;
    result.push_back(
        fmt::format("Face{} has an area of {:.6g} in the mesh and of {:.6g} by OpenCASCADE's integration: "
                    "its size may be too "
                    "coarse for its curvature, or the integral wrong",
                    face + 1, areas[face], area));
  }
  return result;
}

}  // namespace quadrille
