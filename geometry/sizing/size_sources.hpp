#pragma once
/// The sizes that a model's edges and faces request, as points. Internal.

#include <functional>

#include "geometry/base/execution_context.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/sizing/edge_spacing.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "geometry/sizing/sizing_options.hpp"
#include "geometry/sizing/spatial_sizes.hpp"
#include "geometry/surfaces/edge_curve.hpp"

namespace quadrille {

/// Samples edges and faces at distances of about the local size. Thread-safe.
class SizeSources {
 public:
  /// Takes a point that requests a size smaller than the largest.
  using Sink = std::function<void(const Vector3& point, double size)>;

  SizeSources(const CadShape& shape, const SizingOptions& options, const SizeLimits& limits,
              const UnsizedFeatures& unsized, const SpatialSizes& spatial, const ExecutionContext& context);

  /// Throws Error (usage) if the sizes requested on edges alone exceed the budget of segments or of blocks.
  void hold_segments() const;

  /// What an edge requests by its own size and, with `by_shape`, by its length and its curvature.
  void edge(EdgeId id, bool by_shape, const Sink& sink) const;
  /// What a face requests inside.
  void face(FaceId id, const Sink& sink) const;

 private:
  /// The size at a place, and a lower estimate of the sizes around it.
  struct SizeHere {
    double size, hint;
  };
  struct EdgeSample {
    double t;
    Vector3 point;
    SizeHere at;
  };

  void gaps(FaceId id, const Sink& sink) const;
  double size_of(double curvature) const { return size_of_curvature(options_, limits_, curvature); }
  double cap_of(const CadEdge& edge, bool by_shape) const;
  SizeHere with_spatial(double size, const Vector3& point) const;
  Error too_many_segments(const CadEdge& edge, double segments) const;
  void prescribed_edge(const CadEdge& edge, const PrescribedEdge& prescribed, const Sink& sink) const;
  void sample_edge(const EdgeCurve& curve, const CadEdge& edge, double cap, bool with_curvature,
                   const Sink& sink) const;
  template <class SampleAt, class Add>
  void split_interval(const SampleAt& sample, const EdgeSample& first, const EdgeSample& last, int depth,
                      const Add& add, SparseCheck& check) const;
  template <class SampleAt>
  void split_cell(const SampleAt& sample, const Vector2& middle, const Vector2& cell, int depth) const;

  const CadShape& shape_;
  const SizingOptions& options_;
  SizeLimits limits_;
  const UnsizedFeatures& unsized_;
  const SpatialSizes& spatial_;
  const ExecutionContext& context_;
  PrescribedEdges prescribed_;
};

}  // namespace quadrille
