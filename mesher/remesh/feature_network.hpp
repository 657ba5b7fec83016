#pragma once
/// A triangulated surface cut into faces: where its features run. Internal.

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "geometry/base/vector.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// A line of sides along which the surface is cut, from corner to corner.
struct FeatureCurve {
  std::vector<int> points;      ///< of the surface, in order; closed curves end with their first one
  std::vector<Vector3> places;  ///< theirs
  std::vector<double> along;    ///< length from the start to each, millimeters
  int edge = 0;                 ///< the number that the input has for it; 0 = none

  bool closed() const { return points.front() == points.back(); }
  double length() const { return along.back(); }
  /// The place at a length from the start. O(log n).
  Vector3 at(double length) const;
};

/// Faces, the curves between them and the corners of those.
struct FeatureNetwork {
  std::vector<int> patches;          ///< (triangles) the face of each, from 0
  int patch_count = 0;               ///< faces
  std::vector<FeatureCurve> curves;  ///< in the order of their first sides
  std::vector<char> corner;          ///< (points) 1 = curves end here
};

/// What tells faces apart.
struct FeatureRules {
  double angle =
      40;           ///< degrees between the normals of neighbors from which on they are of two faces; 0 = any
  double size = 0;  ///< of elements, millimeters: what is far smaller is no feature
  std::map<std::pair<int, int>, int> sides;  ///< that stay, by their points in ascending order, with a number
  std::vector<char> fixed;                   ///< (points) 1 = a corner wherever a curve comes by
};

/// Cuts a surface where its tags change, at the sides that are to stay and at folds. Faces that folds alone
/// make, of less area than a sixteenth of an element, go to a neighbor; folds that end inside a face count
/// from four elements' length on. \param surface manifold and oriented alike. O(n log n).
FeatureNetwork find_features(const TriangleMesh& surface, const FeatureRules& rules);

/// Where nodes go on each curve: lengths from its start, both ends included, about as far apart as `targets`
/// wants, nearer where the curve turns by more than 60 degrees between two nodes (down to an eighth), and
/// graded from there. Closed curves have three segments at least. \param targets (curves) millimeters.
std::vector<std::vector<double>> place_on_curves(const FeatureNetwork& network,
                                                 const std::vector<double>& targets);

}  // namespace quadrille
