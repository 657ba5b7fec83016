#pragma once
/// Features below the least size that are let go. Internal.

#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/edges/tiny_features.hpp"

namespace quadrille {

/// Chooses the edges that are shorter than the least element and may become points without harm ("virtual
/// topology"): where two edges that meet then meet at an angle fit for a quad, and faces between two edges
/// within that length of each other become edges. No node comes to lie further than `reach` from the place
/// of a vertex that it stands for.
class LetGo {
 public:
  /// \param used (faces) 1 = the face is meshed. \param reach model units; 0 = nothing is let go.
  LetGo(const CadShape& shape, const std::vector<char>& used, double reach);

  /// What is left out with these and `collapse` (edges) together; see find_tiny_features().
  TinyFeatures find(const std::vector<char>& collapse, double length) const;

  /// Keeps what was let go on the face and at its vertices. \param face from 0. \param tiny what find() gave.
  /// \return false if there was nothing.
  bool keep_around(int face, const TinyFeatures& tiny);

  /// (edges) 1 = becomes a point.
  const std::vector<char>& edges() const { return edges_; }

 private:
  void choose();
  bool keep_harmed();

  const CadShape& shape_;
  const std::vector<char>& used_;
  double reach_;
  std::vector<char> edges_;       // (edges)
  std::vector<char> kept_faces_;  // (faces) they may not become edges
};

}  // namespace quadrille
