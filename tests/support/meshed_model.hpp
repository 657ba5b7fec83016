#pragma once
/// A model with the meshes of its faces, from which a shell is assembled.

#include "mesher/quadrille.hpp"
#include "mesher/shell/face_mesher.hpp"
#include "mesher/shell/midsides.hpp"

namespace quadrille::testing {

struct MeshedModel {
  CadModel model;
  BoundaryNodes nodes;
  FaceMeshes faces;
  CadGeometry geometry{model.shape()};
  MeshedFaces parts{geometry, nodes, faces};

  MeshedModel(const CadModel& source, double size) : model(source) {
    MeshOptions options;
    options.sizing.size = size;
    ExecutionContext context(1);
    const CadShape& shape = model.shape();
    const FaceFlags used(shape.faces.size(), 1);
    const SizingField field = SizingField::build(model, options.sizing, context);
    nodes = sample_edges(shape, field, stride(options.strategy), used, SamplingPlan(shape), context);
    for (const FaceId face : shape.faces.ids())
      faces.push_back(mesh_face(shape, face, make_chart(shape, face, nodes, ChartKind::own), nodes, field,
                                options, {}, context));
  }
};

}  // namespace quadrille::testing
