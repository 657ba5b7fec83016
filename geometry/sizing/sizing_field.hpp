#pragma once
/// The size wanted at each point in space, stored in OpenVDB grids.

#include <filesystem>
#include <memory>
#include <vector>

#include "geometry/base/error.hpp"
#include "geometry/base/execution_context.hpp"
#include "geometry/base/vector.hpp"
#include "geometry/cad/cad_model.hpp"
#include "geometry/cad/ids.hpp"
#include "geometry/sizing/sizing_options.hpp"

namespace quadrille {

struct CadEdge;
class FaceSurface;

/// The range of sizes of a field.
struct SizeLimits {
  double largest;   ///< the global size
  double least;     ///< smallest size anywhere: size_min, or a smaller one that users give by name
  double size_min;  ///< smallest size of the sources that are not given by name, such as curvature
  double at_gaps;   ///< smallest size across gaps
};
SizeLimits size_limits(const CadModel& model, const SizingOptions& options);  ///< limits for a model

/// 1 = sizes below limits.size_min, given by name, may reach the edge. Complexity: edges times the number of
/// those sizes.
EdgeFlags edges_below_size_min(const CadModel& model, const SizingOptions& options, const SizeLimits& limits);

/// The size that a curvature (1 / length) requests, from limits.size_min to limits.largest.
double size_of_curvature(const SizingOptions& options, const SizeLimits& limits, double curvature);

/// Features that set no sizes of their own: too small, or meshed by rows of flat quads. Empty = none.
struct UnsizedFeatures {
  EdgeFlags edges;    ///< 1 = the edge
  FaceFlags faces;    ///< 1 = the face
  EdgeFlags divided;  ///< 1 = its prescribed division requests no sizes
  FaceFlags gridded;  ///< 1 = rows of quads run from side to side: sizes have directions there
};

/// The width of the voxels that hold a size in a field whose largest is `size_max`.
double field_voxel(double size_max, double size, double growth);

/// The error for a field that would take so many blocks (see Budget) or more.
Error too_many_blocks(double blocks);

/// Whether the options request sizes by curvature.
bool has_curvature_sizes(const SizingOptions& options);

struct CascadeFrame;
/// The voxel frame of a model's field. Throws Error (usage) if the model is too far from the origin for
/// voxels of its sizes to be numbered.
CascadeFrame frame_of(const CadModel& model, const SizingOptions& options, const SizeLimits& limits);

/// h(x): the largest size below every source that satisfies the gradation |grad h| <= growth.
///
/// Where rows of quads run over a face from side to side (UnsizedFeatures::gridded), sizes have directions:
/// curvature requests its size in the direction of the bend, and SizingOptions::aspect times that in the
/// field; edges request their lengths and curvatures in their own direction alone; narrowness requests
/// nothing. h(x) holds what applies in all directions, Sampler::bent() and Sampler::across() add the rest.
///
/// Sources are the global size, curvature of faces and edges, lengths of short edges, sizes requested on
/// faces, edges and vertices, gaps inside faces, walls, regions, points, and an external grid. They
/// are sampled on the model. Values are stored in cascades of OpenVDB float grids with voxels of
/// size_max/2^k. Each grid is active only where the size is about its voxel, so small features cost no more
/// than they need; where sizes grow slowly, voxels are wider by as much. Each face has its own cascade, and
/// sizes grow along faces and across their edges. With Gradation::space all faces share one cascade, and thin
/// walls see each other's sizes. Immutable and thread-safe; look-ups go through one Sampler per thread.
class SizingField {
 public:
  /// \param options checked before, as by mesh(). Throws Error: usage for sizes that exceed options.budget,
  /// failure for an unreadable external grid.
  static SizingField build(const CadModel& model, const SizingOptions& options, ExecutionContext& context,
                           const UnsizedFeatures& unsized = {});

  /// Writes the grids as .vdb: `size` (coarsest), `size_1`, ... with metadata unit, growth, size_max,
  /// version. Where faces have their own cascades, the smallest value of all is written.
  void write(const std::filesystem::path& path) const;

  const SizingOptions& options() const;  ///< what it was built with
  const SizeLimits& limits() const;      ///< of all its sizes

  /// One level of voxels, summed over all faces.
  struct Level {
    double voxel = 0;         ///< voxel width, millimeters
    std::int64_t blocks = 0;  ///< number of blocks of 8 x 8 x 8 voxels
    std::int64_t bytes = 0;   ///< memory of its trees
  };
  /// All levels, coarsest first.
  std::vector<Level> levels() const;

  class Impl;

  /// Looks up sizes on one face, on one edge, or anywhere; owns the accessors.
  class Sampler {
   public:
    /// Takes the smallest size of all faces: slow for many faces.
    explicit Sampler(const SizingField& field);  ///< the field must outlive it
    /// Sizes on a face.
    Sampler(const SizingField& field, FaceId face);
    /// On an edge: the smallest size of its faces.
    Sampler(const SizingField& field, const CadEdge& edge);
    ~Sampler();
    Sampler(const Sampler&) = delete;
    Sampler& operator=(const Sampler&) = delete;
    double operator()(const Vector3& point);  ///< wanted size, millimeters
    /// A wanted size in the direction in which an edge or face bends with this curvature (1 / length).
    double bent(double size, double curvature) const;
    /// On a face: the wanted size in the direction in which it bends most, given that curvature.
    double across(double size, double curvature) const;
    /// The same at a point of the surface.
    double across(double size, const FaceSurface& surface, const Vector2& uv) const;
    bool is_directed() const { return directed_; }  ///< whether sizes have directions on the face
    const Budget& budget() const;                   ///< SizingOptions::budget of the field

   private:
    struct Lookups;
    std::unique_ptr<Lookups> lookups_;
    const Impl& impl_;
    bool directed_ = false;  // the face has sizes with directions
  };

 private:
  explicit SizingField(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
  std::shared_ptr<const Impl> impl_;
};

}  // namespace quadrille
