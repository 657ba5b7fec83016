/// Replaces BRepBndLib::AddOptimal, which takes up to 70 ms for a face: seconds for parts that are read in a
/// hundredth of a second. Measures only what may reach beyond the rest.

#include "geometry/cad/bounding_box.hpp"

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRepBndLib.hxx>
#include <Eigen/Core>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "geometry/base/trimmed_domain.hpp"

namespace quadrille {

namespace {

/// How far something reaches along x, y, z, -x, -y and -z.
using Reach = Eigen::Array<double, 6, 1>;

const Reach nowhere = Reach::Constant(-INFINITY);

Reach reach_of(const Vector3& p) {
  return (Reach() << p, -p).finished();
}

Reach reach_of(const TopoDS_Shape& part) {
  const Bnd_Box box = box_of(part);
  if (box.IsVoid()) return nowhere;
  return reach_of(to_vector(box.CornerMin())).max(reach_of(to_vector(box.CornerMax())));
}

bool is_finite(const Reach& reach) {
  return (reach.abs() < 1e50).all();
}

double diagonal_of(const Reach& reach) {
  return (reach.head<3>() + reach.tail<3>()).matrix().norm();
}

/// A curve (whose second parameter has no range) or a surface.
struct Patch {
  Vector2 low{0, 0}, high{0, 0};
  std::array<int, 2> cells{0, 0};  ///< intervals of the samples
  std::function<Vector3(const Vector2&)> point;
  std::function<bool(const Vector2&)> inside;
};

/// Extends `known` by the extent of a patch: climbs from the farthest sample in each direction by steps that
/// are halved. \param slack samples farther behind than this are skipped.
void extend(Reach& known, const Patch& patch, double slack) {
  const auto step = [&](int axis) {
    return patch.cells[axis] > 0 ? (patch.high[axis] - patch.low[axis]) / patch.cells[axis] : 0;
  };
  const Vector2 cell(step(0), step(1));
  Reach best = known - slack;
  std::array<Vector2, 6> at;
  std::array<bool, 6> found{};
  /// Keeps a point for each direction in which it is the farthest so far.
  const auto take = [&](int d, const Vector2& uv, const Vector3& p) {
    const double reached = d < 3 ? p[d] : -p[d - 3];
    if (!(reached > best[d]) || !patch.inside(uv)) return;
    best[d] = reached;
    at[d] = uv;
    found[d] = true;
  };
  for (int i = 0; i <= patch.cells[0]; ++i) {
    for (int j = 0; j <= patch.cells[1]; ++j) {
      const Vector2 uv = patch.low + Vector2(i * cell.x(), j * cell.y());
      const Vector3 p = patch.point(uv);
      for (int d = 0; d < 6; ++d) take(d, uv, p);
    }
  }
  constexpr double finest = 1e-4;  // of a cell; the error is quadratic in it
  constexpr int most_steps = 200;
  for (int d = 0; d < 6; ++d) {
    double scale = 0.5;
    for (int steps = 0; found[d] && scale > finest && steps < most_steps; ++steps) {
      const Vector2 center = at[d];
      for (int i = -1; i <= 1; ++i) {
        for (int j = -1; j <= 1; ++j) {
          if (patch.cells[1] == 0 && j != 0) continue;
          const Vector2 uv =
              (center + scale * Vector2(i * cell.x(), j * cell.y())).cwiseMax(patch.low).cwiseMin(patch.high);
          take(d, uv, patch.point(uv));
        }
      }
      if (at[d] == center) scale *= 0.5;
    }
  }
  known = known.max(best);
}

constexpr double slack_share = 0.05;  // of a patch's size: an arc between two samples is lower

int cells_for(int spans) {
  return std::clamp(4 * spans, 16, 64);
}

void extend(Reach& known, const CadEdge& edge, double size) {
  const BRepAdaptor_Curve curve(edge.edge);
  Patch patch;
  patch.low.x() = edge.first;
  patch.high.x() = edge.last;
  patch.cells[0] = curve.GetType() == GeomAbs_Line ? 1 : cells_for(curve.NbIntervals(GeomAbs_C2));
  patch.point = [&](const Vector2& uv) { return to_vector(curve.Value(uv.x())); };
  patch.inside = [](const Vector2&) { return true; };
  extend(known, patch, slack_share * size);
}

void extend(Reach& known, const CadShape& shape, const CadFace& face, double size) {
  const BRepAdaptor_Surface surface(face.face, Standard_False);
  if (surface.GetType() == GeomAbs_Plane) return;  // ends at its edges
  const TrimmedDomain domain = coarse_domain(shape, face);
  Patch patch;
  patch.low = {face.u_min, face.v_min};
  patch.high = {face.u_max, face.v_max};
  patch.cells = {cells_for(surface.NbUIntervals(GeomAbs_C2)), cells_for(surface.NbVIntervals(GeomAbs_C2))};
  patch.point = [&](const Vector2& uv) { return to_vector(surface.Value(uv.x(), uv.y())); };
  // On both sides of the point: at the height of a vertex, where two parametric curves do not quite meet, the
  // ray of the test may pass between them. The border itself is that of the edges.
  const Vector2 off(0, 1e-6 * (face.v_max - face.v_min));
  patch.inside = [&, off](const Vector2& uv) {
    return domain.empty() || (domain.inside(uv - off) && domain.inside(uv + off));
  };
  extend(known, patch, slack_share * size);
}

/// Extends `known` to where a part ends if its own box reaches farther, or else to that box.
template <class Measure>
void extend_to(Reach& known, const Reach& own, double margin, const Measure& measure) {
  if (!(own > known + margin).any()) return;
  try {
    if (!is_finite(own)) throw Standard_Failure("without end");
    measure(diagonal_of(own));
  } catch (const Standard_Failure&) {
    known = known.max(own);
  }
}

}  // namespace

Eigen::AlignedBox3d bounding_box(const CadShape& shape) {
  IdVector<FaceId, Reach> own(shape.faces.size());
  Reach wide = nowhere, known = nowhere;
  double tolerance = 0;
  for (const FaceId id : shape.faces.ids()) {
    own[id] = reach_of(shape.faces[id].face);
    wide = wide.max(own[id]);
    tolerance = std::max(tolerance, shape.faces[id].tolerance);
  }
  for (TopExp_Explorer it(shape.shape, TopAbs_EDGE, TopAbs_FACE); it.More(); it.Next())
    known = known.max(reach_of(it.Current()));
  for (TopExp_Explorer it(shape.shape, TopAbs_VERTEX, TopAbs_EDGE); it.More(); it.Next())
    known = known.max(reach_of(it.Current()));
  // The boxes of some trimmed surfaces (tori that meet their axis) do not contain the bounding edges.
  for (const CadEdge& edge : shape.edges) {
    if (edge.degenerate || !(edge.length > 0)) continue;
    tolerance = std::max(tolerance, edge.tolerance);
    const BRepAdaptor_Curve curve(edge.edge);
    for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0})
      known = known.max(reach_of(to_vector(curve.Value(edge.first + share * (edge.last - edge.first)))));
  }
  wide = wide.max(known);
  if (wide[0] == -INFINITY) return Eigen::AlignedBox3d(Vector3(0, 0, 0));
  // Sides that are right within tolerances stay unchanged, and so do the default sizes, which depend on them.
  const double margin = 1e-5 * diagonal_of(wide) + 2 * tolerance;
  if (is_finite(wide) && (wide > known + margin).any()) {
    for (const CadEdge& edge : shape.edges) {
      if (edge.degenerate || !(edge.length > 0)) continue;
      extend_to(known, reach_of(edge.edge), margin, [&](double size) { extend(known, edge, size); });
    }
    for (const FaceId id : shape.faces.ids()) {
      extend_to(known, own[id], margin, [&](double size) { extend(known, shape, shape.faces[id], size); });
    }
    wide = (wide > known + margin).select(known, wide).max(known);
  }
  return {-wide.tail<3>(), wide.head<3>()};
}

Bnd_Box box_of(const TopoDS_Shape& part) {
  Bnd_Box box;
  BRepBndLib::Add(part, box, Standard_False);
  return box;
}

}  // namespace quadrille
