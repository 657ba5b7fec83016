#pragma once
/// The sizes that a mesh would have, on the surface of the model, before it is meshed.

#include <array>
#include <string>
#include <vector>

#include "geometry/base/api.hpp"
#include "geometry/base/execution_context.hpp"
#include "geometry/cad/cad_model.hpp"
#include "mesher/options.hpp"

namespace quadrille {

/// Sizes on a triangulation of the model's surface. Faces share no points.
struct SizeMap {
  /// A source of sizes, named after the option that requests them.
  struct Source {
    std::string name;    ///< "size", "curvature", "short edges", "proximity", "size-on", ...
    double area = 0;     ///< area where this source governs, square millimeters
    double quads = 0;    ///< approximate number of quads there
    double least = 0;    ///< smallest size there, millimeters
    double largest = 0;  ///< largest size there, millimeters
  };
  /// A piece of a CAD edge.
  struct Line {
    std::array<int, 2> points{-1, -1};  ///< indices into points
    int edge = 0;                       ///< CAD edge, from 1
  };
  std::vector<Vector3> points;  ///< (n) millimeters
  std::vector<double> sizes;    ///< (n) wanted size at each point, on bends across them, millimeters
  std::vector<double> along;    ///< (n) on bends, the wanted size along them; equal to `sizes` elsewhere
  std::vector<int> rulers;      ///< (n) index into `sources`: the source that requests the smallest size
  std::vector<std::array<int, 3>> triangles;  ///< (m) counter-clockwise seen from outside
  std::vector<int> faces;                     ///< (m) CAD face of each triangle, from 1
  std::vector<Line> lines;                    ///< along the faces' boundaries
  std::vector<Source> sources;                ///< the global size first, then the others that are in use
  std::vector<int> missing;                   ///< CAD faces that could not be triangulated, from 1
  double quads = 0;                           ///< approximate number of quads of the mesh
};

/// The sizes that mesh() would use. To find the governing source, one field is built for each source alone.
/// The full field is the minimum of these, since gradation turns a minimum into the minimum of the
/// gradations. Time: that of one field per source and of the triangulation. Triangle sides are at most 1.5
/// times the size or 1/300 of the model's diagonal, whichever is larger. Throws Error as mesh() does for
/// invalid options or sizes that exceed the budget.
QUADRILLE_API SizeMap size_map(const CadModel& model, const MeshOptions& options, ExecutionContext& context);

}  // namespace quadrille
