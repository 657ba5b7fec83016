#pragma once
/// Every face of every sample model at two sizes, with its nodes on the edges: what the stages inside a face
/// begin with.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/faces/face_boundary.hpp"
#include "mesher/faces/point_placement.hpp"
#include "mesher/quadrille.hpp"
#include "tests/support/sample_models.hpp"

namespace quadrille {

inline std::string joined(const std::vector<std::string>& lines) {
  std::string result;
  for (const auto& line : lines) result += line + "\n";
  return result;
}

/// What the stages before a face give, for one model.
struct SampledModel {
  CadModel model;
  MeshOptions options;
  ExecutionContext context;
  SizingField field;
  BoundaryNodes nodes;

  SampledModel(const SampleModel& sample, double divisions, Strategy strategy)
      : model(CadModel::read(sample.path())),
        options(make_options(model, divisions, strategy)),
        field(SizingField::build(model, options.sizing, context)),
        nodes(sample_edges(model.shape(), field, stride(options.strategy), FaceFlags(sample.faces, 1),
                           SamplingPlan(model.shape()), context)) {}

  static MeshOptions make_options(const CadModel& model, double divisions, Strategy strategy) {
    MeshOptions options;
    options.strategy = strategy;
    options.sizing.size = model.diagonal() / divisions;
    return options;
  }
};

template <class Visit>
void for_each_face(Visit&& visit) {
  int faces = 0;
  for (const SampleModel& sample : sample_models()) {
    for (const Strategy strategy : {Strategy::direct, Strategy::subdivide}) {
      for (const double divisions : {10.0, 37.0}) {
        SampledModel sampled(sample, divisions, strategy);
        for (const FaceId face : sampled.model.shape().faces.ids()) {
          SCOPED_TRACE(sample.name + " Face" + std::to_string(face.number()) + " at 1/" +
                       std::to_string(divisions));
          const FaceSurface surface(sampled.model.shape().faces[face]);
          visit(sampled, face, surface,
                face_boundary(sampled.model.shape(), face, sampled.model.shape().faces[face], surface,
                              sampled.nodes));
          ++faces;
        }
      }
    }
  }
  EXPECT_GT(faces, 100);
}

inline PlacedPoints place(SampledModel& sampled, const FaceSurface& surface, const FaceBoundary& boundary) {
  SizingField::Sampler size_at(sampled.field);
  PlacementOptions options;
  options.scale = sampled.nodes.stride;
  return place_points(boundary, surface, enclosed_domain(boundary), size_at, options, sampled.context);
}

}  // namespace quadrille
