#pragma once
/// The part of a symmetric model on one side of its mirror planes. Internal.

#include <optional>
#include <string>
#include <vector>

#include "geometry/cad/cad_model.hpp"
#include "geometry/symmetry/mirror_planes.hpp"

namespace quadrille {

/// Half, a quarter or an eighth of a model. Its mirror images are numbered: bit i of the number is set if the
/// image is mirrored in planes[i], so that image 0 is the part itself.
struct ModelPart {
  /// The whole model's faces, edges and vertices that the part's become in one image.
  struct Image {
    IdVector<FaceId, FaceId> faces;
    FaceFlags turned;                       ///< 1 = its outer side is not the mirror image of the part's
    IdVector<EdgeId, EdgeId> edges;         ///< none if made by a cut or by a seam's image
    IdVector<EdgeId, char> against;         ///< 1 = the image runs against the parameter of the model's edge
    IdVector<VertexId, VertexId> vertices;  ///< or none
  };

  CadModel model;
  std::vector<MirrorPlane> planes;
  std::vector<Image> images;  ///< (2 ^ planes)
  /// The planes that the part's edges and vertices lie in: bit i is set for planes[i].
  IdVector<EdgeId, unsigned> edges_in;
  IdVector<VertexId, unsigned> vertices_in;

  Vector3 mirrored(Vector3 point, unsigned image) const {
    for (std::size_t i = 0; i < planes.size(); ++i) {
      if ((image >> i & 1U) != 0) point = planes[i].mirrored(point);
    }
    return point;
  }
};

/// Cuts the model at its planes and keeps the part on their positive sides. Seams and vertices of closed
/// edges that lie only elsewhere are mirrored onto it and imprinted, so that the images have all edges and
/// vertices of the model. Nothing if OpenCASCADE fails or the images do not make up the model (areas of faces
/// and the number of faces at each edge are compared).
std::optional<ModelPart> cut_at_planes(const CadModel& model, std::vector<MirrorPlane> planes,
                                       const ExecutionContext& context);

}  // namespace quadrille
