#pragma once
/// The CAD model: faces, edges and vertices numbered as FreeCAD numbers them.

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/base/api.hpp"
#include "geometry/base/execution_context.hpp"
#include "geometry/base/vector.hpp"

namespace quadrille {

class CadShape;  // the OpenCASCADE side, see geometry/cad/cad_shape.hpp

/// How a CAD file is read.
struct ReadOptions {
  /// In a child process: OpenCASCADE crashes on some damaged files, and then there is an Error (failure)
  /// rather than no program any more. Costs the time to hand the shape over.
  bool isolated = false;
  /// Asked while reading in a child process: cancelling and its time limit end the reading at once.
  ExecutionContext* context = nullptr;
  double time_limit = 60;  ///< seconds that the child process may take; 0 = any
};

/// A boundary-representation model. Copies share the shape, which is never modified.
class QUADRILLE_API CadModel {
 public:
  /// Reads STEP (.step, .stp), IGES (.iges, .igs) or BREP (.brep, .brp); lengths are converted to
  /// millimeters. Throws Error (failure) with one sentence when the file is missing, is not CAD, or holds no
  /// face.
  static CadModel read(const std::filesystem::path& path, const ReadOptions& options = {});

  /// Parses a shape in OpenCASCADE's BREP text format, as FreeCAD's `Shape.exportBrepToString()` gives it.
  /// \param name used in error messages.
  static CadModel from_brep(std::string_view text, const std::string& name = "shape",
                            const ReadOptions& options = {});

  /// The model with the edges joined that lie within `tolerance` of each other, as in files whose faces touch
  /// without sharing their edges. Faces keep their numbers, edges and vertices get new ones; solids and
  /// shells are not kept. Throws Error: usage if the tolerance is not positive, failure if OpenCASCADE cannot
  /// sew the model. \param tolerance millimeters.
  CadModel sewn(double tolerance) const;

  int face_count() const;    ///< faces are numbered 1 .. face_count() (FreeCAD's Face1, Face2, ...)
  int edge_count() const;    ///< edges are numbered 1 .. edge_count()
  int vertex_count() const;  ///< vertices are numbered 1 .. vertex_count()
  int solid_count() const;   ///< how many solids
  int shell_count() const;   ///< how many shells

  /// Length of the diagonal of the model's bounding box, as FreeCAD gives it (control points may widen it).
  double diagonal() const;
  Vector3 box_min() const;  ///< corner of the box round it
  Vector3 box_max() const;  ///< corner of the box round it
  /// Sum of the face areas. Throws Error (failure), naming the face, where one cannot be integrated.
  double area(const ExecutionContext& context = {}) const;
  /// Problems noticed while reading (invalid faces, loose tolerances, ...), one sentence each.
  const std::vector<std::string>& problems() const;

  const CadShape& shape() const { return *shape_; }  ///< the library's own

  /// Of the library's own kind of shape.
  explicit CadModel(std::shared_ptr<const CadShape> shape) : shape_(std::move(shape)) {}

 private:
  std::shared_ptr<const CadShape> shape_;
};

}  // namespace quadrille
