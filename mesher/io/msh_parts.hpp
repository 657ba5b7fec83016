#pragma once
/// What both versions of Gmsh's .msh share. Internal.

#include "mesher/io/output_mesh.hpp"
#include "mesher/io/text_writer.hpp"

namespace quadrille {

/// Gmsh's number for the type of an element. \param dimension 0, 1 or 2.
int msh_element_type(const ElementNodes& element, int dimension);

/// Numbers of physical groups. A face's is its CAD number; edges follow after the last face of the model, and
/// vertices after the last edge: several programs take groups of one number for one group, whatever their
/// dimensions.
class PhysicalNumbers {
 public:
  explicit PhysicalNumbers(const OutputMesh& mesh);
  /// \param cad number of a CAD face (dimension 2), edge (1) or vertex (0); 0 stays 0: in no group.
  int of(int dimension, int cad) const { return cad > 0 ? first_[dimension] + cad : 0; }

 private:
  int first_[3];  ///< by dimension
};

/// The section $PhysicalNames: Face3, Edge7, Vertex2. Nothing where there are no groups.
void write_physical_names(const OutputMesh& mesh, const PhysicalNumbers& physical, TextWriter& out);

/// The numbers of an element's nodes, and the end of the line.
void write_msh_nodes(const OutputMesh& mesh, const ElementNodes& element, TextWriter& out);

/// "x y z".
void write_msh_point(const Vector3& point, TextWriter& out);

}  // namespace quadrille
