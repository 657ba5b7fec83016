#pragma once
/// A mesh prepared for the writers: dense node numbers, and groups by CAD entity.

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "mesher/io/element_types.hpp"
#include "mesher/mesh/entity_name.hpp"
#include "mesher/mesh/mesh_types.hpp"
#include "mesher/options.hpp"

namespace quadrille {

/// The nodes of one element, as indices for OutputMesh::position(): corners, midside nodes, the middle node.
struct ElementNodes {
  std::array<int, 9> nodes{};
  int count = 0;
  int dimension = 2;
  const ElementType& type() const { return element_type(dimension, count); }
  const int* begin() const { return nodes.data(); }
  const int* end() const { return nodes.data() + count; }
};

/// The elements, segments or corners that belong to one CAD entity, or to one part of the file from which the
/// mesh was read.
struct CadGroup {
  int number = 0;            ///< CAD number; 0 = members that belong to no entity
  std::vector<int> members;  ///< ascending indices of shell elements, segments or corners
};

/// What has one name in a file: the elements, segments or corners of one CAD entity or, in a mesh that was
/// read, a group of its file.
struct NamedGroup {
  std::string name;
  bool has_name = true;       ///< false: the name is made from the number, PhysicalSurface7
  int number = 0;             ///< number in the file that was read; 0 = none
  std::vector<int> entities;  ///< CAD numbers, ascending
  bool is_extra = false;      ///< its entities have groups of their own too
};

/// The faces with the same thickness, or the same range of thicknesses, to the digits in the name:
/// "Thickness2.5", "Thickness2to4".
struct ThicknessGroup : NamedGroup {
  std::string thickness;  ///< "2.5"; the mean if it varies
  bool varies = false;    ///< whether the thickness varies over each face
};

/// A mesh as it is written to a file. Shell elements are numbered together: quads first, then triangles.
/// Keeps a reference to the mesh.
class OutputMesh {
 public:
  /// \param groups the kinds of groups to write. Without edges there are no segments, without vertices no
  /// corners. \param quad_nodes nodes of second-order quads: 8 or 9. The ninth lies at the middle of the
  /// eight-node element, so that the element keeps its shape and validity.
  /// Throws Error (failure) when an element has a node out of range or a node has no finite position.
  explicit OutputMesh(const ShellMesh& mesh, const GroupKinds& groups = {}, int quad_nodes = 8);

  /// The nodes that are used, in file order: node i of the file is nodes()[i - 1].
  const std::vector<int>& nodes() const { return nodes_; }
  /// Number of a node in the file, from 1.
  int number(int node) const { return numbers_[node]; }
  /// Nodes up to the number of points of the mesh are its points; the following ones are middles of quads.
  const Vector3& position(int node) const {
    const int own = static_cast<int>(mesh_.points.size());
    return node < own ? mesh_.points[node] : middles_[node - own];
  }
  const Vector3& point(int file_index) const { return position(nodes_[file_index]); }

  int order() const { return mesh_.order; }
  int quad_count() const { return static_cast<int>(mesh_.quads.size()); }
  int shell_count() const { return quad_count() + static_cast<int>(mesh_.triangles.size()); }
  bool is_quad(int shell) const { return shell < quad_count(); }
  /// CAD face of a shell element; 0 = none.
  int face(int shell) const;
  /// The number of faces of the CAD model or, if that is not known, the largest number of a face with
  /// elements.
  int cad_face_count() const;
  int corner_node(int corner) const { return mesh_.corners[corner].node; }

  /// By dimension, of shell elements (2), segments (1) or corners (0): their number, the CAD face, edge or
  /// vertex of one (0 = none), and its nodes, of segments the ends before the midside node.
  int count(int dimension) const;
  int entity(int dimension, int member) const;
  ElementNodes element_nodes(int dimension, int member) const;

  /// Shell elements by CAD face (2), segments by edge (1) or corners by vertex (0).
  const std::vector<CadGroup>& entities(int dimension) const { return entities_[dimension]; }
  /// Groups by thickness, in the order of their first faces; empty if no thickness is known.
  const std::vector<ThicknessGroup>& thicknesses() const { return thicknesses_; }

  /// Thickness of the shell on a CAD face, the mean if it varies; 0 if not known.
  double face_thickness(int face) const;
  /// Thicknesses at the corners of a shell element; 0 if not known.
  std::array<double, 4> corner_thicknesses(int shell) const;
  /// File numbers of the nodes of faces whose thickness varies, ascending, and the thickness at each node:
  /// the mean over such faces that share the node.
  std::vector<std::pair<int, double>> node_thicknesses() const;

  /// The named groups of shell elements (dimension 2), segments (1), corners (0).
  const std::vector<NamedGroup>& groups(int dimension) const { return named_[dimension]; }
  /// Whether the groups were read from a file with the mesh.
  bool groups_were_read() const { return !mesh_.groups.empty(); }
  /// Calls `visit(dimension, group)` for the groups of shell elements, segments and corners, and for those by
  /// thickness.
  template <class Visit>
  void for_each_group(Visit&& visit) const {
    for (const int dimension : {2, 1, 0})
      for (const NamedGroup& group : named_[dimension]) visit(dimension, group);
    for (const ThicknessGroup& group : thicknesses_) visit(2, group);
  }
  /// Indices of the shell elements, segments or corners in a group, ascending.
  std::vector<int> members(int dimension, const NamedGroup& group) const;
  /// Numbers of the shell elements or segments of a group in the file, ascending; segments follow the shells.
  std::vector<int> element_numbers(int dimension, const NamedGroup& group) const;
  /// Names of groups, each once, that do not follow from the numbers of faces, edges and vertices, such as
  /// those of sets that were read. VTK's formats have one array for each name.
  std::vector<std::string> set_names() const;
  /// For each shell element, segment or corner, 1 if it is in a group of this name.
  std::vector<char> is_in_set(int dimension, const std::string& name) const;
  /// File numbers of the nodes of a group, ascending, each once.
  std::vector<int> node_numbers(int dimension, const NamedGroup& group) const;

 private:
  void number_nodes();
  void add_middles();
  void group_by_thickness();
  const ShellMesh::VaryingThickness* varying_on(int face) const;
  void name_groups(int dimension);

  const ShellMesh& mesh_;
  const GroupKinds groups_;
  std::vector<Vector3> middles_;  ///< (quads) the middle of each, if quads have nine nodes; else empty
  std::vector<int> numbers_;
  std::vector<int> nodes_;
  std::array<std::vector<CadGroup>, 3> entities_;
  std::array<std::vector<NamedGroup>, 3> named_;
  std::vector<ThicknessGroup> thicknesses_;
};

/// The name of the array for a set in VTK's formats: the name of the set, with `_` appended if it is one of
/// our own array names, and with `_` in place of characters that VTK does not escape in XML.
inline std::string array_of_set(std::string name) {
  for (char& c : name)
    if (c == '"' || c == '<' || c == '>' || c == '&' || static_cast<unsigned char>(c) < ' ') c = '_';
  for (const char* own : {"face", "edge", "vertex", "q", "thickness"})
    if (name == own) return name + '_';
  return name;
}

/// The mean thickness of a shell element; 0 if not known.
inline double mean_thickness(const OutputMesh& mesh, int shell) {
  const std::array<double, 4> corners = mesh.corner_thicknesses(shell);
  return 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
}

}  // namespace quadrille
