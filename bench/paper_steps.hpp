#pragma once
/// The last steps of the 2018 paper's method, as it describes them: for comparison. Quadrille instead pairs
/// the triangles that the color leaves (recombine()), and guards shapes as it smooths (smooth()). Based on:
/// Giuliani & Krivodonova, Fast unstructured quadrilateral mesh generation (2018), sections 2.4 and 3.

#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// Collapses the triangles of a mesh that have one side on the boundary. The ends of that side become one
/// point, halfway between them, so that the boundary changes there. A triangle stays if its collapse would
/// put a point into an element twice, move a point of an earlier collapse, or merge a point of another
/// triangle into the other end. Points that are left without an element stay in the array. \return the number
/// of collapsed triangles. Time: linear.
int collapse_boundary_triangles(QuadMesh& mesh);

/// Moves each inner node of a quad with q below a limit to the mean of its neighbors (the other ends of its
/// sides), in the order of the nodes, without regard to other quads. Boundary nodes stay. Meant for planar
/// meshes: on others, nodes leave the surface. Time: linear in the sweeps. \return the number of moves.
int smooth_poor(QuadMesh& mesh, double q_limit = 0.5, int sweeps = 10);

}  // namespace quadrille
