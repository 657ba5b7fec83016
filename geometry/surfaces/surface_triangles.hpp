#pragma once
/// Triangles on the faces of a model, for looking at it and for rays. Internal.

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/base/vector.hpp"

namespace quadrille {

class CadShape;

/// Triangles over points that each face has for itself.
struct SurfaceTriangles {
  /// A piece of a CAD edge, as one of its faces has it.
  struct Line {
    std::array<int, 2> points{-1, -1};  ///< indices into points
    int edge = 0;                       ///< as the file numbers it, from 1
    int face = 0;                       ///< from 1
  };
  std::vector<Vector3> points;                ///< (n) millimeters
  std::vector<int> point_faces;               ///< (n) CAD face of each point, from 1
  std::vector<std::array<int, 3>> triangles;  ///< (m) counter-clockwise seen from outside
  std::vector<int> faces;                     ///< (m) CAD face of each triangle, from 1, ascending
  std::vector<Line> lines;                    ///< along the faces' boundaries
  std::vector<int> missing;                   ///< CAD faces that got no triangles, from 1, ascending
};

/// Triangulates a copy of the model by OpenCASCADE. \param deflection largest distance from the surface,
/// millimeters. \param turn radians between neighboring triangles of a curved face, at most. \param used
/// (faces) 1 = wanted.
SurfaceTriangles triangulate_surface(const CadShape& shape, double deflection, double turn,
                                     const std::vector<char>& used, const ExecutionContext& context);

/// Divides sides that are longer than wanted in their middle, until there are none, or there are `most`
/// triangles. Sides stay whole where the next triangle has none of it: neighbors share all points. \param
/// longest(face from 1, point) the length wanted there.
void divide_sides(SurfaceTriangles& surface, const std::function<double(int face, const Vector3&)>& longest,
                  std::size_t most, const ExecutionContext& context);

}  // namespace quadrille
