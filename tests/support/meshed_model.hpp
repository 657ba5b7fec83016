#pragma once
/// A model with the meshes of its faces, from which a shell is assembled.

#include "mesher/edges/matching.hpp"
#include "mesher/quadrille.hpp"
#include "mesher/shell/face_mesher.hpp"
#include "mesher/shell/midsides.hpp"

namespace quadrille::testing {

struct MeshedModel {
  CadModel model;
  Matches matches;
  BoundaryNodes nodes;
  FaceMeshes faces;
  CadGeometry geometry{model.shape()};
  MeshedFaces parts{geometry, nodes, faces};

  MeshedModel(const CadModel& source, double size, const std::vector<MatchedPair>& pairs = {})
      : model(source) {
    MeshOptions options;
    options.sizing.size = size;
    ExecutionContext context(1);
    const CadShape& shape = model.shape();
    const FaceFlags used(shape.faces.size(), 1);
    const SizingField field = SizingField::build(model, options.sizing, context);
    SamplingPlan plan(shape);
    matches = find_matches(shape, pairs, used);
    plan.matched = matches.edges;
    nodes = sample_edges(shape, field, stride(options.strategy), used, plan, context);
    for (const FaceId face : shape.faces.ids())
      faces.push_back(mesh_face(shape, face, make_chart(shape, face, nodes, ChartKind::own), nodes, field,
                                options, {}, context));
  }
};

}  // namespace quadrille::testing
