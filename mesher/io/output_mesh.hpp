#pragma once
/// What every writer needs of a mesh: dense node numbers and the groups by CAD entity.

#include <array>
#include <string>
#include <vector>

#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// The nodes of one element as indices into ShellMesh::points: corners, then midside nodes.
struct ElementNodes {
  std::array<int, 8> nodes{};
  int count = 0;
  const int* begin() const { return nodes.data(); }
  const int* end() const { return nodes.data() + count; }
};

/// The elements, segments or corners that belong to one CAD entity.
struct CadGroup {
  int number = 0;            ///< CAD number; 0 = elements that belong to none
  std::vector<int> members;  ///< ascending indices of shell elements, segments or corners
};

/// The faces that are shells of one thickness, to the six digits that the name tells.
struct ThicknessGroup {
  std::string name;          ///< "Thickness2.5"
  std::string thickness;     ///< "2.5"
  std::vector<int> faces;    ///< CAD faces with elements, ascending
  std::vector<int> members;  ///< indices of their shell elements
};

/// A mesh as it goes to a file. Shell elements are counted through: first the quads, then the triangles.
/// Keeps a reference to the mesh.
class OutputMesh {
 public:
  /// Throws Error (failure) when an element has a node out of range or a node has no finite position.
  explicit OutputMesh(const ShellMesh& mesh);

  const ShellMesh& mesh() const { return mesh_; }
  /// Indices of the nodes that are used, in file order: node i of the file is points[nodes()[i - 1]].
  const std::vector<int>& nodes() const { return nodes_; }
  /// Number of a node in the file, from 1.
  int number(int node) const { return numbers_[node]; }
  const Vector3& point(int file_index) const { return mesh_.points[nodes_[file_index]]; }

  int quad_count() const { return static_cast<int>(mesh_.quads.size()); }
  int shell_count() const { return quad_count() + static_cast<int>(mesh_.triangles.size()); }
  bool is_quad(int shell) const { return shell < quad_count(); }
  /// CAD face of a shell element, 0 = none.
  int face(int shell) const;
  ElementNodes shell_nodes(int shell) const;
  /// End nodes, then the midside node at second order.
  ElementNodes segment_nodes(int segment) const;

  const std::vector<CadGroup>& faces() const { return faces_; }        ///< shell elements by CAD face
  const std::vector<CadGroup>& edges() const { return edges_; }        ///< segments by CAD edge
  const std::vector<CadGroup>& vertices() const { return vertices_; }  ///< corners by CAD vertex
  /// By thickness, in the order of their first faces; empty where no thickness is known.
  const std::vector<ThicknessGroup>& thicknesses() const { return thicknesses_; }

  /// File numbers of the nodes of a group of shell elements / segments, ascending, each once.
  std::vector<int> shell_node_numbers(const CadGroup& group) const;
  std::vector<int> segment_node_numbers(const CadGroup& group) const;

 private:
  void number_nodes();
  void group_by_thickness();
  void use(int node, const char* what, std::size_t index);

  const ShellMesh& mesh_;
  std::vector<int> numbers_;
  std::vector<int> nodes_;
  std::vector<CadGroup> faces_, edges_, vertices_;
  std::vector<ThicknessGroup> thicknesses_;
};

}  // namespace quadrille
