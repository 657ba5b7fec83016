#pragma once
/// An edge coloring with a cost for each edge: how poor the quad is that removing the edge makes. Internal.

#include <array>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/base/vector.hpp"
#include "mesher/mesh/mesh_types.hpp"
#include "mesher/pairing/edge_coloring.hpp"

namespace quadrille {

class CostedColoring : public EdgeColoring {
 public:
  /// All edges blank and without cost. Throws as EdgeColoring does.
  explicit CostedColoring(const TriangleMesh& mesh, const ExecutionContext& context = {})
      : CostedColoring(mesh, EdgeColoring(mesh, context)) {}
  /// Starts from known colors and neighbors; all edges without cost.
  CostedColoring(const TriangleMesh& mesh, EdgeColoring colors);

  const std::array<int, 3>& corners(int t) const { return triangles_[t].corner; }
  int corner_at(Side s) const { return corners(triangle_of(s))[place_of(s)]; }
  int end_of(Side s) const { return corners(triangle_of(s))[next_index(index_of(s))]; }
  int apex_of(Side s) const { return corners(triangle_of(s))[previous_index(index_of(s))]; }
  /// The cost of the quad made across a side, from its corner angles and its fold: 0 for a rectangle, above 2
  /// for a concave quad. 0 on the boundary.
  float cost_of(Side s) const { return triangles_[triangle_of(s)].cost[place_of(s)]; }

  /// index_of() for an existing side. Tells the compiler that the index is not 3, which stands for "none".
  static int place_of(Side s) {
    const int i = index_of(s);
    if (i == 3) __builtin_unreachable();
    return i;
  }

  /// Fills in the cost of every inner side. Time: about 20 ns per triangle.
  void compute_costs(const std::vector<Vector3>& points, const ExecutionContext& context = {});

  /// Flips an inner edge, so that it joins the other two corners of its triangles. Updates the costs around
  /// it. The edge keeps its color; the other four edges of the two triangles become blank.
  void flip(Side side, const std::vector<Vector3>& points);

 private:
  /// Keeps together what a step across a side needs.
  struct Triangle {
    std::array<int, 3> corner;  // points, counter-clockwise
    std::array<float, 3> cost;
  };

  void update_cost(Side side, const std::vector<Vector3>& points);
  /// Sets the cost of the pair that a side joins, for both of its triangles.
  void set_cost(Side side, float cost);

  std::vector<Triangle> triangles_;
};

/// Gives the removed color to edges one after the other: to the only inner edge of a triangle that can still
/// take it (ears first), else to the cheapest edge. Needs the costs. Time: linear (the order is a bucket
/// sort). Based on: Karp & Sipser, Maximum matching in sparse random graphs (1981).
void color_by_cost(CostedColoring& coloring, const ExecutionContext& context = {});

/// Moves free triangles to each other: a triangle and a quad beside it form a pentagon, which can be cut into
/// a quad and a triangle on the far side. Two triangles that meet become a quad. Diagonals of pairs are
/// flipped where the way needs it. Afterwards a connected piece has at most one free triangle, unless no way
/// was found. \return the number of triangles still free.
int migrate_free_triangles(CostedColoring& coloring, const std::vector<Vector3>& points,
                           const ExecutionContext& context = {});

}  // namespace quadrille
