#pragma once
/// Meshes as arrays of indices. All indices start at 0; CAD numbers (faces, edges, vertices) start at 1, as
/// in FreeCAD, and 0 means "none".

#include <array>
#include <compare>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geometry/base/vector.hpp"

namespace quadrille {

/// Triangles over points; consistently oriented, manifold, with or without boundary.
struct TriangleMesh {
  std::vector<Vector3> points;                ///< (n)
  std::vector<std::array<int, 3>> triangles;  ///< (m) indices into points, counter-clockwise
  /// (m) or empty. Elements with different tags are never joined: sides between them are kept as boundary.
  std::vector<int> tags;
  /// (n) or empty: 1 = the point keeps its position when the quads made from the triangles are improved.
  std::vector<char> fixed;
};

/// Quads over points, and the triangles that could not be paired.
struct QuadMesh {
  std::vector<Vector3> points;                ///< (n)
  std::vector<std::array<int, 4>> quads;      ///< (m) indices into points, counter-clockwise
  std::vector<std::array<int, 3>> triangles;  ///< unpaired triangles; none if the count was even
  std::vector<int> quad_tags;                 ///< (m) or empty
  std::vector<int> triangle_tags;             ///< as many as triangles, or empty
};

/// The outcome for a CAD face.
enum class FaceStatus {
  meshed,
  skipped,  ///< not requested
  failed,
  merged  ///< left out as tiny
};

/// The status as reports spell it: "meshed", "skipped", "failed", "merged".
inline std::string_view name_of(FaceStatus status) {
  constexpr std::array<std::string_view, 4> names{"meshed", "skipped", "failed", "merged"};
  return names[static_cast<std::size_t>(status)];
}

/// The mesh of a CAD model: all quads, conforming, each element and node tied to its CAD entity.
struct ShellMesh {
  /// A side of the mesh that lies on a CAD edge.
  struct Segment {
    std::array<int, 2> nodes{-1, -1};  ///< end nodes, in the direction of the CAD edge's parameter
    int middle = -1;                   ///< midside node at second order, else -1
    int edge = 0;                      ///< CAD edge, from 1
  };
  /// A node that lies on a CAD vertex.
  struct Corner {
    int node = -1;   ///< index into points
    int vertex = 0;  ///< CAD vertex, from 1
  };
  /// The outcome for one CAD face.
  struct Face {
    int face = 0;                             ///< CAD face, from 1
    FaceStatus status = FaceStatus::skipped;  ///< outcome
    /// Why the face failed, or the problems met and the remedy applied to each; empty if there were none.
    std::string note;
    /// The work that all meshings of the face took, and the limit on it. The unit is one check for
    /// cancellation; their number is the same in each run.
    std::int64_t work = 0 /**< work done */, share = 0; /**< work allowed */
    int attempts = 0;             ///< number of meshings, for its own sake or a neighbor's
    int quads = 0;                ///< number of quads
    double q_min = 0;             ///< lowest q of the quads
    double seconds = 0;           ///< time that meshing took
    int off_geometry = 0;         ///< number of its nodes in ShellMesh::off_geometry
    double off_geometry_max = 0;  ///< largest distance of those nodes
    double filled_area = 0;       ///< area of the filled holes in it (filled_holes), millimeters^2
  };
  /// A node that lies off the geometry because elements would be inverted or fold with it there: a midside
  /// node, or any node of a face that has no valid mesh on its surface.
  struct OffGeometry {
    int node = -1;        ///< index into points
    double distance = 0;  ///< distance to its place on the CAD edge, or to the face's surface
  };

  /// A CAD edge or vertex that is not meshed because it is too small.
  struct SuppressedFeature {
    /// The kind of an entity.
    enum class Kind { edge, vertex };
    Kind kind = Kind::edge;     ///< kind of the suppressed entity
    int number = 0;             ///< its number, from 1
    Kind to_kind = Kind::edge;  ///< kind of the entity that stands for it
    int to = 0;                 ///< number of the edge or vertex whose nodes stand for it
    double distance = 0;        ///< farthest that a point of it lies from that edge or vertex, millimeters
  };

  /// A CAD edge between faces that meet smoothly, or a piece of it, that quads cross, or one inside coplanar
  /// faces that were joined: it has no segments.
  struct CrossedEdge {
    int edge = 0;                ///< its number, from 1
    std::array<int, 2> faces{};  ///< its faces, from 1; quads belong to the one that their center lies on
    std::vector<Vector3> line;   ///< points on it, in the direction of its parameter, to draw it by
    /// Whether edge and faces are the same.
    friend bool operator==(const CrossedEdge& a, const CrossedEdge& b) {
      return a.edge == b.edge && a.faces == b.faces;
    }
    /// By edge, then by faces.
    friend bool operator<(const CrossedEdge& a, const CrossedEdge& b) {
      return std::pair(a.edge, a.faces) < std::pair(b.edge, b.faces);
    }
  };

  /// A hole, a pocket or a boss that was left out: the faces that it lies in are meshed as if it was not
  /// there.
  struct FilledHole {
    Vector3 center{0, 0, 0};  ///< center of its mouth
    double diameter = 0;      ///< largest distance of two points of its mouth, millimeters
    bool boss = false;        ///< it stands out of the face
    std::vector<int> in;      ///< the faces that it lies in, from 1: one, or two where it goes through
    std::vector<int> faces;   ///< the faces that were left out, from 1, ascending; none in a sheet
  };

  /// A CAD edge or face below the least size that is meshed nevertheless.
  struct Kept {
    int dimension = 1;  ///< 1: edge, 2: face
    int number = 0;     ///< its number, from 1
    std::string why;    ///< what would be wrong without it
  };

  /// The quads outside the usual limits that one CAD edge, or one reason on a CAD face, forces.
  struct PoorQuads {
    /// What forces them.
    enum class Cause {
      short_edge,  ///< the edge is short
      corner,      ///< two edges of the face meet at a sharp angle
      narrow,      ///< the face is narrow
      none         ///< nothing there is too small or sharp
    };
    Cause cause = Cause::none;  ///< what forces them
    int dimension = 2;          ///< 1: edge, 2: face
    int number = 0;             ///< its number, from 1
    int quads = 0;              ///< number of quads
    double shortest = 0;        ///< shortest side of these, millimeters
    std::string why;            ///< what is small or sharp there

    /// Whether the part, not the mesher, is the cause.
    bool is_forced() const { return cause != Cause::none; }
  };

  /// A set of entities that has a name or a number of its own in the file that the mesh was read from.
  struct Group {
    std::string name;           ///< empty = the group has only a number
    int dimension = 2;          ///< 2: group of elements, 1: of segments, 0: of nodes
    int number = 0;             ///< number in the file; 0 = none
    std::vector<int> entities;  ///< the faces, edges or vertices in the group, ascending
  };

  /// A node at a place that the user chose.
  struct PlacedNode {
    std::string name;    ///< of its group
    int vertex = 0;      ///< its corner's vertex; 0 = not in the mesh, since its faces were left out
    bool added = false;  ///< the vertex is not in the CAD model: its number follows those of the model
  };

  /// The thickness of the shell on a CAD face where it varies over the face.
  struct VaryingThickness {
    int face = 0;                     ///< CAD face, from 1
    double thinnest = 0;              ///< smallest thickness, millimeters
    double thickest = 0;              ///< largest thickness, millimeters
    std::vector<int> nodes;           ///< nodes of the face's elements, ascending
    std::vector<double> thicknesses;  ///< thickness at each of those nodes, millimeters
  };

  double size_min = 0;                    ///< least size of the mesh by its sizes, millimeters; 0 = not known
  std::vector<int> finer_quads;           ///< quads, ascending, where the user asks for sizes below size_min
  int order = 1;                          ///< 1: four-node quads; 2: eight-node (serendipity) quads
  std::vector<Vector3> points;            ///< (n) all nodes, corner nodes first, then midside nodes
  std::vector<std::array<int, 4>> quads;  ///< (m) corner nodes, counter-clockwise seen from outside
  std::vector<std::array<int, 4>>
      midsides;                 ///< (m) at second order: node between corners j and j + 1; else empty
  std::vector<int> quad_faces;  ///< (m) CAD face of each quad, from 1
  std::vector<std::array<int, 3>> triangles;  ///< empty except in meshes read from files of other programs
  std::vector<int> triangle_faces;            ///< CAD face of each triangle, from 1
  std::vector<Segment> segments;              ///< the sides on CAD edges, each once
  std::vector<Corner> corners;                ///< the nodes on CAD vertices and those of placed_nodes
  std::vector<PlacedNode> placed_nodes;       ///< in the order in which they were requested
  std::vector<OffGeometry> off_geometry;      ///< ascending by node; usually empty
  std::vector<SuppressedFeature>
      suppressed_features;                 ///< edges, then vertices, ascending; for faces see Face::status
  std::vector<Kept> kept;                  ///< faces, then edges, ascending
  std::vector<FilledHole> filled_holes;    ///< ascending by the first face they lie in
  std::vector<CrossedEdge> crossed_edges;  ///< ascending
  std::vector<std::string> warnings;       ///< what was not done as asked, one sentence each
  std::vector<PoorQuads> poor_quads;       ///< those that most quads have first
  std::vector<int> marked_edges;           ///< CAD edges, from 1, that pictures draw in red
  std::vector<Face> faces;                 ///< one entry per CAD face; empty in meshes read from files
  /// The groups in a file that the mesh was read from, in file order. Groups may overlap: entities are made
  /// small enough that each group is a set of whole entities. If this is empty, written files get one group
  /// for each entity: Face3, Edge7, Vertex2.
  std::vector<Group> groups;
  /// Thickness of the shell on each CAD face, by face number minus 1, in millimeters; empty if unknown.
  std::vector<double> thicknesses;
  /// The faces whose thickness varies, ascending. `thicknesses` holds the mean of each such face.
  std::vector<VaryingThickness> varying_thicknesses;
  /// Groups that files get besides those of entities: the faces with one name in the CAD file; for middle
  /// surfaces, those that belong to each face of the solid, and the free edges on it.
  std::vector<Group> extra_groups;
};

}  // namespace quadrille
