#pragma once
/// The middle surface of one wall, trimmed to the material. Internal.

#include <TopoDS_Face.hxx>
#include <map>
#include <set>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/midsurface/walls.hpp"

namespace quadrille {

/// The place where a wall ends because another one, nearly parallel to it, begins: a bend or a step.
struct WallEnd {
  int wall = 0, next = 0;  ///< indices of the walls
  TopoDS_Face fence;       ///< stands across the wall, at an edge of one of its sides
  bool step = false;       ///< the two middle surfaces do not meet; the fence reaches from one to the other
  int riser = -1;  ///< index of the face behind the fence, if fences stand along all its edges at the wall
};

/// Whether the fence at a step stands at the end of `wall`: it stands at the thicker one, of equal ones the
/// first.
bool stands_on(const std::vector<Wall>& walls, int wall, int next);

/// How much of a middle face lies between the sides of its wall, and how thick the wall is there.
struct Coverage {
  double share = 0;  ///< share of the area that lies between both sides
  double thinnest = 0, thickest = 0, mean = 0;
  std::set<int> faces{};  ///< indices of the skin's faces that the middle face lies between
  double added = 0;  ///< what fillets add to the distance between the sides; contained in the three above
};

/// Triangulates a middle face for samples: finely enough for its thickness and its width.
void triangulate_middle(const TopoDS_Face& face, double thickness);

/// Triangulates a middle face and looks where it lies. \param past_sides how thick the wall would be where
/// its sides do not reach, as beside a corner with a fillet, by the distance between their surfaces.
Coverage coverage_of(const TopoDS_Face& face, const Wall& wall, bool past_sides = false);

/// The thickness of a middle face at a point, with what fillets add, within the range of its coverage.
double thickness_at(const Coverage& coverage, const Wall& wall, const gp_Pnt& point);

/// All ends of all walls. A step has two ends; the fence of only one of them joins the walls.
std::vector<WallEnd> find_wall_ends(const Skin& skin, const std::vector<Wall>& walls,
                                    const std::vector<int>& surfaces, const ExecutionContext& context);

/// Fences where a wall runs into others but its rim stops at their skin, as at a rib's end on a plate. They
/// extend the rim, so that the middle does not spread inside the other wall. WallEnd::next is the wall
/// itself.
std::vector<WallEnd> find_rim_ends(const Skin& skin, const std::vector<Wall>& walls,
                                   const std::vector<int>& surfaces, const ExecutionContext& context);

/// The border between a wall's side and a fillet: a strip that fills a corner between walls. It may be round
/// and tangent to the walls, or flat or slightly curved and at an obtuse angle to them, as a weld is.
struct FilletBorder {
  int wall = 0;       ///< index of the wall
  TopoDS_Face fence;  ///< a small face across the wall at the border
  gp_Dir outward;     ///< outward normal half way along the border
  double turn = 0;  ///< angle there between the normals of the wall and of the fillet; 0 if they are tangent
  double length = 0;  ///< length of the border
  double share = 1;   ///< of the length of all borders of the fillet with this wall
};

/// The borders of each fillet in a corner of two or more walls, by the fillet's index into Skin::faces().
std::map<int, std::vector<FilletBorder>> find_fillet_borders(const Skin& skin,
                                                             const std::vector<Wall>& walls);

/// The pieces of a wall's middle surface that lie in the material, cut at the skin and at the wall's ends.
/// Where the wall runs into others the surface continues to the end of the material. Pieces that lie nowhere
/// between the sides are left out. Empty if OpenCASCADE fails; the checks of the result report that.
std::vector<TopoDS_Face> wall_pieces(const Skin& skin, const std::vector<Wall>& walls, int wall,
                                     const std::vector<WallEnd>& ends, const ExecutionContext& context);

}  // namespace quadrille
