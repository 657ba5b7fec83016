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
  /// The numbers of an image's faces, edges and vertices in the whole model, by their number in the part
  /// minus 1.
  struct Image {
    std::vector<int> faces;
    std::vector<char> turned;   ///< (faces) 1 = its outer side is not the mirror image of the part's
    std::vector<int> edges;     ///< 0 = none: made by a cut or by a seam's image
    std::vector<char> against;  ///< (edges) 1 = the image runs against the parameter of the model's edge
    std::vector<int> vertices;  ///< 0 = none
  };

  CadModel model;
  std::vector<MirrorPlane> planes;
  std::vector<Image> images;  ///< (2 ^ planes)
  /// By number of the part's edge or vertex minus 1: bit i is set if it lies in planes[i].
  std::vector<unsigned> edges_in, vertices_in;

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
