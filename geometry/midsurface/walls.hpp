#pragma once
/// The walls of a thin solid: faces that face each other through the material, and the surface in the middle.
/// Internal.

#include <Geom_Surface.hxx>
#include <array>
#include <optional>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/midsurface/skin.hpp"

namespace quadrille {

/// All faces of a solid on one surface and the faces on another surface that lie opposite to them through the
/// material. If the middle is a B-spline, the second side may consist of several adjacent surfaces.
struct Wall {
  const Skin* skin = nullptr;               ///< of the solid
  std::array<std::vector<int>, 2> sides{};  ///< indices into Skin::faces()
  Handle(Geom_Surface) middle{};  ///< every point is equally far from both sides; unbounded unless `ends`
  double thickness = 0;           ///< mean over the wall
  bool fitted = false;            ///< the middle is not exact
  bool ends = false;              ///< the middle is a B-spline, which is bounded
  double off = 0;                 ///< largest distance of a fitted middle from the true one
  std::vector<int> goes_on{};  ///< indices of the walls with which the middle shares bounds, without a fence
  /// \param index into Skin::faces().
  const SkinFace& face(int index) const { return skin->faces()[index]; }
};

/// The two sides of a wall as seen from a point between them.
struct WallPosition {
  std::array<gp_Pnt, 2> feet;        ///< the closest point on each side
  std::array<int, 2> faces{-1, -1};  ///< indices into Skin::faces()
  double thickness() const { return feet[0].Distance(feet[1]); }
};

/// Numbers the surfaces that the faces lie on: faces on one plane, cylinder, ... with the material on the
/// same side of it get one number. \return the number for each face.
std::vector<int> surface_numbers(const Skin& skin);

/// Finds the walls. Two faces are paired if a ray from one through the material meets the other nearly at a
/// right angle, and nothing else is nearer to the point half way. Pairs without an exact middle that have one
/// surface in common become one wall with a fitted middle. An example is a bend whose two radii do not share
/// a center, together with the flat parts that one of them reaches over. Free-form walls that continue into
/// each other smoothly, side by side, become a wall each, whose middles end at common bounds. \param surfaces
/// of surface_numbers(). \param tolerance of fitted middles, over the thickness. Time: up to 26 rays for
/// each of about 24 points per face.
std::vector<Wall> find_walls(const Skin& skin, const std::vector<int>& surfaces, double tolerance,
                             const ExecutionContext& context);

/// Where the point lies in the wall; nothing if its closest points do not lie in faces of both sides or it is
/// not between them.
std::optional<WallPosition> position_in(const Wall& wall, const gp_Pnt& point);

/// The distance between the surfaces of the sides near the point, also past the ends of the faces.
double thickness_round(const Wall& wall, const gp_Pnt& point);

/// The distance of a point from the nearest surface of each side of a wall, of the faces whose boxes are
/// not farther than `reach` times the thickness; the solid's size if there are none.
std::array<double, 2> distances_to_sides(const Wall& wall, const gp_Pnt& point, double reach);

/// All faces of a wall.
std::vector<int> both_sides(const Wall& wall);

/// For each face of the skin the wall that it is a side of, the first one; -1 = none. \param walls one or
/// more
std::vector<int> walls_of_faces(const std::vector<Wall>& walls);

}  // namespace quadrille
