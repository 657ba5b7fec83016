#pragma once
/// What every writer needs of a mesh: dense node numbers and the groups by CAD entity.

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "mesher/mesh/mesh_types.hpp"
#include "mesher/options.hpp"

namespace quadrille {

/// The nodes of one element, as OutputMesh::position() takes them: corners, midside nodes, the middle.
struct ElementNodes {
  std::array<int, 9> nodes{};
  int count = 0;
  const int* begin() const { return nodes.data(); }
  const int* end() const { return nodes.data() + count; }
};

/// The elements, segments or corners that belong to one CAD entity, or to a part of the file that the mesh
/// was read from.
struct CadGroup {
  int number = 0;            ///< CAD number; 0 = elements that belong to none
  std::vector<int> members;  ///< ascending indices of shell elements, segments or corners
};

/// What goes by one name in a file: the elements, segments or corners of one CAD entity or, in meshes that
/// were read, what their file named.
struct NamedGroup {
  std::string name;
  bool has_name = true;       ///< else the name is made of the number: PhysicalSurface7
  int number = 0;             ///< in the file that it was read from; 0 = none
  std::vector<int> entities;  ///< CAD numbers, ascending
  bool of_solid = false;      ///< what of the middle surface belongs to one face of the solid
};

/// The faces that are shells of one thickness, or of one range of thicknesses, to the digits that the
/// name tells.
struct ThicknessGroup {
  std::string name;          ///< "Thickness2.5", "Thickness2to4"
  std::string thickness;     ///< "2.5"; the mean where it varies
  bool varies = false;       ///< over each of the faces
  std::vector<int> faces;    ///< CAD faces with elements, ascending
  std::vector<int> members;  ///< indices of their shell elements
};

/// A mesh as it goes to a file. Shell elements are counted through: first the quads, then the triangles.
/// Keeps a reference to the mesh.
class OutputMesh {
 public:
  /// \param groups the kinds of which there are groups: of others there are none, nor segments and corners.
  /// \param quad_nodes of second-order quads: 8 or 9. The ninth lies where the eight-node element has its
  /// middle, so that the element's shape stays what it was, its validity too.
  /// Throws Error (failure) when an element has a node out of range or a node has no finite position.
  explicit OutputMesh(const ShellMesh& mesh, const GroupKinds& groups = {}, int quad_nodes = 8);

  /// Nodes that are used, in file order: node i of the file is nodes()[i - 1].
  const std::vector<int>& nodes() const { return nodes_; }
  /// Number of a node in the file, from 1.
  int number(int node) const { return numbers_[node]; }
  /// Nodes below the mesh's own count are its points, those from there on the middles of quads.
  const Vector3& position(int node) const {
    const int own = static_cast<int>(mesh_.points.size());
    return node < own ? mesh_.points[node] : middles_[node - own];
  }
  const Vector3& point(int file_index) const { return position(nodes_[file_index]); }

  int order() const { return mesh_.order; }
  int quad_count() const { return static_cast<int>(mesh_.quads.size()); }
  int shell_count() const { return quad_count() + static_cast<int>(mesh_.triangles.size()); }
  int segment_count() const { return groups_.edges ? static_cast<int>(mesh_.segments.size()) : 0; }
  int corner_count() const { return groups_.vertices ? static_cast<int>(mesh_.corners.size()) : 0; }
  bool is_quad(int shell) const { return shell < quad_count(); }
  /// CAD face of a shell element, edge of a segment, vertex of a corner; 0 = none.
  int face(int shell) const;
  int edge(int segment) const { return mesh_.segments[segment].edge; }
  int vertex(int corner) const { return mesh_.corners[corner].vertex; }
  /// How many faces the CAD model has, or, where that is not known, the largest number of a face with
  /// elements.
  int cad_face_count() const;
  int corner_node(int corner) const { return mesh_.corners[corner].node; }
  ElementNodes shell_nodes(int shell) const;
  /// End nodes, then the midside node at second order.
  ElementNodes segment_nodes(int segment) const;

  const std::vector<CadGroup>& faces() const { return faces_; }        ///< shell elements by CAD face
  const std::vector<CadGroup>& edges() const { return edges_; }        ///< segments by CAD edge
  const std::vector<CadGroup>& vertices() const { return vertices_; }  ///< corners by CAD vertex
  /// By thickness, in the order of their first faces; empty where no thickness is known.
  const std::vector<ThicknessGroup>& thicknesses() const { return thicknesses_; }

  /// Of the shell on a CAD face, the mean where it varies; 0 where not known.
  double face_thickness(int face) const;
  /// At the corners of a shell element; 0 where not known.
  std::array<double, 4> corner_thicknesses(int shell) const;
  /// File numbers of the nodes of faces whose thickness varies, ascending, and the thickness there: the mean
  /// of such faces that share the node.
  std::vector<std::pair<int, double>> node_thicknesses() const;

  /// What has a name: shell elements (dimension 2), segments (1), corners (0).
  const std::vector<NamedGroup>& groups(int dimension) const { return named_[dimension]; }
  /// Whether the groups are those of a file that the mesh was read from.
  bool groups_were_read() const { return !mesh_.groups.empty(); }
  /// Indices of shell elements, segments or corners, ascending.
  std::vector<int> members(int dimension, const NamedGroup& group) const;
  /// Names that the files' own numbers of faces, edges and vertices do not tell, such as those of sets that
  /// were read; each once. VTK's formats have an array for each.
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
  const std::vector<CadGroup>& entities(int dimension) const {
    return dimension == 2 ? faces_ : dimension == 1 ? edges_ : vertices_;
  }
  void use(int node, const char* what, std::size_t index);

  const ShellMesh& mesh_;
  const GroupKinds groups_;
  std::vector<Vector3> middles_;  ///< of the quads, where they have nine nodes
  std::vector<int> numbers_;
  std::vector<int> nodes_;
  std::vector<CadGroup> faces_, edges_, vertices_;
  std::array<std::vector<NamedGroup>, 3> named_;
  std::vector<ThicknessGroup> thicknesses_;
};

/// What an array of VTK's formats for a set is called: its name, with `_` behind where an array of ours has
/// it, and for what VTK writes into XML as it is.
inline std::string array_of_set(std::string name) {
  for (char& c : name)
    if (c == '"' || c == '<' || c == '>' || c == '&' || static_cast<unsigned char>(c) < ' ') c = '_';
  for (const char* own : {"face", "edge", "vertex", "q", "thickness"})
    if (name == own) return name + '_';
  return name;
}

/// Over a shell element; 0 where not known.
inline double mean_thickness(const OutputMesh& mesh, int shell) {
  const std::array<double, 4> corners = mesh.corner_thicknesses(shell);
  return 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
}

}  // namespace quadrille
