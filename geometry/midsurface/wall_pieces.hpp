#pragma once
/// The middle surface of one wall, cut out of the material. Internal.

#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopoDS_Face.hxx>
#include <map>
#include <set>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/midsurface/walls.hpp"

namespace quadrille {

/// Where one wall stops since another, nearly parallel to it, begins: at a bend or a step.
struct WallEnd {
  int wall = 0, next = 0;  ///< indices of the walls
  TopoDS_Face fence;       ///< stands across the wall, on one edge of its side
  bool step = false;  ///< the middle surfaces of the two do not meet: the fence reaches from one to the other
};

/// How much of a middle face lies between the sides of its wall, and how thick the wall is there.
struct Coverage {
  double share = 0;  ///< of the area that lies between both sides
  double thinnest = 0, thickest = 0, mean = 0;
  std::set<int> faces{};  ///< of the skin that it lies between
};

/// \param face with triangles.
Coverage coverage_of(const TopoDS_Face& face, const Wall& wall, const Skin& skin);

/// All ends of all walls. A step has two, one of which does not join.
std::vector<WallEnd> find_wall_ends(const Skin& skin, const std::vector<Wall>& walls,
                                    const std::vector<int>& surfaces);

/// Where a wall runs into others and its rim stops short of them, as a rib's end does on a plate: fences that
/// carry the rim on, so that the middle surface does not spread inside the other wall. `next` is the wall.
std::vector<WallEnd> find_rim_ends(const Skin& skin, const std::vector<Wall>& walls,
                                   const std::vector<int>& surfaces);

/// Where a fillet begins on a wall's side: a small face across the wall there.
struct FilletBorder {
  int wall = 0;  ///< index of the wall
  TopoDS_Face fence;
  gp_Dir outward;     ///< of the wall and the fillet, half way along the border
  double length = 0;  ///< of the border
};

/// By index into Skin::faces(): the borders of each fillet in a corner between walls, two or more.
std::map<int, std::vector<FilletBorder>> find_fillet_borders(const Skin& skin,
                                                             const std::vector<Wall>& walls);

/// What lies of a wall's middle surface in the material, cut at the skin and at the wall's ends. It runs on
/// where the wall runs into others, as far as the material goes. Pieces that do not lie between the sides
/// anywhere are left out. Empty where OpenCASCADE cannot cut the surface: the checks of the result tell.
std::vector<TopoDS_Face> wall_pieces(const Skin& skin, const std::vector<Wall>& walls, int wall,
                                     const std::vector<WallEnd>& ends);

}  // namespace quadrille
