#pragma once
/// How quads are improved.

namespace quadrille {

/// How quads are improved.
struct ImproveOptions {
  bool clean_up = true;      ///< small patches are refilled for better valences
  int smoothing_sweeps = 8;  ///< sweeps over the nodes of a face
  /// Passes of the last optimization over all faces together, in which nodes slide along CAD edges too; 0 =
  /// none.
  int sliding_sweeps = 30;
};

}  // namespace quadrille
