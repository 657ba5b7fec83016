#pragma once
/// Measures of quads.
///
/// q = max(1 - (2/pi) max_j |pi/2 - a_j|, 0), a_j = corner angles (Giuliani & Krivodonova 2018, eq. 1).
/// Scaled Jacobian: the smallest sine of a corner angle, signed by the element's mean normal (Knupp 2000).
/// It is 1 for a rectangle and <= 0 for an inverted, concave or degenerate quad.

#include <array>
#include <vector>

#include "geometry/base/api.hpp"
#include "geometry/base/vector.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// q of the quad a, b, c, d, in [0, 1]. A corner that is reflex with respect to the mean normal counts with
/// its angle above pi.
QUADRILLE_API double quad_q(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d);

/// Scaled Jacobian of the quad, in [-1, 1].
QUADRILLE_API double quad_scaled_jacobian(const Vector3& a, const Vector3& b, const Vector3& c,
                                          const Vector3& d);

/// Measures of a whole mesh.
struct QualitySummary {
  int nodes = 0;                                                ///< nodes used
  int quads = 0;                                                ///< number of quads
  int triangles = 0;                                            ///< number of triangles
  double q_min = 0 /**< least q */, q_mean = 0;                 /**< mean q */
  double sj_min = 0 /**< least scaled Jacobian */, sj_mean = 0; /**< mean scaled Jacobian */
  /// The least Jacobian of an element, divided by the element's mean: jacobian_bound() at second order, the
  /// least of the four corners at first order. 1 = all elements are parallelograms with straight sides.
  double jacobian_min = 0;
  int inverted = 0;  ///< quads that have a scaled Jacobian <= 0, or that fold at second order
  double irregular_percent =
      0;  ///< interior nodes (all sides with two elements, one face) whose valence is not 4
  std::array<int, 20> q_histogram{};  ///< counts in 20 equal bins over [0, 1]
  std::vector<int> valence_counts;    ///< number of interior nodes of each valence
  double aspect_max = 0 /**< longest over shortest side: maximum */, aspect_mean = 0; /**< mean */
  double warping_max_degrees = 0;  ///< largest angle between a corner's normal and the mean normal
  double edge_min = 0 /**< shortest side */, edge_median = 0 /**< median side */,
         edge_max = 0; /**< longest side */
};

/// Complexity: linear in the mesh, plus sorting of the sides.
QUADRILLE_API QualitySummary quality(const ShellMesh& mesh);

/// q of each quad of the mesh.
QUADRILLE_API std::vector<double> quad_qualities(const ShellMesh& mesh);

}  // namespace quadrille
