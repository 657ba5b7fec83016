#include "mesher/shell/face_mesher.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "geometry/base/error.hpp"
#include "geometry/cad/shape_completion.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/faces/face_boundary.hpp"
#include "mesher/faces/face_grid.hpp"
#include "mesher/faces/face_triangulation.hpp"
#include "mesher/faces/point_placement.hpp"
#include "mesher/mesh/quality.hpp"
#include "mesher/pairing/recombine.hpp"
#include "mesher/quads/improve.hpp"
#include "mesher/quads/subdivision.hpp"

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

/// One way of meshing a face; the ladder of fallbacks tries several.
struct Attempt {
  PlacementOptions placement;
  bool clean_up;
  const char* note;
};

class FaceMesher {
 public:
  FaceMesher(const CadShape& shape, int face, const CadFace& cad_face,
             std::shared_ptr<const FaceSurface> surface, const BoundaryNodes& nodes, const SizingField& field,
             const MeshOptions& options, int fineness, ExecutionContext& context)
      : face_(face),
        fineness_(fineness),
        reversed_(shape.faces[face].reversed),
        nodes_(nodes),
        options_(options),
        context_(context),
        shared_surface_(std::move(surface)),
        surface_(*shared_surface_),
        boundary_(face_boundary(shape, face, cad_face, surface_, nodes)),
        domain_(enclosed_domain(boundary_)),
        size_at_(field) {}

  FaceMesh run() {
    if (auto grid = mesh_as_grid()) return std::move(*grid);
    const double scale = boundary_.stride;
    std::vector<Attempt> attempts{
        {{scale, 0.72, true}, true, ""},
        {{scale, 0.72, true}, false, "without clean-up"},
        {{scale, 0.60, true}, true, "denser points"},
        {{scale, 0.85, true}, true, "sparser points"},
        {{scale, 0.75, false}, true, "hexagonal points"},
    };
    if (fineness_ > 1) attempts.push_back({{scale / fineness_, 0.72, true}, true, "points as fine"});
    const double acceptable = acceptable_q();
    std::optional<FaceMesh> best;
    std::optional<Error> error;
    for (std::size_t i = 0; i < attempts.size(); ++i) {
      context_.check();
      try {
        FaceMesh mesh = mesh_once(attempts[i]);
        if (!best || better(mesh, *best)) best = std::move(mesh);
        // Slender quads are worth a second look, inverted ones all the ladder.
        if (best->inverted == 0 && (best->q_min > acceptable || i > 0)) break;
      } catch (const Error& problem) {
        if (problem.kind() == Error::Kind::cancelled) throw;
        error = problem;
      }
    }
    if (!best) throw *error;
    if (best->inverted > 0) {
      const std::string name = fmt::format("Face{}", face_ + 1);
      throw failure(name, fmt::format("{} keeps {} inverted quads at this size: try a smaller size on it",
                                      name, best->inverted));
    }
    return std::move(*best);
  }

 private:
  static bool better(const FaceMesh& a, const FaceMesh& b) {
    return a.inverted != b.inverted ? a.inverted < b.inverted : a.q_min > b.q_min;
  }

  /// The worst q that is not worth another attempt: where CAD curves meet at a small angle, the quad there is
  /// as slender whatever one does.
  double acceptable_q() const {
    constexpr double usual = 0.05;
    std::vector<char> pole(boundary_.uv.size(), 0);
    for (const auto& segment : boundary_.segments) {
      if (segment.degenerate) pole[segment.a] = pole[segment.b] = 1;
    }
    double sharpest = M_PI;
    for (std::size_t i = 0; i < pole.size(); ++i) {
      // A wire that runs the wrong way round gives the rest to 2 pi.
      if (!pole[i])
        sharpest = std::min({sharpest, boundary_.angles[i], std::abs(2 * M_PI - boundary_.angles[i])});
    }
    // q of a quad with one corner this sharp, and some more, since its other corners suffer too.
    return std::min(usual, 0.3 * sharpest * 2 / M_PI - 0.01);
  }

  std::optional<FaceMesh> mesh_as_grid() {
    const StageTimer timer(context_, "triangulate");
    auto grid = make_grid(boundary_, nodes_.sides[face_], surface_, size_at_, context_);
    context_.check();
    if (!grid) return std::nullopt;
    FaceQuads quads;
    quads.nodes = std::move(grid->nodes);
    auto& mesh = quads.surface_mesh;
    mesh.mesh.quads = std::move(grid->quads);
    mesh.mesh.points = std::move(grid->points);
    mesh.parameters = std::move(grid->uv);
    quads.pole.assign(mesh.parameters.size(), 0);
    context_.check();
    return finish(std::move(quads), "grid");
  }

  FaceMesh mesh_once(const Attempt& attempt) {
    FaceTriangulation triangulation = triangulate(attempt);
    FaceQuads quads = recombine_face(triangulation);
    improve(quads, attempt.clean_up);
    if (boundary_.stride == 2) {
      cut_flat_quads(quads.surface_mesh.mesh, quads.surface_mesh.normals, context_);
      quads = subdivide(quads, triangulation.segments, nodes_.points, surface_, context_);
      improve(quads, false);
    }
    return finish(std::move(quads), attempt.note);
  }

  FaceTriangulation triangulate(const Attempt& attempt) {
    const StageTimer timer(context_, "triangulate");
    const PlacedPoints placed =
        place_points(boundary_, surface_, domain_, size_at_, attempt.placement, context_);
    context_.check();
    return triangulate_face(face_ + 1, boundary_, placed, surface_, context_);
  }

  FaceQuads recombine_face(const FaceTriangulation& triangulation) {
    FaceQuads quads;
    quads.surface_mesh.mesh = recombine(triangulation.mesh, options_.recombine, context_);
    quads.surface_mesh.parameters = triangulation.uv;
    quads.surface_mesh.normals = triangulation.normals;
    quads.surface_mesh.fixed.assign(triangulation.uv.size(), 0);
    std::fill_n(quads.surface_mesh.fixed.begin(), triangulation.boundary_count, 1);
    quads.surface_mesh.boundary_angles = triangulation.angles;
    quads.surface_mesh.boundary_angles.resize(triangulation.uv.size(), 0);
    quads.nodes = triangulation.nodes;
    quads.pole = triangulation.pole;
    if (boundary_.stride == 1 && !quads.surface_mesh.mesh.triangles.empty()) {
      const std::string name = fmt::format("Face{}", face_ + 1);
      throw failure(
          name,
          fmt::format("{} has an odd boundary that cannot be made even: use --strategy subdivide", name));
    }
    return quads;
  }

  void improve(FaceQuads& quads, bool topology) {
    const StageTimer timer(context_, "improve");
    const CadSmoothingSurface surface(surface_);
    ImproveReport report;
    if (topology && options_.improve.clean_up) {
      clean_up(quads.surface_mesh, surface, options_.improve, report, context_);
      // Poles are fixed points, and those keep their places.
      quads.pole.resize(quads.surface_mesh.mesh.points.size(), 0);
      std::fill(quads.pole.begin() + static_cast<long>(quads.nodes.size()), quads.pole.end(), 0);
    }
    smooth(quads.surface_mesh, surface, options_.improve, report, context_);
  }

  FaceMesh finish(FaceQuads quads, const char* note) const {
    FaceMesh result;
    result.quads = std::move(quads.surface_mesh.mesh.quads);
    result.points = std::move(quads.surface_mesh.mesh.points);
    result.uv = std::move(quads.surface_mesh.parameters);
    result.pole = std::move(quads.pole);
    result.nodes = std::move(quads.nodes);
    result.note = note;
    result.surface = shared_surface_;
    result.q_min = 1;
    SparseCheck check(context_);
    for (auto& quad : result.quads) {
      check();
      if (reversed_) std::swap(quad[1], quad[3]);
      const auto& p = result.points;
      result.inverted += quad_scaled_jacobian(p[quad[0]], p[quad[1]], p[quad[2]], p[quad[3]]) <= 0;
      result.q_min = std::min(result.q_min, quad_q(p[quad[0]], p[quad[1]], p[quad[2]], p[quad[3]]));
    }
    return result;
  }

  int face_;
  int fineness_;
  bool reversed_;
  const BoundaryNodes& nodes_;
  const MeshOptions& options_;
  ExecutionContext& context_;
  std::shared_ptr<const FaceSurface> shared_surface_;
  const FaceSurface& surface_;
  FaceBoundary boundary_;
  TrimmedDomain domain_;
  SizingField::Sampler size_at_;
};

/// The nodes of the wire that encloses most, in order.
std::vector<Vector3> widest_loop(const CadFace& face, const BoundaryNodes& nodes) {
  std::vector<Vector3> widest;
  double largest = 0;
  for (const CadWire& wire : face.wires) {
    std::vector<Vector3> loop;
    for (const Coedge& coedge : wire.coedges) {
      const auto& edge = nodes.edges[coedge.edge - 1].nodes;
      // Without the last one, which is the first of the next edge.
      for (std::size_t i = 0; i + 1 < edge.size(); ++i)
        loop.push_back(nodes.points[edge[coedge.forward ? i : edge.size() - 1 - i]]);
    }
    const double area = vector_area(loop).norm();
    if (area > largest) {
      largest = area;
      widest = loop;
    }
  }
  return widest;
}

/// Faces that stand for one whose own parametric curves or parametrisation are of no use.
enum class StandIn { none, new_curves, view };

FaceMesh mesh_as(StandIn stand_in, const CadShape& shape, int face, const BoundaryNodes& nodes,
                 const SizingField& field, const MeshOptions& options, int fineness,
                 ExecutionContext& context) {
  std::optional<CadFace> other;
  if (stand_in == StandIn::new_curves) other = with_new_curves(shape.faces[face]);
  const CadFace& cad_face = other ? *other : shape.faces[face];
  const auto surface = std::make_shared<const FaceSurface>(
      stand_in == StandIn::view ? FaceSurface::seen_from_above(cad_face, widest_loop(cad_face, nodes))
                                : FaceSurface(cad_face));
  FaceMesh mesh = FaceMesher(shape, face, cad_face, surface, nodes, field, options, fineness, context).run();
  if (stand_in == StandIn::none) {
    mesh.surface.reset();  // made again where it is wanted
    return mesh;
  }
  if (!mesh.note.empty()) mesh.note += ", ";
  mesh.note += stand_in == StandIn::view ? "seen from above" : "parametric curves made anew";
  return mesh;
}

}  // namespace

FaceMesh mesh_face(const CadShape& shape, int face, const BoundaryNodes& nodes, const SizingField& field,
                   const MeshOptions& options, int fineness, ExecutionContext& context) {
  const auto start = std::chrono::steady_clock::now();
  std::optional<FaceMesh> mesh;
  std::optional<Error> own_problem;  // of its own parametrisation, which users know
  for (const StandIn stand_in : {StandIn::none, StandIn::new_curves, StandIn::view}) {
    try {
      mesh = mesh_as(stand_in, shape, face, nodes, field, options, fineness, context);
      break;
    } catch (const Error& problem) {
      if (problem.kind() == Error::Kind::cancelled) throw;
      if (!own_problem) own_problem = problem;
      if (fineness <= 2) break;
    }
  }
  if (!mesh) throw *own_problem;
  mesh->seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return std::move(*mesh);
}

}  // namespace quadrille
