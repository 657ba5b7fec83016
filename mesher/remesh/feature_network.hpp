#pragma once
/// Finds the features along which a triangulated surface is cut into faces. Internal.

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "geometry/base/vector.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// A chain of sides along which the surface is cut, from corner to corner or closed.
struct FeatureCurve {
  std::vector<int> points;      ///< points of the surface, in order; a closed curve ends with its first point
  std::vector<Vector3> places;  ///< positions of those points
  std::vector<double> along;    ///< length of the curve from its start to each point, millimeters
  int edge = 0;                 ///< edge number in the input; 0 = none

  bool closed() const { return points.front() == points.back(); }
  double length() const { return along.back(); }
  /// The position at a given length from the start. O(log n).
  Vector3 at(double length) const;
};

/// The faces, the curves between them, and the corners where curves end.
struct FeatureNetwork {
  std::vector<int> patches;          ///< (triangles) the face of each triangle, from 0
  int patch_count = 0;               ///< number of faces
  std::vector<FeatureCurve> curves;  ///< chains from corners first, then closed ones, each by first side
  std::vector<char> corner;          ///< (points) 1 = curves end at the point
};

/// The rules by which the surface is divided into faces.
struct FeatureRules {
  double angle = 40;  ///< a side is a fold if the normals beside it differ by more degrees; 0 = no folds
  double size = 0;    ///< element size, millimeters; folds and faces that are far smaller are not features
  std::map<std::pair<int, int>, int> sides;  ///< sides to keep: their points, ascending -> edge number
  std::vector<char> fixed;                   ///< (points) 1 = a corner if a curve passes through the point
};

/// Cuts a surface where its tags change, along the sides to keep, and at folds. A face with less than a
/// sixteenth of an element's area joins the neighbor with which it shares the greatest length of folds. Folds
/// inside a face count only if they are connected over at least four element lengths. \param surface manifold
/// and consistently oriented. O(n log n).
FeatureNetwork find_features(const TriangleMesh& surface, const FeatureRules& rules);

/// Places nodes on each curve. \return (curves) lengths from the start, both ends included. Nodes are about
/// as far apart as `targets` asks. They are closer (down to about an eighth) on curves that would turn by
/// more than about 60 degrees between two nodes, and spacings are graded from curve to curve. Closed curves
/// have at least three segments. \param targets (curves) wanted segment lengths, millimeters.
std::vector<std::vector<double>> place_on_curves(const FeatureNetwork& network,
                                                 const std::vector<double>& targets);

}  // namespace quadrille
