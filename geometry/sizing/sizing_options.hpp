#pragma once
/// What size is wanted where.

#include <filesystem>
#include <limits>
#include <map>
#include <vector>

#include "geometry/base/vector.hpp"

namespace quadrille {

/// What one run may make, so that no setting and no damaged file takes all memory. Estimated before anything
/// is made, and counted while it is.
struct Budget {
  double elements = 50e6;  ///< the most
  double segments = 5e6;   ///< of all edges
  double blocks = 4e5;     ///< of 512 voxels (2.1 kB) in the sizing field
  /// What an element takes at most while it is made, as measured on parts of half a million; all of them must
  /// fit into the memory that is free.
  double bytes_an_element = bytes_an_element_of_order(1);

  /// Memory that an element takes while it is made.
  static constexpr double bytes_an_element_of_order(int order) { return order == 2 ? 500 : 200; }
  /// One that nothing passes.
  static Budget unlimited() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {infinity, infinity, infinity, 0};
  }
};

/// How far a segment may be from the curve or surface that it stands for; both 0 = any distance.
struct ChordError {
  double length = 0;  ///< millimeters
  double share = 0;   ///< of the global size
};

/// A size in a part of space, and how it changes around it.
struct SizeRegion {
  /// Of the part of space.
  enum class Shape { box, sphere, cylinder, half_space };
  Shape shape = Shape::box;  ///< which of these
  Vector3 a{0, 0, 0};        ///< lowest corner; center; start of the axis; a point of the border
  Vector3 b{0, 0, 0};        ///< highest corner; unused; end of the axis; the way in from the border
  double radius = 0;         ///< of a sphere or cylinder
  double size = 0;           ///< inside
  double transition = 0;     ///< length outside over which sizes reach the global one; 0 = as growth has it

  /// From the region; 0 inside.
  double distance(const Vector3& point) const;
};

/// How many segments a CAD edge gets, and how their lengths follow each other.
struct EdgeSpacing {
  int segments = 0;      ///< 0 = by the size asked for on the edge
  double bias = 1;       ///< length of each segment over that of the one before, in the edge's direction
  double bias_both = 1;  ///< the same from both ends to the middle
};

/// Sizes that grow with the distance as the heights of layers do.
struct SizeLayers {
  double first = 0;  ///< at the face, edge or vertex itself
  double ratio = 1;  ///< of each layer's height to that of the one before
  int count = 0;     ///< layers

  double last() const;  ///< the size where the layers end
};

/// CAD faces, edges and vertices by number.
template <class Value>
struct ByElement {
  std::map<int, Value> faces;     ///< by CAD face, from 1
  std::map<int, Value> edges;     ///< by CAD edge
  std::map<int, Value> vertices;  ///< by CAD vertex
  /// Whether there is none of either.
  bool empty() const { return faces.empty() && edges.empty() && vertices.empty(); }
};

/// Which way sizes grow: only along faces and from one to the next over their edges, or through air as well.
enum class Gradation { surface, space };

/// The size wanted, by source; the smallest wins, and the result varies no faster than `growth`.
struct SizingOptions {
  double size = 0;                    ///< global target edge length; 0 = diagonal / elements_per_diagonal
  double elements_per_diagonal = 60;  ///< of the model's box
  double size_min = 0;                ///< no source goes below this; 0 = size / 8
  double elements_per_circle = 12;    ///< elements per 2 pi of curvature; 0 = curvature is ignored
  ChordError chord_error;             ///< beside elements_per_circle
  bool short_edges = true;            ///< edges below the size ask for their length
  double proximity = 0;               ///< elements across a gap inside a face; 0 = any number
  double proximity_walls = 0;         ///< elements through the thickness of a wall; 0 = any number
  double growth = 0.3;                ///< gradation: largest |grad size|
  Gradation gradation = Gradation::surface;  ///< which way sizes grow
  std::map<int, double> face_sizes;          ///< CAD face -> size on it
  std::map<int, double> edge_sizes;          ///< CAD edge -> size on it
  std::map<int, double> vertex_sizes;        ///< CAD vertex -> size at it
  std::vector<SizeRegion> regions;           ///< parts of space with sizes
  ByElement<SizeLayers> layers;              ///< sizes by the distance from elements
  std::map<int, EdgeSpacing> spacings;       ///< CAD edge -> how it is divided, whatever else is asked for
  std::filesystem::path size_field;          ///< external .vdb grid that caps the size; empty = none
  double size_field_scale = 1;               ///< on the sizes in it
  double size_field_unit = 1;                ///< millimeters to a unit of length in it, of places and sizes
  std::filesystem::path size_points;         ///< .csv with lines x,y,z,size; empty = none
  Budget budget;                             ///< what may be spent
};

}  // namespace quadrille
