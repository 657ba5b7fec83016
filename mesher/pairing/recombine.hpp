#pragma once
/// Triangles into quads by edge coloring.

#include "geometry/base/api.hpp"
#include "geometry/base/execution_context.hpp"
#include "mesher/mesh/mesh_types.hpp"
#include "mesher/pairing/recombine_options.hpp"

namespace quadrille {

/// Pairs the triangles of a mesh into quads: colors its edges, no two alike in a triangle, and removes one
/// color. That color goes to the edges whose quads are best, is exchanged with the other two along chains
/// (kempe_chains.hpp) where quality or valence gains, and is brought to every triangle: along alternating
/// paths, or by triangles that walk until they meet. The other two colors are completed after that; an odd
/// cycle of them keeps one blank edge, since another choice of the removed color would cost quality. With
/// Method::paper all three colors are complete before one is chosen. Points are kept (same indices) unless
/// triangles have to be walked, and boundary nodes never move; no new point is made. Zero triangles remain in
/// each connected piece (of one tag) whose count is even, exactly one where it is odd. Quads may be badly
/// shaped or concave where the triangulation leaves no choice: improve() mends them. Throws Error (failure)
/// naming the triangle when the mesh is not manifold or not oriented alike. Deterministic for input, options
/// and seed, whatever the thread count. Time: linear in practice. Based on: Giuliani & Krivodonova, Fast
/// unstructured quadrilateral mesh generation (2018).
QUADRILLE_API QuadMesh recombine(const TriangleMesh& mesh, const RecombineOptions& options,
                                 ExecutionContext& context);

}  // namespace quadrille
