#pragma once
/// How many segments the edges should have, before the faces are considered. Internal.

#include <utility>

#include "mesher/edges/edge_counts.hpp"
#include "mesher/edges/edge_sampling.hpp"

namespace quadrille {

/// What the sizing field and the plan ask of each edge.
struct EdgeDemand {
  EdgeFlags used;  ///< 1 = the edge has nodes
  EdgeTables tables;
  CountTargets targets;
};

/// For the parameters see sample_edges(). Throws Error (usage) if a prescribed number leaves a loop closed,
/// or if the edges take more segments than the field's budget allows.
EdgeDemand edge_demand(const CadShape& shape, const SizingField& field, int stride, const FaceFlags& used,
                       const SamplingPlan& plan, ExecutionContext& context, EdgeTables* known);

/// The counts by the sizing field at the ends of the part of an edge between its heads.
std::pair<double, double> counts_between(const CountTable& table, const EdgeHeads& heads);

}  // namespace quadrille
