#pragma once
/// The quads of one face, made from its triangles: the same steps for CAD faces and for scanned surfaces.
/// Internal.

#include "geometry/base/execution_context.hpp"
#include "geometry/surfaces/mesh_surface.hpp"
#include "mesher/faces/face_triangulation.hpp"
#include "mesher/pairing/recombine_options.hpp"
#include "mesher/quads/improve.hpp"

namespace quadrille {

class FaceSurface;
struct HoleRings;

/// A quad mesh of one face, tied to the nodes of its boundary.
struct FaceQuads {
  SurfaceMesh surface_mesh;  ///< fixed points first
  std::vector<char> pole;    ///< (n) 1 = a pole of the surface: uv is one of many
  std::vector<int> nodes;    ///< (fixed points) index into BoundaryNodes::points, or a HoleRings::node()

  /// \return the index of the new point.
  int add(const SurfacePlace& place, bool fixed, bool is_pole);
};

/// How triangles become quads.
struct FaceQuadsOptions {
  /// Segments of the final mesh for each side of a triangle: with 2, the quads are cut in four at the end.
  int segments_per_side = 2;
  bool pair = true;      ///< false: triangles stay, each is cut in three
  bool clean_up = true;  ///< topological clean-up, if `improve` asks for it too
  RecombineOptions recombine;
  ImproveOptions improve;
};

/// Pairs the triangles, cleans up, cuts the quads in four and the triangles left over in three (if there are
/// two segments a side), moves the nodes on the surface, and refills patches where quads stay inverted.
/// Triangles stay only if `segments_per_side` is 1. Throws Error (cancelled). Time: linear in practice.
FaceQuads make_quads(FaceTriangulation triangulation, const MeshSurface& surface,
                     const FaceQuadsOptions& options, ExecutionContext& context);

/// Moves nodes of a face's quads without changing which nodes are joined.
void smooth(FaceQuads& quads, const MeshSurface& surface, const ImproveOptions& options,
            ExecutionContext& context);

/// Largest width of a gap that a single row of quads spans, in lengths of the segments on its sides.
constexpr double widest_gap = 0.7;

/// Gives two triangles that make a quad across a gap a tag of their own, so that they are paired. The gap
/// lies between two boundary segments that are nearer to each other than widest_gap segments. Other pairs
/// there would be sheared, or bent around a boundary node. Quads whose parts would be poor are left out.
/// \param normals (points) unit normals of the surface. \param segments as for subdivide().
void tie_across_gaps(TriangleMesh& mesh, const std::vector<Vector3>& normals,
                     const std::vector<FaceBoundary::Segment>& segments);

/// Splits each quad into four and each triangle into three quads. New points on boundary sides are the edges'
/// own nodes; the others are put on the surface. \param segments the boundary sides and their middle nodes.
FaceQuads subdivide(const FaceQuads& coarse, const std::vector<FaceBoundary::Segment>& segments,
                    const MeshSurface& surface, const ExecutionContext& context = {});

/// Adds the rings between the holes and the other quads of the face. The nodes of the holes' loops become
/// fixed points, those of the lines around them free points.
/// \param quads in: the final quads of rings.inside; out: the quads of the whole face
void add_ring_quads(FaceQuads& quads, const HoleRings& rings, const FaceSurface& surface);

}  // namespace quadrille
