#pragma once
/// Seams that CAD files leave out of faces on closed surfaces. Internal.

#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <string>
#include <vector>

namespace quadrille {

/// Whether the wires of a face on a closed surface bound no region of its parameter plane: a wire goes once
/// round without a seam, a hole crosses the seam, or nothing but holes lies on a sphere or a torus.
/// Linear in the edges of the face, but for holes near a seam.
bool lacks_seam(const TopoDS_Face& face);

/// An edge that was split, and one of its pieces.
struct EdgePiece {
  TopoDS_Edge whole, piece;
};

/// Gives faces that lack a seam one, and splits edges where they cross a seam, there and in the other faces
/// that use them. What belongs to the faces is changed in place: they must be a copy. Faces that cannot be
/// mended stay as they are.
/// \param problems is told what was done, a sentence a face.
/// \returns the pieces of the edges that were split.
std::vector<EdgePiece> add_seams(std::vector<TopoDS_Face>& faces, std::vector<std::string>& problems);

}  // namespace quadrille
