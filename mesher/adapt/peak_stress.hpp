#pragma once
/// Where the stresses of a solution are largest, and how they change from one mesh to the next.

#include <array>
#include <string>
#include <vector>

#include "geometry/base/api.hpp"
#include "geometry/base/vector.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

struct ShellStress;

/// A corner node of the mesh where the stress is larger than at all nodes around it.
struct StressPeak {
  Vector3 at{0, 0, 0};        ///< place of the node
  double stress = 0;          ///< von Mises stress at the shell's surface, for Young's modulus 1
  double size = 0;            ///< mean size of the quads at the node
  bool sharp_corner = false;  ///< the mesh's rim has a sharp re-entrant corner there: stress has no limit
};

/// How a peak has changed since the previous mesh.
struct PeakChange {
  StressPeak peak;    ///< on the new mesh
  double change = 0;  ///< relative to the stress before: 0.2 = 20 % more

  /// Whether the peak is singular: it grows at a sharp re-entrant corner.
  bool is_singular() const { return change > 0 && peak.sharp_corner; }
  /// One sentence with place, change in percent and what to do.
  QUADRILLE_API std::string sentence() const;
};

/// The highest peaks of at least 0.3 of the largest stress, at most ten, the highest first, none within three
/// sizes of a higher one. The stress at a node is the mean over its quads of the stress extrapolated to it.
/// Internal. \param stresses (quads) at four points each
std::vector<StressPeak> stress_peaks(const ShellMesh& mesh,
                                     const std::vector<std::array<ShellStress, 4>>& stresses);

/// The changes of peaks that stand where one stood before, within twice the larger of the two sizes, by more
/// than 5 %; in the order of the peaks. Internal.
std::vector<PeakChange> changes_of_peaks(const std::vector<StressPeak>& before,
                                         const std::vector<StressPeak>& now);

}  // namespace quadrille
