#include "geometry/symmetry/mirror_planes.hpp"

#include <BRepAdaptor_Surface.hxx>
#include <BRepGProp.hxx>
#include <BRepTopAdaptor_FClass2d.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <ShapeAnalysis_Curve.hxx>
#include <ShapeAnalysis_Surface.hxx>
#include <Standard_Failure.hxx>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "geometry/base/place_text.hpp"
#include "geometry/surfaces/edge_curve.hpp"
#include "geometry/surfaces/face_surface.hpp"

namespace quadrille {

namespace {

/// What is compared first: the center and length of an edge, face (sum of its edges) or vertex (length 1).
struct Feature {
  Vector3 center{0, 0, 0};
  double length = 0;
};

/// Finds features by their centers.
template <class Id>
class Places {
 public:
  explicit Places(const IdVector<Id, Feature>& features) : features_(features) {
    for (const Id id : features.ids()) {
      if (features[id].length > 0) order_.push_back(id);
    }
    std::sort(order_.begin(), order_.end(), [&](Id a, Id b) { return key(a) < key(b); });
  }

  /// The features with the center within `reach` and the length within 2 * reach of the wanted.
  std::vector<Id> at(const Feature& wanted, double reach) const {
    const double low = direction_.dot(wanted.center) - reach;
    auto it =
        std::lower_bound(order_.begin(), order_.end(), low, [&](Id id, double x) { return key(id) < x; });
    std::vector<Id> found;
    for (; it != order_.end() && key(*it) <= low + 2 * reach; ++it) {
      const Feature& feature = features_[*it];
      if ((feature.center - wanted.center).norm() <= reach &&
          std::abs(feature.length - wanted.length) <= 2 * reach)
        found.push_back(*it);
    }
    return found;
  }

 private:
  double key(Id id) const { return direction_.dot(features_[id].center); }

  const IdVector<Id, Feature>& features_;
  // A direction that models are unlikely to be aligned with.
  const Vector3 direction_ = Vector3(0.61, 0.53, 0.59).normalized();
  std::vector<Id> order_;
};

bool is_seam(const CadEdge& edge) {
  return std::adjacent_find(edge.faces.begin(), edge.faces.end()) != edge.faces.end();
}

class Search {
 public:
  Search(const CadShape& shape, const ExecutionContext& context)
      : shape_(shape), context_(context), faces_(shape.faces.size()), edges_(shape.edges.size()) {
    for (const EdgeId edge : edges_.ids()) measure_edge(edge);
    for (const FaceId face : faces_.ids()) add_face(face);
    for (const Vector3& vertex : shape.vertices) vertices_.push_back({vertex, 1});
    edge_places_.emplace(edges_);
    face_places_.emplace(faces_);
    vertex_places_.emplace(vertices_);
  }

  std::vector<MirrorPlane> run() {
    std::vector<MirrorPlane> found;
    // A face that has only seams and poles has no feature to compare.
    if (whole_.Mass() <= 0 ||
        std::any_of(faces_.begin(), faces_.end(), [](const Feature& face) { return !(face.length > 0); }))
      return found;
    for (const Vector3& normal : candidates()) {
      if (found.size() == 3) break;
      const bool square = std::all_of(found.begin(), found.end(), [&](const MirrorPlane& plane) {
        return std::abs(plane.normal.dot(normal)) < 1e-3;
      });
      if (!square) continue;
      for (std::optional<MirrorPlane> plane : refined(normal)) {
        if (!plane || !accept(*plane)) continue;
        found.push_back(std::move(*plane));
        break;
      }
    }
    return found;
  }

 private:
  using EdgeImages = IdVector<EdgeId, std::vector<EdgeId>>;  // edges that may be an edge's mirror image

  void measure_edge(EdgeId id) {
    context_.check();
    const CadEdge& edge = shape_.edges[id];
    if (edge.degenerate || edge.faces.empty() || is_seam(edge) || !(edge.length > 0)) return;
    GProp_GProps properties;
    BRepGProp::LinearProperties(edge.edge, properties);
    edges_[id] = {to_vector(properties.CentreOfMass()), properties.Mass()};
    whole_.Add(properties);
  }

  void add_face(FaceId id) {
    Feature& face = faces_[id];
    for (const EdgeId edge : own_edges(id)) {
      face.length += edges_[edge].length;
      face.center += edges_[edge].length * edges_[edge].center;
    }
    if (face.length > 0) face.center /= face.length;
  }

  /// The edges of a face, each once, without seams and poles.
  std::vector<EdgeId> own_edges(FaceId face) const {
    std::vector<EdgeId> result;
    for (const CadWire& wire : shape_.faces[face].wires) {
      for (const Coedge& coedge : wire.coedges) {
        if (edges_[coedge.edge].length > 0) result.push_back(coedge.edge);
      }
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

  std::vector<Vector3> candidates() const {
    Eigen::Matrix3d inertia;
    const gp_Mat matrix = whole_.MatrixOfInertia();
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) inertia(i, j) = matrix(i + 1, j + 1);
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(inertia);
    const Vector3& moments = solver.eigenvalues();
    const Eigen::Matrix3d& axes = solver.eigenvectors();
    const auto equal = [&](int a, int b) { return std::abs(moments[a] - moments[b]) < 1e-3 * moments[2]; };
    std::vector<Vector3> result;
    const bool low = equal(0, 1), high = equal(1, 2);
    for (int i = 0; i < 3; ++i) {
      const bool unique = !(low && i < 2) && !(high && i > 0);
      if (unique) result.emplace_back(axes.col(i));
    }
    if (!low && !high) return result;
    const Vector3 axis = low && high ? Vector3::Zero() : Vector3(low ? axes.col(2) : axes.col(0));
    for (const Vector3& normal : ambiguous_normals()) {
      const Vector3 across = normal - axis.dot(normal) * axis;
      if (across.norm() > 0.5) result.push_back(across.normalized());
    }
    return result;
  }

  /// The coordinate axes, the directions between edges of the least frequent length, and directions at right
  /// angles to the line from the centroid to the first of these edges.
  std::vector<Vector3> ambiguous_normals() const {
    std::vector<Vector3> result{Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ()};
    const Vector3 middle = to_vector(whole_.CentreOfMass());
    const double near = 1e-6 * shape_.diagonal();
    std::vector<EdgeId> order;
    for (const EdgeId edge : edges_.ids()) {
      if (!((edges_[edge].center - middle).norm() < 1e-3 * shape_.diagonal())) order.push_back(edge);
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](EdgeId a, EdgeId b) { return edges_[a].length < edges_[b].length; });
    std::size_t from = 0, count = 0;
    for (std::size_t i = 0; i < order.size();) {
      std::size_t end = i + 1;
      while (end < order.size() && edges_[order[end]].length - edges_[order[end - 1]].length <= near) ++end;
      if (edges_[order[i]].length > 0 && (count == 0 || end - i < count)) {
        from = i;
        count = end - i;
      }
      i = end;
    }
    constexpr std::size_t most = 24;
    for (std::size_t i = from + 1; i < from + std::min(count, most); ++i) {
      const Vector3 way = edges_[order[i]].center - edges_[order[from]].center;
      if (way.norm() > near) result.push_back(way.normalized());
    }
    if (count > 0) {
      const Vector3 out = (edges_[order[from]].center - middle).normalized();
      for (int i = 0; i < 3; ++i) {
        const Vector3 across = out.cross(Vector3::Unit(i));
        if (across.norm() > 1e-3) result.push_back(across.normalized());
      }
    }
    return result;
  }

  double tolerance(double own) const { return std::max(relative_tolerance * shape_.diagonal(), own); }

  /// The plane that fits the edges and their images best, preceded by the plane normal to a coordinate axis
  /// if that is very near. None if an edge has no image.
  std::array<std::optional<MirrorPlane>, 2> refined(const Vector3& normal) const {
    const Vector3 middle = to_vector(whole_.CentreOfMass());
    MirrorPlane plane;
    plane.normal = normal;
    plane.offset = normal.dot(middle);
    const double reach = 1e-3 * shape_.diagonal();
    Eigen::Matrix3d across = Eigen::Matrix3d::Zero();
    Vector3 halfway(0, 0, 0);
    int pairs = 0;
    for (const Feature& edge : edges_) {
      if (!(edge.length > 0)) continue;
      const auto found = edge_places_->at({plane.mirrored(edge.center), edge.length}, reach);
      if (found.empty()) return {};
      if (found.size() > 1) continue;
      const Vector3& image = edges_[found.front()].center;
      across += (edge.center - image) * (edge.center - image).transpose();
      halfway += 0.5 * (edge.center + image);
      ++pairs;
    }
    if (pairs == 0) return {plane, std::nullopt};
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(across);
    if (solver.eigenvalues()[2] > reach * reach) {
      const Vector3 best = solver.eigenvectors().col(2);
      plane.normal = best.dot(normal) < 0 ? Vector3(-best) : best;
    }
    halfway /= pairs;
    int largest = 0;
    plane.normal.cwiseAbs().maxCoeff(&largest);
    if (plane.normal[largest] < 0) plane.normal = -plane.normal;
    plane.offset = plane.normal.dot(halfway);
    if (std::abs(plane.offset) < 1e-9 * shape_.diagonal()) plane.offset = 0;
    if (plane.normal[largest] < 1 - 1e-6) return {plane, std::nullopt};
    MirrorPlane along = plane;
    along.normal = Vector3::Unit(largest);
    along.offset = halfway[largest];
    if (std::abs(along.offset) < 1e-9 * shape_.diagonal()) along.offset = 0;
    return {along, plane};
  }

  /// Completes the plane with the images of faces, edges and vertices; false if one has no image.
  bool accept(MirrorPlane& plane) const {
    EdgeImages edge_images(edges_.size());
    for (const EdgeId id : edges_.ids()) {
      const Feature& edge = edges_[id];
      if (!(edge.length > 0)) continue;
      context_.check();
      const double reach = tolerance(2 * shape_.edges[id].tolerance);
      for (const EdgeId image : edge_places_->at({plane.mirrored(edge.center), edge.length}, reach)) {
        if (is_image(plane, id, image, reach)) edge_images[id].push_back(image);
      }
      if (edge_images[id].empty()) return false;
    }
    return match_faces(plane, edge_images) && match_edges(plane, edge_images) && match_vertices(plane);
  }

  /// Whether the mirror image of an edge coincides with the edge `image`.
  bool is_image(const MirrorPlane& plane, EdgeId edge, EdgeId image, double reach) const {
    const CadEdge &a = shape_.edges[edge], &b = shape_.edges[image];
    const EdgeCurve from(a), to(b);
    const auto at = [](const CadEdge& e, double share) { return e.first + share * (e.last - e.first); };
    if (a.closed() != b.closed()) return false;
    const bool forward = (plane.mirrored(from.point(a.first)) - to.point(b.first)).norm() <= reach;
    if (!a.closed()) {
      const Vector3 &first = to.point(forward ? b.first : b.last),
                    &last = to.point(forward ? b.last : b.first);
      if ((plane.mirrored(from.point(a.first)) - first).norm() > reach ||
          (plane.mirrored(from.point(a.last)) - last).norm() > reach)
        return false;
      if (from.straight() && to.straight()) return true;
    }
    const BRepAdaptor_Curve curve(b.edge);
    const int samples = from.circular() && to.circular() ? 3 : std::min(4 + 2 * from.spans(), 64);
    for (int i = 1; i <= samples; ++i) {
      const double share = i / (samples + 1.0);
      const Vector3 wanted = plane.mirrored(from.point(at(a, share)));
      if ((to.point(at(b, forward ? share : 1 - share)) - wanted).norm() <= reach) continue;
      gp_Pnt foot;
      double parameter = 0;
      const gp_Pnt point(wanted.x(), wanted.y(), wanted.z());
      if (ShapeAnalysis_Curve().Project(curve, point, 0.1 * reach, foot, parameter, Standard_False) > reach)
        return false;
    }
    return true;
  }

  bool match_faces(MirrorPlane& plane, const EdgeImages& edge_images) const {
    plane.faces.assign(faces_.size(), {});
    plane.turned.assign(faces_.size(), 0);
    FaceFlags taken(faces_.size());
    for (const FaceId face : faces_.ids()) {
      if (plane.faces[face].exists()) continue;
      context_.check();
      // The length of a face is a sum over its edges, whose errors add up.
      const double reach = 10 * tolerance(2 * shape_.faces[face].tolerance);
      std::optional<std::pair<FaceId, char>> best;
      for (const FaceId image :
           face_places_->at({plane.mirrored(faces_[face].center), faces_[face].length}, reach)) {
        if (taken[image] || !has_edges(image, face, edge_images)) continue;
        const auto turned = mirrors(plane, face, image);
        if (turned && (!best || *turned < best->second)) best = {image, *turned};
      }
      if (!best) return false;
      // A face that lies in the plane cannot be halved.
      if (best->first == face && best->second != 0) return false;
      for (const auto& [from, to] : {std::pair(face, best->first), std::pair(best->first, face)}) {
        plane.faces[from] = to;
        plane.turned[from] = best->second;
        taken[to] = 1;
      }
    }
    return true;
  }

  /// Whether each edge of a face has an image among the edges of `image`, and both have equally many edges.
  bool has_edges(FaceId image, FaceId face, const EdgeImages& edge_images) const {
    const std::vector<EdgeId> edges = own_edges(face), others = own_edges(image);
    return edges.size() == others.size() && std::all_of(edges.begin(), edges.end(), [&](EdgeId edge) {
             return std::any_of(edge_images[edge].begin(), edge_images[edge].end(), [&](EdgeId other) {
               return std::binary_search(others.begin(), others.end(), other);
             });
           });
  }

  /// 1 if a face's mirror image lies on the surface of the face `image` and is turned over, 0 if it lies on
  /// it and is not; nothing if it does not lie on it.
  std::optional<char> mirrors(const MirrorPlane& plane, FaceId face, FaceId image) const {
    const CadFace &from = shape_.faces[face], &to = shape_.faces[image];
    const FaceSurface surface(from), other(to);
    if (surface.planar() != other.planar()) return std::nullopt;
    const Handle(Geom_Surface) geometry = BRep_Tool::Surface(to.face);
    ShapeAnalysis_Surface analysis(geometry);
    const double reach = tolerance(2 * std::max(from.tolerance, to.tolerance));
    std::optional<char> turned;
    for (const Vector2& uv : inner_parameters(from)) {
      const SurfacePoint at = surface.evaluate(uv);
      const Vector3 wanted = plane.mirrored(at.point);
      const gp_Pnt2d found = analysis.ValueOfUV(gp_Pnt(wanted.x(), wanted.y(), wanted.z()), 0.1 * reach);
      const Vector2 foot(found.X(), found.Y());
      const SurfacePoint there = other.evaluate(foot);
      if ((there.point - wanted).norm() > reach) return std::nullopt;
      const Vector3 normal = surface.normal(at, uv);
      const Vector3 expected = normal - 2 * plane.normal.dot(normal) * plane.normal;
      const bool same = (expected.dot(other.normal(there, foot)) > 0) == (from.reversed == to.reversed);
      if (turned && (*turned == 0) != same) return std::nullopt;
      turned = same ? 0 : 1;
    }
    return turned;
  }

  /// Some parameter points inside a face; more if its surface is free-form.
  static std::vector<Vector2> inner_parameters(const CadFace& face) {
    const GeomAbs_SurfaceType type = BRepAdaptor_Surface(face.face, Standard_False).GetType();
    const bool free_form = type == GeomAbs_BSplineSurface || type == GeomAbs_BezierSurface ||
                           type == GeomAbs_OffsetSurface || type == GeomAbs_OtherSurface;
    const std::size_t enough = type == GeomAbs_Plane ? 1 : free_form ? 40 : 4;
    const BRepTopAdaptor_FClass2d inside(face.face, 1e-9);
    std::vector<Vector2> result;
    for (int grid = free_form ? 7 : 3; grid < 40 && result.size() < enough; grid = 2 * grid + 1) {
      result.clear();
      for (int i = 1; i <= grid; ++i) {
        for (int j = 1; j <= grid && result.size() < 2 * enough; ++j) {
          const Vector2 uv(face.u_min + (face.u_max - face.u_min) * i / (grid + 1.0),
                           face.v_min + (face.v_max - face.v_min) * j / (grid + 1.0));
          if (inside.Perform(gp_Pnt2d(uv.x(), uv.y())) == TopAbs_IN) result.push_back(uv);
        }
      }
    }
    return result;
  }

  /// Edges that coincide are told apart by their faces.
  bool match_edges(MirrorPlane& plane, const EdgeImages& edge_images) const {
    plane.edges.assign(edges_.size(), {});
    for (const EdgeId edge : edges_.ids()) {
      if (!(edges_[edge].length > 0)) continue;
      std::vector<FaceId> wanted;
      for (const FaceId face : shape_.edges[edge].faces) wanted.push_back(plane.faces[face]);
      std::sort(wanted.begin(), wanted.end());
      const auto found = std::find_if(edge_images[edge].begin(), edge_images[edge].end(),
                                      [&](EdgeId image) { return shape_.edges[image].faces == wanted; });
      if (found == edge_images[edge].end()) return false;
      plane.edges[edge] = *found;
    }
    return true;
  }

  /// Matches vertices by the ends of edges; those that bound no open edge by their place.
  bool match_vertices(MirrorPlane& plane) const {
    plane.vertices.assign(vertices_.size(), {});
    VertexFlags needed(vertices_.size());
    for (const EdgeId id : edges_.ids()) {
      const CadEdge& edge = shape_.edges[id];
      if (!plane.edges[id].exists() || edge.closed()) continue;
      const CadEdge& image = shape_.edges[plane.edges[id]];
      for (const VertexId vertex : {edge.first_vertex, edge.last_vertex}) {
        needed[vertex] = 1;
        for (const VertexId other : {image.first_vertex, image.last_vertex}) {
          if (lies_at(plane, vertex, other)) plane.vertices[vertex] = other;
        }
      }
    }
    for (const VertexId vertex : vertices_.ids()) {
      VertexId& image = plane.vertices[vertex];
      if (!image.exists()) {
        const double reach = tolerance(2 * shape_.vertex_tolerances[vertex]);
        const auto found = vertex_places_->at({plane.mirrored(vertices_[vertex].center), 1}, reach);
        if (!found.empty()) image = found.front();
      }
      if (!image.exists() && needed[vertex]) return false;
    }
    return true;
  }

  /// Whether the mirror image of a vertex lies at another vertex.
  bool lies_at(const MirrorPlane& plane, VertexId vertex, VertexId other) const {
    const double own = shape_.vertex_tolerances[vertex] + shape_.vertex_tolerances[other];
    return (plane.mirrored(shape_.vertices[vertex]) - shape_.vertices[other]).norm() <= tolerance(own);
  }

  static constexpr double relative_tolerance = 1e-7;

  const CadShape& shape_;
  const ExecutionContext& context_;
  GProp_GProps whole_;
  // Features of length 0 are not compared.
  IdVector<FaceId, Feature> faces_;
  IdVector<EdgeId, Feature> edges_;
  IdVector<VertexId, Feature> vertices_;
  std::optional<Places<FaceId>> face_places_;
  std::optional<Places<EdgeId>> edge_places_;
  std::optional<Places<VertexId>> vertex_places_;
};

}  // namespace

std::string MirrorPlane::name() const {
  for (int i = 0; i < 3; ++i) {
    if (normal == Vector3::Unit(i))
      return fmt::format("{} = {:.6g}", "xyz"[i], offset);  // 0 where it is a rounding error
  }
  const Vector3 foot = offset * normal + Vector3::Zero();  // no "-0"
  return fmt::format("normal {} through {}", place_text(normal), place_text(foot));
}

std::vector<MirrorPlane> mirror_planes(const CadShape& shape, const ExecutionContext& context) {
  try {
    return Search(shape, context).run();
  } catch (const Standard_Failure&) {
    return {};  // what cannot be measured cannot be compared
  }
}

}  // namespace quadrille
