#pragma once
/// Quadrille: all-quad shell meshes of CAD models. The one header for users of the library.
///
///     auto model = quadrille::CadModel::read("part.step");
///     quadrille::MeshOptions options;
///     options.sizing.size = 2.0;                       // millimeters
///     quadrille::ExecutionContext context;             // progress, cancel, threads
///     quadrille::ShellMesh mesh = quadrille::mesh(model, options, context);
///     quadrille::write_mesh(mesh, "part.inp");

#include <filesystem>
#include <string>
#include <vector>

#include "geometry/base/api.hpp"
#include "geometry/base/error.hpp"
#include "geometry/base/execution_context.hpp"
#include "geometry/cad/cad_model.hpp"
#include "geometry/midsurface/midsurface.hpp"
#include "mesher/estimate.hpp"
#include "mesher/io/io.hpp"
#include "mesher/io/limits_reader.hpp"
#include "mesher/io/midsurface_writer.hpp"
#include "mesher/mesh/criteria.hpp"
#include "mesher/mesh/mesh_types.hpp"
#include "mesher/mesh/quality.hpp"
#include "mesher/options.hpp"
#include "mesher/pairing/recombine.hpp"
#include "mesher/remesh/remesh.hpp"
#include "mesher/shell/from_triangles.hpp"
#include "mesher/shell/validate.hpp"
#include "mesher/size_map.hpp"

namespace quadrille {

/// Meshes the faces of a CAD model with quads only.
/// Throws Error: usage for invalid options, failure that names the face that cannot be meshed (with
/// options.partial only if no face can be meshed), cancelled. Time is linear in the number of quads. The
/// result depends only on the model and the options, not on the thread count.
QUADRILLE_API ShellMesh mesh(const CadModel& model, const MeshOptions& options, ExecutionContext& context);

/// Meshes the middle surface of thin solids, as above; the mesh carries the thickness of each face.
QUADRILLE_API ShellMesh mesh(const MidSurface& middle, const MeshOptions& options, ExecutionContext& context);

/// What is too small for the sizes of a mesh.
struct SmallFeatures {
  std::vector<ShellMesh::SuppressedFeature> suppressed_features;  ///< edges, then vertices, ascending
  std::vector<int> faces;                    ///< faces that become an edge or a node, from 1, ascending
  std::vector<ShellMesh::Kept> kept;         ///< small faces, then edges, that are kept nevertheless
  std::vector<ShellMesh::FilledHole> holes;  ///< holes, pockets and bosses to be left out
};

/// What mesh() suppresses with these options before any face is meshed. If a face then cannot be meshed,
/// mesh() restores its features. Throws Error (usage) for invalid options. Time is linear in the edges.
QUADRILLE_API SmallFeatures small_features(const CadModel& model, const MeshOptions& options);

/// The library's version, "major.minor.patch".
QUADRILLE_API std::string version();

}  // namespace quadrille
