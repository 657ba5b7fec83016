#pragma once
/// The criteria by which industry passes or refuses shell quads, measured by geometry alone: corners only,
/// also at second order. Usual limits: those of HyperMesh's default criteria.

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/base/api.hpp"
#include "geometry/base/vector.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// What industry asks of a quad.
enum class Criterion {
  aspect,          ///< longest over shortest side
  warp,            ///< larger angle between the two triangles of a diagonal, degrees
  skew,            ///< 90 minus the angle between the lines that join middles of opposite sides, degrees
  angle_min,       ///< smallest corner angle, degrees
  angle_max,       ///< largest corner angle, degrees
  jacobian_ratio,  ///< least over largest Jacobian at the four Gauss points
  taper            ///< 1 - least corner triangle over half the quad's area
};

constexpr std::size_t criterion_count = 7;  ///< members of Criterion

/// Values of all criteria, by Criterion.
using CriteriaValues = std::array<double, criterion_count>;

/// What holds of a criterion whatever the limit.
struct CriterionInfo {
  std::string_view name;  ///< in reports and limit files
  std::string_view unit;  ///< empty, or "degrees"
  double ideal;           ///< of the perfect square; values beyond the limit, seen from here, fail
  double usual_limit;     ///< that CriteriaLimits has unless told otherwise
};

/// Indexed by Criterion.
constexpr std::array<CriterionInfo, criterion_count> criteria_info{{{"aspect", "", 1, 5},
                                                                    {"warp", "degrees", 0, 15},
                                                                    {"skew", "degrees", 0, 40},
                                                                    {"angle_min", "degrees", 90, 40},
                                                                    {"angle_max", "degrees", 90, 140},
                                                                    {"jacobian_ratio", "", 1, 0.6},
                                                                    {"taper", "", 0, 0.6}}};

/// A limit a criterion; NaN = not checked.
struct QUADRILLE_API CriteriaLimits {
  static constexpr double unchecked = std::numeric_limits<double>::quiet_NaN();  ///< a limit that all meet

  CriteriaValues values = usual();        ///< by criterion
  std::vector<std::string> not_measured;  ///< criteria of a limits file that are none of ours

  /// How far a value is from the ideal, in units of the limit's distance: above 1 the quad fails; 0 where the
  /// criterion is not checked.
  double severity(Criterion criterion, double value) const;
  bool fails(Criterion criterion, double value) const;  ///< whether the value is outside the limit

 private:
  static constexpr CriteriaValues usual() {
    CriteriaValues result{};
    for (std::size_t i = 0; i < criterion_count; ++i) result[i] = criteria_info[i].usual_limit;
    return result;
  }
};

/// All criteria of the quad a, b, c, d.
QUADRILLE_API CriteriaValues measure_criteria(const Vector3& a, const Vector3& b, const Vector3& c,
                                              const Vector3& d);

/// Which quads of a mesh fail, and how.
struct CriteriaSummary {
  /// The quads of one CAD face.
  struct Face {
    int face = 0;     ///< CAD face, from 1; 0 = none
    int quads = 0;    ///< how many
    int failing = 0;  ///< how many of them
  };
  /// One of the worst.
  struct Quad {
    int quad = 0;                             ///< index into ShellMesh::quads
    int face = 0;                             ///< CAD face, from 1; 0 = none
    Vector3 center;                           ///< mean of the corners
    Criterion criterion = Criterion::aspect;  ///< the one with the largest severity
    double value = 0;                         ///< of the criterion that it fails by most
  };
  int quads = 0;             ///< how many
  int failing = 0;           ///< by any criterion
  int failing_but_warp = 0;  ///< by any criterion other than warp, which the surface's curvature forces
  std::array<int, criterion_count> failing_by{};  ///< quads that fail, by criterion
  std::vector<Face> faces;                        ///< faces with failing quads, ascending
  std::vector<Quad> worst;                        ///< of the failing quads, worst first
};

/// \param worst_count at most so many of the worst quads are listed. Complexity: linear in the mesh.
QUADRILLE_API CriteriaSummary check_criteria(const ShellMesh& mesh, const CriteriaLimits& limits = {},
                                             int worst_count = 10);

}  // namespace quadrille
