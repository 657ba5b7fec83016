#pragma once
/// The closest point of a surface, for many points. Internal.

#include <GeomAdaptor_Surface.hxx>
#include <ShapeAnalysis_Surface.hxx>
#include <TopoDS_Face.hxx>
#include <array>
#include <gp_Pnt.hxx>
#include <gp_Pnt2d.hxx>
#include <optional>
#include <vector>

namespace quadrille {

/// Finds closest points of a face's surface, trimmed or not. On bounded free-form surfaces Newton's method
/// starts at the nearest points of a grid, which is about fifty times faster than OpenCASCADE's search. That
/// search, which finds the same points, is used for other surfaces and where the method does not converge.
/// Evaluation uses internal caches: threads must not share an object.
class ClosestPoint {
 public:
  explicit ClosestPoint(const TopoDS_Face& face);
  /// Parameters of the surface's point that is closest to a point.
  gp_Pnt2d operator()(const gp_Pnt& point);

 private:
  /// A point of the surface, and the square of its distance from the given point.
  struct Place {
    std::array<double, 2> uv{};
    double distance = 0;
  };
  void make_grid();
  std::size_t count(int direction) const { return values_[direction].size(); }
  /// The places of the grid that are closer than those around them, and may have the closest point near them.
  std::vector<Place> starts(const gp_Pnt& point) const;
  /// The closest point near a place; none without convergence.
  std::optional<Place> descend(Place from, const gp_Pnt& point) const;
  /// Newton's step to the closest point, in both parameters; one that is at its bound stays there if it
  /// would leave it. None where the surface is singular.
  struct Step {
    std::array<double, 2> by{};
    double length = 0;  ///< in space, about
  };
  std::optional<Step> step(const Place& at, const gp_Pnt& point) const;

  ShapeAnalysis_Surface search_;
  GeomAdaptor_Surface surface_;
  std::array<double, 4> bounds_{};             ///< low and high u, low and high v
  std::array<std::vector<double>, 2> values_;  ///< parameters of the grid; empty = it is not used
  std::vector<gp_Pnt> grid_;                   ///< v runs fastest; made when it is first needed
  double size_ = 0, spacing_ = 0;              ///< of the grid in space: diagonal, and of its largest cell
};

}  // namespace quadrille
