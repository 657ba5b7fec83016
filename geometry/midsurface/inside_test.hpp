#pragma once
/// Whether parameters lie in a face, fast also where it has many holes. Internal.

#include <BRepTopAdaptor_FClass2d.hxx>
#include <Bnd_Box2d.hxx>
#include <TopAbs_State.hxx>
#include <TopoDS_Face.hxx>
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
  /// up to which they are on the border. Of a face with many holes only those are looked at in whose box the
  /// parameters lie.
  TopAbs_State at(const gp_Pnt2d& uv, double near) const;

 private:
  /// The face, or the same surface within one of its wires.
  struct Part {
    TopoDS_Face face;
    std::unique_ptr<BRepTopAdaptor_FClass2d> inside;
    Bnd_Box2d box;  ///< of a hole's parameters, a little larger
    TopAbs_State at(const gp_Pnt2d& uv, double near) const;
  };
  static Part part_of(const TopoDS_Face& face);

  Part outside_;             ///< without the holes if these are tested one by one
  std::vector<Part> holes_;  ///< empty if the face has few holes
};

}  // namespace quadrille
