#pragma once
/// Whether parameters lie in a face, fast also where it has many holes. Internal.

#include <BRepTopAdaptor_FClass2d.hxx>
#include <TopAbs_State.hxx>
#include <TopoDS_Face.hxx>
#include <array>
#include <gp_Pnt2d.hxx>
#include <memory>
#include <vector>

namespace quadrille {

/// Whether the face is plane and has so many holes that OpenCASCADE's triangulation, whose time grows with
/// the square of their number, is to be avoided.
bool has_many_holes(const TopoDS_Face& face);

/// A face, prepared for the test. Threads must not share an object.
class InsideTest {
 public:
  explicit InsideTest(const TopoDS_Face& face);

  /// Whether the parameters are in the face, on its border or out of it. \param near distance in parameters
  /// up to which they are on the border. Of a face with many holes only those are looked at that share a cell
  /// of a grid with the parameters.
  TopAbs_State at(const gp_Pnt2d& uv, double near) const;

 private:
  /// The face, or the same surface within one of its wires.
  struct Part {
    TopoDS_Face face;
    std::unique_ptr<BRepTopAdaptor_FClass2d> inside;
    TopAbs_State at(const gp_Pnt2d& uv, double near) const;
  };
  static Part part_of(const TopoDS_Face& face);
  std::size_t cell_of(double value, int axis) const;

  Part outside_;                                 ///< without the holes if they are in the grid
  std::vector<Part> holes_;                      ///< empty if the face has few holes
  std::vector<std::vector<std::size_t>> cells_;  ///< indices of the holes in each cell
  std::size_t count_ = 0;                        ///< cells along each axis
  std::array<double, 2> low_{0, 0}, step_{1, 1};
};

}  // namespace quadrille
