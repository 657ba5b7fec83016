#pragma once
/// Turns thin solids into shells: the middle surface of a solid, with its thickness.

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "geometry/base/api.hpp"
#include "geometry/base/execution_context.hpp"
#include "geometry/base/vector.hpp"
#include "geometry/cad/cad_model.hpp"

namespace quadrille {

/// Options of midsurface().
struct MidSurfaceOptions {
  /// If a part of the solid is not thin, return the middle of the rest and report what is left out. Otherwise
  /// that is an error.
  bool partial = false;
  /// Treat solids that touch, overlap or leave a narrow gap as welded: their middle surfaces share edges.
  bool join = false;
  /// Largest ratio of thickness to width at which a wall still counts as thin.
  double thickest = 0.2;
  /// Largest distance of a fitted middle surface from the true one, over the thickness. Ten times as much is
  /// allowed where the sides have kinks and more points gain little.
  double tolerance = 1e-3;
};

/// One face of the middle surface.
struct MiddleFace {
  double thinnest = 0 /**< millimeters */,
         thickest = 0;           ///< millimeters; equal where the thickness is constant
  double thickness = 0;          ///< mean over the face
  double area = 0;               ///< square millimeters
  std::vector<int> solid_faces;  ///< numbers of the solid's faces that it lies between
  int solid = 0;                 ///< from 1, in the order of the model
  /// The face joins two middle surfaces that do not meet where the thickness steps. It has the smaller
  /// thickness of the two.
  bool step = false;
  bool fitted = false;  ///< there is no exact middle surface
  double off = 0;       ///< largest distance found from the true middle; 0 where exact
};

/// Whether the thickness of a face varies by more than a thousandth.
inline bool varies(const MiddleFace& face) {
  return face.thickest > 1.001 * face.thinnest;
}

/// A free edge of the middle surface.
struct MiddleRim {
  int edge = 0;                  ///< number in the middle surface, from 1
  std::vector<int> solid_faces;  ///< numbers of the solid's faces that the edge lies on, ascending
};

/// The middle surfaces of the solids of a model, and the results of the checks on them.
struct MidSurface {
  CadModel model;                   ///< the middle surfaces; their faces share edges where they meet
  std::vector<MiddleFace> faces{};  ///< by face number minus 1
  std::vector<MiddleRim> rims{};    ///< the free edges that lie on the skin, ascending
  std::map<std::string, std::set<int>> face_names{};  ///< of the solid's faces, see CadModel::face_names()
  double volume = 0;                                  ///< volume of the solids
  double shell_volume = 0;                            ///< sum of area times mean thickness over all faces
  /// What of shell_volume is counted twice: where walls meet, if it compensates for no fillet there; in
  /// fillets that are thickness of more than one wall; and in the faces that join the walls of a step.
  double counted_twice = 0;
  int solids = 0;                  ///< number of solids that are thin; with options.join, after joining
  int parts = 0;                   ///< number of connected parts of the middle surface
  int free_edges = 0;              ///< number of edges that bound one face only
  std::vector<int> stray_edges{};  ///< numbers of the free edges that end inside the material
  /// For each of stray_edges, the numbers of the one or two faces of the solid that are nearest to it.
  std::vector<std::vector<int>> stray_faces{};
  /// Numbers of the solid's faces that are neither a side nor a rim of a wall nor the riser of a step, and
  /// that are not narrower than half the thickness of the thinnest wall.
  std::vector<int> unpaired{};
  std::vector<int> uneven{};  ///< numbers of the faces where rays through the solid measure another thickness
  std::vector<std::string> problems{};  ///< with options.partial: what would have been an error
  std::vector<std::string> warnings{};  ///< imprecise results that are not errors
  /// The thickness of a face (from 1) at a point; the mean if it does not vary. One thread at a time.
  std::function<double(int face, const Vector3& point)> thickness_at{};
};

/// Makes the middle surface of each solid of the model. Faces that face each other through the material are
/// paired. The surface in the middle of a pair is exact for planes, and for coaxial or concentric cylinders,
/// cones, spheres and tori; otherwise it is fitted. Surfaces are extended to where they meet and share edges
/// there. Solids are kept apart unless options.join. Throws Error (failure, with one sentence) if the model
/// has no solid, a solid is not thin, or solids or surfaces cannot be joined. Without options.partial also if
/// a part is not thin, area times thickness is over 110 % of the volume or, without what is counted twice
/// where walls meet, under 95 %, a fitted surface misses its tolerance, the numbers of parts and solids
/// differ, or a free edge lies elsewhere than at a rim of the solid. Throws Error (cancelled). Deterministic.
QUADRILLE_API MidSurface midsurface(const CadModel& model, const MidSurfaceOptions& options,
                                    ExecutionContext& context);

}  // namespace quadrille
