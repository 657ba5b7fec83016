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

/// Sizes over triangles of the model's surface. Each face has points of its own.
struct SizeMap {
  /// What asks for sizes, by the options that say so.
  struct Source {
    std::string name;    ///< "size", "curvature", "short edges", "proximity", "size-on", ...
    double area = 0;     ///< where it rules, square millimeters
    double quads = 0;    ///< about how many there would be there
    double least = 0;    ///< size where it rules, millimeters
    double largest = 0;  ///< the same
  };
  /// A piece of a CAD edge.
  struct Line {
    std::array<int, 2> points{-1, -1};  ///< indices into points
    int edge = 0;                       ///< CAD edge, from 1
  };
  std::vector<Vector3> points;                ///< (n) millimeters
  std::vector<double> sizes;                  ///< (n) wanted there, millimeters
  std::vector<int> rulers;                    ///< (n) index into sources of the one that asks for the least
  std::vector<std::array<int, 3>> triangles;  ///< (m) counter-clockwise seen from outside
  std::vector<int> faces;                     ///< (m) CAD face of each triangle, from 1
  std::vector<Line> lines;                    ///< along the faces' boundaries
  std::vector<Source> sources;                ///< the size itself, then those that the options have
  std::vector<int> missing;                   ///< CAD faces that could not be shown, from 1
  double quads = 0;                           ///< about how many the mesh would have
};

/// The sizes that mesh() would work with. Which source rules is found by letting each make a field alone: the
/// field of all is the least of those, since gradation takes least values to least values. Time: that of a
/// field for each source, and of the triangles, which are no longer than 1.5 times the size or a 300th of the
/// model. Throws Error as mesh() for options that make no sense or sizes that pass their budget.
QUADRILLE_API SizeMap size_map(const CadModel& model, const MeshOptions& options, ExecutionContext& context);

}  // namespace quadrille
