#pragma once
/// The quads of one face, made from its triangles: the same steps for CAD faces and for scanned surfaces.
/// Internal.

#include "geometry/base/execution_context.hpp"
#include "geometry/surfaces/mesh_surface.hpp"
#include "mesher/faces/face_triangulation.hpp"
#include "mesher/pairing/recombine_options.hpp"
#include "mesher/quads/improve_options.hpp"
#include "mesher/quads/subdivision.hpp"

namespace quadrille {

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

}  // namespace quadrille
