#pragma once
/// What both versions of Gmsh's .msh share. Internal.

#include <span>
#include <unordered_map>

#include "mesher/io/output_mesh.hpp"
#include "mesher/io/text_writer.hpp"

namespace quadrille {

/// Gmsh's number for the type of an element. \param dimension 0, 1 or 2.
int msh_element_type(const ElementNodes& element, int dimension);

/// Numbers of physical groups: those that the mesh was read with. Else a face's is its CAD number; edges
/// follow after the last face of the model, and vertices after the last edge: several programs take groups of
/// one number for one group, whatever their dimensions. The solid's faces come next, thicknesses last.
class PhysicalNumbers {
 public:
  /// \param several whether an element may be in more groups than its entity's own: in version 2.2 it is
  /// there twice then, which few programs take. If not, thicknesses and the solid's faces are no groups.
  PhysicalNumbers(const OutputMesh& mesh, bool several);
  /// 0 where it is no physical group. \param group its place in OutputMesh::groups(dimension).
  int of_group(int dimension, std::size_t group) const { return numbers_[dimension][group]; }
  /// Of each of OutputMesh::thicknesses(), where they are groups.
  const std::vector<int>& of_thicknesses() const { return of_thicknesses_; }
  /// Of the groups that a CAD face (dimension 2), edge (1) or vertex (0) belongs to, ascending.
  std::span<const int> of_entity(int dimension, int cad) const;

 private:
  std::vector<int> numbers_[3];                               ///< by dimension and group
  std::unordered_map<int, std::vector<int>> of_entities_[3];  ///< by dimension and CAD number
  std::vector<int> of_thicknesses_;
};

/// The section $PhysicalNames: Face3, Edge7, Vertex2. Nothing where there are no names.
void write_physical_names(const OutputMesh& mesh, const PhysicalNumbers& physical, TextWriter& out);

/// The numbers of an element's nodes, and the end of the line.
void write_msh_nodes(const OutputMesh& mesh, const ElementNodes& element, TextWriter& out);

/// "x y z".
void write_msh_point(const Vector3& point, TextWriter& out);

}  // namespace quadrille
