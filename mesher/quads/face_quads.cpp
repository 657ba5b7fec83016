/// Runs the stages from the triangles of a face to its quads, in the order of the method.

#include "mesher/quads/face_quads.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "mesher/faces/loop_filling.hpp"
#include "mesher/mesh/quad_geometry.hpp"
#include "mesher/pairing/recombine.hpp"
#include "mesher/quads/improve.hpp"
#include "mesher/quads/mending.hpp"

namespace quadrille {

namespace {

/// Adapts `pole` after quads were replaced. Poles are fixed points, which keep their indices.
void keep_poles(FaceQuads& quads) {
  quads.pole.resize(quads.surface_mesh.mesh.points.size(), 0);
  std::fill(quads.pole.begin() + static_cast<long>(quads.nodes.size()), quads.pole.end(), 0);
}

FaceQuads paired(FaceTriangulation& triangulation, const FaceQuadsOptions& options,
                 ExecutionContext& context) {
  FaceQuads quads;
  SurfaceMesh& surface_mesh = quads.surface_mesh;
  if (options.pair) {
    surface_mesh.mesh = recombine(triangulation.mesh, options.recombine, context);
  } else {
    std::set<std::pair<int, int>> sides;
    for (const auto& segment : triangulation.segments) sides.insert(std::minmax(segment.a, segment.b));
    flip_flat(triangulation.mesh.points, sides, triangulation.mesh.triangles);
    surface_mesh.mesh.points = std::move(triangulation.mesh.points);
    surface_mesh.mesh.triangles = std::move(triangulation.mesh.triangles);
  }
  surface_mesh.mesh.quad_tags.clear();
  surface_mesh.mesh.triangle_tags.clear();
  const std::size_t count = triangulation.uv.size();
  surface_mesh.parameters = std::move(triangulation.uv);
  surface_mesh.normals = std::move(triangulation.normals);
  surface_mesh.fixed.assign(count, 0);
  std::fill_n(surface_mesh.fixed.begin(), triangulation.boundary_count, 1);
  surface_mesh.boundary_angles = std::move(triangulation.angles);
  surface_mesh.boundary_angles.resize(count, 0);
  quads.nodes = std::move(triangulation.nodes);
  quads.pole = std::move(triangulation.pole);
  return quads;
}

void clean(FaceQuads& quads, const MeshSurface& surface, const ImproveOptions& options,
           ExecutionContext& context) {
  const StageTimer timer(context, Stage::improve);
  clean_up(quads.surface_mesh, surface, options, context);
  keep_poles(quads);
}

void mend_folded(FaceQuads& quads, const MeshSurface& surface, ExecutionContext& context) {
  const StageTimer timer(context, Stage::improve);
  if (!has_inverted_quads(quads.surface_mesh.mesh)) return;
  std::vector<char> changed;
  mend_quads(quads.surface_mesh, surface, folded_objective, -1, changed, context);
  keep_poles(quads);
}

}  // namespace

void smooth(FaceQuads& quads, const MeshSurface& surface, const ImproveOptions& options,
            ExecutionContext& context) {
  const StageTimer timer(context, Stage::improve);
  smooth(quads.surface_mesh, surface, options, context);
}

FaceQuads make_quads(FaceTriangulation triangulation, const MeshSurface& surface,
                     const FaceQuadsOptions& options, ExecutionContext& context) {
  const bool split = options.segments_per_side == 2;
  if (split) tie_across_gaps(triangulation.mesh, triangulation.normals, triangulation.segments);
  FaceQuads quads = paired(triangulation, options, context);
  const std::vector<FaceBoundary::Segment>& segments = triangulation.segments;
  if (!split && !quads.surface_mesh.mesh.triangles.empty()) return quads;
  if (options.clean_up && options.improve.clean_up) clean(quads, surface, options.improve, context);
  smooth(quads, surface, options.improve, context);
  if (split) {
    quads = subdivide(quads, segments, surface, context);
    smooth(quads, surface, options.improve, context);
  }
  mend_folded(quads, surface, context);
  return quads;
}

}  // namespace quadrille
