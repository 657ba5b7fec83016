#pragma once
/// The part of a symmetric model on one side of its mirror planes. Internal.

#include <optional>
#include <string>
#include <vector>

#include "geometry/cad/cad_model.hpp"
#include "geometry/symmetry/mirror_planes.hpp"

namespace quadrille {

/// Half, a quarter or an eighth of a model. Its mirror images are numbered: bit i of the number tells whether
/// it is mirrored in planes[i], so that 0 is the part itself.
struct ModelPart {
  /// What an image's faces, edges and vertices are in the whole model: its numbers, by those of the part
  /// less 1.
  struct Image {
    std::vector<int> faces;
    std::vector<char> turned;   ///< (faces) 1 = its outer side is not the mirror image of the part's
    std::vector<int> edges;     ///< 0 = none: made by a cut, or by a seam's image
    std::vector<char> against;  ///< (edges) 1 = the image runs against the parameter of the model's edge
    std::vector<int> vertices;  ///< 0 = none
  };

  CadModel model;
  std::vector<MirrorPlane> planes;
  std::vector<Image> images;  ///< (2 ^ planes)
  /// By edge and vertex of the part less 1: bit i is set where it lies in planes[i].
  std::vector<unsigned> edges_in, vertices_in;

  Vector3 mirrored(Vector3 point, unsigned image) const {
    for (std::size_t i = 0; i < planes.size(); ++i) {
      if ((image >> i & 1U) != 0) point = planes[i].mirrored(point);
    }
    return point;
  }
};

/// Cuts the model at its planes and keeps what lies on their positive sides. Seams, and vertices on closed
/// edges, that lie elsewhere only are imprinted on it, so that all of the model's edges and vertices are met
/// by those of the images. Nothing where OpenCASCADE does not give a part whose images make up the model
/// (faces' areas, and the faces at each edge, are compared).
std::optional<ModelPart> cut_at_planes(const CadModel& model, std::vector<MirrorPlane> planes,
                                       const ExecutionContext& context);

}  // namespace quadrille
