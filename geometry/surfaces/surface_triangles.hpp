#pragma once
/// Triangles on the faces of a model, for display and for ray casting. Internal.

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/base/vector.hpp"
#include "geometry/cad/ids.hpp"

namespace quadrille {

class CadShape;

/// Triangles and their points. Faces share no points.
struct SurfaceTriangles {
  /// A segment of a CAD edge in the triangulation of one of its faces.
  struct Line {
    std::array<int, 2> points{-1, -1};  ///< indices into points
    int edge = 0;                       ///< edge number in the file, from 1
    FaceId face;
  };
  std::vector<Vector3> points;                ///< (n) millimeters
  std::vector<Vector2> uv;                    ///< (n) parameters on the surface, approximate
  std::vector<FaceId> point_faces;            ///< (n) CAD face of each point
  std::vector<std::array<int, 3>> triangles;  ///< (m) counter-clockwise seen from outside
  std::vector<FaceId> faces;                  ///< (m) CAD face of each triangle, ascending
  std::vector<Line> lines;                    ///< segments along the faces' boundaries
  std::vector<FaceId> missing;                ///< CAD faces without triangles, ascending
};

/// Triangulates a copy of the model with OpenCASCADE. \param deflection largest distance from the surface,
/// millimeters. \param turn largest angle between neighboring triangles of a curved face, radians.
SurfaceTriangles triangulate_surface(const CadShape& shape, double deflection, double turn,
                                     const FaceFlags& used, const ExecutionContext& context);

/// Bisects sides that are longer than wanted, until there are none or there are `most` triangles. The
/// triangles of a face are conforming if there are none. \param longest(face, point) the longest side wanted
/// with its middle there.
void divide_sides(SurfaceTriangles& surface,
                  const std::function<double(FaceId face, const Vector3&)>& longest, std::size_t most,
                  const ExecutionContext& context);

}  // namespace quadrille
