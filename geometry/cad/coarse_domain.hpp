#pragma once
/// Faces in their parameter plane, approximately. Internal.

#include "geometry/base/trimmed_domain.hpp"
#include "geometry/cad/cad_shape.hpp"

namespace quadrille {

/// The region of a face in its parameter plane, with each edge approximated by 16 chords.
TrimmedDomain coarse_domain(const CadShape& shape, const CadFace& face);

}  // namespace quadrille
