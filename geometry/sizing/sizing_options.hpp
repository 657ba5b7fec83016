#pragma once
/// The options for the sizes wanted.

#include <filesystem>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "geometry/base/vector.hpp"

namespace quadrille {

/// Limits of one run, so that no setting and no damaged file takes all memory. Amounts are estimated in
/// advance and counted during the run.
struct Budget {
  double elements = 50e6;  ///< largest number of elements
  double segments = 5e6;   ///< largest number of segments, all edges together
  double blocks = 4e5;     ///< largest number of blocks of 512 voxels (2.1 kB) in the sizing field
  /// Peak bytes per element, measured on parts of half a million elements. All elements must fit into the
  /// free memory. 0 = not checked.
  double bytes_an_element = bytes_an_element_of_order(1);

  /// Peak bytes per element of this order (1 or 2).
  static constexpr double bytes_an_element_of_order(int order) { return order == 2 ? 500 : 200; }
  /// A budget that nothing exceeds.
  static Budget unlimited() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {infinity, infinity, infinity, 0};
  }
};

/// The largest distance of a segment from the curve or surface that it approximates; both 0 = no limit.
struct ChordError {
  double length = 0;  ///< millimeters
  double share = 0;   ///< share of the global size
};

/// A size in a region of space, and its transition around the region.
struct SizeRegion {
  /// Shape of the region.
  enum class Shape { box, sphere, cylinder, half_space };
  Shape shape = Shape::box;  ///< shape of the region
  Vector3 a{0, 0, 0};        ///< lowest corner; center; start of the axis; point on the border
  Vector3 b{0, 0, 0};        ///< highest corner; unused; end of the axis; inward normal of the border
  double radius = 0;         ///< radius of a sphere or cylinder
  double size = 0;           ///< size inside the region
  double transition = 0;     ///< distance outside over which sizes reach the global one; 0 = set by growth

  /// Distance of a point from the region; 0 inside.
  double distance(const Vector3& point) const;
};

/// The number of segments of a CAD edge, and the ratios of their lengths.
struct EdgeSpacing {
  int segments = 0;      ///< number of segments; 0 = from its chord, or the size requested on the edge
  double bias = 1;       ///< length ratio of each segment to the one before, in the edge's direction
  double bias_both = 1;  ///< the same ratio from both ends to the middle
};

/// A place that gets a node.
struct NodePlace {
  std::string name;        ///< of the node's group; empty = Node1, Node2, ...
  Vector3 point{0, 0, 0};  ///< where, in millimeters
};

/// What a map has for a number, or `otherwise`.
inline double value_or(const std::map<int, double>& values, int number, double otherwise) {
  const auto found = values.find(number);
  return found == values.end() ? otherwise : found->second;
}

/// How sizes grow: only along faces and across their common edges, or also through space.
enum class Gradation { surface, space };

/// The wanted size by source. The smallest wins, and the result varies no faster than `growth`.
struct SizingOptions {
  double size = 0;                    ///< global target length; 0 = diagonal / elements_per_diagonal
  double elements_per_diagonal = 60;  ///< elements along the diagonal of the model's bounding box
  double size_min = 0;                ///< lower limit of sizes, unless users request less; 0 = size / 8
  double elements_per_circle = 12;    ///< elements per 2 pi of curvature; 0 = curvature is ignored
  ChordError chord_error;             ///< applies in addition to elements_per_circle
  /// largest length over width of quads where sizes have directions: in rows over bends, fillets and strips
  double aspect = 4;
  bool short_edges = true;                   ///< edges and parts of faces that are small request small sizes
  double proximity = 0;                      ///< elements across a gap inside a face; 0 = any number
  double growth = 0.3;                       ///< gradation: largest |grad size|
  Gradation gradation = Gradation::surface;  ///< how sizes grow
  std::map<int, double> face_sizes;          ///< CAD face -> size on it
  std::map<int, double> edge_sizes;          ///< CAD edge -> size on it
  std::map<int, double> vertex_sizes;        ///< CAD vertex -> size at it
  std::vector<SizeRegion> regions;           ///< regions of space with sizes
  std::map<int, EdgeSpacing> spacings;       ///< CAD edge -> its division, whatever else is requested
  std::set<int> kept_faces;                  ///< CAD faces whose edges are kept too
  std::set<int> kept_edges;                  ///< CAD edges that are not suppressed, and that no quad crosses
  std::vector<NodePlace> nodes;              ///< places on the model that get nodes
  std::filesystem::path size_field;          ///< external .vdb grid that caps the size; empty = none
  double size_field_scale = 1;               ///< factor on the sizes in it
  double size_field_unit = 1;                ///< millimeters per unit of length in it (positions and sizes)
  std::filesystem::path size_points;         ///< .csv with lines x,y,z,size; empty = none
  Budget budget;                             ///< limits of the run

  /// Whether a setting names the CAD face. \param face its number, from 1
  bool names_face(int face) const { return face_sizes.contains(face) || kept_faces.contains(face); }
  /// Whether a setting names the CAD edge. \param edge its number, from 1
  bool names_edge(int edge) const {
    return edge_sizes.contains(edge) || spacings.contains(edge) || kept_edges.contains(edge);
  }
  /// Whether a setting names the CAD vertex. \param vertex its number, from 1
  bool names_vertex(int vertex) const { return vertex_sizes.contains(vertex); }
};

}  // namespace quadrille
