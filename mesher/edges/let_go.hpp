#pragma once
/// Features below the least size that are let go. Internal.

#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/edges/tiny_features.hpp"

namespace quadrille {

/// Chooses the edges shorter than `reach` that can become points without harm ("virtual topology"): edges
/// that meet as a result must meet at an angle fit for a quad. Faces between two edges within `reach` of each
/// other become edges. No node lies further than `reach` from a vertex that it replaces.
class LetGo {
 public:
  /// \param used (faces) 1 = the face is meshed. \param reach model units; 0 = nothing is let go.
  /// \param fine (edges) 1 = must not become a point; nor does a face become an edge if all its edges are so.
  LetGo(const CadShape& shape, const std::vector<char>& used, double reach, const std::vector<char>& fine);

  /// What is left out of the mesh if edges() and the edges marked in `collapse` become points; see
  /// find_tiny_features().
  TinyFeatures find(const std::vector<char>& collapse, double length) const;

  /// Keeps what was let go on the face, on the faces beside it and at its vertices. \param face from 0.
  /// \param tiny the result of find(). \return false if nothing was let go there.
  bool keep_around(int face, const TinyFeatures& tiny);

  /// (edges) 1 = becomes a point.
  const std::vector<char>& edges() const { return edges_; }

 private:
  void choose(const std::vector<char>& fine);
  bool keep_harmed();

  const CadShape& shape_;
  const std::vector<char>& used_;
  double reach_;
  std::vector<char> edges_;       // (edges) 1 = becomes a point
  std::vector<char> kept_faces_;  // (faces) 1 = must not become an edge
};

}  // namespace quadrille
