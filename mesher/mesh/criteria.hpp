#pragma once
/// The criteria by which industry accepts or rejects shell quads. Only the positions of the corner nodes are
/// measured, also at second order. The usual limits are those of HyperMesh's default criteria.

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

/// The quality criteria for a quad.
enum class Criterion {
  aspect,          ///< longest over shortest side
  warp,            ///< angle between the two triangles of a diagonal, the larger of both diagonals, degrees
  skew,            ///< 90 minus the angle between the lines through the midpoints of opposite sides, degrees
  angle_min,       ///< smallest corner angle, degrees
  angle_max,       ///< largest corner angle, degrees
  jacobian_ratio,  ///< smallest over largest Jacobian at the four Gauss points
  taper,           ///< 1 - (smallest corner triangle / half the quad's area)
  min_length       ///< shortest side, millimeters; checked where a limit is known, see limits_of()
};

constexpr std::size_t criterion_count = 8;  ///< number of members of Criterion

/// The values of all criteria, indexed by Criterion.
using CriteriaValues = std::array<double, criterion_count>;

/// A limit that no value fails.
constexpr double unchecked = std::numeric_limits<double>::quiet_NaN();

/// The properties of a criterion that do not depend on the limit in use.
struct CriterionInfo {
  std::string_view name;  ///< name in reports and limit files
  std::string_view unit;  ///< empty, "degrees" or "mm"
  double ideal;           ///< value of a perfect square; values farther from it than the limit fail
  double usual_limit;     ///< default limit in CriteriaLimits; NaN = not checked
  /// Whether values above the limit fail, instead of those below.
  constexpr bool has_most() const { return usual_limit > ideal; }
};

/// Indexed by Criterion.
constexpr std::array<CriterionInfo, criterion_count> criteria_info{{{"aspect", "", 1, 5},
                                                                    {"warp", "degrees", 0, 15},
                                                                    {"skew", "degrees", 0, 40},
                                                                    {"angle_min", "degrees", 90, 40},
                                                                    {"angle_max", "degrees", 90, 140},
                                                                    {"jacobian_ratio", "", 1, 0.6},
                                                                    {"taper", "", 0, 0.6},
                                                                    {"min_length", "mm", 0, unchecked}}};

/// The default limit of a criterion; NaN = not checked.
constexpr double usual_limit(Criterion criterion) {
  return criteria_info[static_cast<std::size_t>(criterion)].usual_limit;
}

/// One limit per criterion.
struct QUADRILLE_API CriteriaLimits {
  static constexpr double unchecked = quadrille::unchecked;  ///< no value fails it

  CriteriaValues values = usual();        ///< limits, indexed by Criterion
  std::vector<std::string> not_measured;  ///< criteria that a limits file checks and Criterion lacks

  /// Distance of a value from the ideal, divided by that of the limit: above 1 the quad fails. 0 if the
  /// criterion is not checked.
  double severity(Criterion criterion, double value) const;
  bool fails(Criterion criterion, double value) const;  ///< whether the value is beyond the limit

 private:
  static constexpr CriteriaValues usual() {
    CriteriaValues result{};
    for (std::size_t i = 0; i < criterion_count; ++i) result[i] = criteria_info[i].usual_limit;
    return result;
  }
};

/// Whether a quad that fails the criterion is outside the limits, see CriteriaSummary::outside.
constexpr bool is_of_shape(Criterion criterion) {
  return criterion != Criterion::warp && criterion != Criterion::min_length;
}

/// The usual limits, with half the least size that the mesh was made with as the least length of a side.
QUADRILLE_API CriteriaLimits limits_of(const ShellMesh& mesh);

/// Measures all criteria of the quad a, b, c, d.
QUADRILLE_API CriteriaValues measure_criteria(const Vector3& a, const Vector3& b, const Vector3& c,
                                              const Vector3& d);

/// Which quads of a mesh fail, and by which criteria.
struct CriteriaSummary {
  /// The quads of one CAD face.
  struct Face {
    int face = 0;     ///< CAD face, from 1; 0 = none
    int quads = 0;    ///< number of quads on the face
    int failing = 0;  ///< number of those that fail
  };
  /// One of the worst quads.
  struct Quad {
    int quad = 0;                             ///< index into ShellMesh::quads
    int face = 0;                             ///< CAD face, from 1; 0 = none
    Vector3 center;                           ///< mean of the corners
    Criterion criterion = Criterion::aspect;  ///< criterion with the largest severity
    double value = 0;                         ///< value of that criterion
  };
  int quads = 0;    ///< number of quads in the mesh
  int failing = 0;  ///< quads that fail any criterion
  /// Quads that fail a criterion of shape: any but warp, which curved surfaces force, and the shortest side,
  /// which is one of size. This is what "outside" means everywhere; the other two are counted apart.
  int outside = 0;
  std::array<int, criterion_count> failing_by{};  ///< quads that fail each criterion, indexed by Criterion
  std::vector<Face> faces;                        ///< faces with failing quads, ascending by number
  std::vector<Quad> worst;                        ///< the worst of the failing quads, worst first
};

/// Sides in ShellMesh::finer_quads are as short as the user asked for and do not fail.
/// \param worst_count largest number of quads in `worst`. Complexity: linear in the mesh.
QUADRILLE_API CriteriaSummary check_criteria(const ShellMesh& mesh, const CriteriaLimits& limits = {},
                                             int worst_count = 10);

}  // namespace quadrille
