#pragma once
/// Triangulated surfaces meshed anew with quads: scans, .stl files, meshes of other programs.

#include <string>
#include <vector>

#include "geometry/base/api.hpp"
#include "geometry/base/execution_context.hpp"
#include "mesher/mesh/mesh_types.hpp"
#include "mesher/pairing/recombine_options.hpp"
#include "mesher/quads/improve_options.hpp"

namespace quadrille {

/// How remesh() works.
struct RemeshOptions {
  double size = 0;            ///< length of elements, millimeters
  double feature_angle = 40;  ///< degrees between the normals of neighbors from which on they are of two
                              ///< faces; 0 = shape makes no faces
  double merge = -1;   ///< nodes at most this far apart become one, millimeters; 0 = those on one place;
                       ///< negative = none, and two on one place are refused
  int order = 1;       ///< 1 or 2
  bool force = false;  ///< go on where the mesh would pass 50 million elements or the memory
  RecombineOptions recombine;  ///< how triangles are paired
  ImproveOptions improve;      ///< how quads are improved
};

/// How a mesh compares with the surface that it was made of.
struct RemeshFidelity {
  /// A distance and where it is.
  struct Distance {
    double length = 0;    ///< millimeters
    Vector3 at{0, 0, 0};  ///< the point that is so far away
    int face = 0;         ///< that it belongs to, as the mesh numbers them
  };
  Distance
      of_mesh;  ///< the farthest point of the mesh from the surface, of nodes, middles of sides and quads
  Distance of_surface;  ///< the farthest node of the surface from the mesh
  double surface_area = 0 /**< of the input */, mesh_area = 0;      ///< square millimeters
  double surface_volume = 0 /**< of the input */, mesh_volume = 0;  ///< cubic millimeters; 0 where it is open
};

/// Makes an all-quad mesh of a triangulated surface, at another size. The surface is cut into faces where its
/// own faces end, along its segments, and at folds; nodes lie on it, and on the curves between the faces. The
/// faces keep their numbers as far as they stay whole, and groups of faces and segments hold what they held.
/// Smooth surfaces whose sides are longer than the surface allows, and places near small faces, get smaller
/// elements, down to an eighth of the size. At second order midside nodes lie on the surface, or on straight
/// sides where an element would fold. \param fidelity out, may be null. \param notes takes a sentence for
/// each thing that was mended or lost. Throws Error: usage for options that make no sense or ask for too
/// much, failure naming the place that cannot be meshed (three triangles on one side, one side only, no area,
/// quads that stay turned over), cancelled. The result does not depend on the thread count.
QUADRILLE_API ShellMesh remesh(const ShellMesh& input, const RemeshOptions& options, RemeshFidelity* fidelity,
                               std::vector<std::string>& notes, ExecutionContext& context);

}  // namespace quadrille
