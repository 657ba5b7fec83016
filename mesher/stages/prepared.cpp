/// Simplifies and divides the model, and decides once what is protected.

#include "mesher/stages/prepared.hpp"

#include <algorithm>

#include "geometry/sizing/element_count.hpp"
#include "geometry/surfaces/stray_edges.hpp"
#include "mesher/edges/chords.hpp"
#include "mesher/edges/simplified_model.hpp"
#include "mesher/settings.hpp"
#include "mesher/shell/remedies.hpp"

namespace quadrille {

FaceFlags faces_used(const CadModel& model, const MeshOptions& options) {
  FaceFlags used(model.face_count(), options.faces.empty());
  for (const int face : options.faces) used[FaceId::from_number(face)] = 1;
  return used;
}

namespace {

/// With options.fill_holes small holes are filled, and without options.keep_features coplanar faces are
/// joined, unless options.faces names those to mesh.
SimplifiedModel simplified(const CadModel& model, const MeshOptions& options, bool joins) {
  const FaceFlags used = faces_used(model, options);
  SimplifiedModel result = fill_holes(model, used, options.sizing, options.fill_holes);
  if (joins && !options.keep_features && options.faces.empty())
    join_coplanar_faces(result, used, options.sizing, size_limits(model, options.sizing));
  return result;
}

/// Throws Error: usage for invalid options, failure for edges far outside the model.
const MeshOptions& checked(const CadModel& model, const MeshOptions& options) {
  check({options, {}}, model);
  for (const StrayEdge& stray : stray_edges(model.shape(), faces_used(model, options)))
    throw failure(fmt::format("Edge{}", stray.edge), stray.sentence() + "; `faces` can leave its faces out");
  return options;
}

double suppression_reach(const SizeLimits& limits, const MeshOptions& options, double share) {
  constexpr double far_below = 0.5;
  if (options.keep_features) return 0;
  return share * (options.reach > 0 ? options.reach : far_below * limits.size_min);
}

/// The model with edges divided at slivers, except around edges whose nodes users prescribe.
CadModel divided(const CadModel& model, FaceFlags used, const MeshOptions& options, double reach) {
  const SizingOptions& sizing = options.sizing;
  const CadShape& source = model.shape();
  for (const CadEdge& edge : source.edges)
    if (sizing.spacings.contains(edge.number))
      for (const FaceId face : edge.faces) used[face] = 0;
  const auto shape = divided_at_slivers(source, used, reach);
  return shape ? CadModel(shape) : model;
}

Protection protect(const Prepared& prepared, const std::set<int>& uncrossed) {
  const CadShape& shape = prepared.shape;
  const SizingOptions& sizing = prepared.options.sizing;
  Protection result{prepared.plan.below_size_min,
                    EdgeFlags(shape.edges.size(), prepared.options.keep_features ? 1 : 0),
                    {}};
  for (const PlacedNode& node : prepared.placed.nodes) result.vertices.push_back(node.vertex);
  for (const EdgeId id : shape.edges.ids()) {
    const CadEdge& edge = shape.edges[id];
    const auto& nodes = prepared.placed.nodes;
    const bool kept = sizing.kept_edges.contains(edge.number) ||
                      std::any_of(edge.faces.begin(), edge.faces.end(),
                                  [&](FaceId face) { return sizing.kept_faces.contains(face.number()); });
    result.lengths[id] |= kept;
    result.own_nodes[id] |= kept || sizing.names_edge(edge.number) || uncrossed.contains(edge.number) ||
                            std::any_of(nodes.begin(), nodes.end(), [&](const PlacedNode& node) {
                              return node.vertex == edge.first_vertex || node.vertex == edge.last_vertex;
                            });
  }
  return result;
}

/// The outlines of the faces, before sizes are known.
FaceOutlines find_outlines(const Prepared& prepared, const TinyFeatures& tiny) {
  IdVector<EdgeId, double> wanted;
  for (const CadEdge& edge : prepared.shape.edges)
    wanted.push_back(edge.length / (prepared.limits.largest * stride(prepared.options.strategy)));
  return find_face_sides(prepared.shape, prepared.meshed, tiny, wanted);
}

}  // namespace

Prepared::Prepared(const CadModel& source, const MeshOptions& settings, const Preparation& how)
    : options(checked(source, settings)),
      vertices(source.vertex_count()),
      simple(simplified(source, options, how.joins)),
      asked(simple.left(faces_used(source, options))),
      limits(size_limits(source, options.sizing)),
      reach(suppression_reach(limits, options, how.reach_share)),
      placed(how.divides ? place_nodes(simple.model.shape(), asked, options.sizing, limits.largest)
                         : PlacedNodes()),
      model(how.divides ? divided(placed.shape ? CadModel(placed.shape) : simple.model, asked, options, reach)
                        : simple.model),
      shape(model.shape()),
      plan(shape, edges_below_size_min(model, options.sizing, limits)),
      protection(protect(*this, how.uncrossed)),
      suppressed(shape, asked, reach, protection.lengths, protection.vertices) {
  constexpr double far_below = 0.02;
  plan.shortest_segment = far_below * limits.size_min;
  if (options.strategy == Strategy::subdivide) plan.subdivided.assign(shape.faces.size(), 1);
  plan.prescribed = prescribed_edges(shape, options.sizing, limits.largest);
  meshed = leave_out_tiny(suppressed, plan);
  const FaceOutlines outlines = find_outlines(*this, plan.tiny);
  unsized = {suppressed.edges(), plan.tiny.merged_faces,
             find_grid_rows(shape, outlines, plan.prescribed, options.sizing, limits.largest),
             FaceFlags(shape.faces.size())};
  for (const FaceId face : outlines.ids())
    unsized.gridded[face] = options.sizing.aspect > 1 && outlines[face].is_filled();
}

FaceFlags Prepared::leave_out_tiny(const SuppressedFeatures& now, SamplingPlan& to) const {
  to.tiny = now.find(options.merge_tiny);
  for (const FaceId face : simple.gone.ids()) to.tiny.merged_faces[face] |= simple.gone[face];
  FaceFlags left = asked;
  for (const FaceId face : left.ids()) left[face] = asked[face] && !to.tiny.merged_faces[face];
  return left;
}

SizingField sizes_for(const Prepared& prepared, ExecutionContext& context) {
  const StageTimer timer(context, Stage::size);
  const MeshOptions& options = prepared.options;
  SizingOptions sizing = options.sizing;
  sizing.budget.bytes_an_element = Budget::bytes_an_element_of_order(options.order);
  if (options.force) sizing.budget = Budget::unlimited();
  const ElementBudget budget(prepared.model, sizing, prepared.asked, context);
  SizingField field = SizingField::build(prepared.model, sizing, context, prepared.unsized);
  budget.check(field);
  return field;
}

}  // namespace quadrille
