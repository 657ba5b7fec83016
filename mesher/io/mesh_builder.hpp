#pragma once
/// Collects the nodes and elements of a file, in whatever order and numbering, into a ShellMesh.

#include <array>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// Shapes of elements that a shell mesh can hold.
enum class ElementShape { point, line, triangle, quad };

/// An element as it stands in a file.
struct FileElement {
  std::int64_t number = 0;
  ElementShape shape = ElementShape::quad;
  int cad = 0;                          ///< CAD face, edge or vertex; 0 = none
  std::array<std::int64_t, 8> nodes{};  ///< file numbers: corners, then midside nodes
  int node_count = 0;
};

class MeshBuilder {
 public:
  /// \param name of the file, for error messages.
  explicit MeshBuilder(std::string name) : name_(std::move(name)) {}

  /// Throws Error (failure) when the number is not positive or taken, or the position is not finite.
  void add_node(std::int64_t number, const Vector3& position);
  void add_element(const FileElement& element) { elements_.push_back(element); }
  /// Changes the CAD face of an element that has been added; false when there is no element of this number.
  bool set_cad(std::int64_t element_number, int cad);

  /// The mesh of all that was added: nodes that no element uses are dropped, corner nodes come first, midside
  /// nodes of triangles are dropped. Throws Error (failure) when an element refers to a node that does not
  /// exist or uses one twice, when four-node and eight-node quads are mixed, or when there is neither quad
  /// nor triangle.
  ShellMesh finish();

 private:
  int index_of(std::int64_t number) const;
  int resolve(const FileElement& element, int place) const;
  void check(const FileElement& element) const;
  void find_order();
  void renumber();
  void append(const FileElement& element);
  int kept(const FileElement& element, int place) const { return new_index_[resolve(element, place)]; }

  std::string name_;
  std::vector<Vector3> points_;
  std::vector<int> dense_;                           // file number -> index, -1 = none
  std::unordered_map<std::int64_t, int> scattered_;  // the numbers too large for dense_
  std::vector<FileElement> elements_;
  std::unordered_map<std::int64_t, std::size_t> element_places_;  // filled by the first set_cad()
  std::vector<int> new_index_;
  ShellMesh mesh_;
};

}  // namespace quadrille
