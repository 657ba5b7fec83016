#pragma once
/// First stage of a run: the model that is meshed, and what must stay as it is. Internal.

#include <set>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/cad/cad_model.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "mesher/edges/edge_sampling.hpp"
#include "mesher/edges/placed_nodes.hpp"
#include "mesher/edges/simplified_model.hpp"
#include "mesher/edges/suppressed_features.hpp"
#include "mesher/options.hpp"

namespace quadrille {

/// 1 = the options ask for this face to be meshed.
FaceFlags faces_used(const CadModel& model, const MeshOptions& options);

/// What users keep from being suppressed or crossed.
struct Protection {
  EdgeFlags lengths;               ///< 1 = the edge must not become a point
  EdgeFlags own_nodes;             ///< 1 = the edge keeps nodes of its own: no quad crosses it
  std::vector<VertexId> vertices;  ///< they share their nodes with no other
};

struct Preparation {
  bool divides = true;  ///< edges at slivers and placed nodes: they and vertices then differ from the model's
  bool joins = true;    ///< coplanar faces may be joined
  std::set<int> uncrossed{};  ///< numbers of edges that no quad may cross
  double reach_share = 1;     ///< of the length below which features are suppressed
};

/// Does not change in a run.
struct Prepared {
  /// Throws Error: usage for invalid options, failure for edges far outside the model.
  Prepared(const CadModel& source, const MeshOptions& settings, const Preparation& how = {});
  Prepared(const Prepared&) = delete;
  Prepared& operator=(const Prepared&) = delete;

  /// Leaves out what is too small, in `plan`. \return 1 = the face is meshed
  FaceFlags leave_out_tiny(const SuppressedFeatures& now, SamplingPlan& plan) const;

  MeshOptions options;
  int vertices;  ///< of the model; the others divide edges or are placed inside faces
  SimplifiedModel simple;
  FaceFlags asked;  ///< 1 = is to be meshed, unless it is tiny
  SizeLimits limits;
  double reach;  ///< features below it are suppressed, model units; 0 = none
  PlacedNodes placed;
  CadModel model;
  const CadShape& shape;
  SamplingPlan plan;  ///< to begin with
  Protection protection;
  SuppressedFeatures suppressed;  ///< to begin with
  FaceFlags meshed;               ///< to begin with, see leave_out_tiny()
  UnsizedFeatures unsized;
};

/// The sizing field. Suppressed features request no sizes. Throws Error (usage) if the sizes exceed the
/// budget.
SizingField sizes_for(const Prepared& prepared, ExecutionContext& context);

}  // namespace quadrille
