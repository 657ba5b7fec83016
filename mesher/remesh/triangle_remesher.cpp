/// Rounds of splits, collapses, flips and moves, each of them refused where triangles would fold.

#include "mesher/remesh/triangle_remesher.hpp"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
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

/// Whether two vectors are less than 60 degrees apart.
bool look_alike(const Vector3& a, const Vector3& b) {
  constexpr double least_cosine = 0.5;
  return a.dot(b) > least_cosine * a.norm() * b.norm();
}

/// The triangles while they change, with the curves, sizes and patches that they keep.
struct Triangulation {
  Mesh mesh;
  Mesh::Property_map<Face, int> patch = add<Face>("f:patch", -1);
  Mesh::Property_map<Edge, Span> span = add<Edge>("e:span", Span());
  Mesh::Property_map<Vertex, char> hold = add<Vertex>("v:hold", static_cast<char>(free_point));
  Mesh::Property_map<Vertex, double> size = add<Vertex>("v:size", 0.0), target = add<Vertex>("v:target", 0.0);
  /// (vertices) limits of the size: the spacing of nodes on curves, and what folds require.
  Mesh::Property_map<Vertex, double> node_size = add<Vertex>("v:node_size", infinity),
                                     cap = add<Vertex>("v:cap", infinity);
  Mesh::Property_map<Vertex, int> corner = add<Vertex>("v:corner", -1);  ///< index in the surface

  Vector3 at(Vertex v) const {
    const auto& p = mesh.point(v);
    return {p.x(), p.y(), p.z()};
  }
  void put(Vertex v, const Vector3& p) { mesh.point(v) = {p.x(), p.y(), p.z()}; }
  double length(Edge e) const { return (at(mesh.vertex(e, 0)) - at(mesh.vertex(e, 1))).norm(); }
  double size_at(Edge e) const { return 0.5 * (size[mesh.vertex(e, 0)] + size[mesh.vertex(e, 1)]); }
  bool on_curve(Edge e) const { return span[e].curve >= 0; }
  Vertex opposite_corner(Halfedge h) const { return mesh.target(mesh.next(h)); }

  /// Twice the area of a face as a vector.
  Vector3 area(Face f) const {
    const Halfedge h = mesh.halfedge(f);
    const Vector3 a = at(mesh.source(h)), b = at(mesh.target(h)), c = at(opposite_corner(h));
    return (b - a).cross(c - a);
  }

  /// Splits an edge and the faces beside it. \param along length along the edge's curve, if it has one.
  /// \return the new vertex.
  Vertex split(Halfedge h, const Vector3& place, double along) {
    const Span whole = span[mesh.edge(h)];
    const Halfedge added = CGAL::Euler::split_edge(h, mesh);  // ends at the new vertex; h follows
    const Vertex v = mesh.target(added);
    put(v, place);
    size[v] = 0.5 * (size[mesh.source(added)] + size[mesh.target(h)]);
    cap[v] = std::min(cap[mesh.source(added)], cap[mesh.target(h)]);
    target[v] = target[mesh.source(added)];
    corner[v] = -1;
    node_size[v] = infinity;
    hold[v] = free_point;
    span[mesh.edge(added)] = span[mesh.edge(h)] = {};
    if (whole.curve >= 0) {
      hold[v] = held;
      const bool forward = mesh.source(added) == whole.first;
      span[mesh.edge(forward ? added : h)] = {whole.curve, whole.low, along, whole.first};
      span[mesh.edge(forward ? h : added)] = {whole.curve, along, whole.high, v};
    }
    const Halfedge back = mesh.opposite(added);
    const Halfedge before = mesh.prev(back), after = mesh.next(back);
    if (!mesh.is_border(added)) cut_face(added, mesh.next(mesh.next(added)));
    if (!mesh.is_border(back)) cut_face(before, after);
    return v;
  }

  /// Collapses a halfedge, moving its source onto its target, if that does no harm. \return whether it did.
  bool collapse(Halfedge h) {
    const Vertex gone = mesh.source(h), kept = mesh.target(h);
    const Edge e = mesh.edge(h);
    if (hold[gone] == held || (hold[gone] == passing && !on_curve(e))) return false;
    const Halfedge back = mesh.opposite(h);
    std::map<Vertex, Span> merged;  // corner beside the edge -> span of its edge to `kept`
    for (const Halfedge side : {h, back}) {
      if (mesh.is_border(side)) continue;
      const Vertex beside = opposite_corner(side);
      merged[beside] = span[mesh.edge(mesh.halfedge(kept, beside))];
    }
    if (!CGAL::Euler::does_satisfy_link_condition(e, mesh) ||
        !may_move(gone, at(kept), kept, hold[gone] == passing))
      return false;
    const Span along = span[e];
    Span beyond;
    Vertex far;
    if (along.curve >= 0) {
      for (const Halfedge other : mesh.halfedges_around_target(mesh.halfedge(gone))) {
        if (mesh.edge(other) == e || !on_curve(mesh.edge(other))) continue;
        beyond = span[mesh.edge(other)];
        far = mesh.source(other);
      }
      // Otherwise the curve's next side would coincide with another side, which may be on a curve too.
      if (mesh.halfedge(far, kept) != Mesh::null_halfedge()) return false;
    }
    const double least_cap = std::min(cap[gone], cap[kept]);
    CGAL::Euler::collapse_edge(Edge(h), mesh);
    cap[kept] = least_cap;
    for (const auto& [beside, its_span] : merged) span[mesh.edge(mesh.halfedge(beside, kept))] = its_span;
    if (along.curve >= 0) {
      const bool from_kept = along.first == kept;
      span[mesh.edge(mesh.halfedge(far, kept))] = {along.curve, std::min(along.low, beyond.low),
                                                   std::max(along.high, beyond.high), from_kept ? kept : far};
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
    const auto normal_of = [&](int of) -> Vector3& {
      for (auto& [known, normal] : normals)
        if (known == of) return normal;
      return normals.emplace_back(of, Vector3::Zero()).second;
    };
    for (const Halfedge h : mesh.halfedges_around_target(mesh.halfedge(v)))
      if (!mesh.is_border(h)) normal_of(patch[mesh.face(h)]) += area(mesh.face(h));
    for (const Halfedge h : mesh.halfedges_around_target(mesh.halfedge(v))) {
      const Vertex other = mesh.source(h);
      if (onto && other != *onto && !long_sides &&
          (at(other) - place).norm() > longest_share * 0.5 * (size[other] + size[*onto]))
        return false;
      if (mesh.is_border(h)) continue;
      const Vertex third = opposite_corner(h);
      if (onto && (other == *onto || third == *onto)) continue;
      const Vector3 a = at(other), b = at(third);
      const Vector3 now = (place - a).cross(b - a), before = area(mesh.face(h));
      const Vector3& normal = normal_of(patch[mesh.face(h)]);
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

 private:
  template <class Element, class Value>
  Mesh::Property_map<Element, Value> add(const char* name, Value initial) {
    return mesh.add_property_map<Element, Value>(name, initial).first;
  }

  void cut_face(Halfedge a, Halfedge b) {
    const int whole = patch[mesh.face(a)];
    const Halfedge added = CGAL::Euler::split_face(a, b, mesh);
    span[mesh.edge(added)] = {};
    patch[mesh.face(added)] = patch[mesh.face(mesh.opposite(added))] = whole;
  }
};

/// \param targets (points of the surface) sizes
Triangulation triangulation_of(const TriangleMesh& surface, const FeatureNetwork& network,
                               const std::vector<double>& targets, SparseCheck& check) {
  Triangulation t;
  t.mesh.reserve(static_cast<Mesh::size_type>(surface.points.size()),
                 static_cast<Mesh::size_type>(surface.triangles.size() * 3 / 2),
                 static_cast<Mesh::size_type>(surface.triangles.size()));
  for (std::size_t v = 0; v < surface.points.size(); ++v) {
    const Vector3& p = surface.points[v];
    const Vertex vertex = t.mesh.add_vertex({p.x(), p.y(), p.z()});
    t.size[vertex] = t.target[vertex] = targets[v];
  }
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    check();
    const auto& [a, b, c] = surface.triangles[i];
    const Face face = t.mesh.add_face(Vertex(a), Vertex(b), Vertex(c));
    if (face == Mesh::null_face())
      throw failure("", "the surface touches itself where its triangles cannot be distinguished");
    t.patch[face] = network.patches[i];
  }
  for (std::size_t c = 0; c < network.curves.size(); ++c) {
    const FeatureCurve& curve = network.curves[c];
    for (std::size_t k = 0; k + 1 < curve.points.size(); ++k) {
      const Vertex a(curve.points[k]), b(curve.points[k + 1]);
      t.span[t.mesh.edge(t.mesh.halfedge(a, b))] = {static_cast<int>(c), curve.along[k], curve.along[k + 1],
                                                    a};
      for (const Vertex v : {a, b})
        if (t.hold[v] == free_point) t.hold[v] = passing;
    }
    for (const int end : {curve.points.front(), curve.points.back()}) {
      t.hold[Vertex(end)] = held;
      t.corner[Vertex(end)] = end;
    }
  }
  return t;
}

/// Splits the sides of a curve at the places of its nodes.
void insert_nodes(Triangulation& t, const FeatureCurve& curve, const std::vector<double>& nodes) {
  const double near = 1e-6 * curve.length() / static_cast<double>(nodes.size());
  std::size_t k = 0;
  Vertex start(curve.points[0]);
  const auto tell = [&](Vertex v, double size) { t.node_size[v] = std::min(t.node_size[v], size); };
  tell(start, nodes[1]);
  tell(Vertex(curve.points.back()), nodes.back() - nodes[nodes.size() - 2]);
  for (std::size_t n = 1; n + 1 < nodes.size(); ++n) {
    const double s = nodes[n], size = 0.5 * (nodes[n + 1] - nodes[n - 1]);
    while (curve.along[k + 1] <= s - near) start = Vertex(curve.points[++k]);
    Vertex node;
    if (std::abs(curve.along[k + 1] - s) < near) {
      node = start = Vertex(curve.points[++k]);
    } else if (std::abs(curve.along[k] - s) < near && k > 0) {
      node = Vertex(curve.points[k]);
    } else {
      const Halfedge h = t.mesh.halfedge(start, Vertex(curve.points[k + 1]));
      node = start = t.split(h, curve.at(s), s);
    }
    t.hold[node] = held;
    tell(node, size);
  }
}

/// Reduces sizes at folds, which show that triangles are too large for the surface.
void refine_folds(Triangulation& t, SparseCheck& check) {
  constexpr double smaller = 0.6, finest = 1.0 / 8;
  for (const Edge e : t.mesh.edges()) {
    check();
    if (t.on_curve(e) || t.mesh.is_border(e)) continue;
    const Halfedge h = t.mesh.halfedge(e);
    if (look_alike(t.area(t.mesh.face(h)), t.area(t.mesh.face(t.mesh.opposite(h))))) continue;
    const double size = std::max(finest * t.target[t.mesh.source(h)], smaller * t.size_at(e));
    for (const Vertex v :
         {t.mesh.source(h), t.mesh.target(h), t.opposite_corner(h), t.opposite_corner(t.mesh.opposite(h))})
      t.cap[v] = std::min(t.cap[v], size);
  }
}

/// Computes the sizes at points: the least of target, cap and node spacing, with limited growth from there.
void find_sizes(Triangulation& t, SparseCheck& check) {
  constexpr double growth = 0.3;
  using Entry = std::pair<double, Vertex>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (const Vertex v : t.mesh.vertices()) {
    const double size = std::min({t.target[v], t.cap[v], t.node_size[v]});
    t.size[v] = size;
    if (size < t.target[v]) queue.emplace(size, v);
  }
  while (!queue.empty()) {
    check();
    const auto [size, v] = queue.top();
    queue.pop();
    if (size > t.size[v]) continue;
    for (const Vertex other : t.mesh.vertices_around_target(t.mesh.halfedge(v))) {
      const double here = size + growth * (t.at(v) - t.at(other)).norm();
      if (here >= t.size[other]) continue;
      t.size[other] = here;
      queue.emplace(here, other);
    }
  }
}

/// Whether the corners opposite an edge are far enough from the point where it would be split. In triangles
/// with almost no area they are not.
bool may_split_near(const Triangulation& t, Halfedge h, const Vector3& place) {
  constexpr double near_share = 0.1;
  for (const Halfedge side : {h, t.mesh.opposite(h)})
    if (!t.mesh.is_border(side) &&
        (t.at(t.opposite_corner(side)) - place).norm() < near_share * t.length(t.mesh.edge(h)))
      return false;
  return true;
}

/// Whether the parts of the split faces beside an edge have about the same normals as the faces.
bool may_split_at(const Triangulation& t, Halfedge h, const Vector3& place) {
  const Vector3 a = t.at(t.mesh.source(h)), b = t.at(t.mesh.target(h));
  for (const Halfedge side : {h, t.mesh.opposite(h)}) {
    if (t.mesh.is_border(side)) continue;
    const Vector3 third = t.at(t.opposite_corner(side)), normal = t.area(t.mesh.face(side));
    const Vector3 &from = side == h ? a : b, &to = side == h ? b : a;
    if (!look_alike((place - from).cross(third - from), normal) ||
        !look_alike((to - place).cross(third - place), normal))
      return false;
  }
  return true;
}

/// The Delaunay criterion: the angles opposite the side ab sum to more than 180 degrees, that is, the sum
/// of their cotangents is negative. The new triangles must not fold.
bool wants_flip(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  const Vector3 ca = a - c, cb = b - c, da = a - d, db = b - d;
  const double at_c = ca.cross(cb).norm(), at_d = da.cross(db).norm();
  constexpr double certain = 1e-6;
  if (ca.dot(cb) * at_d + da.dot(db) * at_c >= -certain * at_c * at_d) return false;
  const Vector3 first = (b - a).cross(c - a), second = (d - a).cross(b - a), normal = first + second;
  return look_alike((d - a).cross(c - a), normal) && look_alike((c - b).cross(d - b), normal);
}

/// Flips sides to the Delaunay criterion until few are left.
void flip(Triangulation& t, SparseCheck& check, int rounds = 10) {
  for (int round = 0; round < rounds; ++round) {
    int flips = 0;
    for (const Edge e : t.mesh.edges()) {
      check();
      if (t.on_curve(e) || t.mesh.is_border(e)) continue;
      const Halfedge h = t.mesh.halfedge(e), back = t.mesh.opposite(h);
      const Vertex a = t.mesh.source(h), b = t.mesh.target(h), c = t.opposite_corner(h),
                   d = t.opposite_corner(back);
      if (c == d || !wants_flip(t.at(a), t.at(b), t.at(c), t.at(d)) ||
          t.mesh.halfedge(c, d) != Mesh::null_halfedge())
        continue;
      CGAL::Euler::flip_edge(h, t.mesh);
      ++flips;
    }
    if (flips * 1000 < static_cast<int>(t.mesh.number_of_edges())) return;
  }
}

/// Splits sides that are too long, the longest first.
void split_long(Triangulation& t, const FeatureNetwork& network, const SurfaceLocator& locator,
                SparseCheck& check) {
  constexpr int rounds = 40;  // each halves the sides
  std::vector<std::pair<double, Edge>> edges;
  for (int round = 0; round < rounds; ++round) {
    edges.clear();
    for (const Edge e : t.mesh.edges()) {
      const double ratio = t.length(e) / t.size_at(e);
      // Sides on curves are not split, because their nodes are given, unless folds require smaller sizes.
      if (ratio > longest_share &&
          !(t.on_curve(e) && std::min(t.cap[t.mesh.vertex(e, 0)], t.cap[t.mesh.vertex(e, 1)]) == infinity))
        edges.emplace_back(-ratio, e);
    }
    if (edges.empty()) return;
    std::ranges::sort(edges);
    bool any = false;
    for (const auto& [ratio, e] : edges) {
      check();
      const Span span = t.span[e];
      const double middle = 0.5 * (span.low + span.high);
      const Halfedge h = t.mesh.halfedge(e);
      const Vector3 half = 0.5 * (t.at(t.mesh.source(h)) + t.at(t.mesh.target(h)));
      Vector3 place = half;
      if (span.curve >= 0) {
        place = network.curves[span.curve].at(middle);
      } else {
        // A point farther away lies on another sheet of the surface.
        const Face beside = t.mesh.face(t.mesh.is_border(h) ? t.mesh.opposite(h) : h);
        const Vector3 there = locator.nearest(t.patch[beside], half).point;
        if ((there - half).norm() < 0.4 * t.length(e) && may_split_at(t, h, there)) place = there;
      }
      if (!may_split_near(t, h, place)) continue;
      t.split(h, place, middle);
      any = true;
    }
    if (!any) return;
    flip(t, check, 2);
  }
}

/// Collapses sides that are too short, and those that end at original points on curves.
void collapse_short(Triangulation& t, SparseCheck& check) {
  const auto passes = [&](Edge e) {
    return t.on_curve(e) &&
           (t.hold[t.mesh.vertex(e, 0)] == passing || t.hold[t.mesh.vertex(e, 1)] == passing);
  };
  std::vector<std::pair<double, Edge>> edges;
  for (const Edge e : t.mesh.edges()) {
    const double ratio = t.length(e) / t.size_at(e);
    if (passes(e) || ratio < shortest_share) edges.emplace_back(ratio, e);
  }
  std::ranges::sort(edges);
  for (const auto& [ratio, e] : edges) {
    check();
    if (t.mesh.is_removed(e)) continue;
    const Halfedge h = t.mesh.halfedge(e), back = t.mesh.opposite(h);
    if (!passes(e) && !(t.length(e) < shortest_share * t.size_at(e))) continue;
    // Remove the end with the weaker hold.
    const bool forward = t.hold[t.mesh.source(h)] <= t.hold[t.mesh.target(h)];
    if (!t.collapse(forward ? h : back) && t.hold[t.mesh.source(h)] == t.hold[t.mesh.target(h)])
      t.collapse(forward ? back : h);
  }
}

/// Moves each free point to the weighted mean of the centers of its faces, and back onto its patch.
void relax(Triangulation& t, const SurfaceLocator& locator, SparseCheck& check) {
  for (const Vertex v : t.mesh.vertices()) {
    check();
    if (t.hold[v] != free_point || t.mesh.is_isolated(v) || t.mesh.is_border(v)) continue;
    Vector3 sum = Vector3::Zero();
    double weights = 0;
    int patch = -1;
    for (const Halfedge h : t.mesh.halfedges_around_target(t.mesh.halfedge(v))) {
      const Face face = t.mesh.face(h);
      const Vertex a = t.mesh.source(h), b = t.opposite_corner(h);
      const double size = (t.size[v] + t.size[a] + t.size[b]) / 3;
      const double weight = t.area(face).norm() / (size * size);
      sum += weight / 3 * (t.at(v) + t.at(a) + t.at(b));
      weights += weight;
      patch = t.patch[face];
    }
    if (!(weights > 0)) continue;
    const Vector3 place = locator.nearest(patch, sum / weights).point;
    if (t.may_move(v, place, std::nullopt, false)) t.put(v, place);
  }
}

RemeshedTriangles result_of(const Triangulation& t) {
  RemeshedTriangles made;
  std::vector<int> number(t.mesh.number_of_vertices() + t.mesh.number_of_removed_vertices(), -1);
  const auto point = [&](Vertex v) {
    int& known = number[v];
    if (known < 0) {
      known = static_cast<int>(made.mesh.points.size());
      made.mesh.points.push_back(t.at(v));
      made.surface_corner.push_back(t.corner[v]);
    }
    return known;
  };
  for (const Face face : t.mesh.faces()) {
    const Halfedge h = t.mesh.halfedge(face);
    made.mesh.triangles.push_back(
        {point(t.mesh.source(h)), point(t.mesh.target(h)), point(t.opposite_corner(h))});
    made.mesh.tags.push_back(t.patch[face]);
  }
  for (const Edge e : t.mesh.edges()) {
    const Span& span = t.span[e];
    if (span.curve < 0) continue;
    const Vertex last = t.mesh.vertex(e, t.mesh.vertex(e, 0) == span.first ? 1 : 0);
    made.sides.push_back({{point(span.first), point(last)}, span.curve, span.low, span.high});
  }
  std::ranges::sort(made.sides, {}, [](const auto& side) { return std::pair(side.curve, side.from); });
  return made;
}

}  // namespace

RemeshedTriangles remesh_triangles(const TriangleMesh& surface, const FeatureNetwork& network,
                                   const std::vector<std::vector<double>>& nodes,
                                   const SurfaceLocator& locator, const std::vector<double>& targets,
                                   ExecutionContext& context) {
  SparseCheck check(context, 256);
  Triangulation triangles = triangulation_of(surface, network, targets, check);
  for (std::size_t c = 0; c < nodes.size(); ++c) insert_nodes(triangles, network.curves[c], nodes[c]);
  constexpr int iterations = 12, last_refinement = 8;
  for (int k = 0; k < iterations; ++k) {
    context.report(Stage::triangulate, static_cast<double>(k) / iterations);
    if (k >= 2 && k <= last_refinement && k % 2 == 0) refine_folds(triangles, check);
    find_sizes(triangles, check);
    split_long(triangles, network, locator, check);
    collapse_short(triangles, check);
    flip(triangles, check);
    relax(triangles, locator, check);
  }
  flip(triangles, check);
  return result_of(triangles);
}

}  // namespace quadrille
