/// Rounds of splits, collapses, flips and moves, each of them refused where triangles would fold.

#include "mesher/remesh/triangle_remesher.hpp"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <queue>

#include "geometry/base/error.hpp"

namespace quadrille {

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex = Mesh::Vertex_index;
using Halfedge = Mesh::Halfedge_index;
using Edge = Mesh::Edge_index;
using Face = Mesh::Face_index;

/// What keeps a point where it is.
enum Hold : char {
  free_point,  ///< moves on its patch
  passing,     ///< an original point of the surface on a curve: removed when possible
  held         ///< a node on a curve, or a corner
};

/// The part of a curve that an edge stands for.
struct Span {
  int curve = -1;  ///< index of the curve; -1 = none
  double low = 0, high = 0;
  Vertex first;  ///< vertex at the low end
};

/// Sides between these multiples of the size stay as they are. With them two triangles have on average the
/// area of a square of the size.
constexpr double longest_share = 1.57, shortest_share = 0.94;
constexpr double infinity = std::numeric_limits<double>::infinity();

class TriangleRemesher {
 public:
  TriangleRemesher(const TriangleMesh& surface, const FeatureNetwork& network, const SurfaceLocator& locator,
                   const std::vector<double>& targets, ExecutionContext& context)
      : surface_(surface),
        network_(network),
        locator_(locator),
        targets_(targets),
        context_(context),
        check_(context, 256) {
    build();
  }

  RemeshedTriangles run(const std::vector<std::vector<double>>& nodes) {
    for (std::size_t c = 0; c < nodes.size(); ++c) insert_nodes(static_cast<int>(c), nodes[c]);
    constexpr int iterations = 12, last_refinement = 8;
    for (int k = 0; k < iterations; ++k) {
      context_.report(Stage::triangulate, static_cast<double>(k) / iterations);
      if (k >= 2 && k <= last_refinement && k % 2 == 0) refine_folds();
      find_sizes();
      split_long();
      collapse_short();
      flip();
      relax();
    }
    flip();
    return result();
  }

 private:
  Vector3 at(Vertex v) const {
    const auto& p = mesh_.point(v);
    return {p.x(), p.y(), p.z()};
  }
  void put(Vertex v, const Vector3& p) { mesh_.point(v) = {p.x(), p.y(), p.z()}; }
  double length(Edge e) const { return (at(mesh_.vertex(e, 0)) - at(mesh_.vertex(e, 1))).norm(); }
  double size_at(Edge e) const { return 0.5 * (size_[mesh_.vertex(e, 0)] + size_[mesh_.vertex(e, 1)]); }
  bool on_curve(Edge e) const { return span_[e].curve >= 0; }
  Vertex opposite_corner(Halfedge h) const { return mesh_.target(mesh_.next(h)); }

  /// Twice the area of a face as a vector.
  Vector3 area(Face f) const {
    const Halfedge h = mesh_.halfedge(f);
    const Vector3 a = at(mesh_.source(h)), b = at(mesh_.target(h)), c = at(opposite_corner(h));
    return (b - a).cross(c - a);
  }

  void build() {
    patch_ = mesh_.add_property_map<Face, int>("f:patch", -1).first;
    span_ = mesh_.add_property_map<Edge, Span>("e:span").first;
    hold_ = mesh_.add_property_map<Vertex, char>("v:hold", free_point).first;
    size_ = mesh_.add_property_map<Vertex, double>("v:size", 0).first;
    target_ = mesh_.add_property_map<Vertex, double>("v:target", 0).first;
    node_size_ = mesh_.add_property_map<Vertex, double>("v:node_size", infinity).first;
    cap_ = mesh_.add_property_map<Vertex, double>("v:cap", infinity).first;
    corner_ = mesh_.add_property_map<Vertex, int>("v:corner", -1).first;
    mesh_.reserve(static_cast<Mesh::size_type>(surface_.points.size()),
                  static_cast<Mesh::size_type>(surface_.triangles.size() * 3 / 2),
                  static_cast<Mesh::size_type>(surface_.triangles.size()));
    for (std::size_t v = 0; v < surface_.points.size(); ++v) {
      const Vector3& p = surface_.points[v];
      const Vertex vertex = mesh_.add_vertex({p.x(), p.y(), p.z()});
      size_[vertex] = target_[vertex] = targets_[v];
    }
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
      check_();
      const auto& [a, b, c] = surface_.triangles[t];
      const Face face = mesh_.add_face(Vertex(a), Vertex(b), Vertex(c));
      if (face == Mesh::null_face())
        throw failure("", "the surface touches itself where its triangles cannot be distinguished");
      patch_[face] = network_.patches[t];
    }
    for (std::size_t c = 0; c < network_.curves.size(); ++c) {
      const FeatureCurve& curve = network_.curves[c];
      for (std::size_t k = 0; k + 1 < curve.points.size(); ++k) {
        const Vertex a(curve.points[k]), b(curve.points[k + 1]);
        span_[mesh_.edge(mesh_.halfedge(a, b))] = {static_cast<int>(c), curve.along[k], curve.along[k + 1],
                                                   a};
        hold_[a] = hold_[a] == held ? held : passing;
        hold_[b] = hold_[b] == held ? held : passing;
      }
      for (const int end : {curve.points.front(), curve.points.back()}) {
        hold_[Vertex(end)] = held;
        corner_[Vertex(end)] = end;
      }
    }
  }

  /// Splits the sides of a curve at the places of its nodes.
  void insert_nodes(int index, const std::vector<double>& nodes) {
    const FeatureCurve& curve = network_.curves[index];
    const double near = 1e-6 * curve.length() / static_cast<double>(nodes.size());
    std::size_t k = 0;
    Vertex start(curve.points[0]);
    const auto tell = [&](Vertex v, double size) { node_size_[v] = std::min(node_size_[v], size); };
    tell(start, nodes[1]);
    tell(Vertex(curve.points.back()), nodes.back() - nodes[nodes.size() - 2]);
    for (std::size_t n = 1; n + 1 < nodes.size(); ++n) {
      const double s = nodes[n], size = 0.5 * (nodes[n + 1] - nodes[n - 1]);
      while (curve.along[k + 1] <= s - near) start = Vertex(curve.points[++k]);
      if (std::abs(curve.along[k + 1] - s) < near) {
        start = Vertex(curve.points[++k]);
        hold_[start] = held;
        tell(start, size);
      } else if (std::abs(curve.along[k] - s) < near && k > 0) {
        hold_[Vertex(curve.points[k])] = held;
        tell(Vertex(curve.points[k]), size);
      } else {
        const Halfedge h = mesh_.halfedge(start, Vertex(curve.points[k + 1]));
        start = split(h, curve.at(s), s);
        tell(start, size);
      }
    }
  }

  /// Splits an edge and the faces beside it. \param along length along the edge's curve, if it has one.
  /// \return the new vertex.
  Vertex split(Halfedge h, const Vector3& place, double along) {
    const Span span = span_[mesh_.edge(h)];
    const Halfedge added = CGAL::Euler::split_edge(h, mesh_);  // ends at the new vertex; h follows
    const Vertex v = mesh_.target(added);
    put(v, place);
    size_[v] = 0.5 * (size_[mesh_.source(added)] + size_[mesh_.target(h)]);
    cap_[v] = std::min(cap_[mesh_.source(added)], cap_[mesh_.target(h)]);
    target_[v] = target_[mesh_.source(added)];
    corner_[v] = -1;
    node_size_[v] = infinity;
    hold_[v] = free_point;
    span_[mesh_.edge(added)] = span_[mesh_.edge(h)] = {};
    if (span.curve >= 0) {
      hold_[v] = held;
      const bool forward = mesh_.source(added) == span.first;
      span_[mesh_.edge(forward ? added : h)] = {span.curve, span.low, along, span.first};
      span_[mesh_.edge(forward ? h : added)] = {span.curve, along, span.high, v};
    }
    const Halfedge back = mesh_.opposite(added);
    const Halfedge before = mesh_.prev(back), after = mesh_.next(back);
    if (!mesh_.is_border(added)) cut_face(added, mesh_.next(mesh_.next(added)));
    if (!mesh_.is_border(back)) cut_face(before, after);
    return v;
  }

  void cut_face(Halfedge a, Halfedge b) {
    const int patch = patch_[mesh_.face(a)];
    const Halfedge added = CGAL::Euler::split_face(a, b, mesh_);
    span_[mesh_.edge(added)] = {};
    patch_[mesh_.face(added)] = patch_[mesh_.face(mesh_.opposite(added))] = patch;
  }

  /// Reduces sizes at folds, which show that triangles are too large for the surface.
  void refine_folds() {
    constexpr double sharp = 0.5, smaller = 0.6, finest = 1.0 / 8;  // sharp: cosine of 60 degrees
    for (const Edge e : mesh_.edges()) {
      check_();
      if (on_curve(e) || mesh_.is_border(e)) continue;
      const Halfedge h = mesh_.halfedge(e);
      const Vector3 a = area(mesh_.face(h)), b = area(mesh_.face(mesh_.opposite(h)));
      if (a.dot(b) > sharp * a.norm() * b.norm()) continue;
      const double size = std::max(finest * target_[mesh_.source(h)], smaller * size_at(e));
      for (const Vertex v :
           {mesh_.source(h), mesh_.target(h), opposite_corner(h), opposite_corner(mesh_.opposite(h))})
        cap_[v] = std::min(cap_[v], size);
    }
  }

  /// Computes the sizes at points: the least of target, cap and node spacing, with limited growth from there.
  void find_sizes() {
    constexpr double growth = 0.3;
    using Entry = std::pair<double, Vertex>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (const Vertex v : mesh_.vertices()) {
      const double size = std::min({target_[v], cap_[v], node_size_[v]});
      size_[v] = size;
      if (size < target_[v]) queue.emplace(size, v);
    }
    while (!queue.empty()) {
      check_();
      const auto [size, v] = queue.top();
      queue.pop();
      if (size > size_[v]) continue;
      for (const Vertex other : mesh_.vertices_around_target(mesh_.halfedge(v))) {
        const double here = size + growth * (at(v) - at(other)).norm();
        if (here >= size_[other]) continue;
        size_[other] = here;
        queue.emplace(here, other);
      }
    }
  }

  int patch_beside(Edge e) const {
    const Halfedge h = mesh_.halfedge(e);
    return patch_[mesh_.face(mesh_.is_border(h) ? mesh_.opposite(h) : h)];
  }

  void split_long() {
    constexpr int rounds = 40;  // each halves the sides
    std::vector<std::pair<double, Edge>> edges;
    for (int round = 0; round < rounds; ++round) {
      edges.clear();
      for (const Edge e : mesh_.edges()) {
        const double ratio = length(e) / size_at(e);
        if (ratio > longest_share && !may_not_split(e)) edges.emplace_back(-ratio, e);
      }
      if (edges.empty()) return;
      std::sort(edges.begin(), edges.end());
      bool any = false;
      for (const auto& [ratio, e] : edges) {
        check_();
        const Span span = span_[e];
        const double middle = 0.5 * (span.low + span.high);
        const Halfedge h = mesh_.halfedge(e);
        const Vector3 half = 0.5 * (at(mesh_.source(h)) + at(mesh_.target(h)));
        Vector3 place = half;
        if (span.curve >= 0) {
          place = network_.curves[span.curve].at(middle);
        } else {
          // A point farther away lies on another sheet of the surface.
          const Vector3 there = locator_.nearest(patch_beside(e), half).point;
          if ((there - half).norm() < 0.4 * length(e) && may_split_at(h, there)) place = there;
        }
        if (!may_split_near(h, place)) continue;
        split(h, place, middle);
        any = true;
      }
      if (!any) return;
      flip(2);
    }
  }

  /// Whether the corners opposite an edge are far enough from the point where it would be split. In triangles
  /// with almost no area they are not.
  bool may_split_near(Halfedge h, const Vector3& place) const {
    constexpr double near_share = 0.1;
    for (const Halfedge side : {h, mesh_.opposite(h)})
      if (!mesh_.is_border(side) &&
          (at(opposite_corner(side)) - place).norm() < near_share * length(mesh_.edge(h)))
        return false;
    return true;
  }

  /// Whether the parts of the split faces beside an edge have about the same normals as the faces.
  bool may_split_at(Halfedge h, const Vector3& place) const {
    constexpr double least_cosine = 0.5;
    const Vector3 a = at(mesh_.source(h)), b = at(mesh_.target(h));
    for (const Halfedge side : {h, mesh_.opposite(h)}) {
      if (mesh_.is_border(side)) continue;
      const Vector3 third = at(opposite_corner(side)), normal = area(mesh_.face(side));
      const Vector3 &from = side == h ? a : b, &to = side == h ? b : a;
      for (const Vector3& part :
           {Vector3((place - from).cross(third - from)), Vector3((to - place).cross(third - place))})
        if (!(part.dot(normal) > least_cosine * part.norm() * normal.norm())) return false;
    }
    return true;
  }

  /// Sides on curves are not split, because their nodes are given, unless folds require smaller sizes.
  bool may_not_split(Edge e) const {
    if (!on_curve(e)) return false;
    return cap_[mesh_.vertex(e, 0)] == infinity && cap_[mesh_.vertex(e, 1)] == infinity;
  }

  void collapse_short() {
    std::vector<std::pair<double, Edge>> edges;
    for (const Edge e : mesh_.edges()) {
      const bool passes =
          on_curve(e) && (hold_[mesh_.vertex(e, 0)] == passing || hold_[mesh_.vertex(e, 1)] == passing);
      const double ratio = length(e) / size_at(e);
      if (passes || ratio < shortest_share) edges.emplace_back(ratio, e);
    }
    std::sort(edges.begin(), edges.end());
    for (const auto& [ratio, e] : edges) {
      check_();
      if (mesh_.is_removed(e)) continue;
      const Halfedge h = mesh_.halfedge(e), back = mesh_.opposite(h);
      const bool passes =
          on_curve(e) && (hold_[mesh_.source(h)] == passing || hold_[mesh_.target(h)] == passing);
      if (!passes && !(length(e) < shortest_share * size_at(e))) continue;
      // Remove the end with the weaker hold.
      const bool forward = hold_[mesh_.source(h)] <= hold_[mesh_.target(h)];
      if (!collapse(forward ? h : back) && hold_[mesh_.source(h)] == hold_[mesh_.target(h)])
        collapse(forward ? back : h);
    }
  }

  /// Collapses a halfedge, moving its source onto its target, if that does no harm. \return whether it did.
  bool collapse(Halfedge h) {
    const Vertex gone = mesh_.source(h), kept = mesh_.target(h);
    const Edge e = mesh_.edge(h);
    if (hold_[gone] == held || (hold_[gone] == passing && !on_curve(e))) return false;
    const Halfedge back = mesh_.opposite(h);
    std::map<Vertex, Span> merged;  // corner beside the edge -> span of its edge to `kept`
    for (const Halfedge side : {h, back}) {
      if (mesh_.is_border(side)) continue;
      const Vertex corner = opposite_corner(side);
      merged[corner] = span_[mesh_.edge(mesh_.halfedge(kept, corner))];
    }
    if (!CGAL::Euler::does_satisfy_link_condition(e, mesh_) ||
        !may_move(gone, at(kept), kept, hold_[gone] == passing))
      return false;
    const Span along = span_[e];
    Span beyond;
    Vertex far;
    if (along.curve >= 0) {
      for (const Halfedge other : mesh_.halfedges_around_target(mesh_.halfedge(gone))) {
        if (mesh_.edge(other) == e || !on_curve(mesh_.edge(other))) continue;
        beyond = span_[mesh_.edge(other)];
        far = mesh_.source(other);
      }
      // Otherwise the curve's next side would coincide with another side, which may be on a curve too.
      if (mesh_.halfedge(far, kept) != Mesh::null_halfedge()) return false;
    }
    const double cap = std::min(cap_[gone], cap_[kept]);
    CGAL::Euler::collapse_edge(Edge(h), mesh_);
    cap_[kept] = cap;
    for (const auto& [corner, span] : merged) span_[mesh_.edge(mesh_.halfedge(corner, kept))] = span;
    if (along.curve >= 0) {
      const bool from_kept = along.first == kept;
      span_[mesh_.edge(mesh_.halfedge(far, kept))] = {along.curve, std::min(along.low, beyond.low),
                                                      std::max(along.high, beyond.high),
                                                      from_kept ? kept : far};
    }
    return true;
  }

  /// Whether a point can move without inverting a face around it or making sides too long.
  /// \param onto the vertex it collapses onto; common faces vanish. \param long_sides long sides are allowed.
  bool may_move(Vertex v, const Vector3& place, std::optional<Vertex> onto, bool long_sides) const {
    // Wide triangles would leave the surface where it bends.
    const double least_cosine = onto && !long_sides ? 0.7 : 0.2;
    constexpr double least_shape = 0.02;
    std::vector<std::pair<int, Vector3>> normals;  // patch around the point -> its normal there
    const auto normal_of = [&](int patch) -> Vector3& {
      for (auto& [known, normal] : normals)
        if (known == patch) return normal;
      return normals.emplace_back(patch, Vector3::Zero()).second;
    };
    for (const Halfedge h : mesh_.halfedges_around_target(mesh_.halfedge(v)))
      if (!mesh_.is_border(h)) normal_of(patch_[mesh_.face(h)]) += area(mesh_.face(h));
    for (const Halfedge h : mesh_.halfedges_around_target(mesh_.halfedge(v))) {
      const Vertex other = mesh_.source(h);
      if (onto && other != *onto && !long_sides &&
          (at(other) - place).norm() > longest_share * 0.5 * (size_[other] + size_[*onto]))
        return false;
      if (mesh_.is_border(h)) continue;
      const Vertex third = opposite_corner(h);
      if (onto && (other == *onto || third == *onto)) continue;
      const Vector3 a = at(other), b = at(third);
      const Vector3 now = (place - a).cross(b - a), before = area(mesh_.face(h));
      const Vector3& normal = normal_of(patch_[mesh_.face(h)]);
      const auto cosine = [&](const Vector3& of) {
        const double norms = of.norm() * normal.norm();
        return norms > 0 ? of.dot(normal) / norms : 0;
      };
      // A face that is folded or flat already need not improve.
      if (cosine(now) < std::min(least_cosine, cosine(before) - 1e-9)) return false;
      const double longest =
          std::max({(place - a).squaredNorm(), (b - a).squaredNorm(), (place - b).squaredNorm()});
      if (!long_sides && now.norm() < least_shape * longest && now.norm() < before.norm()) return false;
    }
    return true;
  }

  void flip(int rounds = 10) {
    for (int round = 0; round < rounds; ++round) {
      int flips = 0;
      for (const Edge e : mesh_.edges()) {
        check_();
        if (on_curve(e) || mesh_.is_border(e)) continue;
        const Halfedge h = mesh_.halfedge(e), back = mesh_.opposite(h);
        const Vertex a = mesh_.source(h), b = mesh_.target(h), c = opposite_corner(h),
                     d = opposite_corner(back);
        if (c == d || !wants_flip(at(a), at(b), at(c), at(d)) ||
            mesh_.halfedge(c, d) != Mesh::null_halfedge())
          continue;
        CGAL::Euler::flip_edge(h, mesh_);
        ++flips;
      }
      if (flips * 1000 < static_cast<int>(mesh_.number_of_edges())) return;
    }
  }

  /// The Delaunay criterion: the angles opposite the side ab sum to more than 180 degrees, that is, the sum
  /// of their cotangents is negative. The new triangles must not fold.
  static bool wants_flip(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
    const Vector3 ca = a - c, cb = b - c, da = a - d, db = b - d;
    const double at_c = ca.cross(cb).norm(), at_d = da.cross(db).norm();
    constexpr double certain = 1e-6;
    if (ca.dot(cb) * at_d + da.dot(db) * at_c >= -certain * at_c * at_d) return false;
    const Vector3 first = (b - a).cross(c - a), second = (d - a).cross(b - a), normal = first + second;
    const Vector3 now = (d - a).cross(c - a), then = (c - b).cross(d - b);
    constexpr double least_cosine = 0.5;
    return now.dot(normal) > least_cosine * now.norm() * normal.norm() &&
           then.dot(normal) > least_cosine * then.norm() * normal.norm();
  }

  /// Moves each free point to the weighted mean of the centers of its faces, and back onto its patch.
  void relax() {
    for (const Vertex v : mesh_.vertices()) {
      check_();
      if (hold_[v] != free_point || mesh_.is_isolated(v) || mesh_.is_border(v)) continue;
      Vector3 sum = Vector3::Zero();
      double weights = 0;
      int patch = -1;
      for (const Halfedge h : mesh_.halfedges_around_target(mesh_.halfedge(v))) {
        const Face face = mesh_.face(h);
        const Vertex a = mesh_.source(h), b = opposite_corner(h);
        const double size = (size_[v] + size_[a] + size_[b]) / 3;
        const double weight = area(face).norm() / (size * size);
        sum += weight / 3 * (at(v) + at(a) + at(b));
        weights += weight;
        patch = patch_[face];
      }
      if (!(weights > 0)) continue;
      const Vector3 place = locator_.nearest(patch, sum / weights).point;
      if (may_move(v, place, std::nullopt, false)) put(v, place);
    }
  }

  RemeshedTriangles result() const {
    RemeshedTriangles made;
    std::vector<int> number(mesh_.number_of_vertices() + mesh_.number_of_removed_vertices(), -1);
    const auto point = [&](Vertex v) {
      int& known = number[v];
      if (known < 0) {
        known = static_cast<int>(made.mesh.points.size());
        made.mesh.points.push_back(at(v));
        made.surface_corner.push_back(corner_[v]);
      }
      return known;
    };
    for (const Face face : mesh_.faces()) {
      const Halfedge h = mesh_.halfedge(face);
      made.mesh.triangles.push_back(
          {point(mesh_.source(h)), point(mesh_.target(h)), point(opposite_corner(h))});
      made.mesh.tags.push_back(patch_[face]);
    }
    for (const Edge e : mesh_.edges()) {
      const Span& span = span_[e];
      if (span.curve < 0) continue;
      const Vertex last = mesh_.vertex(e, mesh_.vertex(e, 0) == span.first ? 1 : 0);
      made.sides.push_back({{point(span.first), point(last)}, span.curve, span.low, span.high});
    }
    std::sort(made.sides.begin(), made.sides.end(), [](const auto& a, const auto& b) {
      return std::pair(a.curve, a.from) < std::pair(b.curve, b.from);
    });
    return made;
  }

  const TriangleMesh& surface_;
  const FeatureNetwork& network_;
  const SurfaceLocator& locator_;
  const std::vector<double>& targets_;
  ExecutionContext& context_;
  SparseCheck check_;
  Mesh mesh_;
  Mesh::Property_map<Face, int> patch_;
  Mesh::Property_map<Edge, Span> span_;
  Mesh::Property_map<Vertex, char> hold_;
  Mesh::Property_map<Vertex, double> size_, cap_, target_, node_size_;
  Mesh::Property_map<Vertex, int> corner_;
};

}  // namespace

RemeshedTriangles remesh_triangles(const TriangleMesh& surface, const FeatureNetwork& network,
                                   const std::vector<std::vector<double>>& nodes,
                                   const SurfaceLocator& locator, const std::vector<double>& targets,
                                   ExecutionContext& context) {
  return TriangleRemesher(surface, network, locator, targets, context).run(nodes);
}

}  // namespace quadrille
