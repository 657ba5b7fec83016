/// Makes a grid where the outline suits one; otherwise triangulates, pairs, cleans up, splits and smooths.

#include "mesher/shell/face_mesher.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <type_traits>

#include <fmt/format.h>

#include "geometry/base/error.hpp"
#include "geometry/base/place_text.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/edges/grid_rows.hpp"
#include "mesher/faces/boundary_crossings.hpp"
#include "mesher/faces/face_grid.hpp"
#include "mesher/faces/face_triangulation.hpp"
#include "mesher/faces/hole_rings.hpp"
#include "mesher/faces/loop_filling.hpp"
#include "mesher/faces/point_placement.hpp"
#include "mesher/mesh/criteria.hpp"
#include "mesher/mesh/quad_geometry.hpp"
#include "mesher/mesh/quality.hpp"
#include "mesher/mesh/renumbering.hpp"
#include "mesher/pairing/recombine.hpp"
#include "mesher/quads/criteria_patch.hpp"
#include "mesher/quads/improve.hpp"
#include "mesher/quads/mending.hpp"
#include "mesher/quads/ring_quads.hpp"
#include "mesher/quads/subdivision.hpp"
#include "mesher/quads/unfold_in_space.hpp"
#include "mesher/shell/boundary_sides.hpp"

namespace quadrille {

namespace {

class CadSmoothingSurface : public SmoothingSurface {
 public:
  explicit CadSmoothingSurface(const FaceSurface& surface) : surface_(surface) {}
  Vector3 move(Vector2& uv, const Vector3& target, Vector3& normal) const override {
    const SurfacePoint at = surface_.move(uv, target);
    normal = surface_.normal(at, uv);
    return at.point;
  }

 private:
  const FaceSurface& surface_;
};

class FaceMesher {
 public:
  FaceMesher(const CadShape& shape, FaceId face, const FaceChart& chart, const BoundaryNodes& nodes,
             const SizingField& field, const MeshOptions& options, const FaceRecipe& recipe,
             ExecutionContext& context)
      : shape_(shape),
        face_(face),
        nodes_(nodes),
        options_(options),
        recipe_(recipe),
        context_(context),
        chart_(chart),
        surface_(*chart.surface),
        domain_(enclosed_domain(chart.boundary)),
        size_at_(field, face) {}

  FaceMesh run() {
    if (recipe_.off != FaceRecipe::Off::none) return finish(mesh_freely(chart_.boundary, domain_));
    if (!recipe_.mapped) return mesh_without_grid();
    auto grid = mesh_as_grid();
    if (!grid) return mesh_without_grid();
    if (has_kept_edge(shape_.faces[face_], nodes_)) return std::move(*grid);  // flat rows are wanted
    const bool is_stepped = nodes_.sides[face_].outline == FaceSides::Outline::stepped;
    const double much = is_stepped ? 0.01 : 0.05, better = is_stepped ? 1 : 2;
    // A mesh replaces a wasteful grid if it has less than `fewer` times as many quads, and at most
    // `most_outside` times as many outside the limits. Sliding nodes later mends most of those.
    constexpr double fewer = 0.8, most_outside = 0.05;
    const double outside = is_stepped || has_rows(*grid) ? share_outside(*grid) : 0;
    const bool wasteful = !has_divided_edge(shape_.faces[face_], nodes_) &&
                          wastes_quads(grid->points, grid->quads, grid->nodes.size(), 1.5);
    if (wasteful || outside > much) {  // nodes that one side has only for its neighbors squeeze the rows
      try {
        FaceMesh free = mesh_without_grid();
        const double left = share_outside(free);
        const double share = static_cast<double>(free.quads.size()) / static_cast<double>(grid->quads.size());
        const double bound = std::max(outside, most_outside / share);
        if (better * left < outside || (wasteful && share < fewer && left <= bound)) return free;
      } catch (const FaceProblem&) {
        context_.check();  // keep the grid, which has no problem
      }
    }
    return std::move(*grid);
  }

 private:
  /// The share of quads outside the usual limits for criteria other than warp. In large meshes a sample of
  /// about a thousand quads is measured.
  static double share_outside(const FaceMesh& mesh) {
    constexpr std::size_t enough = 1000;
    const std::size_t step = 1 + mesh.quads.size() / enough;
    const CriteriaLimits limits;
    const auto& p = mesh.points;
    int outside = 0, measured = 0;
    for (std::size_t at = 0; at < mesh.quads.size(); at += step, ++measured) {
      const auto [a, b, c, d] = mesh.quads[at];
      const CriteriaValues values = measure_criteria(p[a], p[b], p[c], p[d]);
      for (std::size_t i = 0; i < criterion_count; ++i) {
        const auto criterion = static_cast<Criterion>(i);
        if (criterion == Criterion::warp || !limits.fails(criterion, values[i])) continue;
        ++outside;
        break;
      }
    }
    return static_cast<double>(outside) / std::max(1, measured);
  }

  /// Whether there are more than `most` times the quads that the sizes ask for, plus half of the `rim`
  /// boundary segments. Rows that are fine for one edge also run through areas that want larger quads.
  bool wastes_quads(const std::vector<Vector3>& p, const std::vector<std::array<int, 4>>& quads,
                    std::size_t rim, double most) {
    double wanted = 0;
    SparseCheck check(context_);
    for (const auto& [a, b, c, d] : quads) {
      check();
      const double size = size_at_(0.25 * (p[a] + p[b] + p[c] + p[d]));
      wanted += 0.5 * (p[c] - p[a]).cross(p[d] - p[b]).norm() / (size * size);
    }
    return static_cast<double>(quads.size()) > most * wanted + 0.5 * static_cast<double>(rim);
  }

  /// Whether a grid has more than 1.5 quads per boundary node: over three rows if long, over six if square.
  static bool has_rows(const FaceMesh& grid) {
    return 2 * static_cast<double>(grid.quads.size()) > 3 * static_cast<double>(grid.nodes.size());
  }

  FaceMesh mesh_without_grid() {
    if (options_.rings > 0 && recipe_.clean_up) {
      const HoleRings rings = place_rings(chart_.boundary, surface_, domain_, options_.rings);
      if (!rings.holes.empty()) {
        try {
          return mesh_inside(rings);
        } catch (const FaceProblem&) {
          context_.check();  // mesh it without rings
        }
      }
    }
    return finish(mesh_freely(chart_.boundary, domain_));
  }

  FaceMesh mesh_inside(const HoleRings& rings) {
    FaceQuads quads = mesh_freely(rings.inside, enclosed_domain(rings.inside));
    add_ring_quads(quads, rings, surface_);
    improve(quads, false);
    return finish(std::move(quads));
  }

  /// To quads of twice the size, sizes seem to grow twice as fast, and clean-up leaves rows that continue
  /// where they should end. So large faces with too many quads are meshed at the final size instead. So are
  /// faces of few quads if the parts of larger quads are poor.
  FaceQuads mesh_freely(const FaceBoundary& boundary, const TrimmedDomain& domain) {
    constexpr std::size_t few = 200;
    constexpr double too_many = 1.1, poor = 0.1, gain = 0.6;
    FaceQuads quads = make_quads(boundary, triangulate(boundary, domain));
    if (boundary.stride != 2 || !recipe_.clean_up) return quads;
    const QuadMesh& mesh = quads.surface_mesh.mesh;
    const bool is_large = mesh.quads.size() > few;
    const double bad = is_large ? 0 : badness(mesh);
    if (is_large ? !wastes_quads(mesh.points, mesh.quads, 2 * boundary.segments.size(), too_many)
                 : bad < poor * static_cast<double>(mesh.quads.size()))
      return quads;
    try {
      const FaceBoundary fine = halved(boundary);
      FaceQuads direct = make_quads(fine, triangulate(fine, domain));
      const QuadMesh& other = direct.surface_mesh.mesh;
      if (is_large ? !is_folded(other) : badness(other) < gain * bad) return direct;
    } catch (const FaceProblem&) {
      context_.check();  // keep the first quads
    }
    return quads;
  }

  /// The sum over the quads of how far their objective exceeds `fine`. Each quad counts up to `most`.
  static double badness(const QuadMesh& mesh) {
    constexpr double fine = 0.5, most = 10;
    double sum = 0;
    const auto& p = mesh.points;
    for (const auto& [a, b, c, d] : mesh.quads)
      sum += std::clamp(measure_objective(p[a], p[b], p[c], p[d]).value - fine, 0.0, most);
    return sum;
  }

  FaceQuads make_quads(const FaceBoundary& boundary, FaceTriangulation triangulation) {
    if (boundary.stride == 2)
      tie_across_gaps(triangulation.mesh, triangulation.normals, triangulation.segments);
    FaceQuads quads = recombine_face(triangulation, boundary.stride);
    improve(quads, recipe_.clean_up);
    if (boundary.stride == 2) {
      cut_flat_quads(quads.surface_mesh.mesh, quads.surface_mesh.normals, triangulation.segments, context_);
      quads = subdivide(quads, triangulation.segments, surface_, context_);
      improve(quads, false);
    }
    mend_folded(quads);
    if (recipe_.off != FaceRecipe::Off::none) leave_surface(quads);
    return quads;
  }

  static bool is_folded(const QuadMesh& mesh) {
    const auto& p = mesh.points;
    return std::any_of(mesh.quads.begin(), mesh.quads.end(), [&](const std::array<int, 4>& q) {
      return quad_scaled_jacobian(p[q[0]], p[q[1]], p[q[2]], p[q[3]]) <= no_jacobian;
    });
  }

  /// Replaces quads if moving nodes left some inverted.
  void mend_folded(FaceQuads& quads) {
    const StageTimer timer(context_, Stage::improve);
    if (!is_folded(quads.surface_mesh.mesh)) return;
    std::vector<char> changed;
    mend_quads(quads.surface_mesh, CadSmoothingSurface(surface_), folded_objective, changed, context_);
    keep_poles(quads);
  }

  /// Moves nodes of inverted quads off the surface, and notes how far.
  void leave_surface(FaceQuads& quads) {
    SurfaceMesh& mesh = quads.surface_mesh;
    const std::vector<char> moved = unfold_in_space(mesh.mesh, mesh.fixed, context_);
    off_.assign(moved.size(), 0);
    for (std::size_t i = 0; i < moved.size(); ++i) {
      const Vector3& at = mesh.mesh.points[i];
      if (moved[i]) off_[i] = (surface_.project(mesh.parameters[i], at).point - at).norm();
    }
  }

  /// Adapts `pole` after quads were replaced. Poles are fixed points, which keep their indices.
  static void keep_poles(FaceQuads& quads) {
    quads.pole.resize(quads.surface_mesh.mesh.points.size(), 0);
    std::fill(quads.pole.begin() + static_cast<long>(quads.nodes.size()), quads.pole.end(), 0);
  }

  std::optional<FaceMesh> mesh_as_grid() {
    const StageTimer timer(context_, Stage::triangulate);
    auto grid = make_grid(chart_.boundary, nodes_.sides[face_], surface_, size_at_, context_);
    context_.check();
    if (!grid || (grid->rings > 0 && grid->rings < options_.rings)) return std::nullopt;
    FaceQuads quads;
    quads.nodes = std::move(grid->nodes);
    auto& mesh = quads.surface_mesh;
    mesh.mesh.quads = std::move(grid->quads);
    mesh.mesh.points = std::move(grid->points);
    mesh.parameters = std::move(grid->uv);
    quads.pole.assign(mesh.parameters.size(), 0);
    context_.check();
    if (nodes_.sides[face_].outline == FaceSides::Outline::holed && !settle(quads)) return std::nullopt;
    FaceMesh result = finish(std::move(quads));
    result.grid = true;
    return result;
  }

  /// Moves the nodes of a grid with holes. \return whether its quads are then well shaped.
  bool settle(FaceQuads& quads) {
    constexpr int rounds = 6;
    constexpr double least_jacobian = 0.5;
    SurfaceMesh& mesh = quads.surface_mesh;
    for (const Vector2& uv : mesh.parameters) mesh.normals.push_back(surface_.normal(uv));
    mesh.fixed.assign(mesh.parameters.size(), 0);
    std::fill_n(mesh.fixed.begin(), quads.nodes.size(), 1);
    for (int round = 0; round < rounds; ++round) improve(quads, false);
    const auto& p = mesh.mesh.points;
    return std::all_of(mesh.mesh.quads.begin(), mesh.mesh.quads.end(), [&](const std::array<int, 4>& q) {
      return folded_scaled_jacobian(p[q[0]], p[q[1]], p[q[2]], p[q[3]], mesh.normals[q[0]]) > least_jacobian;
    });
  }

  FaceTriangulation triangulate(const FaceBoundary& boundary, const TrimmedDomain& domain) {
    const StageTimer timer(context_, Stage::triangulate);
    PlacementOptions placement;
    placement.scale = static_cast<double>(boundary.stride) / recipe_.fineness;
    placement.refusal = recipe_.refusal;
    PlacedPoints placed = place_points(boundary, surface_, domain, size_at_, placement, context_);
    context_.check();
    return triangulate_face(face_, boundary, std::move(placed), surface_, context_);
  }

  FaceQuads recombine_face(const FaceTriangulation& triangulation, int stride) {
    FaceQuads quads;
    if (recipe_.off == FaceRecipe::Off::as_triangles) {
      quads.surface_mesh.mesh.points = triangulation.mesh.points;
      quads.surface_mesh.mesh.triangles = triangulation.mesh.triangles;
      std::set<std::pair<int, int>> sides;
      for (const auto& segment : triangulation.segments) sides.insert(std::minmax(segment.a, segment.b));
      flip_flat(triangulation.mesh.points, sides, quads.surface_mesh.mesh.triangles);
    } else {
      quads.surface_mesh.mesh = recombine(triangulation.mesh, options_.recombine, context_);
    }
    quads.surface_mesh.mesh.quad_tags.clear();
    quads.surface_mesh.mesh.triangle_tags.clear();
    quads.surface_mesh.parameters = triangulation.uv;
    quads.surface_mesh.normals = triangulation.normals;
    quads.surface_mesh.fixed.assign(triangulation.uv.size(), 0);
    std::fill_n(quads.surface_mesh.fixed.begin(), triangulation.boundary_count, 1);
    quads.surface_mesh.boundary_angles = triangulation.angles;
    quads.surface_mesh.boundary_angles.resize(triangulation.uv.size(), 0);
    quads.nodes = triangulation.nodes;
    quads.pole = triangulation.pole;
    if (stride == 1 && !quads.surface_mesh.mesh.triangles.empty()) {
      throw FaceProblem(
          Cause::odd_boundary, face_,
          fmt::format("Face{} has an odd boundary that cannot be made even: `strategy` subdivide meshes it",
                      face_.number()));
    }
    return quads;
  }

  void improve(FaceQuads& quads, bool topology) {
    const StageTimer timer(context_, Stage::improve);
    const CadSmoothingSurface surface(surface_);
    ImproveReport report;
    if (topology && options_.improve.clean_up) {
      clean_up(quads.surface_mesh, surface, options_.improve, report, context_);
      keep_poles(quads);
    }
    smooth(quads.surface_mesh, surface, options_.improve, report, context_);
  }

  FaceMesh finish(FaceQuads quads) const {
    FaceMesh result;
    result.quads = std::move(quads.surface_mesh.mesh.quads);
    result.points = std::move(quads.surface_mesh.mesh.points);
    result.uv = std::move(quads.surface_mesh.parameters);
    result.pole = std::move(quads.pole);
    result.nodes = std::move(quads.nodes);
    if (recipe_.chart != ChartKind::own) result.surface = chart_.surface;  // otherwise made again when needed
    result.off = off_;
    result.q_min = 1;
    std::vector<int> inverted;
    SparseCheck check(context_);
    for (auto& quad : result.quads) {
      check();
      if (shape_.faces[face_].reversed) std::swap(quad[1], quad[3]);
      const auto& p = result.points;
      if (quad_scaled_jacobian(p[quad[0]], p[quad[1]], p[quad[2]], p[quad[3]]) <= no_jacobian)
        inverted.push_back(static_cast<int>(&quad - result.quads.data()));
      result.q_min = std::min(result.q_min, quad_q(p[quad[0]], p[quad[1]], p[quad[2]], p[quad[3]]));
    }
    if (!inverted.empty()) throw inverted_problem(result, inverted);
    if (const auto side = wrong_boundary_side(chart_.boundary, result.nodes, result.quads))
      throw boundary_problem(nodes_.points[side->first], nodes_.points[side->second]);
    order(result);
    return result;
  }

  /// Reorders the mesh so that neighbors are near each other in memory, here, in solvers and in viewers.
  void order(FaceMesh& mesh) const {
    const std::vector<int> before = order_by_place(mesh.points, mesh.nodes.size(), mesh.quads, context_);
    const auto permute = [&](auto& values) {
      std::remove_cvref_t<decltype(values)> ordered(before.size());
      for (std::size_t i = 0; i < before.size(); ++i) ordered[i] = values[before[i]];
      context_.check();
      values = std::move(ordered);
    };
    permute(mesh.points);
    permute(mesh.uv);
    permute(mesh.pole);
    if (!mesh.off.empty()) permute(mesh.off);
  }

  FaceProblem boundary_problem(const Vector3& a, const Vector3& b) const {
    const Vector3 middle = 0.5 * (a + b);
    return {Cause::no_mesh, face_,
            fmt::format("the mesh of Face{} does not end as its wires do near {}", face_.number(),
                        place_text(middle))};
  }

  /// The problem of inverted quads, with the stretches of edges that they and the quads around them touch.
  FaceProblem inverted_problem(const FaceMesh& mesh, const std::vector<int>& inverted) const {
    std::set<int> corners, touched;
    for (const int quad : inverted) corners.insert(mesh.quads[quad].begin(), mesh.quads[quad].end());
    for (const auto& quad : mesh.quads) {
      if (std::none_of(quad.begin(), quad.end(), [&](int corner) { return corners.contains(corner); }))
        continue;
      for (const int corner : quad) {
        if (corner < static_cast<int>(mesh.nodes.size())) touched.insert(mesh.nodes[corner]);
      }
    }
    const int corner = worst_corner(mesh, mesh.quads[inverted.front()]);
    const Vector3& near = mesh.points[corner];
    const bool inside = std::any_of(inverted.begin(), inverted.end(), [&](int quad) {
      return worst_corner(mesh, mesh.quads[quad]) >= static_cast<int>(mesh.nodes.size());
    });
    const Cause cause = largest_stray(chart_.boundary, surface_) > 1 ? Cause::stray_curves
                        : inside                                     ? Cause::inverted_inside
                                                                     : Cause::inverted_at_boundary;
    FaceProblem problem(cause, face_,
                        fmt::format("Face{} keeps {} inverted quad{} at this size, the first at {}, {}",
                                    face_.number(), inverted.size(), inverted.size() == 1 ? "" : "s",
                                    place_text(near), place_of(mesh, corner)));
    problem.stretches = stretches_at(touched);
    for (const EdgeStretch& part : problem.stretches) problem.edges.push_back(part.edge);
    return problem;
  }

  /// The node at the corner of a quad that is inverted most.
  int worst_corner(const FaceMesh& mesh, const std::array<int, 4>& quad) const {
    const auto& p = mesh.points;
    const Vector3 outward = (shape_.faces[face_].reversed ? -1 : 1) * surface_.normal(mesh.uv[quad[0]]);
    int worst = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 4; ++k) {
      const Vector3 &at = p[quad[k]], &next = p[quad[(k + 1) % 4]], &before = p[quad[(k + 3) % 4]];
      const double area = (next - at).cross(before - at).dot(outward);
      if (area < least) {
        least = area;
        worst = k;
      }
    }
    return quad[worst];
  }

  /// A text that says where a node of the face lies.
  std::string place_of(const FaceMesh& mesh, int corner) const {
    if (corner >= static_cast<int>(mesh.nodes.size())) return "inside the face";
    const int node = mesh.nodes[corner];
    const auto vertex = std::find(nodes_.vertex_nodes.begin(), nodes_.vertex_nodes.end(), node);
    if (vertex != nodes_.vertex_nodes.end())
      return fmt::format("Vertex{}", vertex - nodes_.vertex_nodes.begin() + 1);
    for (const auto& segment : chart_.boundary.segments) {
      if (!segment.edge.exists()) continue;
      const auto& on_edge = nodes_.edges[segment.edge].nodes;
      if (std::find(on_edge.begin(), on_edge.end(), node) != on_edge.end())
        return fmt::format("a node of Edge{}", shape_.edges[segment.edge].number);
    }
    return "inside the face";
  }

  /// The segments that end at the given nodes, joined where consecutive. Each is to become four segments.
  std::vector<EdgeStretch> stretches_at(const std::set<int>& touched) const {
    const int stride = chart_.boundary.stride;
    std::vector<EdgeStretch> result;
    std::set<EdgeId> edges;
    for (const auto& segment : chart_.boundary.segments) {
      if (segment.edge.exists()) edges.insert(segment.edge);
    }
    for (const EdgeId id : edges) {
      const BoundaryNodes::Edge& edge = nodes_.edges[id];
      int last = -1;  // last segment in a stretch
      for (int i = 0; i + stride < static_cast<int>(edge.nodes.size()); i += stride) {
        if (!touched.contains(edge.nodes[i]) && !touched.contains(edge.nodes[i + stride])) continue;
        const double from = edge.parameters[i], to = edge.parameters[i + stride];
        if (last >= 0 && last + stride == i) {
          result.back().to = to;
          result.back().segments += 4;
        } else {
          result.push_back({id, from, to, 4});
        }
        last = i;
      }
    }
    return result;
  }

  const CadShape& shape_;
  FaceId face_;
  const BoundaryNodes& nodes_;
  const MeshOptions& options_;
  const FaceRecipe& recipe_;
  ExecutionContext& context_;
  const FaceChart& chart_;
  const FaceSurface& surface_;
  TrimmedDomain domain_;
  std::vector<double> off_;  // (points) see FaceMesh::off
  SizingField::Sampler size_at_;
};

}  // namespace

FaceMesh mesh_face(const CadShape& shape, FaceId face, const FaceChart& chart, const BoundaryNodes& nodes,
                   const SizingField& field, const MeshOptions& options, const FaceRecipe& recipe,
                   ExecutionContext& context) {
  return FaceMesher(shape, face, chart, nodes, field, options, recipe, context).run();
}

}  // namespace quadrille
