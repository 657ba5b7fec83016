#pragma once
/// The CAD model: faces, edges and vertices numbered as FreeCAD numbers them.

#include <filesystem>
#include <map>
#include <memory>
#include <set>
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
  /// Read in a child process. OpenCASCADE crashes on some damaged files; then an Error (failure) is thrown
  /// and the program survives. Costs the time to transfer the shape.
  bool isolated = false;
  /// Checked while reading in a child process: cancellation and its time limit end the reading at once.
  ExecutionContext* context = nullptr;
  double time_limit = 60;  ///< seconds that the child process may take; 0 = no limit
};

/// A boundary-representation model. Copies share the shape, which is never modified.
class QUADRILLE_API CadModel {
 public:
  /// Reads STEP (.step, .stp), IGES (.iges, .igs) or BREP (.brep, .brp); lengths are converted to
  /// millimeters. Throws Error with one sentence: usage for another file name ending, failure when the file
  /// is missing, is not CAD, or contains no face.
  static CadModel read(const std::filesystem::path& path, const ReadOptions& options = {});

  /// Parses a shape in OpenCASCADE's BREP text format, as FreeCAD's `Shape.exportBrepToString()` gives it.
  /// \param name used in error messages.
  static CadModel from_brep(std::string_view text, const std::string& name = "shape",
                            const ReadOptions& options = {});

  /// The model with all edges joined that lie within `tolerance` of each other, for files whose faces touch
  /// without sharing edges. Faces, solids and shells are kept; edges and vertices get new numbers; faces
  /// outside solids are reversed where needed to match their neighbors. Throws Error: usage if the tolerance
  /// is not positive or not below the diagonal, failure if OpenCASCADE cannot sew the model or loses faces,
  /// or if faces coincide after sewing, which only imprinted() can join. \param tolerance millimeters.
  CadModel sewn(double tolerance) const;

  /// The model cut so that solids, shells and faces that touch or cross share faces, edges and vertices
  /// (OpenCASCADE's general fuse). Faces that touch no other part keep their numbers, and one piece of each
  /// cut face keeps its number, see pieces(); edges and vertices get new numbers. Seams of two edges become
  /// one, and faces outside solids are oriented alike. A model of one part without such seams stays as it is.
  /// Takes milliseconds a face where parts meet. Throws Error: usage if the tolerance is negative
  /// or not below the diagonal, failure if OpenCASCADE cannot do it. \param tolerance millimeters: parts no
  /// farther apart touch; 0 = within the tolerances of the model itself.
  CadModel imprinted(double tolerance = 0) const;

  int face_count() const;    ///< faces are numbered 1 .. face_count() (FreeCAD's Face1, Face2, ...)
  int edge_count() const;    ///< edges are numbered 1 .. edge_count()
  int vertex_count() const;  ///< vertices are numbered 1 .. vertex_count()
  int solid_count() const;   ///< number of solids
  int shell_count() const;   ///< number of shells

  /// Length of the diagonal of the bounding box, which control points do not widen.
  double diagonal() const;
  Vector3 box_min() const;  ///< lowest corner of the bounding box
  Vector3 box_max() const;  ///< highest corner of the bounding box
  /// Sum of the face areas. Throws Error (failure), naming the face, when one cannot be integrated.
  double area(const ExecutionContext& context = {}) const;
  /// Problems found while reading (missing curves or seams, loose vertices, ...), one sentence each.
  const std::vector<std::string>& problems() const;
  /// The numbers of the faces that have a name in a STEP file: that of the face, its solid or its part. Names
  /// that say nothing are left out. Faces with one name are together.
  const std::map<std::string, std::set<int>>& face_names() const;
  /// For an imprinted model: the numbers of the faces that each face of the original model became, ascending,
  /// by its number minus 1. Faces of different parts may have become the same face. Empty for other models.
  const std::vector<std::vector<int>>& pieces() const;
  /// The same for edges, by their numbers. Empty also if the model was sewn after that.
  const std::vector<std::vector<int>>& edge_pieces() const;
  /// The same for vertices.
  const std::vector<std::vector<int>>& vertex_pieces() const;

  const CadShape& shape() const { return *shape_; }  ///< internal representation

  /// Wraps the library's internal shape.
  explicit CadModel(std::shared_ptr<const CadShape> shape) : shape_(std::move(shape)) {}

 private:
  std::shared_ptr<const CadShape> shape_;
};

}  // namespace quadrille
