#pragma once
/// The walls of a thin solid: faces that face each other through the material, with the surface in their
/// middle. Internal.

#include <Geom_Surface.hxx>
#include <array>
#include <optional>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/midsurface/skin.hpp"

namespace quadrille {

/// All faces of a solid on one surface and those on another that it has in common a thickness with. Where
/// the middle is fitted, the second side may be several surfaces, one behind the other.
struct Wall {
  std::array<std::vector<int>, 2> sides;  ///< indices into Skin::faces()
  Handle(Geom_Surface)
      middle;  ///< every point is as far from one side as from the other; unbounded unless it `ends`
  double thickness = 0;  ///< mean over the wall
  bool fitted = false;   ///< the middle is not exact
  bool ends = false;     ///< the middle is a B-spline, and ends
  double off = 0;        ///< of a fitted middle: largest distance from the true one
};

/// A piece of the material at one point: how far the two sides of a wall are apart there.
struct WallPosition {
  std::array<gp_Pnt, 2> feet;        ///< on the sides
  std::array<int, 2> faces{-1, -1};  ///< indices into Skin::faces()
  double thickness() const { return feet[0].Distance(feet[1]); }
};

/// Numbers the surfaces that the faces lie on: faces on one plane, cylinder, ... that have the material on
/// the same side of it get one number. \return a number a face.
std::vector<int> surface_numbers(const Skin& skin);

/// Finds the walls: a ray from a face through the material meets the other face nearly at a right angle, and
/// nothing else is nearer to the point in the middle. Pairs without an exact middle, such as a bend whose two
/// radii do not share a center with the flat parts it reaches over, become one wall with a fitted middle
/// where they have one surface in common. \param tolerance of fitted middles, over their thickness. Time:
/// some ten rays for each of some 24 points a face.
std::vector<Wall> find_walls(const Skin& skin, const std::vector<int>& surfaces, double tolerance,
                             const ExecutionContext& context);

/// Where the point stands in the wall: the feet of its perpendiculars, when they lie in faces of both sides
/// and the point between them.
std::optional<WallPosition> position_in(const Wall& wall, const Skin& skin, const gp_Pnt& point);

/// How far apart the surfaces of the sides are round the point, beyond the faces' ends too.
double thickness_round(const Wall& wall, const Skin& skin, const gp_Pnt& point);

/// All faces of a wall.
std::vector<int> both_sides(const Wall& wall);

}  // namespace quadrille
