#pragma once
/// Seams that CAD files leave out of faces on closed surfaces. Internal.

#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <string>
#include <vector>

namespace quadrille {

/// Whether the wires of a face on a closed surface bound no region of its parameter plane. Either a wire runs
/// once around the surface without a seam, or a sphere or torus has only holes. Linear in the edges.
bool lacks_seam(const TopoDS_Face& face);

/// An edge that was split, and one of its pieces.
struct EdgePiece {
  TopoDS_Edge whole, piece;
};

/// Adds a seam to faces that lack one, by shape healing. Edges that it splits are split in all their faces.
/// The faces' contents are changed in place, so the faces must be a copy. Faces that cannot be repaired stay
/// as they are. \param problems gets one sentence per changed face. \returns the pieces of the edges that
/// were split.
std::vector<EdgePiece> add_seams(std::vector<TopoDS_Face>& faces, std::vector<std::string>& problems);

}  // namespace quadrille
