#pragma once
/// The size wanted at each point of space, in OpenVDB grids.

#include <filesystem>
#include <memory>
#include <vector>

#include "geometry/base/error.hpp"
#include "geometry/base/execution_context.hpp"
#include "geometry/base/vector.hpp"
#include "geometry/cad/cad_model.hpp"
#include "geometry/sizing/sizing_options.hpp"

namespace quadrille {

struct CadEdge;

/// Between which sizes a field lies.
struct SizeLimits {
  double largest;  ///< the global size
  double least;    ///< that any source may ask for
};
SizeLimits size_limits(const CadModel& model, const SizingOptions& options);  ///< of a model

/// The size that a curvature (1 / length) asks for, within the limits.
double size_of_curvature(const SizingOptions& options, const SizeLimits& limits, double curvature);

/// What asks for no sizes of its own: too small for the mesh, or kept by rows of flat quads. Empty = nothing.
struct UnsizedFeatures {
  std::vector<char> edges /**< by edge */, faces; /**< by face */
  std::vector<char> divided;                      ///< (edges) 1 = not by how users divide it
  std::vector<char> layered;                      ///< (edges) 1 = not by its layers
  /// Whether an edge, from 0, is one of them.
  bool edge(std::size_t index) const { return index < edges.size() && edges[index] != 0; }
  /// Whether how users divide an edge, from 0, asks for no sizes.
  bool is_divided(std::size_t index) const { return index < divided.size() && divided[index] != 0; }
  /// Whether the layers of an edge, from 0, ask for no sizes.
  bool is_layered(std::size_t index) const { return index < layered.size() && layered[index] != 0; }
  /// Whether a face, from 0, is one of them.
  bool face(std::size_t index) const { return index < faces.size() && faces[index] != 0; }
};

/// The width of the voxels that hold a size in a field whose largest is `size_max`.
double field_voxel(double size_max, double size, double growth);

/// That a field would take so many blocks (see Budget), or more.
Error too_many_blocks(double blocks);

/// Whether curvature asks for sizes.
bool has_curvature_sizes(const SizingOptions& options);

struct CascadeFrame;
/// What the voxels of a model's field have in common. Throws Error (usage) where the model is so far from the
/// origin that its sizes cannot be told apart.
CascadeFrame frame_of(const CadModel& model, const SizingOptions& options, const SizeLimits& limits);

/// h(x): the largest size that respects every source and the gradation |grad h| <= growth.
///
/// Sources (global size, curvature of faces and edges, lengths of short edges, sizes asked for on faces,
/// edges and vertices, gaps inside faces, regions, points, layers, an external grid) are sampled on the
/// model. Values live in cascades of OpenVDB float grids with voxels of size_max / 2^k: each is active only
/// where the size is about its voxel, so that small features cost what they need and no more; where sizes
/// grow slowly, voxels are wider by as much. Each face has a cascade of its own, and sizes grow along faces
/// and over the edges between them; with Gradation::space all have one, and thin walls see each other's
/// sizes. Immutable and thread-safe; look-ups go through one Sampler a thread.
class SizingField {
 public:
  /// \param options as mesh() checks them. Throws Error: usage for sizes that pass options.budget, failure
  /// for an unreadable external grid.
  static SizingField build(const CadModel& model, const SizingOptions& options, ExecutionContext& context,
                           const UnsizedFeatures& unsized = {});

  /// Writes the grids as .vdb: `size` (coarsest), `size_1`, ... with metadata unit, growth, size_max,
  /// version. Where faces have sizes of their own, the least of all holds.
  void write(const std::filesystem::path& path) const;

  double size_max() const;  ///< millimeters
  double size_min() const;  ///< millimeters

  /// One level of voxels, of all faces together.
  struct Level {
    double voxel = 0;         ///< width, millimeters
    std::int64_t blocks = 0;  ///< of 8 x 8 x 8 voxels
    std::int64_t bytes = 0;   ///< that its trees take
    double seconds = 0;       ///< of all threads, for the gradation
  };
  /// From the coarsest on.
  std::vector<Level> levels() const;

  class Impl;

  /// Looks sizes up on one face, on one edge, or anywhere; holds the accessors.
  class Sampler {
   public:
    /// The least size of all faces: slow where there are many.
    explicit Sampler(const SizingField& field);  ///< of a field that must outlive it
    /// On a face, from 0.
    Sampler(const SizingField& field, int face);
    /// On an edge: the least of its faces.
    Sampler(const SizingField& field, const CadEdge& edge);
    ~Sampler();
    Sampler(const Sampler&) = delete;
    Sampler& operator=(const Sampler&) = delete;
    double operator()(const Vector3& point);  ///< size wanted there, millimeters
    const Budget& budget() const;             ///< the field's

   private:
    struct Lookups;
    std::unique_ptr<Lookups> lookups_;
    const Impl& impl_;
  };

 private:
  explicit SizingField(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
  std::shared_ptr<const Impl> impl_;
};

}  // namespace quadrille
