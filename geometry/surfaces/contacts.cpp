/// Joins faces with shared edges to parts, then measures edges against faces whose bounding boxes meet.

#include "geometry/surfaces/contacts.hpp"

#include <BRepAdaptor_Surface.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <Standard_Failure.hxx>
#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "geometry/cad/bounding_box.hpp"
#include "geometry/cad/sewing.hpp"
#include "geometry/cad/shape_parts.hpp"
#include "geometry/surfaces/edge_curve.hpp"

namespace quadrille {

namespace {

constexpr double least_tolerance = 1e-7;  ///< share of the diagonal
constexpr int most_tests = 20000;         ///< of an edge against a face

/// The faces of the model by part.
std::vector<std::vector<FaceId>> parts_of(const CadShape& shape) {
  const int count = static_cast<int>(shape.faces.size());
  boost::disjoint_sets_with_storage<> unions(shape.faces.size() + shape.vertices.size());
  for (const CadEdge& edge : shape.edges) {
    for (const FaceId face : edge.faces) {
      unions.union_set(edge.faces.front().index(), face.index());
      for (const VertexId vertex : {edge.first_vertex, edge.last_vertex})
        if (vertex.exists()) unions.union_set(face.index(), count + vertex.index());
    }
  }
  for (const FaceId face : shape.faces.ids())  // where others touch it in a point
    for (const InnerVertex& inner : shape.faces[face].inner_vertices)
      unions.union_set(face.index(), count + inner.vertex.index());
  const TopTools_IndexedMapOfShape faces = map_of(shape.shape, TopAbs_FACE);
  for (TopExp_Explorer solid(shape.shape, TopAbs_SOLID); solid.More(); solid.Next()) {
    const std::vector<TopoDS_Shape> own = list_of(solid.Current(), TopAbs_FACE);
    for (const TopoDS_Shape& face : own)
      unions.union_set(faces.FindIndex(own.front()) - 1, faces.FindIndex(face) - 1);
  }
  std::map<std::size_t, std::size_t> part_of;  // by representative
  std::vector<std::vector<FaceId>> parts;
  for (const FaceId face : shape.faces.ids()) {
    const auto [part, is_new] = part_of.try_emplace(unions.find_set(face.index()), parts.size());
    if (is_new) parts.emplace_back();
    parts[part->second].push_back(face);
  }
  return parts;
}

class Search {
 public:
  Search(const CadShape& shape, std::vector<std::vector<FaceId>> parts, const ExecutionContext& context)
      : shape_(shape),
        context_(context),
        parts_(std::move(parts)),
        tolerance_(least_tolerance * shape.diagonal()),
        part_of_(shape.faces.size()),
        boxes_(shape.faces.size()),
        edge_boxes_(shape.edges.size()),
        edges_of_(shape.faces.size()) {
    for (std::size_t part = 0; part < parts_.size(); ++part) {
      Bnd_Box all;
      for (const FaceId face : parts_[part]) {
        part_of_[face] = static_cast<int>(part);
        boxes_[face] = wider_box_of(shape.faces[face].face);
        all.Add(boxes_[face]);
      }
      part_boxes_.push_back(all);
    }
    for (const EdgeId id : shape.edges.ids()) {
      const CadEdge& edge = shape.edges[id];
      if (edge.degenerate || edge.faces.empty() || !(edge.length > 0)) continue;
      edge_boxes_[id] = wider_box_of(edge.edge);
      for (const FaceId face : edge.faces)
        if (edges_of_[face].empty() || edges_of_[face].back() != id) edges_of_[face].push_back(id);
    }
  }

  Contacts run() {
    find_edges_on_edges();
    for (std::size_t a = 0; a < parts_.size(); ++a) {
      context_.check();
      for (std::size_t b = a + 1; b < parts_.size(); ++b)
        if (!part_boxes_[a].IsOut(part_boxes_[b])) test(static_cast<int>(a), static_cast<int>(b));
    }
    for (const auto& [parts, faces] : met_) result_.faces.push_back(faces);
    std::sort(result_.faces.begin(), result_.faces.end());
    result_.free_edges = !met_.empty() && free_ == met_.size() && !faces_coincide_;
    return std::move(result_);
  }

 private:
  Bnd_Box wider_box_of(const TopoDS_Shape& part) const {
    Bnd_Box box = box_of(part);
    box.Enlarge(tolerance_);
    return box;
  }

  double reach(double own, double other) const { return std::max({own, other, tolerance_}); }

  /// Records that the parts of two faces touch. Returns whether that is new.
  bool add(FaceId a, FaceId b) {
    const std::array<int, 2> parts{std::min(part_of_[a], part_of_[b]), std::max(part_of_[a], part_of_[b])};
    return met_.emplace(parts, std::array{std::min(a, b).number(), std::max(a, b).number()}).second;
  }

  /// Edges with the same ends and middle. Sorting by the middle keeps this fast where all faces lie apart.
  void find_edges_on_edges() {
    struct Middle {
      Vector3 point;
      EdgeId edge;
    };
    std::vector<Middle> middles;
    double widest = tolerance_;
    for (const EdgeId id : shape_.edges.ids()) {
      const CadEdge& edge = shape_.edges[id];
      if (edge_boxes_[id].IsVoid()) continue;
      middles.push_back({EdgeCurve(edge).point((edge.first + edge.last) / 2), id});
      widest = std::max(widest, edge.tolerance);
    }
    std::stable_sort(middles.begin(), middles.end(),
                     [](const Middle& a, const Middle& b) { return a.point.x() < b.point.x(); });
    for (std::size_t i = 0; i < middles.size(); ++i)
      for (std::size_t j = i + 1; j < middles.size(); ++j) {
        if (middles[j].point.x() - middles[i].point.x() > widest) break;
        const CadEdge &a = shape_.edges[middles[i].edge], &b = shape_.edges[middles[j].edge];
        if (part_of_[a.faces.front()] == part_of_[b.faces.front()]) continue;
        const double near = reach(a.tolerance, b.tolerance);
        if ((middles[i].point - middles[j].point).norm() > near || !same_ends(a, b, near)) continue;
        ++result_.edges;
        const FaceId face = a.faces.front(), other = b.faces.front();
        if (add(face, other) && a.faces.size() == 1 && b.faces.size() == 1) ++free_;
        const std::size_t common = ++edges_in_common_[{std::min(face, other), std::max(face, other)}];
        if (common == edges_of_[face].size() && common == edges_of_[other].size() &&
            lies_on(shape_.faces[face].face, shape_.faces[other].face, near))
          faces_coincide_ = true;
      }
  }

  static bool same_ends(const CadEdge& a, const CadEdge& b, double near) {
    const EdgeCurve first(a), second(b);
    const Vector3 start = first.point(a.first), end = first.point(a.last);
    const Vector3 other_start = second.point(b.first), other_end = second.point(b.last);
    return ((start - other_start).norm() <= near && (end - other_end).norm() <= near) ||
           ((start - other_end).norm() <= near && (end - other_start).norm() <= near);
  }

  /// Looks for the first two faces of two parts that touch.
  void test(int a, int b) {
    if (met_.count({a, b}) > 0) return;
    for (const FaceId face : parts_[a]) {
      if (boxes_[face].IsOut(part_boxes_[b])) continue;
      for (const FaceId other : parts_[b]) {
        if (boxes_[face].IsOut(boxes_[other])) continue;
        if (!touch(face, other) && !touch(other, face)) continue;
        add(face, other);
        return;
      }
    }
  }

  /// Whether a face is plane and an edge stays off it: on one side of the plane or, if it is straight,
  /// through a place of the plane away from the face.
  bool misses_plane(EdgeId id, FaceId face, double near) const {
    const BRepAdaptor_Surface surface(TopoDS::Face(shape_.faces[face].face), Standard_False);
    if (surface.GetType() != GeomAbs_Plane) return false;
    const Vector3 origin = to_vector(surface.Plane().Location()),
                  normal = to_vector(surface.Plane().Axis().Direction().XYZ());
    const Bnd_Box& box = edge_boxes_[id];
    const Vector3 low = to_vector(box.CornerMin()), high = to_vector(box.CornerMax());
    const Vector3 middle = 0.5 * (low + high), half = 0.5 * (high - low);
    if (std::abs((middle - origin).dot(normal)) - half.dot(normal.cwiseAbs()) > near) return true;
    const CadEdge& edge = shape_.edges[id];
    const EdgeCurve curve(edge);
    if (!curve.straight()) return false;
    const Vector3 a = curve.point(edge.first), b = curve.point(edge.last);
    const double from = (a - origin).dot(normal), to = (b - origin).dot(normal);
    if (std::min(std::abs(from), std::abs(to)) > near && from * to > 0) return true;
    constexpr double steep = 0.1;  // sine of the angle to the plane
    if (std::abs(to - from) < steep * (b - a).norm()) return false;
    const Vector3 place = a + from / (from - to) * (b - a);
    Bnd_Box around = boxes_[face];
    around.Enlarge(near / steep);
    return around.IsOut(gp_Pnt(place.x(), place.y(), place.z()));
  }

  /// Whether an edge of one face touches the other.
  bool touch(FaceId edges_of, FaceId face) {
    const CadFace& other = shape_.faces[face];
    for (const EdgeId id : edges_of_[edges_of]) {
      const double near = reach(shape_.edges[id].tolerance, other.tolerance);
      if (edge_boxes_[id].IsOut(boxes_[face]) || misses_plane(id, face, near)) continue;
      if (++tests_ > most_tests) {
        result_.all_tested = false;
        return false;
      }
      context_.check();
      try {
        const BRepExtrema_DistShapeShape distance(shape_.edges[id].edge, other.face);
        if (distance.IsDone() && distance.Value() <= near) return true;
      } catch (const Standard_Failure&) {
        // Its distance is unknown. Other edges decide.
      }
    }
    return false;
  }

  const CadShape& shape_;
  const ExecutionContext& context_;
  std::vector<std::vector<FaceId>> parts_;
  double tolerance_;
  IdVector<FaceId, int> part_of_;
  IdVector<FaceId, Bnd_Box> boxes_;
  IdVector<EdgeId, Bnd_Box> edge_boxes_;
  IdVector<FaceId, std::vector<EdgeId>> edges_of_;
  std::vector<Bnd_Box> part_boxes_;
  std::map<std::array<int, 2>, std::array<int, 2>> met_;
  std::map<std::array<FaceId, 2>, std::size_t> edges_in_common_;
  std::size_t free_ = 0;
  bool faces_coincide_ = false;
  int tests_ = 0;
  Contacts result_;
};

}  // namespace

std::string advice(std::string_view remedy, const std::set<std::string_view>& tried) {
  if (tried.count(remedy) > 0 && remedy == "keep_features") return "a smaller size there may part them";
  if (tried.count(remedy) > 0)
    return fmt::format(
        "they are left after `{}`: parts that touch in a point or only graze each other have no "
        "line in common, gaps need a larger tolerance of `sew`, all else is to be repaired in "
        "the program that made the file",
        remedy);
  if (remedy == "sew") return "`sew` joins such edges";
  return remedy == "imprint" ? "`imprint` joins parts that touch or cross"
                             : "`keep_features` meshes what is thin between them";
}

std::string_view Contacts::remedy() const {
  if (faces.empty()) return "";
  return free_edges ? "sew" : "imprint";
}

std::string Contacts::sentence(const std::set<std::string_view>& tried) const {
  if (faces.empty()) return "";
  constexpr std::size_t pairs_shown = 4;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(pairs_shown, faces.size()); ++i)
    names.push_back(fmt::format("Face{} and Face{}", faces[i][0], faces[i][1]));
  const char* more = faces.size() > pairs_shown ? ", ..." : "";
  const std::string along =
      edges > 0 ? fmt::format(", {} pair(s) of their edges lie on each other", edges) : "";
  return fmt::format(
      "{}{} pair(s) of parts touch or cross without sharing edges ({}{}){}, so that their meshes are "
      "not joined: {}",
      all_tested ? "" : "at least ", faces.size(), fmt::join(names, "; "), more, along,
      advice(remedy(), tried));
}

Contacts contacts(const CadShape& shape, const ExecutionContext& context) {
  std::vector<std::vector<FaceId>> parts = parts_of(shape);
  if (parts.size() < 2) return {};
  return Search(shape, std::move(parts), context).run();
}

}  // namespace quadrille
