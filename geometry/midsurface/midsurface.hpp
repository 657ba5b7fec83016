#pragma once
/// Thin solids become shells: the middle surface of a solid with its thickness.

#include <functional>
#include <string>
#include <vector>

#include "geometry/base/api.hpp"
#include "geometry/base/execution_context.hpp"
#include "geometry/base/vector.hpp"
#include "geometry/cad/cad_model.hpp"

namespace quadrille {

/// How middle surfaces are found.
struct MidSurfaceOptions {
  /// Give what could be paired where a part of the solid is not thin, and say what is left out. Otherwise
  /// that is an error.
  bool partial = false;
  /// Take solids that touch or overlap for one part, as if welded: their middle surfaces share edges.
  bool join = false;
  /// Largest thickness of a wall over its width that still counts as thin.
  double thickest = 0.2;
  /// How far a middle surface that has to be fitted may lie off the true one, over the thickness; ten times
  /// that where its sides have kinks and more points gain little.
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
  /// It joins two middle surfaces that pass each other where the thickness steps; it has the smaller
  /// thickness of the two.
  bool step = false;
  bool fitted = false;  ///< a B-spline: there is no exact middle surface
  double off = 0;       ///< largest distance found from the true middle; 0 where exact
};

/// Whether the thickness of a face varies, by more than a thousandth.
inline bool varies(const MiddleFace& face) {
  return face.thickest > 1.001 * face.thinnest;
}

/// A free edge of the middle surface.
struct MiddleRim {
  int edge = 0;                  ///< of the middle surface, from 1
  std::vector<int> solid_faces;  ///< numbers of the solid's faces that it lies on, ascending
};

/// The middle surfaces of the solids of a model, and what the program found when it checked them.
struct MidSurface {
  CadModel model;                   ///< its faces, which share their edges where they meet
  std::vector<MiddleFace> faces{};  ///< by face number minus 1
  std::vector<MiddleRim> rims{};    ///< the free edges, ascending
  double volume = 0;                ///< of the solids
  double shell_volume = 0;          ///< sum of area times mean thickness
  int solids = 0;                   ///< of the model; with options.join, after those that touch became one
  int parts = 0;                    ///< connected parts of the middle surface
  int free_edges = 0;               ///< edges that bound one face only
  std::vector<int> stray_edges{};   ///< of these, the ones that do not lie on the skin of the solid
  /// Numbers of solid faces that are neither side nor rim of a wall, and wider than half the thinnest one.
  std::vector<int> unpaired{};
  std::vector<std::string> problems{};  ///< with options.partial: what would have been an error
  /// The thickness at a point of a face, from 1, whose thickness varies; of others the constant one.
  /// Called by one thread at a time.
  std::function<double(int face, const Vector3& point)> thickness_at{};
};

/// The middle surface of each solid of the model: faces that face each other through the material are paired;
/// the surface in the middle of a pair is exact for planes, cylinders, cones, spheres and tori that belong
/// together, else fitted; surfaces run on to where they meet and share edges there. Solids are kept apart
/// unless options.join. Throws Error (failure) with a sentence: where the model holds no solid, a solid is
/// not thin, or, without options.partial, where more than a twentieth of the volume is not in walls, or the
/// result is checked and found not connected or with free edges inside the material; cancelled.
/// Deterministic.
QUADRILLE_API MidSurface midsurface(const CadModel& model, const MidSurfaceOptions& options,
                                    ExecutionContext& context);

}  // namespace quadrille
