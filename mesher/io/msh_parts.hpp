#pragma once
/// Parts of the writers for both versions of Gmsh's .msh. Internal.

#include <span>
#include <unordered_map>

#include "mesher/io/output_mesh.hpp"
#include "mesher/io/text_writer.hpp"

namespace quadrille {

/// Gmsh's number for the type of an element. \param dimension 0, 1 or 2.
int msh_element_type(const ElementNodes& element, int dimension);

/// The nodes of a shell element (dimension 2), segment (1) or corner (0).
ElementNodes element_nodes(const OutputMesh& mesh, int dimension, int member);

/// Numbers of physical groups. A mesh that was read keeps its numbers. Else the number of a face is its CAD
/// number; edges follow after the last face of the model, and vertices after the last edge, since several
/// programs take groups with the same number for one group, whatever their dimensions. The groups of the
/// solid's faces come next, thicknesses last.
class PhysicalNumbers {
 public:
  /// \param several whether an element may belong to more groups than that of its CAD entity. If not,
  /// thicknesses and the solid's faces are not groups: version 2.2 would repeat the elements, which few
  /// programs accept.
  PhysicalNumbers(const OutputMesh& mesh, bool several);
  /// Number of a group; 0 if it is not a physical group. \param group index in OutputMesh::groups(dimension).
  int of_group(int dimension, std::size_t group) const { return numbers_[dimension][group]; }
  /// Numbers of the groups OutputMesh::thicknesses(); empty if these are not physical groups.
  const std::vector<int>& of_thicknesses() const { return of_thicknesses_; }
  /// Numbers of the groups that a CAD face (dimension 2), edge (1) or vertex (0) belongs to, ascending.
  std::span<const int> of_entity(int dimension, int cad) const;

 private:
  std::vector<int> numbers_[3];                               ///< by dimension and group
  std::unordered_map<int, std::vector<int>> of_entities_[3];  ///< by dimension and CAD number
  std::vector<int> of_thicknesses_;
};

/// Writes the section $PhysicalNames: Face3, Edge7, Vertex2. Writes nothing if there are no names.
void write_physical_names(const OutputMesh& mesh, const PhysicalNumbers& physical, TextWriter& out);

/// Writes the section $Periodic: the second of two matched faces or edges first, then the one that is moved
/// there. Writes nothing if there are none. \param version4 for version 4.1 of the format
void write_periodic(const OutputMesh& mesh, bool version4, TextWriter& out);

/// Writes the numbers of an element's nodes and the end of the line.
void write_msh_nodes(const OutputMesh& mesh, const ElementNodes& element, TextWriter& out);

/// Writes "x y z".
void write_msh_point(const Vector3& point, TextWriter& out);

}  // namespace quadrille
