#pragma once
/// Collects the nodes and elements of a file, in whatever order and numbering, into a ShellMesh.

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
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
  int cad = 0;                          ///< CAD face, edge or vertex, as far as the file tells; 0 = none
  int groups = 0;                       ///< that it belongs to, as MeshBuilder::joined() gives it
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

  /// A group by its name and number, made where there is none of them. \param dimension of its elements; -1 =
  /// of any, for formats that do not tell.
  int group(const std::string& name, int number, int dimension = -1);
  /// What belongs to `groups`, and to one more. \param groups 0 = none yet.
  int joined(int groups, int group);
  /// Puts what has been added into a group; false when there is no element, or node, of this number.
  bool put_element(std::int64_t element_number, int group);
  bool put_node(std::int64_t node_number, int group);
  /// Makes one of elements that have the same corners: some formats write an element once for each group.
  void unite_repeated();

  /// A sentence on something that a mesh has no place for.
  void note(std::string sentence) { notes_.push_back(std::move(sentence)); }

  /// The mesh of all that was added: nodes that no element uses are dropped, corner nodes come first, midside
  /// nodes of triangles are dropped. Elements of one CAD number that belong to different groups get numbers
  /// of their own. Throws Error (failure) when an element refers to a node that does not exist or uses one
  /// twice, when four-node and eight-node quads are mixed, or when there is neither quad nor triangle.
  /// \param notes takes the sentences of note(), and those on what finish() leaves out.
  ShellMesh finish(std::vector<std::string>* notes = nullptr);

 private:
  int index_of(std::int64_t number) const;
  int resolve(const FileElement& element, int place) const;
  void check(const FileElement& element) const;
  void find_order();
  void renumber();
  void append(const FileElement& element);
  void number_entities();
  int number_in_name(int groups, std::string_view kind) const;
  int kept(const FileElement& element, int place) const { return new_index_[resolve(element, place)]; }

  std::string name_;
  std::vector<Vector3> points_;
  std::vector<int> dense_;                           // file number -> index, -1 = none
  std::unordered_map<std::int64_t, int> scattered_;  // the numbers too large for dense_
  std::vector<FileElement> elements_;
  std::unordered_map<std::int64_t, std::size_t> element_places_;  // filled by the first put_element()
  struct Group {
    std::string name;
    int number, dimension;
  };
  std::vector<Group> groups_;
  std::map<std::tuple<std::string, int, int>, int> group_places_;
  std::vector<std::vector<int>> group_sets_{{}};  // groups that something belongs to, ascending
  std::map<std::vector<int>, int> set_places_{{{}, 0}};
  std::vector<int> node_groups_;  // by node, place in group_sets_; may be shorter
  std::vector<std::string> notes_;
  std::vector<int> new_index_;
  ShellMesh mesh_;
};

}  // namespace quadrille
