#pragma once
/// Meshes as arrays of indices. All indices start at 0; CAD numbers (faces, edges, vertices) start at 1, as
/// in FreeCAD, and 0 means "none".

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/base/vector.hpp"

namespace quadrille {

/// Triangles over points; consistently oriented, manifold, with or without boundary.
struct TriangleMesh {
  std::vector<Vector3> points;                ///< (n)
  std::vector<std::array<int, 3>> triangles;  ///< (m) indices into points, counter-clockwise
  /// (m) or empty. Elements of different tags are never joined: the sides between them are kept as boundary.
  std::vector<int> tags;
  /// (n) or empty: 1 = a point that keeps its place when the quads made of the triangles are improved.
  std::vector<char> fixed;
};

/// Quadrilaterals over points, and the triangle that an odd count leaves.
struct QuadMesh {
  std::vector<Vector3> points;                ///< (n)
  std::vector<std::array<int, 4>> quads;      ///< (m) indices into points, counter-clockwise
  std::vector<std::array<int, 3>> triangles;  ///< what could not be paired; empty wherever the count is even
  std::vector<int> quad_tags;                 ///< (m) or empty
  std::vector<int> triangle_tags;             ///< as many as triangles, or empty
};

/// What became of a CAD face.
enum class FaceStatus {
  meshed,
  skipped,  ///< not asked for
  failed,
  merged  ///< left out as tiny
};

/// As reports have it: "meshed", "skipped", "failed", "merged".
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
  /// What became of one CAD face.
  struct Face {
    int face = 0;                             ///< CAD face, from 1
    FaceStatus status = FaceStatus::skipped;  ///< what became of it
    /// Why it failed, or the causes found on the way and the remedy applied to each; empty if nothing to say.
    std::string note;
    /// What its meshings took, and the most that they may take together; in checks for cancellation, which
    /// are the same in each run.
    std::int64_t work = 0 /**< taken */, share = 0; /**< allowed */
    int attempts = 0;             ///< how often it was meshed, for its own sake or a neighbor's
    int quads = 0;                ///< how many it has
    double q_min = 0;             ///< least q of theirs
    double seconds = 0;           ///< that meshing took
    int off_geometry = 0;         ///< midside nodes on it that are in ShellMesh::off_geometry
    double off_geometry_max = 0;  ///< the largest distance of theirs
  };
  /// A midside node that would fold an element if it lay on the geometry.
  struct OffGeometry {
    int node = -1;        ///< index into points
    double distance = 0;  ///< to its place on the CAD edge, or to the face's surface
  };

  /// A CAD edge or vertex that has no place of its own in the mesh, since it is too small.
  struct LetGo {
    /// Of entities.
    enum class Kind { edge, vertex };
    Kind kind = Kind::edge;     ///< of what was let go
    int number = 0;             ///< from 1
    Kind to_kind = Kind::edge;  ///< of what stands for it
    int to = 0;                 ///< the edge or vertex whose nodes stand for it
  };

  /// The planes in which the mesh is its own mirror image.
  struct Symmetry {
    std::vector<std::string> planes;  ///< "x = 12.5"; empty = meshed as a whole
    std::string note;                 ///< why planes of the model were not used; empty if nothing to say
  };

  /// What goes by a name, or by a number of its own, in the file that the mesh was read from.
  struct Group {
    std::string name;           ///< empty = it has a number alone
    int dimension = 2;          ///< 2: of elements, 1: of segments, 0: of nodes
    int number = 0;             ///< that the file gives it; 0 = none
    std::vector<int> entities;  ///< ascending: the faces, edges or vertices that make it up
  };

  /// How thick the shell on a CAD face is where that is not the same all over.
  struct VaryingThickness {
    int face = 0;                     ///< CAD face, from 1
    double thinnest = 0;              ///< millimeters
    double thickest = 0;              ///< millimeters
    std::vector<int> nodes;           ///< of the face's elements, ascending
    std::vector<double> thicknesses;  ///< at those nodes, millimeters
  };

  int order = 1;                          ///< 1: four-node quads; 2: eight-node (serendipity) quads
  std::vector<Vector3> points;            ///< (n) all nodes, corner nodes first, then midside nodes
  std::vector<std::array<int, 4>> quads;  ///< (m) corner nodes, counter-clockwise seen from outside
  std::vector<std::array<int, 4>>
      midsides;                 ///< (m) at second order: node between corner j and j + 1; else empty
  std::vector<int> quad_faces;  ///< (m) CAD face of each quad, from 1
  std::vector<std::array<int, 3>> triangles;  ///< empty, except in meshes read from other programs' files
  std::vector<int> triangle_faces;            ///< as many as triangles
  std::vector<Segment> segments;              ///< the sides on CAD edges, each once
  std::vector<Corner> corners;                ///< the nodes on CAD vertices
  std::vector<OffGeometry> off_geometry;      ///< ascending by node; empty but in coarse second-order meshes
  std::vector<LetGo> let_go;                  ///< edges, then vertices, ascending; faces say it themselves
  Symmetry symmetry;                          ///< by MeshOptions::symmetry
  std::vector<Face> faces;                    ///< one entry a CAD face; empty in meshes read from files
  /// Of meshes read from files that name any, in their order. Groups may share entities: those are as small
  /// as it takes. Empty: files have a group Face3, Edge7, Vertex2 for each entity.
  std::vector<Group> groups;
  /// Of the shell on each CAD face, by face number minus 1, in millimeters; empty where not known.
  std::vector<double> thicknesses;
  /// Of the faces whose thickness varies, ascending; `thicknesses` has the mean of such a face.
  std::vector<VaryingThickness> varying_thicknesses;
  /// Of middle surfaces: the faces that lie on each face of the solid, and the edges, where its rim is one of
  /// them. Besides the groups of entities, in files that have groups.
  std::vector<Group> solid_faces;
};

}  // namespace quadrille
