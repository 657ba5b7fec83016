#pragma once
/// Checks of the middle surface of a solid against the solid. Internal.

#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <map>
#include <vector>

#include "geometry/midsurface/joining.hpp"
#include "geometry/midsurface/midsurface.hpp"
#include "geometry/midsurface/skin.hpp"
#include "geometry/midsurface/walls.hpp"

namespace quadrille {

/// A middle face at a point of one of its edges.
struct Fan {
  gp_Pnt point;
  gp_Vec along;   ///< unit tangent of the edge, in the direction of its curve
  gp_Vec normal;  ///< unit normal of the face
  gp_Vec away;    ///< unit vector in the face, across the edge and out of the face
};

/// \param edge oriented as in the face. \param share of the edge's parameters.
Fan fan_at(const TopoDS_Edge& edge, const TopoDS_Face& face, double share);

/// Whether the middle of the wall `own` leaves the material through a side of another wall.
bool leaves_through_side(const std::vector<Wall>& walls, int own, const Fan& fan);

/// Sorts numbers and removes those that occur twice.
void sort_unique(std::vector<int>& numbers);

/// Checks the free edges: each must lie at a rim, where the skin closes the wall across its thickness.
/// Records the solid's faces that they lie on, and the faces that belong to no wall. \param faces of one
/// solid. \param edge_numbers of the result.
void check_rims(const Skin& skin, const std::vector<Wall>& walls, const std::vector<JoinedFace>& faces,
                const TopTools_IndexedMapOfShape& edge_numbers, const ExecutionContext& context,
                MidSurface& result);

/// The volume that area times thickness counts twice, and where.
struct CountedTwice {
  double junctions = 0;                   ///< where more than two middle surfaces meet
  double fillets = 0;                     ///< in fillets that are thickness of more than one wall
  double steps = 0;                       ///< in faces that join the walls of a step
  std::map<std::size_t, double> faces{};  ///< by index of a face: the volume of all places that it is part of
  double sum() const { return junctions + fillets + steps; }
};

/// What area times thickness counts twice. Corners of two walls count once: what is counted twice on their
/// inside is missing on their outside. What a junction counts twice compensates for fillets between the same
/// walls, as far as no thickness contains these. Linear in the edges.
CountedTwice counted_twice(const std::vector<Wall>& walls, const std::vector<JoinedFace>& faces,
                           Fillets fillets);

/// Indices of the faces whose thickness differs by more than a twentieth from what rays through the solid
/// measure on most of the face.
std::vector<std::size_t> faces_of_wrong_thickness(const Skin& skin, const std::vector<Wall>& walls,
                                                  const std::vector<JoinedFace>& faces,
                                                  const ExecutionContext& context);

/// Indices of the faces that a hollow section standing on another one closes off: walls stand all around
/// them, on one side, and on the other there is the inside of a section. Between them a solid has the depth
/// of the joint, a shell has none. The faces must be triangulated.
std::vector<std::size_t> hollow_joints(const Skin& skin, const std::vector<JoinedFace>& faces);

}  // namespace quadrille
