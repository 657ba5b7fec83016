/// Sorts the parameters of points; on periodic surfaces the range leaves out the widest gap.

#include "geometry/midsurface/parameter_range.hpp"

#include <BRepAdaptor_Curve.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <Precision.hxx>
#include <ShapeAnalysis_Surface.hxx>
#include <algorithm>
#include <cmath>

#include "geometry/cad/shape_parts.hpp"

namespace quadrille {

namespace {

ParameterRange plain_range(const std::vector<double>& values, double margin) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return {*low - margin, *high + margin};
}

/// The whole period from 0, unless the values leave a wide gap.
ParameterRange periodic_range(std::vector<double> values, double margin, double period) {
  for (double& value : values) value -= period * std::floor(value / period);
  std::sort(values.begin(), values.end());
  double gap = values.front() + period - values.back(), after = values.front();
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (values[i] - values[i - 1] <= gap) continue;
    gap = values[i] - values[i - 1];
    after = values[i];
  }
  const double least_gap = period / 10;
  if (gap < least_gap + 2 * margin) return {0, period};
  return {after - margin, after - gap + period + margin};
}

}  // namespace

std::vector<gp_Pnt> points_on_edges(const Skin& skin, const std::vector<int>& faces) {
  constexpr int intervals = 16;
  std::vector<gp_Pnt> result;
  for (const int face : faces) {
    for (const TopoDS_Edge& edge : edges_of(skin.faces()[face].face())) {
      const BRepAdaptor_Curve curve(edge);
      const double first = curve.FirstParameter(), last = curve.LastParameter();
      for (int i = 0; i <= intervals; ++i)
        result.push_back(curve.Value(first + (last - first) * i / intervals));
    }
  }
  return result;
}

std::array<ParameterRange, 2> range_of(const Handle(Geom_Surface) & surface,
                                       const std::vector<gp_Pnt>& points,
                                       const std::array<double, 2>& margins) {
  ShapeAnalysis_Surface inverse(surface);
  std::vector<double> us, vs;
  for (const gp_Pnt& point : points) {
    const gp_Pnt2d uv = inverse.ValueOfUV(point, Precision::Confusion());
    us.push_back(uv.X());
    vs.push_back(uv.Y());
  }
  const GeomAdaptor_Surface kind(surface);
  return {kind.IsUPeriodic() ? periodic_range(us, margins[0], kind.UPeriod()) : plain_range(us, margins[0]),
          kind.IsVPeriodic() ? periodic_range(vs, margins[1], kind.VPeriod()) : plain_range(vs, margins[1])};
}

}  // namespace quadrille
