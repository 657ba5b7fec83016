/// Meshes a face by one candidate after another, from a flat list, until FaceJudge has no doubts.

#include "mesher/shell/face_mesher.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "geometry/base/place_text.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/faces/face_grid.hpp"
#include "mesher/faces/face_triangulation.hpp"
#include "mesher/faces/hole_rings.hpp"
#include "mesher/faces/point_placement.hpp"
#include "mesher/mesh/quad_geometry.hpp"
#include "mesher/mesh/renumbering.hpp"
#include "mesher/quads/face_quads.hpp"
#include "mesher/quads/improve.hpp"
#include "mesher/shell/boundary_sides.hpp"
#include "mesher/shell/face_judge.hpp"

namespace quadrille {

namespace {

enum class Layout {
  grid,   ///< by its outline, without triangles
  rings,  ///< rings round the holes, triangles between them
  plain   ///< triangles everywhere
};

/// One way to mesh a face.
struct Candidate {
  Layout layout;
  /// Quads are paired at the final size. Otherwise, with two segments a side, they are cut in four: these
  /// have fewer irregular nodes, but sizes seem to grow twice as fast to the quads of twice the size, and
  /// rows continue where they should end.
  bool direct;
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
        size_at_(field, face),
        judge_(field, face, surface_, context),
        plan_(nodes.plans[face]) {}

  FaceMesh run() {
    constexpr std::array candidates{Candidate{Layout::grid, false}, Candidate{Layout::rings, false},
                                    Candidate{Layout::rings, true}, Candidate{Layout::plain, false},
                                    Candidate{Layout::plain, true}};
    std::optional<FaceMesh> grid, best;
    for (const Candidate& candidate : candidates) {
      if (!is_worth_trying(candidate, best)) continue;
      std::optional<FaceMesh> mesh = attempt(candidate);
      if (!mesh) continue;
      if (candidate.layout == Layout::grid) {
        // Beside an edge with prescribed spacing, flat rows are wanted.
        if (plan_.has_kept_edge || !judge_.is_doubtful(*mesh, plan_)) return std::move(*mesh);
        grid = std::move(mesh);
      } else if (!best || judge_.replaces_cut(*mesh, *best)) {
        best = std::move(mesh);
        layout_ = candidate.layout;
      }
    }
    if (grid && !(best && judge_.replaces_grid(*best, *grid))) return std::move(*grid);
    if (!best && recipe_.leaves_surface) {
      may_leave_surface_ = true;
      best = attempt({Layout::plain, false});
    }
    if (!best) throw FaceProblem(*problem_);
    return std::move(*best);
  }

 private:
  bool is_worth_trying(const Candidate& candidate, const std::optional<FaceMesh>& best) {
    if (candidate.layout == Layout::grid) return recipe_.mapped;
    if (candidate.direct)
      return best && candidate.layout == layout_ && chart_.boundary.stride == 2 && recipe_.clean_up &&
             judge_.is_doubtful(*best);
    if (best) return false;
    return candidate.layout == Layout::plain || (options_.rings > 0 && recipe_.clean_up);
  }

  /// Empty if the face has no such mesh. A problem is kept for the user and for the remedies.
  std::optional<FaceMesh> attempt(const Candidate& candidate) {
    try {
      if (candidate.layout == Layout::grid) return grid_mesh();
      if (candidate.layout == Layout::plain) return finish(quads_inside(chart_.boundary, candidate));
      return ringed_mesh(candidate);
    } catch (const FaceProblem& problem) {
      context_.check();
      if (!candidate.direct) problem_ = problem;
      return std::nullopt;
    }
  }

  std::optional<FaceMesh> ringed_mesh(const Candidate& candidate) {
    if (!rings_)
      rings_ = place_rings(chart_.boundary, surface_, enclosed_domain(chart_.boundary), options_.rings);
    if (rings_->holes.empty()) return std::nullopt;
    FaceQuads quads = quads_inside(rings_->inside, candidate);
    add_ring_quads(quads, *rings_, surface_);
    smooth(quads, surface_, options_.improve, context_);
    return finish(std::move(quads));
  }

  FaceQuads quads_inside(const FaceBoundary& boundary, const Candidate& candidate) {
    const bool is_halved = candidate.direct && boundary.stride == 2;
    const FaceBoundary segments = is_halved ? halved(boundary) : boundary;
    const FaceQuadsOptions options{.segments_per_side = segments.stride,
                                   .pair = recipe_.pair,
                                   .clean_up = recipe_.clean_up,
                                   .recombine = options_.recombine,
                                   .improve = options_.improve};
    FaceQuads quads =
        make_quads(triangulate(segments, enclosed_domain(boundary)), surface_, options, context_);
    if (!quads.surface_mesh.mesh.triangles.empty())
      throw FaceProblem(Cause::odd_boundary, face_,
                        fmt::format("Face{} has an odd number of boundary segments that cannot be made even: "
                                    "use `strategy` subdivide",
                                    face_.number()));
    if (may_leave_surface_) leave_surface(quads);
    return quads;
  }

  /// Moves nodes of inverted quads off the surface, and notes how far.
  void leave_surface(FaceQuads& quads) {
    SurfaceMesh& mesh = quads.surface_mesh;
    const std::vector<char> moved =
        unfold_in_space(mesh.mesh.quads, mesh.mesh.points, mesh.fixed, recipe_.reach, context_);
    off_.assign(moved.size(), 0);
    for (std::size_t i = 0; i < moved.size(); ++i) {
      const Vector3& at = mesh.mesh.points[i];
      if (moved[i]) off_[i] = (surface_.project(mesh.parameters[i], at).point - at).norm();
    }
  }

  std::optional<FaceMesh> grid_mesh() {
    const StageTimer timer(context_, Stage::triangulate);
    auto grid = make_grid(chart_.boundary, plan_, surface_, size_at_, context_);
    context_.check();
    if (!grid) return std::nullopt;
    const bool has_holes = grid->rings > 0;
    if (has_holes && grid->rings < options_.rings) return std::nullopt;
    FaceQuads quads;
    quads.nodes = std::move(grid->nodes);
    auto& mesh = quads.surface_mesh;
    mesh.mesh.quads = std::move(grid->quads);
    mesh.mesh.points = std::move(grid->points);
    mesh.parameters = std::move(grid->uv);
    quads.pole.assign(mesh.parameters.size(), 0);
    context_.check();
    if (has_holes && !settle(quads)) return std::nullopt;
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
    for (int round = 0; round < rounds; ++round) smooth(quads, surface_, options_.improve, context_);
    const auto& p = mesh.mesh.points;
    return std::all_of(mesh.mesh.quads.begin(), mesh.mesh.quads.end(), [&](const std::array<int, 4>& q) {
      return folded_scaled_jacobian(p[q[0]], p[q[1]], p[q[2]], p[q[3]], mesh.normals[q[0]]) > least_jacobian;
    });
  }

  FaceTriangulation triangulate(const FaceBoundary& boundary, const TrimmedDomain& domain) {
    const StageTimer timer(context_, Stage::triangulate);
    const PlacementOptions placement{static_cast<double>(boundary.stride) / recipe_.fineness,
                                     recipe_.refusal};
    PlacedPoints placed = place_points(boundary, surface_, domain, size_at_, placement, context_);
    context_.check();
    return triangulate_face(face_, boundary, std::move(placed), surface_, context_);
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
    std::vector<int> inverted;
    SparseCheck check(context_);
    for (auto& quad : result.quads) {
      check();
      if (shape_.faces[face_].reversed) std::swap(quad[1], quad[3]);
      if (quad_scaled_jacobian(result.points, quad) <= no_jacobian)
        inverted.push_back(static_cast<int>(&quad - result.quads.data()));
    }
    if (!inverted.empty() && !recipe_.inverted_too)
      throw inverted_problem(shape_, face_, chart_, nodes_, result, inverted);
    if (const auto side = wrong_boundary_side(chart_.boundary, result.nodes, result.quads)) {
      const Vector3 middle = 0.5 * (nodes_.points[side->first] + nodes_.points[side->second]);
      throw FaceProblem(Cause::no_mesh, face_,
                        fmt::format("the mesh of Face{} does not end on the face's boundary near {}",
                                    face_.number(), place_text(middle)));
    }
    if (const auto side = crowded_side(result.nodes, result.quads)) {
      const Vector3 middle = 0.5 * (result.points[side->first] + result.points[side->second]);
      throw FaceProblem(
          Cause::no_mesh, face_,
          fmt::format("Face{} is so thin near {} that two sides of its quads join the same nodes",
                      face_.number(), place_text(middle)));
    }
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

  const CadShape& shape_;
  FaceId face_;
  const BoundaryNodes& nodes_;
  const MeshOptions& options_;
  const FaceRecipe& recipe_;
  ExecutionContext& context_;
  const FaceChart& chart_;
  const FaceSurface& surface_;
  SizingField::Sampler size_at_;
  FaceJudge judge_;
  const FacePlan& plan_;
  std::optional<HoleRings> rings_;
  std::optional<FaceProblem> problem_;  // of the last candidate that failed
  Layout layout_ = Layout::plain;       // of the best mesh other than a grid
  bool may_leave_surface_ = false;      // where quads are inverted
  std::vector<double> off_;             // (points) see FaceMesh::off
};

}  // namespace

FaceMesh mesh_face(const CadShape& shape, FaceId face, const FaceChart& chart, const BoundaryNodes& nodes,
                   const SizingField& field, const MeshOptions& options, const FaceRecipe& recipe,
                   ExecutionContext& context) {
  return FaceMesher(shape, face, chart, nodes, field, options, recipe, context).run();
}

}  // namespace quadrille
