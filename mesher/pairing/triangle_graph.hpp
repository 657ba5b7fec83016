#pragma once
/// The triangles of a mesh as the nodes of a graph: what the colouring and the matching work on. Internal.

#include <cstdint>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/base/vector.hpp"
#include "mesher/mesh/mesh_types.hpp"
#include "mesher/mesh/side_twins.hpp"
#include "mesher/pairing/recombine_options.hpp"

namespace quadrille {

/// A triangle with all that a step across one of its sides needs: most steps touch one cache line.
struct GraphTriangle {
  std::int32_t corner[3];  ///< points, counter-clockwise
  Side twin[3];            ///< the same side seen from the neighbour; -1 on the boundary
  float cost[3];           ///< of the quad made across the side, see pair_cost()
  std::int32_t mate;       ///< index of the side across which it is paired; -1 = free
};

class EdgeColoring;

class TriangleGraph {
 public:
  /// Sides between triangles of different tags become boundary.
  /// Throws Error (failure) naming the triangle where indices are out of range or repeated, where more than
  /// two triangles of a tag share a side, or where two of them run along it the same way. Time and memory:
  /// linear.
  explicit TriangleGraph(const TriangleMesh& mesh, const ExecutionContext& context = {});
  /// The same where the neighbours are known already: those of the colouring of this mesh.
  TriangleGraph(const TriangleMesh& mesh, const EdgeColoring& connected);

  int size() const { return static_cast<int>(triangles.size()); }
  int corner_at(Side s) const { return triangles[triangle_of(s)].corner[index_of(s)]; }
  int end_of(Side s) const { return triangles[triangle_of(s)].corner[next_index(index_of(s))]; }
  int apex_of(Side s) const { return triangles[triangle_of(s)].corner[previous_index(index_of(s))]; }
  Side twin_of(Side s) const { return triangles[triangle_of(s)].twin[index_of(s)]; }
  float cost_of(Side s) const { return triangles[triangle_of(s)].cost[index_of(s)]; }

  bool free(int t) const { return triangles[t].mate < 0; }
  /// The triangle's partner in a quad; -1 = free.
  int mate_of(int t) const {
    return triangles[t].mate < 0 ? -1 : triangle_of(triangles[t].twin[triangles[t].mate]);
  }
  /// Pairs the two triangles at an inner side.
  void pair(Side s) {
    const Side other = twin_of(s);
    triangles[triangle_of(s)].mate = index_of(s);
    triangles[triangle_of(other)].mate = index_of(other);
  }

  /// Fills in the cost of every inner side. Time: about 20 ns a triangle.
  void compute_costs(const std::vector<Vector3>& points, const ExecutionContext& context = {});

  /// Turns the diagonal of the two triangles at an inner side to their other two corners. The costs around
  /// are computed anew; the pairing of the two with each other is kept, any other is the caller's to restore.
  /// \return the new diagonal, seen from triangle_of(side).
  Side flip(Side side, const std::vector<Vector3>& points);

  std::vector<GraphTriangle> triangles;
  Objective objective = Objective::regular;  ///< decides the costs

 private:
  void update_cost(Side side, const std::vector<Vector3>& points);
};

/// Corner angles of a triangle and its unit normal. The angles of an inverted triangle are negative.
struct TriangleShape {
  float angle[3];
  float normal[3];
};

/// The cost of the quad made of two triangles across the side i of the first and j of the second, from its
/// corner angles and the fold between the two: 0 for a rectangle, about 0.3 for two equilateral triangles,
/// above 3 for a concave quad.
/// For the objective `shape`: 1 - q before it is cut off at 0, and the fold.
float pair_cost(const TriangleShape& first, int i, const TriangleShape& second, int j,
                Objective objective = Objective::regular);

}  // namespace quadrille
