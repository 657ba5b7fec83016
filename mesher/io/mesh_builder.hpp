#pragma once
/// Collects the nodes and elements of a file, in any order and numbering, into a ShellMesh.

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "mesher/io/element_types.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// An element as it is in the file.
struct FileElement {
  std::int64_t number = 0;
  ElementShape shape = ElementShape::quad;
  int cad = 0;                          ///< CAD face, edge or vertex, if the file gives one; 0 = none
  int groups = 0;                       ///< the set of groups of the element, from MeshBuilder::joined()
  std::array<std::int64_t, 8> nodes{};  ///< file numbers: corners, then midside nodes
  int node_count = 0;
};

class MeshBuilder {
 public:
  /// \param name of the file, for error messages.
  explicit MeshBuilder(std::string name) : name_(std::move(name)) {}

  /// Throws Error (failure) when the number is not positive or already taken, or the position is not finite.
  void add_node(std::int64_t number, const Vector3& position);
  void add_element(const FileElement& element) { elements_.push_back(element); }

  /// Index of the group with this name (in which _ replaces control characters and bytes that are not UTF-8),
  /// number and dimension; adds the group if there is none. \param dimension dimension of its elements; -1 =
  /// any, for formats that do not specify it.
  int group(const std::string& given, int number, int dimension = -1);
  /// Index of the set of groups `groups` with one more group added. \param groups 0 = the empty set.
  int joined(int groups, int group);
  /// Puts an element or node into a group; false when none of this number has been added.
  bool put_element(std::int64_t element_number, int group);
  bool put_node(std::int64_t node_number, int group);
  /// Unites elements that have the same corners: some formats write an element once for each of its groups.
  void unite_repeated();

  /// Adds a sentence about something that a mesh cannot hold.
  void note(std::string sentence) { notes_.push_back(std::move(sentence)); }

  /// The mesh of all that was added. Nodes that no element uses and midside nodes of triangles are dropped;
  /// corner nodes come first. Elements with the same CAD number but different groups get numbers of their
  /// own. Throws Error (failure) when an element refers to a node that does not exist or uses one twice, when
  /// four-node and eight-node quads are mixed, or when there are neither quads nor triangles.
  /// \param notes receives the sentences of note(), and those on what finish() leaves out.
  ShellMesh finish(std::vector<std::string>* notes = nullptr);

 private:
  int index_of(std::int64_t number) const;
  /// Puts indices in place of the numbers of an element's nodes.
  void resolve(FileElement& element) const;
  void find_order();
  void renumber();
  void append(const FileElement& element);
  void number_entities();
  int number_in_name(int groups, int dimension) const;

  std::string name_;
  std::vector<Vector3> points_;
  std::vector<int> dense_;                           // file number -> index, -1 = none
  std::unordered_map<std::int64_t, int> scattered_;  // likewise, for numbers too large for dense_
  std::vector<FileElement> elements_;
  std::unordered_map<std::int64_t, std::size_t> element_places_;  // filled by the first put_element()
  struct Group {
    std::string name;
    int number, dimension;
  };
  std::vector<Group> groups_;
  std::map<std::tuple<std::string, int, int>, int> group_places_;
  std::vector<std::vector<int>> group_sets_{{}};  // sets of groups, each ascending; 0 = the empty set
  std::map<std::vector<int>, int> set_places_{{{}, 0}};
  std::vector<int> node_groups_;  // (nodes) indices into group_sets_; may be shorter
  std::vector<std::string> notes_;
  std::vector<int> new_index_;
  ShellMesh mesh_;
};

}  // namespace quadrille
