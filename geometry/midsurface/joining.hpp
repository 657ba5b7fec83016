#pragma once
/// Joins the middle surfaces of walls where they meet. Internal.

#include <TopoDS_Face.hxx>
#include <map>
#include <set>
#include <vector>

#include "geometry/midsurface/wall_pieces.hpp"

namespace quadrille {

/// A face of the result.
struct JoinedFace {
  TopoDS_Face face;
  int wall = 0;
  bool step = false;  ///< stands across a wall and joins two middle surfaces that do not meet
  Coverage coverage;
};

/// Cuts the pieces of all walls at each other, so that they share edges. Drops the parts that extend past the
/// sides of their wall, and merges faces that were cut without need. Orients faces alike where two meet.
/// \param pieces for each wall, the pieces of its middle surface. \param tolerance of fitted middles, over
/// the thickness. Throws Error (failure) if OpenCASCADE cannot intersect them.
std::vector<JoinedFace> join_walls(const Skin& skin, const std::vector<Wall>& walls,
                                   const std::vector<WallEnd>& ends,
                                   const std::vector<std::vector<TopoDS_Face>>& pieces, double tolerance,
                                   const ExecutionContext& context);

/// Removes edges that lie inside one face and that no other face uses.
void drop_traces(std::vector<JoinedFace>& faces);

/// Reverses faces so that the two faces of an edge show the same side, as far as that is possible.
void orient_alike(std::vector<JoinedFace>& faces);

/// What is known of the fillets in corners.
struct Fillets {
  /// Their volume that no thickness contains, by the walls, as indices, of their corners; negative where
  /// thicknesses contain it twice.
  std::map<std::set<int>, double> beside{};
  std::set<int> left_out{};  ///< indices of those that stiffen their walls more than the thickness does
  double softer = 0;         ///< by which share of the walls' stiffness; 0 if hardly
};

/// Adds the material of fillets in corners, as thickness, to the strips of the walls between the fillet and
/// the corner: in open sections all of it to each wall, or as much as makes the second moments of the section
/// a fortieth too large; in closed ones the actual amount. The faces are cut where the fillets begin. Leaves
/// the fillets of open sections out if they make the walls less than a fiftieth stiffer where these bend or
/// twist, and those of closed sections unless the middle surfaces lack more than a hundredth of the volume
/// and the fillets hold at least half of that. What is counted twice where walls meet compensates for the
/// fillets there, and for nothing else. \param volume of the solid. \return the material of fillets that no
/// thickness contains.
Fillets add_fillets(const Skin& skin, const std::vector<Wall>& walls, double volume,
                    const ExecutionContext& context, std::vector<JoinedFace>& faces);

/// The indices of the faces in each connected part. \param group number of each wall; only faces in walls
/// with one number count as connected. Empty = all.
std::vector<std::vector<std::size_t>> connected_parts(const std::vector<JoinedFace>& faces,
                                                      const std::vector<int>& group = {});

}  // namespace quadrille
