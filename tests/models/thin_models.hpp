#pragma once
/// Thin solids whose middle surface is known.

#include <TopoDS_Shape.hxx>
#include <functional>
#include <string>
#include <vector>

namespace quadrille {

/// An outline, its corners in order, rounded by a radius each.
struct Corner2d {
  double x = 0, y = 0, radius = 0;
};

struct ThinModel {
  std::string name;  ///< fit for a file name
  std::function<TopoDS_Shape()> make;
  double middle_area = 0;           ///< of the true middle surface; 0 = not known
  std::vector<double> thicknesses;  ///< that occur, ascending
  double share_off = 0.01;          ///< how far area times thickness may be off the volume
  int free_loops = 0;               ///< closed chains of free edges
};

/// Each can be turned into its middle surface.
const std::vector<ThinModel>& thin_models();

/// A section for a cantilever of `length` along z.
struct CantileverModel {
  std::string name;
  std::vector<std::vector<Corner2d>> outlines;
  double length = 0;
};
std::vector<CantileverModel> cantilevers();

/// A block, which is not thin.
TopoDS_Shape thick_block();

/// A plate of 3 mm that stands on a block of 40 x 40 mm: thin in places only. Where the block is lower than
/// wide it has two sides that face each other.
TopoDS_Shape plate_on_block(double height = 40);

/// A housing made of lofts whose lid is rounded: twelve walls of free form that go on into each other.
TopoDS_Shape blended_housing();

/// Three box profiles that touch, a solid each: two columns of 40 x 40 x 3, 200 mm high, and between them,
/// 160 mm long, a beam of 30 x 30 x 2. \param gap between the beam and either column, by which the beam is
/// shorter. \param wide of the beam; 40: its sides are flush with those of the columns.
TopoDS_Shape welded_frame(double gap = 0, double wide = 30);

/// Solids that are one part with what joins them.
struct JoinedModel {
  std::string name;
  std::function<TopoDS_Shape()> make;
  int solids = 0;
  double middle_area = 0;           ///< of the true middle surface, with the strips at steps; 0 = not known
  std::vector<double> thicknesses;  ///< that occur, ascending
};

/// Solids with gaps between them that are narrow enough to be closed, and solids that lie on each other.
const std::vector<JoinedModel>& joined_models();

/// A plate with many ribs: 200 faces and more.
TopoDS_Shape ribbed_plate(int ribs_each_way);

/// The face between outlines in the plane z = 0, the first one outside, the others holes in it.
TopoDS_Shape section(const std::vector<std::vector<Corner2d>>& outlines);

/// The solid between outlines in the plane z = 0, the first one outside, the others holes in it, and the same
/// at z = length.
TopoDS_Shape profile(const std::vector<std::vector<Corner2d>>& outlines, double length);

}  // namespace quadrille
