#pragma once
/// The skin of a solid: its faces with their outward normals, sample points on them, and rays through the
/// material. Internal.

#include <BRepAdaptor_Surface.hxx>
#include <Bnd_Box.hxx>
#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Solid.hxx>
#include <array>
#include <cmath>
#include <gp_Dir.hxx>
#include <gp_Lin.hxx>
#include <gp_Pnt.hxx>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/midsurface/box_tree.hpp"
#include "geometry/midsurface/closest_point.hpp"
#include "geometry/midsurface/inside_test.hpp"

namespace quadrille {

/// A point of a face that represents a part of its area.
struct FaceSample {
  gp_Pnt2d uv;
  gp_Pnt point;
  double area = 0;
};

/// Points inside a face, about `at_least` or more, spread over the triangulation that the face must carry;
/// over its parameters if the triangles do not have its area, or if the face has many holes.
std::vector<FaceSample> sample_face(const TopoDS_Face& face, int at_least);

/// Triangulates the faces of a shape for sampling and rays, but not those with many holes. \param deflection
/// largest distance from the shape. \param angle radians between neighboring triangles of a curved face, and
/// between parts of its edges.
void triangulate(const TopoDS_Shape& shape, double deflection, double angle = 0.4);

/// A triangle of a face.
struct SkinTriangle {
  std::array<gp_Pnt, 3> points;  ///< on the surface
  std::array<gp_Pnt2d, 3> uv;
  double area = 0;
};

/// One face of a solid. Evaluation uses internal caches: threads must not share an object.
class SkinFace {
 public:
  /// \param face oriented as in the solid. \param number in the model, from 1.
  /// \param near points closer to a line than this lie on it.
  SkinFace(const TopoDS_Face& face, int number, double near = 0);

  const TopoDS_Face& face() const { return face_; }
  int number() const { return number_; }
  const BRepAdaptor_Surface& surface() const { return *adaptor_; }
  double area() const { return area_; }
  double width() const { return width_; }  ///< see width_of()
  /// Unit normal out of the material; none where the surface is singular.
  std::optional<gp_Dir> outward(const gp_Pnt2d& uv) const;
  /// Parameters of the closest point of the (untrimmed) surface.
  gp_Pnt2d closest(const gp_Pnt& point) const;
  /// outward() at the closest point of the (untrimmed) surface.
  std::optional<gp_Dir> outward_at(const gp_Pnt& near) const { return outward(closest(near)); }
  /// The distance from the (untrimmed) surface.
  double distance(const gp_Pnt& from) const { return point(closest(from)).Distance(from); }
  gp_Pnt point(const gp_Pnt2d& uv) const { return adaptor_->Value(uv.X(), uv.Y()); }
  /// The closest point of the surface, if it lies in the face.
  std::optional<gp_Pnt> foot(const gp_Pnt& point) const;
  /// Whether parameters lie in the face or on its border.
  bool holds(const gp_Pnt2d& uv) const;
  const Bnd_Box& box() const { return box_; }

  std::vector<FaceSample> samples(int at_least) const { return sample_face(face_, at_least); }

  struct LineHit {
    gp_Pnt2d uv;
    double along = 0;  ///< parameter on the line
  };
  /// Intersections with a line, about between two of its parameters: with the triangles that the face must
  /// have had from the beginning, then with the exact surface; a plane with many holes needs no triangles. On
  /// tori and B-splines this is about a hundred times faster than OpenCASCADE. Time: logarithmic in the
  /// triangles.
  std::vector<LineHit> hits(const gp_Lin& line, double from, double to) const;

 private:
  TopoDS_Face face_;
  int number_;
  double near_, area_, width_;
  Bnd_Box box_;
  std::shared_ptr<BRepAdaptor_Surface> adaptor_;
  std::shared_ptr<ClosestPoint> inverse_;
  std::shared_ptr<InsideTest> inside_;
  std::vector<SkinTriangle> triangles_;  ///< empty if the face has many holes
  BoxTree boxes_;                        ///< of the triangles
};

/// The faces of one solid.
class Skin {
 public:
  struct Hit {
    int face = -1;  ///< index into faces()
    gp_Pnt2d uv;
    gp_Pnt point;
    double distance = 0;
  };

  /// \param solid with triangulated faces, material inside. \param numbers of its faces in the model, from 1.
  Skin(const TopoDS_Solid& solid, const TopTools_DataMapOfShapeInteger& numbers);
  Skin(const Skin&) = delete;
  Skin& operator=(const Skin&) = delete;

  const TopoDS_Solid& solid() const { return solid_; }
  const std::vector<SkinFace>& faces() const { return faces_; }
  /// Index of a face of the solid; -1 if it is none.
  int index_of(const TopoDS_Shape& face) const { return map_.FindIndex(face) - 1; }
  /// The edges of a face, but not its seams, each with the index of the face on its other side.
  std::vector<std::pair<TopoDS_Edge, int>> neighbors(const SkinFace& of) const;
  double size() const { return size_; }  ///< diagonal of the bounding box
  /// Indices of the faces that a point lies on, within a tolerance.
  std::vector<int> faces_at(const gp_Pnt& point, double tolerance) const;

  /// The first face that a ray meets, of those about within `reach`.
  std::optional<Hit> first_hit(const gp_Pnt& from, const gp_Dir& direction, double reach = HUGE_VAL) const;
  /// Whether the point lies in the material, by rays; of a point on the skin it is not known.
  bool in_material(const gp_Pnt& point) const;
  /// Whether a face lies within the distance `reach` of the point, along the direction or opposite to it.
  bool meets_face(const gp_Pnt& from, const gp_Dir& direction, double reach) const;

 private:
  TopoDS_Solid solid_;
  TopTools_IndexedMapOfShape map_;
  TopTools_IndexedDataMapOfShapeListOfShape around_;  ///< each edge; the same face twice at a seam
  std::vector<SkinFace> faces_;
  double size_ = 0;
  BoxTree boxes_;  ///< of the faces
};

}  // namespace quadrille
