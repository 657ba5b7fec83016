/// OpenCASCADE's shape healing (ShapeFix_Face) makes missing seams; the faces that need it are found here.

#include "geometry/cad/seams.hpp"

#include <BRepAdaptor_Surface.hxx>
#include <BRepBuilderAPI_Copy.hxx>
#include <BRepTools_WireExplorer.hxx>
#include <Geom2d_Curve.hxx>
#include <ShapeBuild_ReShape.hxx>
#include <ShapeFix_Face.hxx>
#include <Standard_Failure.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "geometry/base/vector.hpp"
#include "geometry/cad/shape_parts.hpp"

namespace quadrille {

namespace {

constexpr int line_intervals = 16;  // intervals of a sampled parametric curve

struct SampledWire {
  bool has_seam = false;  ///< or a pole (a degenerate edge)
  Vector2 advance{0, 0};  ///< sum of the edges' end minus start, without the jumps between edges
  double area = 0;        ///< enclosed area, positive for a counterclockwise wire
};

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
    std::optional<Vector2> origin;
    int edges = 0;
    for (TopoDS_Iterator it(wire); it.More(); it.Next()) ++edges;
    for (BRepTools_WireExplorer it(wire, face_); it.More() && edges > 0; it.Next(), --edges) {
      const TopoDS_Edge& edge = it.Current();
      double first = 0, last = 0;
      const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face_, first, last);
      if (curve.IsNull() || !(std::abs(last - first) < 1e50)) break;
      if (edge.Orientation() == TopAbs_REVERSED) std::swap(first, last);
      const auto place = [&](int i) {
        const gp_Pnt2d p = curve->Value(first + (last - first) * i / line_intervals);
        return Vector2(p.X(), p.Y());
      };
      if (!origin) origin = place(0);
      for (int i = 0; i < line_intervals; ++i) {
        const Vector2 a = place(i) - *origin, b = place(i + 1) - *origin;
        sampled.area += 0.5 * (a.x() * b.y() - a.y() * b.x());
      }
      sampled.advance += place(line_intervals) - place(0);
      if (BRep_Tool::Degenerated(edge) || BRep_Tool::IsClosed(edge, face_)) sampled.has_seam = true;
    }
    // The test works only for wires whose edges form a chain.
    if (edges > 0)
      complete_ = false;
    else
      wires_.push_back(sampled);
  }

  TopoDS_Face face_;
  std::array<double, 2> period_{0, 0};
  bool closed_ = false, all_round_ = false, complete_ = true;
  std::vector<SampledWire> wires_;
};

/// The face with its seam, if that can be made. Changes are recorded in `context`.
TopoDS_Shape mended(const TopoDS_Face& face, const Handle(ShapeBuild_ReShape) & context) {
  ShapeFix_Face fix(face);
  fix.SetContext(context);
  fix.SetPrecision(BRep_Tool::Tolerance(face));
  if (ClosedSurfaceFace(face).has_holes_only()) fix.FixAddNaturalBound();
  fix.Perform();
  return context->Apply(face);
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
  return sampled.goes_round() || sampled.has_holes_only();
}

std::vector<EdgePiece> add_seams(std::vector<TopoDS_Face>& faces, std::vector<std::string>& problems) {
  const TopTools_IndexedMapOfShape before = map_of(faces, TopAbs_EDGE);
  const Handle(ShapeBuild_ReShape) context = new ShapeBuild_ReShape;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const TopoDS_Shape now = context->Apply(faces[i]);
    if (now.ShapeType() != TopAbs_FACE || !lacks_seam(TopoDS::Face(now))) continue;
    if (!can_be_mended(TopoDS::Face(now))) continue;
    mended(TopoDS::Face(now), context);
    problems.push_back(fmt::format("Face{} lacked a seam: shape healing has made one", i + 1));
  }
  for (TopoDS_Face& face : faces) face = TopoDS::Face(context->Apply(face));
  const TopTools_IndexedMapOfShape after = map_of(faces, TopAbs_EDGE);
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
