/// Interpolates points equally far from both sides on a grid, or along the profile of a wall of revolution,
/// refined until it meets the tolerance.

#include "geometry/midsurface/fitted_middle.hpp"

#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <BSplCLib.hxx>
#include <BSplSLib.hxx>
#include <ElCLib.hxx>
#include <GeomLib.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BoundedCurve.hxx>
#include <Geom_BoundedSurface.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <Precision.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Ax1.hxx>
#include <gp_Lin.hxx>
#include <iterator>
#include <map>
#include <utility>

#include "geometry/midsurface/parameter_range.hpp"

namespace quadrille {

namespace {

/// The faces of a side, with the bounds of their parameters.
class SideFaces {
 public:
  SideFaces(const Skin& skin, const std::vector<int>& faces) {
    for (const int index : faces) {
      Part part{&skin.faces()[index]};
      BRepTools::UVBounds(part.face->face(), part.low[0], part.high[0], part.low[1], part.high[1]);
      parts_.push_back(part);
    }
  }

  /// The nearest foot in the faces; without one, that on the nearest untrimmed surface, which goes on
  /// straight past its bounds: at the closest point of a border, middles would bend round each corner. At an
  /// edge between two of the faces, the closest point.
  gp_Pnt nearest(const gp_Pnt& from) const {
    constexpr double near = 1e-6;  // over the distance
    gp_Pnt inside, outside;
    double least_inside = -1, least_outside = -1;
    for (const Part& part : parts_) {
      const gp_Pnt2d uv = part.face->closest(from);
      const gp_Pnt closest = part.face->point(uv), straight = on_tangent_plane(*part.face, uv, from);
      const double distance = closest.Distance(from);
      if (closest.Distance(straight) <= near * distance + Precision::Confusion() && part.face->holds(uv)) {
        if (least_inside >= 0 && distance >= least_inside) continue;
        least_inside = distance;
        inside = closest;
      }
      if (least_inside >= 0) continue;
      const gp_Pnt2d kept(std::clamp(uv.X(), part.low[0], part.high[0]),
                          std::clamp(uv.Y(), part.low[1], part.high[1]));
      const double to_kept = part.face->point(kept).Distance(from);
      if (least_outside >= 0 && std::abs(to_kept - least_outside) <= near * to_kept) outside = closest;
      if (least_outside >= 0 && to_kept >= (1 - near) * least_outside) continue;
      least_outside = to_kept;
      outside = straight;
    }
    return least_inside >= 0 ? inside : outside;
  }

 private:
  struct Part {
    const SkinFace* face;
    std::array<double, 2> low{}, high{};
  };

  /// The foot on the plane that touches a face's surface at (u, v).
  static gp_Pnt on_tangent_plane(const SkinFace& face, const gp_Pnt2d& uv, const gp_Pnt& from) {
    const gp_Pnt at = face.point(uv);
    const auto normal = face.outward(uv);
    return normal ? from.Translated(gp_Vec(from, at).Dot(gp_Vec(*normal)) * gp_Vec(*normal)) : at;
  }

  std::vector<Part> parts_;
};

/// One direction of the grid: the parameters of the interpolated points and the knots of the B-spline.
class GridLine {
 public:
  GridLine(const ParameterRange& range, int spans) : range_(range), spans_(spans) {}

  /// The next finer one; none where the error is good enough, or where it fell too little to go on.
  std::optional<GridLine> finer(double off, double tolerance) const {
    constexpr int most_spans = 128;
    constexpr double gain = 0.1;  // error ratio below which refining pays; 1/16 on smooth sides
    const bool pays = off < gain * before_;
    const bool is_good = off <= tolerance || (off <= most_tolerances * tolerance && !pays);
    if (is_good || spans_ >= most_spans) return std::nullopt;
    GridLine result(range_, std::max(4, 2 * spans_));
    result.before_ = off;
    return result;
  }
  int degree() const { return spans_ == 1 ? 1 : 3; }
  int count() const { return spans_ + degree(); }
  double knot(int i) const { return range_.low + range_.length() * i / spans_; }
  double value(int i) const {  // Greville abscissa
    double sum = 0;
    for (int j = 1; j <= degree(); ++j) sum += knot(std::clamp(i + j - degree(), 0, spans_));
    return sum / degree();
  }
  /// Parameters to check between the i-th value and the next one; more of them for a straight line.
  std::vector<double> between(int i) const {
    auto places = spans_ == 1 ? std::vector<double>{0.1, 0.25, 0.5, 0.75, 0.9} : std::vector<double>{0.5};
    for (double& place : places) place = (1 - place) * value(i) + place * value(i + 1);
    return places;
  }

  TColStd_Array1OfReal values() const {
    TColStd_Array1OfReal result(1, count());
    for (int i = 0; i < count(); ++i) result(i + 1) = value(i);
    return result;
  }
  TColStd_Array1OfReal knots() const {
    TColStd_Array1OfReal result(1, spans_ + 1);
    for (int i = 0; i <= spans_; ++i) result(i + 1) = knot(i);
    return result;
  }
  TColStd_Array1OfInteger multiplicities() const {
    TColStd_Array1OfInteger result(1, spans_ + 1);
    result.Init(1);
    result(1) = result(spans_ + 1) = degree() + 1;
    return result;
  }
  TColStd_Array1OfReal flat_knots() const {
    TColStd_Array1OfReal result(1, spans_ + 1 + 2 * degree());
    for (int i = 0; i < result.Length(); ++i) result(i + 1) = knot(std::clamp(i - degree(), 0, spans_));
    return result;
  }

 private:
  ParameterRange range_;
  int spans_;
  double before_ = HUGE_VAL;  ///< error of the coarser line
};

/// The first side, and the faces beside it.
std::vector<int> with_beside(const std::vector<int>& side, const std::array<int, 4>& beside) {
  std::vector<int> result{side.front()};
  std::copy_if(beside.begin(), beside.end(), std::back_inserter(result), [](int face) { return face >= 0; });
  return result;
}

class MiddlePoints {
 public:
  MiddlePoints(const Skin& skin, const std::array<std::vector<int>, 2>& sides,
               const std::array<ParameterRange, 2>& ranges, const std::array<int, 4>& beside)
      : skin_(skin),
        base_(skin.faces()[sides[0].front()]),
        own_(skin, with_beside(sides[0], beside)),
        across_(skin, sides[1]),
        ranges_(ranges),
        beside_(beside) {}

  /// The point on the normal at (u, v) of the first side, or on the tilted normal, that is equally far from
  /// the other side.
  std::optional<gp_Pnt> at(double u, double v) {
    const auto [entry, is_new] = known_.try_emplace({u, v});
    if (is_new) entry->second = find({u, v});
    return entry->second;
  }

 private:
  /// The normal of the first side; at a pole, that beside it.
  std::optional<gp_Dir> outward_near(const gp_Pnt2d& uv) const {
    if (const auto outward = base_.outward(uv)) return outward;
    constexpr double beside = 1e-6;
    const double middle = ranges_[1].low + 0.5 * ranges_[1].length();
    return base_.outward({uv.X(), uv.Y() + beside * (middle - uv.Y())});
  }

  /// How much the direction in which middle points are searched is tilted from the normal of the first side:
  /// the vector to add to the outward unit normal. Where that side and the face beside it meet at an angle,
  /// the middles of both must end at the same points, on the plane that bisects the angle. From there the
  /// tilt fades toward the other end.
  gp_Vec tilt(const gp_Pnt2d& uv) const {
    const double y = (uv.Y() - ranges_[1].low) / ranges_[1].length();
    gp_Vec result = tilt_between_ends_of_u(uv.X(), uv.Y());
    // The tilt for the ends of v, beyond that from the ends of u.
    const std::array<double, 2> bounds{ranges_[1].low, ranges_[1].high}, weights{1 - y, y};
    for (int end = 0; end < 2; ++end) {
      if (beside_[2 + end] >= 0)
        result += weights[end] * (tilt_at_end(2 + end, uv.X()) - tilt_between_ends_of_u(uv.X(), bounds[end]));
    }
    return result;
  }

  gp_Vec tilt_between_ends_of_u(double u, double v) const {
    const double x = (u - ranges_[0].low) / ranges_[0].length();
    return (1 - x) * tilt_at_end(0, v) + x * tilt_at_end(1, v);
  }

  /// Half the difference of the normals beside and on this face. \param along the other parameter.
  gp_Vec tilt_at_end(int end, double along) const {
    if (beside_[end] < 0) return {};
    const ParameterRange& range = ranges_[end / 2];
    const double bound = end % 2 == 0 ? range.low : range.high;
    const gp_Pnt2d uv = end < 2 ? gp_Pnt2d(bound, along) : gp_Pnt2d(along, bound);
    const auto own = base_.outward(uv), next = skin_.faces()[beside_[end]].outward_at(base_.point(uv));
    return own && next ? 0.5 * (gp_Vec(*next) - gp_Vec(*own)) : gp_Vec();
  }

  std::optional<gp_Pnt> find(const gp_Pnt2d& uv) const {
    const auto outward = outward_near(uv);
    if (!outward) return std::nullopt;
    const gp_Vec tilt = this->tilt(uv);
    const bool tilted = tilt.Magnitude() > 1e-4;
    const double size = skin_.size();
    const gp_Pnt foot = base_.point(uv);
    const gp_Vec inward(gp_Dir(tilted ? tilt + gp_Vec(*outward) : gp_Vec(*outward)).Reversed());
    double depth = 0;
    for (int step = 0; step < 40; ++step) {  // Newton iteration on a nearly linear function
      const gp_Pnt point = foot.Translated(depth * inward);
      const gp_Vec from_other(across_.nearest(point), point);
      const gp_Vec from_own = tilted ? gp_Vec(own_.nearest(point), point) : depth * inward;
      const double distance = from_other.Magnitude(), own = from_own.Magnitude();
      if (std::abs(distance - own) < 1e-10 * size) return point;
      const double own_slope = own > 1e-9 * size ? from_own.Dot(inward) / own : 1;
      const double slope = (distance > 0 ? from_other.Dot(inward) / distance : 0) - own_slope;
      if (slope > -0.5) return std::nullopt;
      depth -= (distance - own) / slope;
      if (depth < 0 || depth > size) return std::nullopt;
    }
    return std::nullopt;
  }

  const Skin& skin_;
  const SkinFace& base_;
  SideFaces own_, across_;
  std::array<ParameterRange, 2> ranges_;
  std::array<int, 4> beside_;
  std::map<std::pair<double, double>, std::optional<gp_Pnt>> known_;
};

std::optional<Handle(Geom_Surface)> interpolate(MiddlePoints& points, const std::array<GridLine, 2>& grid) {
  TColgp_Array2OfPnt poles(1, grid[0].count(), 1, grid[1].count());
  for (int i = 0; i < grid[0].count(); ++i) {
    for (int j = 0; j < grid[1].count(); ++j) {
      const auto point = points.at(grid[0].value(i), grid[1].value(j));
      if (!point) return std::nullopt;
      poles(i + 1, j + 1) = *point;
    }
  }
  int problem = 0;
  BSplSLib::Interpolate(grid[0].degree(), grid[1].degree(), grid[0].flat_knots(), grid[1].flat_knots(),
                        grid[0].values(), grid[1].values(), poles, problem);
  if (problem != 0) return std::nullopt;
  return new Geom_BSplineSurface(poles, grid[0].knots(), grid[1].knots(), grid[0].multiplicities(),
                                 grid[1].multiplicities(), grid[0].degree(), grid[1].degree());
}

/// The largest error of the surface between grid points along one direction.
std::optional<double> off_along(int direction, const Handle(Geom_Surface) & surface, MiddlePoints& points,
                                const std::array<GridLine, 2>& grid) {
  const GridLine &along = grid[direction], &across = grid[1 - direction];
  double off = 0;
  for (int i = 0; i + 1 < along.count(); ++i) {
    for (const double value : along.between(i)) {
      for (int j = 0; j < across.count(); ++j) {
        std::array<double, 2> uv{value, across.value(j)};
        if (direction == 1) std::swap(uv[0], uv[1]);
        const auto point = points.at(uv[0], uv[1]);
        if (!point) return std::nullopt;
        off = std::max(off, surface->Value(uv[0], uv[1]).Distance(*point));
      }
    }
  }
  return off;
}

std::optional<NearMiddle> fit(MiddlePoints& points, const std::array<ParameterRange, 2>& ranges,
                              double tolerance) {
  std::array<GridLine, 2> grid{GridLine(ranges[0], 1), GridLine(ranges[1], 1)};
  for (;;) {
    const auto surface = interpolate(points, grid);
    if (!surface) return std::nullopt;
    const auto first = off_along(0, *surface, points, grid), second = off_along(1, *surface, points, grid);
    if (!first || !second) return std::nullopt;
    const std::array<double, 2> off{*first, *second};
    bool is_finer = false;
    for (int direction = 0; direction < 2; ++direction) {
      const auto finer = grid[direction].finer(off[direction], tolerance);
      if (!finer) continue;
      grid[direction] = *finer;
      is_finer = true;
    }
    if (!is_finer) return NearMiddle{*surface, std::max(off[0], off[1])};
  }
}

/// A curve between two profiles of surfaces of revolution.
struct FittedProfile {
  Handle(Geom_BSplineCurve) curve;
  double off = 0;  ///< largest distance found from the true middle
};

/// The profile along v at u. Its ends that lie on the axis within a tolerance, poles, do so exactly.
std::optional<FittedProfile> fit_profile(MiddlePoints& points, double u, const ParameterRange& range,
                                         const gp_Lin& axis, double at_pole, double tolerance) {
  GridLine grid(range, 1);
  for (;;) {
    TColgp_Array1OfPnt poles(1, grid.count());
    for (int i = 0; i < grid.count(); ++i) {
      const auto point = points.at(u, grid.value(i));
      if (!point) return std::nullopt;
      const bool is_pole = axis.Distance(*point) < at_pole;
      poles(i + 1) = is_pole ? ElCLib::Value(ElCLib::Parameter(axis, *point), axis) : *point;
    }
    TColStd_Array1OfInteger orders(1, grid.count());
    orders.Init(0);
    int problem = 0;
    BSplCLib::Interpolate(grid.degree(), grid.flat_knots(), grid.values(), orders, poles, problem);
    if (problem != 0) return std::nullopt;
    FittedProfile result{new Geom_BSplineCurve(poles, grid.knots(), grid.multiplicities(), grid.degree())};
    for (int i = 0; i + 1 < grid.count(); ++i) {
      for (const double value : grid.between(i)) {
        const auto point = points.at(u, value);
        if (!point) return std::nullopt;
        result.off = std::max(result.off, result.curve->Value(value).Distance(*point));
      }
    }
    const auto finer = grid.finer(result.off, tolerance);
    if (!finer) return result;
    grid = *finer;
  }
}

/// Extends a profile straight by the margin, but not across the axis, and not from a pole.
void run_on(FittedProfile& profile, double margin, const gp_Lin& axis, const std::array<int, 4>& beside) {
  for (const bool after : {false, true}) {
    if (beside[after ? 3 : 2] >= 0) continue;
    gp_Pnt end;
    gp_Vec along;
    profile.curve->D1(after ? profile.curve->LastParameter() : profile.curve->FirstParameter(), end, along);
    const double radius = axis.Distance(end);
    if (radius == 0 || !(along.Magnitude() > 0)) continue;
    const gp_Vec out = (after ? 1 : -1) * along.Normalized();
    const double longer = std::min(margin, 0.9 * radius);
    Handle(Geom_BoundedCurve) curve(profile.curve);
    GeomLib::ExtendCurveToPoint(curve, end.Translated(longer * out), 1, after);
    profile.curve = Handle(Geom_BSplineCurve)::DownCast(curve);
  }
}

/// The profile at the middle of an angle, turned around the axis by that angle and a little farther. It stays
/// a surface of revolution: a rational B-spline has poles at twice the radius, and OpenCASCADE 7.8 takes over
/// five minutes to cut it.
Handle(Geom_Surface) revolved(const FittedProfile& profile, const gp_Ax1& axis, double angle, double margin,
                              const std::array<int, 4>& beside) {
  constexpr double whole = 2 * M_PI;
  double radius = 0;
  for (int i = 1; i <= profile.curve->NbPoles(); ++i)
    radius = std::max(radius, gp_Lin(axis).Distance(profile.curve->Pole(i)));
  const bool goes_on = beside[0] < 0 && beside[1] < 0 && angle < whole;
  const double farther = goes_on ? std::min(margin / radius, 0.45 * (whole - angle)) : 0;
  const double turn = std::min(angle + 2 * farther, whole);
  const Handle(Geom_Curve) start = Handle(Geom_Curve)::DownCast(profile.curve->Rotated(axis, -0.5 * turn));
  Handle(Geom_Surface) surface = new Geom_SurfaceOfRevolution(start, axis);
  // OpenCASCADE gives a trimmed surface no seam.
  if (turn > whole - Precision::Angular()) return surface;
  return new Geom_RectangularTrimmedSurface(surface, 0, turn, true);
}

/// The ranges of the first side's surface parameters that both sides cover.
std::array<ParameterRange, 2> common_range(const Skin& skin, const std::array<std::vector<int>, 2>& sides) {
  const Handle(Geom_Surface) base = BRep_Tool::Surface(skin.faces()[sides[0].front()].face());
  auto ranges = range_of(base, points_on_edges(skin, sides[0]), {0, 0});
  const auto others = range_of(base, points_on_edges(skin, sides[1]), {0, 0});
  for (int i = 0; i < 2; ++i) {
    if (i == 0 ? base->IsUPeriodic() : base->IsVPeriodic()) continue;
    const double low = std::max(ranges[i].low, others[i].low);
    const double high = std::min(ranges[i].high, others[i].high);
    if (low < high) ranges[i] = {low, high};
  }
  return ranges;
}

/// Extends a surface straight by the margin at the ends that are neither closed nor shared with the middle
/// beside.
Handle(Geom_Surface)
    run_on(const Handle(Geom_Surface) & surface, double margin, const std::array<int, 4>& beside) {
  auto result = Handle(Geom_BoundedSurface)::DownCast(surface);
  for (const bool in_u : {true, false}) {
    if (in_u ? surface->IsUClosed() : surface->IsVClosed()) continue;
    for (const int after : {0, 1}) {
      if (beside[(in_u ? 0 : 2) + after] < 0)
        GeomLib::ExtendSurfByLength(result, margin, 1, in_u, after == 1);
    }
  }
  return result;
}

}  // namespace

std::optional<NearMiddle> fit_middle(const Skin& skin, const std::array<std::vector<int>, 2>& sides,
                                     double tolerance, double margin, const std::array<int, 4>& beside) {
  const auto ranges = common_range(skin, sides);
  if (!(ranges[0].length() > 0) || !(ranges[1].length() > 0)) return std::nullopt;
  MiddlePoints points(skin, sides, ranges, beside);
  std::vector<int> all = with_beside(sides[0], beside);
  all.insert(all.end(), sides[1].begin(), sides[1].end());
  if (const auto axis = common_axis(skin, all)) {
    const gp_Lin line(*axis);
    auto profile = fit_profile(points, ranges[0].low + 0.5 * ranges[0].length(), ranges[1], line,
                               1e-6 * skin.size(), tolerance);
    if (!profile) return std::nullopt;
    run_on(*profile, margin, line, beside);
    return NearMiddle{revolved(*profile, *axis, ranges[0].length(), margin, beside), profile->off};
  }
  auto result = fit(points, ranges, tolerance);
  if (result) result->surface = run_on(result->surface, margin, beside);
  return result;
}

}  // namespace quadrille
