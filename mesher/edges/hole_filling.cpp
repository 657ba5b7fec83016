/// Leaves out small holes: finds the loops inside faces, and the faces that such loops alone connect with the
/// rest.

#include "mesher/edges/simplified_model.hpp"

#include <BRepGProp.hxx>
#include <BRep_Builder.hxx>
#include <GProp_GProps.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Iterator.hxx>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>

#include "geometry/cad/cad_shape.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/edges/tiny_features.hpp"

namespace quadrille {

namespace {

/// A loop inside a face, around a hole or a boss.
struct Loop {
  FaceId host;
  std::size_t wire = 0;  // of the host
  Vector3 center{0, 0, 0};
  Vector3 axis{0, 0, 0};  // unit normal of the loop, out of the part
  double diameter = 0;
};

/// Faces that loops alone connect with the rest; none = the loops are free edges.
struct Hole {
  std::vector<std::size_t> loops;
  std::vector<FaceId> faces;
  bool boss = false;
};

class HoleFinder {
 public:
  HoleFinder(const CadShape& shape, FaceFlags used, const SizingOptions& sizing, double diameter)
      : shape_(shape),
        used_(std::move(used)),
        sizing_(sizing),
        diameter_(diameter),
        loop_of_(shape.edges.size(), none) {
    for (const FaceId face : used_.ids())
      if (used_[face]) find_loops(face);
  }

  const Loop& loop(std::size_t index) const { return loops_[index]; }

  std::vector<Hole> find() const {
    std::vector<Hole> result;
    std::set<FaceId> taken;
    for (std::size_t i = 0; i < loops_.size(); ++i) {
      const auto hole = hole_at(i);
      if (!hole || (!hole->faces.empty() && taken.contains(hole->faces.front()))) continue;
      // A hole in a hole: first the inner one, then the other in the next pass.
      taken.insert(hole->faces.begin(), hole->faces.end());
      result.push_back(*hole);
    }
    std::erase_if(result, [&](const Hole& hole) {
      return std::ranges::any_of(hole.loops, [&](std::size_t i) { return taken.contains(loops_[i].host); });
    });
    return result;
  }

 private:
  static constexpr int none = -1;
  static constexpr std::size_t most_faces = 64;  // of a hole

  void find_loops(FaceId face) {
    const CadFace& host = shape_.faces[face];
    if (host.wires.size() < 2) return;
    std::vector<Loop> found;
    for (std::size_t i = 0; i < host.wires.size(); ++i) {
      Loop loop{face, i};
      if (is_inner(host.wires[i]) && measure(host, host.wires[i], loop)) found.push_back(loop);
    }
    if (found.size() == host.wires.size()) return;  // which one is the outer loop?
    for (const Loop& loop : found) {
      for (const Coedge& coedge : host.wires[loop.wire].coedges)
        loop_of_[coedge.edge] = static_cast<int>(loops_.size());
      loops_.push_back(loop);
    }
  }

  /// Whether the loop closes in the parameter plane and the face lies outside of it.
  bool is_inner(const CadWire& wire) const {
    if (!wire.ordered) return false;
    std::vector<Vector2> points;
    Vector2 end{0, 0};
    for (const Coedge& coedge : wire.coedges) {
      const CadEdge& edge = shape_.edges[coedge.edge];
      if (coedge.internal || edge.degenerate || coedge.parametric_curve.IsNull()) return false;
      for (int i = 0; i <= steps_of_edge; ++i) {
        const double share = static_cast<double>(coedge.forward ? i : steps_of_edge - i) / steps_of_edge;
        points.push_back(parametric_point(coedge, edge.first + share * (edge.last - edge.first)));
      }
    }
    Eigen::AlignedBox2d box;
    double area = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vector2 &a = points[i], &b = points[(i + 1) % points.size()];
      box.extend(a);
      area += 0.5 * (a.x() * b.y() - a.y() * b.x());
    }
    constexpr double closed = 0.01;  // of its extent: a loop around a tube ends a period away
    return area < 0 && (points.front() - points.back()).norm() < closed * box.diagonal().norm();
  }

  /// \return false if the loop is larger than the holes to fill, or if something that stays lies on it.
  bool measure(const CadFace& host, const CadWire& wire, Loop& loop) const {
    if (std::ranges::any_of(wire.coedges, [&](const Coedge& coedge) { return stays(coedge.edge); }))
      return false;
    if (length_of(shape_, wire) > 2 * std::numbers::pi * diameter_) return false;  // of any outline
    const std::vector<Vector3> points = points_around(shape_, wire);
    for (const Vector3& a : points) {
      for (const Vector3& b : points) loop.diameter = std::max(loop.diameter, (a - b).norm());
    }
    if (loop.diameter > diameter_ * (1 + 1e-6)) return false;
    loop.center =
        std::accumulate(points.begin(), points.end(), Vector3(0, 0, 0)) / static_cast<double>(points.size());
    const Vector3 area = vector_area(points);
    // The wire runs the other way around than one that encloses the face.
    loop.axis = (host.reversed ? 1 : -1) * area.normalized();
    return area.norm() > 0;
  }

  bool stays(EdgeId edge) const { return is_named(shape_.edges[edge], sizing_); }
  bool stays(FaceId face) const {
    return sizing_.names_face(face.number()) ||
           std::ranges::any_of(shape_.faces[face].edges(), [&](EdgeId edge) { return stays(edge); });
  }

  /// The faces behind a loop, up to the next loops. Nothing if they are not a hole to be filled.
  std::optional<Hole> hole_at(std::size_t first) const {
    std::set<std::size_t> loops{first};
    std::set<FaceId> faces;
    std::vector<FaceId> next;
    const auto reach = [&](EdgeId edge, FaceId from) {
      for (const FaceId face : shape_.edges[edge].faces)
        if (face != from && used_[face] && faces.insert(face).second) next.push_back(face);
    };
    const Loop& mouth = loops_[first];
    for (const Coedge& coedge : shape_.faces[mouth.host].wires[mouth.wire].coedges)
      reach(coedge.edge, mouth.host);
    while (!next.empty()) {
      const FaceId face = next.back();
      next.pop_back();
      if (face == mouth.host || stays(face) || faces.size() > most_faces) return std::nullopt;
      for (const EdgeId edge : shape_.faces[face].edges()) {
        const int loop = loop_of_[edge];
        if (loop == none) reach(edge, face);
        if (loop != none) loops.insert(loop);
      }
    }
    if (loops.size() > 2) return std::nullopt;
    if (std::ranges::any_of(loops, [&](std::size_t loop) { return faces.contains(loops_[loop].host); }))
      return std::nullopt;
    Hole hole{{loops.begin(), loops.end()}, {faces.begin(), faces.end()}};
    return hole.faces.empty() || is_hole_or_boss(hole) ? std::optional(hole) : std::nullopt;
  }

  /// Whether the faces lie close to an axis, and behind their loops; in front of one they are a boss.
  bool is_hole_or_boss(Hole& hole) const {
    const Loop& mouth = loops_[hole.loops.front()];
    const Loop& other = loops_[hole.loops.back()];
    const bool goes_through = hole.loops.size() == 2;
    const Vector3 axis = goes_through ? (other.center - mouth.center).normalized() : mouth.axis;
    if (!axis.allFinite()) return false;
    Vector3 middle{0, 0, 0};
    double height = 0;
    int count = 0;
    for (const FaceId face : hole.faces) {
      for (const EdgeId edge : shape_.faces[face].edges()) {
        for (const Vector3& point : points_along(shape_.edges[edge])) {
          const Vector3 from = point - mouth.center;
          if (from.cross(axis).norm() > diameter_) return false;
          height = std::max(height, from.dot(mouth.axis));
          middle += point;
          ++count;
        }
      }
    }
    middle /= count;
    constexpr double flat = 1e-3;  // of the diameter: an outline that parts a face in two
    const double before = (middle - mouth.center).dot(mouth.axis) / mouth.diameter;
    const double behind = (middle - other.center).dot(other.axis) / other.diameter;
    hole.boss = !goes_through && before > flat;
    return hole.boss ? height <= diameter_ : std::max(before, behind) < -flat;
  }

  const CadShape& shape_;
  FaceFlags used_;
  const SizingOptions& sizing_;
  double diameter_;
  std::vector<Loop> loops_;
  IdVector<EdgeId, int> loop_of_;  // index of the loop that an edge is on
};

double area_of(const TopoDS_Face& face) {
  try {
    GProp_GProps properties;
    BRepGProp::SurfaceProperties(face, properties);
    return std::abs(properties.Mass());
  } catch (const Standard_Failure&) {
    return 0;  // nothing to compare with: the area of the face is not checked either
  }
}

/// Takes a face of a hole out of the shape. A hole that was filled in the face before is removed with it.
void leave_out(FaceId face, ShellMesh::FilledHole& with, CadShape& shape, SimplifiedModel& result) {
  result.gone[face] = 1;
  with.faces.push_back(face.number());
  for (auto& inner : result.holes) {
    if (std::erase(inner.in, face.number()) > 0 && inner.in.empty())
      with.faces.insert(with.faces.end(), inner.faces.begin(), inner.faces.end());
  }
  std::erase_if(result.holes, [](const auto& inner) { return inner.in.empty(); });
  result.areas[face] = 0;
  for (const EdgeId edge : shape.faces[face].edges()) shape.edges[edge].faces.clear();
}

/// Removes wires from a face. \param which indices of the wires \return by how much its area grows
double close(CadFace& face, const std::set<std::size_t>& which, CadShape& shape) {
  std::vector<CadWire> left;
  TopTools_MapOfShape gone;
  for (std::size_t i = 0; i < face.wires.size(); ++i) {
    if (!which.contains(i)) {
      left.push_back(face.wires[i]);
      continue;
    }
    for (const Coedge& coedge : face.wires[i].coedges) {
      shape.edges[coedge.edge].faces.clear();
      gone.Add(coedge.source);
    }
  }
  face.wires = std::move(left);
  const TopoDS_Face before = face.face;
  face.face = TopoDS::Face(before.EmptyCopied());
  for (TopoDS_Iterator wire(before); wire.More(); wire.Next()) {
    const TopExp_Explorer edge(wire.Value(), TopAbs_EDGE);
    if (!edge.More() || !gone.Contains(edge.Current())) BRep_Builder().Add(face.face, wire.Value());
  }
  return area_of(face.face) - area_of(before);
}

/// Makes holes missing in the shape. \param result of the shape
void fill(const HoleFinder& finder, const std::vector<Hole>& holes, CadShape& shape,
          SimplifiedModel& result) {
  std::map<FaceId, std::set<std::size_t>> wires;  // to be left out, by host
  for (const Hole& hole : holes) {
    ShellMesh::FilledHole filled;
    filled.center = finder.loop(hole.loops.front()).center;
    filled.boss = hole.boss;
    for (const std::size_t i : hole.loops) {
      const Loop& loop = finder.loop(i);
      filled.in.push_back(loop.host.number());
      filled.diameter = std::max(filled.diameter, loop.diameter);
      wires[loop.host].insert(loop.wire);
    }
    for (const FaceId face : hole.faces) leave_out(face, filled, shape, result);
    std::ranges::sort(filled.in);
    std::ranges::sort(filled.faces);
    result.holes.push_back(std::move(filled));
  }
  for (const auto& [host, which] : wires) result.areas[host] += close(shape.faces[host], which, shape);
}

}  // namespace

SimplifiedModel fill_holes(const CadModel& model, const FaceFlags& used, const SizingOptions& sizing,
                           double diameter) {
  constexpr int most_passes = 8;  // holes inside holes
  if (!(diameter > 0)) return SimplifiedModel(model);
  const auto shape = std::make_shared<CadShape>(model.shape());
  SimplifiedModel result((CadModel(shape)));
  for (int pass = 0; pass < most_passes; ++pass) {
    const HoleFinder finder(*shape, result.left(used), sizing, diameter);
    const std::vector<Hole> holes = finder.find();
    if (holes.empty()) break;
    fill(finder, holes, *shape, result);
  }
  std::ranges::stable_sort(result.holes, {}, &ShellMesh::FilledHole::in);
  return result;
}

}  // namespace quadrille
