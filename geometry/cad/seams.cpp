/// OpenCASCADE's shape healing (ShapeFix_Face) makes missing seams; the faces that need it are found here.
/// Holes across a seam are cut here, since healing finds their crossings on one side of the seam only.

#include "geometry/cad/seams.hpp"

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Curve2d.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRepBuilderAPI_Copy.hxx>
#include <BRepTools_WireExplorer.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2dInt_GInter.hxx>
#include <Geom2d_Curve.hxx>
#include <IntRes2d_IntersectionPoint.hxx>
#include <Precision.hxx>
#include <ShapeBuild_ReShape.hxx>
#include <ShapeFix_Face.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "geometry/base/trimmed_domain.hpp"
#include "geometry/base/vector.hpp"

namespace quadrille {

namespace {

constexpr int line_intervals = 16;  // intervals of a sampled parametric curve

using Polyline = std::array<Vector2, line_intervals + 1>;

struct SampledWire {
  TopoDS_Wire wire;
  std::vector<TopoDS_Edge> edges;
  std::vector<Polyline> lines;  ///< the edges' polylines, in the direction of the wire
  bool has_seam = false;        ///< or a pole (a degenerate edge)
  Vector2 low{INFINITY, INFINITY}, high{-INFINITY, -INFINITY};
  Vector2 advance{0, 0};      ///< sum of the edges' end minus start, without the jumps between edges
  double area = 0;            ///< enclosed area, positive for a counterclockwise wire
  bool crosses_seam = false;  ///< a hole that crosses a seam or contains a piece of one
};

/// The region that a wire encloses; each edge's end is joined to the next one's start.
TrimmedDomain enclosed_by(const SampledWire& wire) {
  std::vector<Vector2> loop;
  for (const Polyline& line : wire.lines) loop.insert(loop.end(), line.begin(), line.end() - 1);
  std::vector<TrimmedDomain::Segment> segments;
  for (std::size_t i = 0; i < loop.size(); ++i) segments.push_back({loop[i], loop[(i + 1) % loop.size()]});
  return TrimmedDomain(std::move(segments));
}

class ClosedSurfaceFace {
 public:
  explicit ClosedSurfaceFace(const TopoDS_Face& face) : face_(TopoDS::Face(face.Oriented(TopAbs_FORWARD))) {
    if (BRep_Tool::Surface(face_).IsNull()) return;
    const BRepAdaptor_Surface surface(face_, Standard_False);
    if (surface.IsUClosed()) period_[0] = surface.LastUParameter() - surface.FirstUParameter();
    if (surface.IsVClosed()) period_[1] = surface.LastVParameter() - surface.FirstVParameter();
    closed_ = period_[0] > 0 || period_[1] > 0;
    all_round_ = (period_[0] > 0 && period_[1] > 0) || surface.GetType() == GeomAbs_Sphere;
    if (!closed_) return;
    for (TopoDS_Iterator it(face_); it.More() && complete_; it.Next()) {
      if (it.Value().ShapeType() == TopAbs_WIRE) sample(TopoDS::Wire(it.Value()));
    }
    for (SampledWire& wire : wires_) wire.crosses_seam = crosses_seam(wire);
  }

  /// Whether a wire runs around the surface without a seam.
  bool goes_round() const {
    return usable() && std::any_of(wires_.begin(), wires_.end(), [&](const SampledWire& wire) {
             return !wire.has_seam && !is_closed(wire);
           });
  }

  /// Whether there are only holes on a surface without a boundary of its own.
  bool has_holes_only() const {
    if (!usable() || !all_round_ || wires_.empty()) return false;
    const SampledWire* widest = nullptr;
    for (const SampledWire& wire : wires_) {
      if (wire.has_seam || !is_closed(wire)) return false;
      if (!widest || std::abs(wire.area) > std::abs(widest->area)) widest = &wire;
    }
    return widest->area < 0;
  }

  bool has_crossing_hole() const {
    return std::any_of(wires_.begin(), wires_.end(),
                       [](const SampledWire& wire) { return wire.crosses_seam; });
  }

  double period(int axis) const { return period_[axis]; }
  const std::vector<SampledWire>& wires() const { return wires_; }

 private:
  bool usable() const { return closed_ && complete_; }

  bool is_closed(const SampledWire& wire) const {
    for (const int axis : {0, 1}) {
      if (period_[axis] > 0 && std::abs(wire.advance[axis]) > 0.5 * period_[axis]) return false;
    }
    return true;
  }

  void sample(const TopoDS_Wire& wire) {
    SampledWire sampled;
    sampled.wire = wire;
    int edges = 0;
    for (TopoDS_Iterator it(wire); it.More(); it.Next()) ++edges;
    for (BRepTools_WireExplorer it(wire, face_); it.More() && edges > 0; it.Next(), --edges) {
      const TopoDS_Edge& edge = it.Current();
      double first = 0, last = 0;
      const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face_, first, last);
      if (curve.IsNull() || !(std::abs(last - first) < 1e50)) break;
      if (edge.Orientation() == TopAbs_REVERSED) std::swap(first, last);
      Polyline line;
      for (int i = 0; i <= line_intervals; ++i) {
        const gp_Pnt2d p = curve->Value(first + (last - first) * i / line_intervals);
        line[i] = {p.X(), p.Y()};
        sampled.low = sampled.low.cwiseMin(line[i]);
        sampled.high = sampled.high.cwiseMax(line[i]);
      }
      sampled.advance += line.back() - line.front();
      sampled.edges.push_back(edge);
      sampled.lines.push_back(line);
      if (BRep_Tool::Degenerated(edge) || BRep_Tool::IsClosed(edge, face_)) sampled.has_seam = true;
    }
    // The test works only for wires whose edges form a chain.
    if (edges > 0) {
      complete_ = false;
      return;
    }
    for (const Polyline& line : sampled.lines) {
      for (int i = 0; i < line_intervals; ++i) {
        const Vector2 a = line[i] - sampled.low, b = line[i + 1] - sampled.low;
        sampled.area += 0.5 * (a.x() * b.y() - a.y() * b.x());
      }
    }
    wires_.push_back(std::move(sampled));
  }

  bool crosses_seam(const SampledWire& hole) const {
    if (!usable() || hole.has_seam || !is_closed(hole)) return false;
    const TrimmedDomain enclosed = enclosed_by(hole);
    for (const SampledWire& outer : wires_) {
      for (std::size_t i = 0; i < outer.edges.size(); ++i) {
        if (!BRep_Tool::IsClosed(outer.edges[i], face_)) continue;
        if (enclosed.inside(outer.lines[i][line_intervals / 2])) return true;
        for (int k = 0; k < line_intervals; ++k) {
          if (crosses(hole, outer.lines[i][k], outer.lines[i][k + 1])) return true;
        }
      }
    }
    return false;
  }

  static bool crosses(const SampledWire& hole, const Vector2& a, const Vector2& b) {
    if ((a.cwiseMax(b).array() <= hole.low.array()).any() ||
        (a.cwiseMin(b).array() >= hole.high.array()).any())
      return false;
    const auto side = [](const Vector2& p, const Vector2& q, const Vector2& r) {
      return (q.x() - p.x()) * (r.y() - p.y()) - (q.y() - p.y()) * (r.x() - p.x());
    };
    for (const Polyline& line : hole.lines) {
      for (int i = 0; i < line_intervals; ++i) {
        const Vector2 &c = line[i], &d = line[i + 1];
        if (side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0) return true;
      }
    }
    return false;
  }

  TopoDS_Face face_;
  std::array<double, 2> period_{0, 0};
  bool closed_ = false, all_round_ = false, complete_ = true;
  std::vector<SampledWire> wires_;
};

/// Moves the parametric curve of an edge by a vector.
void move_curve(const TopoDS_Edge& edge, const TopoDS_Face& face, const Vector2& shift) {
  double first = 0, last = 0;
  const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face, first, last);
  const Handle(Geom2d_Geometry) moved = curve->Translated(gp_Vec2d(shift.x(), shift.y()));
  BRep_Builder().UpdateEdge(edge, Handle(Geom2d_Curve)::DownCast(moved), face, BRep_Tool::Tolerance(edge));
}

/// A place where an edge is to be split.
struct Cut {
  double parameter = 0;
  TopoDS_Vertex vertex;
};

/// The edges of holes and seams that intersect between their ends, and their intersection points.
std::vector<std::pair<TopoDS_Edge, std::vector<Cut>>> crossings(const TopoDS_Face& face) {
  const ClosedSurfaceFace sampled(face);
  std::vector<std::pair<TopoDS_Edge, std::vector<Cut>>> cuts;
  const auto cuts_of = [&](const TopoDS_Edge& edge) -> std::vector<Cut>& {
    for (auto& [known, list] : cuts) {
      if (known.IsSame(edge)) return list;
    }
    return cuts.emplace_back(TopoDS::Edge(edge.Oriented(TopAbs_FORWARD)), std::vector<Cut>()).second;
  };
  const auto inside = [](const BRepAdaptor_Curve2d& curve, double t) {
    const double range = curve.LastParameter() - curve.FirstParameter(), margin = 1e-7 * range;
    return t > curve.FirstParameter() + margin && t < curve.LastParameter() - margin;
  };
  const BRep_Builder builder;
  for (const SampledWire& hole : sampled.wires()) {
    if (!hole.crosses_seam) continue;
    for (const SampledWire& outer : sampled.wires()) {
      for (const TopoDS_Edge& seam : outer.edges) {
        if (!BRep_Tool::IsClosed(seam, face)) continue;
        const BRepAdaptor_Curve2d seam_curve(seam, face);
        for (const TopoDS_Edge& rim : hole.edges) {
          const BRepAdaptor_Curve2d rim_curve(rim, face);
          const Geom2dInt_GInter crossing(rim_curve, seam_curve, Precision::PConfusion(),
                                          Precision::PConfusion());
          for (int i = 1; crossing.IsDone() && i <= crossing.NbPoints(); ++i) {
            const IntRes2d_IntersectionPoint& point = crossing.Point(i);
            const double on_rim = point.ParamOnFirst(), on_seam = point.ParamOnSecond();
            if (!inside(rim_curve, on_rim) || !inside(seam_curve, on_seam)) continue;
            TopoDS_Vertex vertex;
            builder.MakeVertex(vertex, BRepAdaptor_Curve(seam).Value(on_seam),
                               std::max(BRep_Tool::Tolerance(seam), BRep_Tool::Tolerance(rim)));
            cuts_of(rim).push_back({on_rim, vertex});
            cuts_of(seam).push_back({on_seam, vertex});
          }
        }
      }
    }
  }
  return cuts;
}

/// Splits an edge into pieces that keep its curves. \returns them as a wire.
TopoDS_Wire split(const TopoDS_Edge& edge, std::vector<Cut> cuts) {
  TopoDS_Vertex first, last;
  TopExp::Vertices(edge, first, last);
  double from = 0, to = 0;
  BRep_Tool::Range(edge, from, to);
  std::sort(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) { return a.parameter < b.parameter; });
  cuts.push_back({to, last});
  const BRep_Builder builder;
  TopoDS_Wire wire;
  builder.MakeWire(wire);
  for (const Cut& cut : cuts) {
    TopoDS_Edge piece = TopoDS::Edge(edge.EmptyCopied());
    builder.Add(piece, first.Oriented(TopAbs_FORWARD));
    builder.Add(piece, cut.vertex.Oriented(TopAbs_REVERSED));
    builder.Range(piece, from, cut.parameter);
    builder.Add(wire, piece);
    first = cut.vertex;
    from = cut.parameter;
  }
  return wire;
}

/// Chains edges into wires: each edge is followed by the one that starts nearest to its end.
std::vector<TopoDS_Wire> chained(std::vector<TopoDS_Edge> edges, const TopoDS_Face& face) {
  const auto end_of = [&](const TopoDS_Edge& edge, bool last) {
    double from = 0, to = 0;
    const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face, from, to);
    const gp_Pnt2d p = curve->Value(last == (edge.Orientation() != TopAbs_REVERSED) ? to : from);
    return Vector2(p.X(), p.Y());
  };
  const BRep_Builder builder;
  std::vector<TopoDS_Wire> wires;
  while (!edges.empty()) {
    TopoDS_Wire wire;
    builder.MakeWire(wire);
    const Vector2 start = end_of(edges.front(), false);
    for (auto next = edges.begin(); next != edges.end();) {
      const Vector2 end = end_of(*next, true);
      builder.Add(wire, *next);
      edges.erase(next);
      double nearest = (end - start).norm();
      next = edges.end();
      for (auto it = edges.begin(); it != edges.end(); ++it) {
        const double distance = (end_of(*it, false) - end).norm();
        if (distance >= nearest) continue;
        nearest = distance;
        next = it;
      }
    }
    wire.Closed(Standard_True);
    wires.push_back(wire);
  }
  return wires;
}

/// For a face whose seam was split where holes cross it: removes the pieces of the seam inside holes and
/// moves the pieces of holes beyond the seam by a period, so that seam and holes become one wire.
TopoDS_Face joined_with_seam(const TopoDS_Face& source) {
  const TopoDS_Face face = TopoDS::Face(source.Oriented(TopAbs_FORWARD));
  const ClosedSurfaceFace sampled(face);
  TopTools_IndexedMapOfShape left_out;
  std::vector<TopoDS_Edge> edges;
  Vector2 low(-INFINITY, -INFINITY), high(INFINITY, INFINITY);  // range between the sides of the seam
  for (const SampledWire& hole : sampled.wires()) {
    if (!hole.crosses_seam) continue;
    const TrimmedDomain enclosed = enclosed_by(hole);
    for (const SampledWire& outer : sampled.wires()) {
      for (std::size_t i = 0; i < outer.edges.size(); ++i) {
        if (!BRep_Tool::IsClosed(outer.edges[i], face)) continue;
        if (!enclosed.inside(outer.lines[i][line_intervals / 2])) continue;
        left_out.Add(outer.edges[i]);
        const Vector2 along = (outer.lines[i].back() - outer.lines[i].front()).cwiseAbs();
        const int axis = along.x() < along.y() ? 0 : 1;
        const double center = 0.5 * (outer.low[axis] + outer.high[axis]);
        const double half = 0.5 * sampled.period(axis);
        low[axis] = center - half;
        high[axis] = center + half;
      }
    }
  }
  const BRep_Builder builder;
  TopoDS_Face result = TopoDS::Face(face.EmptyCopied());
  for (TopoDS_Iterator it(face); it.More(); it.Next()) {
    if (it.Value().ShapeType() != TopAbs_WIRE) builder.Add(result, it.Value());
  }
  for (const SampledWire& wire : sampled.wires()) {
    if (!wire.crosses_seam && !wire.has_seam) {
      builder.Add(result, wire.wire);
      continue;
    }
    for (std::size_t i = 0; i < wire.edges.size(); ++i) {
      if (left_out.Contains(wire.edges[i])) continue;
      edges.push_back(wire.edges[i]);
      if (!wire.crosses_seam) continue;
      const Vector2 middle = wire.lines[i][line_intervals / 2];
      Vector2 shift(0, 0);
      for (const int axis : {0, 1}) {
        if (middle[axis] < low[axis]) shift[axis] = sampled.period(axis);
        if (middle[axis] > high[axis]) shift[axis] = -sampled.period(axis);
      }
      if (!shift.isZero()) move_curve(wire.edges[i], face, shift);
    }
  }
  for (const TopoDS_Wire& wire : chained(std::move(edges), face)) builder.Add(result, wire);
  return TopoDS::Face(result.Oriented(source.Orientation()));
}

/// The face with its seam, if that can be made. Changes are recorded in `context`.
TopoDS_Shape mended(const TopoDS_Face& face, const Handle(ShapeBuild_ReShape) & context) {
  TopoDS_Shape result = face;
  const ClosedSurfaceFace sampled(face);
  if (!sampled.has_crossing_hole()) {
    ShapeFix_Face fix(face);
    fix.SetContext(context);
    fix.SetPrecision(BRep_Tool::Tolerance(face));
    if (sampled.has_holes_only()) fix.FixAddNaturalBound();
    fix.Perform();
    result = context->Apply(face);
  }
  if (result.ShapeType() != TopAbs_FACE) return result;
  const auto cuts = crossings(TopoDS::Face(result));
  if (cuts.empty()) return result;
  for (const auto& [edge, points] : cuts) context->Replace(edge, split(edge, points));
  result = context->Apply(result);
  const TopoDS_Face joined = joined_with_seam(TopoDS::Face(result));
  context->Replace(result, joined);
  return joined;
}

/// Whether the repair succeeds, tried on a copy of the face alone.
bool can_be_mended(const TopoDS_Face& face) {
  try {
    const TopoDS_Face copy = TopoDS::Face(BRepBuilderAPI_Copy(face, Standard_True).Shape());
    const TopoDS_Shape result = mended(copy, new ShapeBuild_ReShape);
    return !result.IsNull() && result.ShapeType() == TopAbs_FACE && !lacks_seam(TopoDS::Face(result));
  } catch (const Standard_Failure&) {
    return false;
  }
}

}  // namespace

bool lacks_seam(const TopoDS_Face& face) {
  const ClosedSurfaceFace sampled(face);
  return sampled.goes_round() || sampled.has_holes_only() || sampled.has_crossing_hole();
}

std::vector<EdgePiece> add_seams(std::vector<TopoDS_Face>& faces, std::vector<std::string>& problems) {
  TopTools_IndexedMapOfShape before, after;
  for (const TopoDS_Face& face : faces) TopExp::MapShapes(face, TopAbs_EDGE, before);
  const Handle(ShapeBuild_ReShape) context = new ShapeBuild_ReShape;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const TopoDS_Shape now = context->Apply(faces[i]);
    if (now.ShapeType() != TopAbs_FACE || !lacks_seam(TopoDS::Face(now))) continue;
    if (!can_be_mended(TopoDS::Face(now))) continue;
    mended(TopoDS::Face(now), context);
    problems.push_back(fmt::format(
        "Face{} lacked a seam or crossed it: seam and edges were cut to fit by shape healing", i + 1));
  }
  for (TopoDS_Face& face : faces) face = TopoDS::Face(context->Apply(face));
  for (const TopoDS_Face& face : faces) TopExp::MapShapes(face, TopAbs_EDGE, after);
  std::vector<EdgePiece> pieces;
  for (int i = 1; i <= before.Extent(); ++i) {
    if (after.Contains(before(i))) continue;
    const TopoDS_Shape replacement = context->Apply(before(i));
    for (TopExp_Explorer it(replacement, TopAbs_EDGE); it.More(); it.Next())
      pieces.push_back({TopoDS::Edge(before(i)), TopoDS::Edge(it.Current())});
  }
  return pieces;
}

}  // namespace quadrille
