#pragma once
/// The steps that end the 2018 paper's method, as it describes them: for comparison with what Quadrille does
/// instead. Quadrille pairs the triangles that the color leaves (recombine()) and smooths with a guard
/// (smooth()). Based on: Giuliani & Krivodonova, Fast unstructured quadrilateral mesh generation (2018),
/// sections 2.4 and 3.

#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// Collapses the triangles of a mesh that have one side on the boundary: the ends of that side become one
/// point, half way, so that the boundary changes there. Left as they are: triangles whose collapse would
/// bring a point twice into an element. Points that this leaves without element stay in the array. \return
/// the number collapsed. Time: linear.
int collapse_boundary_triangles(QuadMesh& mesh);

/// Moves each inner node of the quads with q below a limit to the mean of its neighbors (the other ends of
/// its sides), in the order of the nodes, without regard to what that does to other quads; nothing where none
/// is below. Boundary nodes stay. Meant for planar meshes: on others nodes leave the surface. Time: linear in
/// sweeps. \return the number of moves.
int smooth_poor(QuadMesh& mesh, double q_limit = 0.5, int sweeps = 10);

}  // namespace quadrille
