#pragma once
/// Triangles on the faces of a model, for display and for ray casting. Internal.

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/base/vector.hpp"

namespace quadrille {

class CadShape;

/// Triangles and their points. Faces share no points.
struct SurfaceTriangles {
  /// A segment of a CAD edge in the triangulation of one of its faces.
  struct Line {
    std::array<int, 2> points{-1, -1};  ///< indices into points
    int edge = 0;                       ///< edge number in the file, from 1
    int face = 0;                       ///< from 1
  };
  std::vector<Vector3> points;                ///< (n) millimeters
  std::vector<int> point_faces;               ///< (n) CAD face of each point, from 1
  std::vector<std::array<int, 3>> triangles;  ///< (m) counter-clockwise seen from outside
  std::vector<int> faces;                     ///< (m) CAD face of each triangle, from 1, ascending
  std::vector<Line> lines;                    ///< segments along the faces' boundaries
  std::vector<int> missing;                   ///< CAD faces without triangles, from 1, ascending
};

/// Triangulates a copy of the model with OpenCASCADE. \param deflection largest distance from the surface,
/// millimeters. \param turn largest angle between neighboring triangles of a curved face, radians.
/// \param used (faces) 1 = wanted.
SurfaceTriangles triangulate_surface(const CadShape& shape, double deflection, double turn,
                                     const std::vector<char>& used, const ExecutionContext& context);

/// Bisects sides that are longer than wanted, until there are none or there are `most` triangles. The
/// triangles of a face stay conforming. \param longest(face from 1, point) the longest side wanted there.
void divide_sides(SurfaceTriangles& surface, const std::function<double(int face, const Vector3&)>& longest,
                  std::size_t most, const ExecutionContext& context);

}  // namespace quadrille
