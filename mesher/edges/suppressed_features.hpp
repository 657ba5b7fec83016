#pragma once
/// Features below the least size that are suppressed. Internal.

#include <map>
#include <string>
#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/edges/tiny_features.hpp"

namespace quadrille {

/// Chooses the edges shorter than `reach` that can become points without harm ("virtual topology"): edges
/// that meet as a result must not meet too sharply. Faces narrower than `reach` become edges (slivers.hpp).
/// No node lies further than `reach` from a vertex that it replaces.
class SuppressedFeatures {
 public:
  /// \param used 1 = the face is meshed. \param reach model units; 0 = nothing is suppressed.
  /// \param fine 1 = must not become a point; a face with only such edges does not become an edge either,
  /// and no such edge gets the nodes of another.
  /// \param held vertices that share their nodes with no other: edges that end there and faces around them
  /// stay.
  SuppressedFeatures(const CadShape& shape, const FaceFlags& used, double reach, const EdgeFlags& fine,
                     const std::vector<VertexId>& held = {});

  /// What is left out of the mesh if edges() become points; see find_tiny_features().
  TinyFeatures find(double length) const;

  /// Restores what was suppressed at these edges of the face, beside them and at their vertices or, if there
  /// is nothing, all around the face. \param edges none = all of the face \param tiny the result of find().
  /// \return false if nothing was suppressed there.
  bool keep_around(FaceId face, const std::vector<EdgeId>& edges, const TinyFeatures& tiny);

  /// 1 = becomes a point.
  const EdgeFlags& edges() const { return edges_; }

  /// Small edges and narrow faces that are kept nevertheless, and why.
  const std::map<EdgeId, std::string>& kept_edges() const { return kept_edges_; }
  const std::map<FaceId, std::string>& kept_faces() const { return reasons_; }

 private:
  void hold(const std::vector<VertexId>& held, EdgeFlags& fine);
  void choose(const EdgeFlags& fine);
  bool keep_harmed();
  void keep_face(FaceId face, const std::string& why);

  const CadShape& shape_;
  const FaceFlags& used_;
  double reach_;
  SliverChoice slivers_;
  EdgeFlags edges_;  // 1 = becomes a point
  std::map<EdgeId, std::string> kept_edges_;
  std::map<FaceId, std::string> reasons_;
};

}  // namespace quadrille
