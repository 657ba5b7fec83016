#pragma once
/// Makes quads of triangles by edge coloring.

#include "geometry/base/api.hpp"
#include "geometry/base/execution_context.hpp"
#include "mesher/mesh/mesh_types.hpp"
#include "mesher/pairing/recombine_options.hpp"

namespace quadrille {

/// Pairs the triangles of a mesh into quads: colors its edges, no two alike in a triangle, and removes one
/// color. That color is given to the edges whose quads are best, then brought to every triangle, along
/// alternating paths or by triangles that migrate until they meet. The other two colors are not completed:
/// an odd cycle of them would keep a blank edge.
/// With Method::paper all three colors are assigned before one is chosen. Points are kept (same indices and
/// places). Edges are kept too, unless triangles have to be walked. No triangle remains in a connected piece
/// (of one tag) with an even number of them, one in a piece with an odd number (Leftovers::leave may leave
/// more). Quads may be badly shaped or concave where the triangulation leaves no choice: improve_on()
/// improves them. Throws Error (failure) naming the triangle if the mesh is not manifold or not consistently
/// oriented. Deterministic for input, options and seed, whatever the thread count. Time: linear in practice.
/// Based on: Giuliani & Krivodonova, Fast unstructured quadrilateral mesh generation (2018).
QUADRILLE_API QuadMesh recombine(const TriangleMesh& mesh, const RecombineOptions& options,
                                 ExecutionContext& context);

}  // namespace quadrille
