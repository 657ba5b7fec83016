/// Gmsh .msh, versions 1, 2.2 and 4.1. Based on: the Gmsh reference manual, "MSH file format".

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <utility>

#include "mesher/io/mesh_builder.hpp"
#include "mesher/io/readers.hpp"
#include "mesher/io/text_cursor.hpp"

namespace quadrille {

namespace {

struct ElementType {
  int type;
  ElementShape shape;
  int file_nodes;  // nodes in the file
  int kept_nodes;  // nodes kept: not the middle of nine-node quads
};

constexpr ElementType element_types[] = {
    {1, ElementShape::line, 2, 2},   {2, ElementShape::triangle, 3, 3}, {3, ElementShape::quad, 4, 4},
    {8, ElementShape::line, 3, 3},   {9, ElementShape::triangle, 6, 6}, {10, ElementShape::quad, 9, 8},
    {15, ElementShape::point, 1, 1}, {16, ElementShape::quad, 8, 8},
};

bool is_volume(std::int64_t type) {
  return (type >= 4 && type <= 7) || (type >= 11 && type <= 14) || (type >= 17 && type <= 19);
}

class MshReader {
 public:
  MshReader(std::string_view bytes, const std::string& name) : cursor_(bytes, name), builder_(name) {}

  ShellMesh read(std::vector<std::string>* notes) {
    read_format();
    while (!cursor_.at_end()) read_section();
    if (!has_nodes_) throw cursor_.truncated("$Nodes");
    if (!has_elements_) throw cursor_.truncated("$Elements");
    if (repeated_) builder_.unite_repeated();
    return builder_.finish(notes);
  }

 private:
  void read_format() {
    const std::string_view heading = cursor_.word();
    if (heading == "$NOD") return read_nodes1();
    if (heading != "$MeshFormat")
      throw failure(
          cursor_.name(),
          fmt::format("{}: is not a Gmsh .msh file: it does not begin with $MeshFormat", cursor_.name()));
    const double version = cursor_.real("the format's version");
    if (version != 2.2 && version != 4.1)
      throw cursor_.error(
          fmt::format("version {} of the .msh format is not read: save the mesh as 2.2 or 4.1", version));
    new_ = version == 4.1;
    const std::int64_t mode = cursor_.integer("0 (ASCII) or 1 (binary)");
    if (mode != 0 && mode != 1)
      throw cursor_.error(fmt::format("file type {} is neither 0 (ASCII) nor 1 (binary)", mode));
    binary_ = mode == 1;
    if (cursor_.integer("the size of numbers") != 8)
      throw cursor_.error("only files with 8-byte numbers are read");
    cursor_.line();
    if (binary_ && cursor_.binary<std::int32_t>("the mark of byte order") != 1)
      throw cursor_.error("the file was written with another byte order");
    expect_end("$EndMeshFormat");
  }

  void read_section() {
    const std::string_view heading = cursor_.word();
    if (heading.empty()) return;
    if (heading == "$ELM" && old_) {
      begin_once(has_elements_, "$ELM");
      read_elements1();
      expect_end("$ENDELM");
    } else if (heading == "$Nodes") {
      begin_once(has_nodes_, "$Nodes");
      new_ ? read_nodes4() : read_nodes2();
      expect_end("$EndNodes");
    } else if (heading == "$Elements") {
      begin_once(has_elements_, "$Elements");
      new_ ? read_elements4() : read_elements2();
      expect_end("$EndElements");
    } else if (heading == "$PhysicalNames") {
      read_names();
      expect_end("$EndPhysicalNames");
    } else if (heading == "$Entities" && new_) {
      cursor_.line();
      read_entities4();
      expect_end("$EndEntities");
    } else if (heading.front() == '$' && heading.size() < 80) {
      const std::string end = "$End" + std::string(heading.substr(1));
      if (!cursor_.skip_past(end)) throw cursor_.truncated(end.c_str());
    } else {
      throw cursor_.error("expected the beginning of a section, such as $Nodes");
    }
  }

  void begin_once(bool& flag, const char* section) {
    if (flag) throw cursor_.error(fmt::format("a second {} section", section));
    flag = true;
    cursor_.line();
  }

  void expect_end(const char* marker) {
    const std::string_view found = cursor_.word();
    if (found.empty()) throw cursor_.truncated(marker);
    if (found != marker) throw cursor_.error(fmt::format("expected {}", marker));
  }

  /// A count or tag: text in ASCII, `Binary` in binary files.
  template <class Binary>
  std::int64_t integer(const char* what) {
    if (!binary_) return cursor_.integer(what);
    const Binary value = cursor_.binary<Binary>(what);
    if (value > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
      throw cursor_.error(fmt::format("{} is out of range", what));
    return static_cast<std::int64_t>(value);
  }
  std::int64_t small(const char* what) {
    return binary_ ? cursor_.binary<std::int32_t>(what) : cursor_.integer(what);
  }
  std::int64_t large(const char* what) { return integer<std::uint64_t>(what); }
  double real(const char* what) { return binary_ ? cursor_.binary<double>(what) : cursor_.real(what); }

  /// No item takes less than a byte: a larger count can only be wrong, and must not cost memory or time.
  std::int64_t count_of(std::int64_t count, const char* what) const {
    if (count < 0 || count > static_cast<std::int64_t>(cursor_.remaining()))
      throw cursor_.error(fmt::format("{} ({}) does not fit the file's length", what, count));
    return count;
  }

  /// Lines such as: 2 7 "the top".
  void read_names() {
    const std::int64_t count = count_of(cursor_.integer("the number of names"), "the number of names");
    cursor_.line();
    for (std::int64_t i = 0; i < count; ++i) {
      const std::int64_t dimension = cursor_.integer("a group's dimension");
      const int number = cad_number(cursor_.integer("a group's number"));
      const std::string_view rest = cursor_.line();
      const std::size_t begin = rest.find('"'), end = rest.rfind('"');
      if (begin == end) throw cursor_.error_before("expected a name in quotes");
      names_[{dimension, number}] = rest.substr(begin + 1, end - begin - 1);
    }
  }

  /// The group of a physical number; -1 = none. \param tag negative where Gmsh reverses the elements.
  int group_of(int dimension, std::int64_t tag) {
    const int number = cad_number(tag < 0 ? -tag : tag);
    if (number == 0) return -1;
    const auto found = names_.find({dimension, number});
    return builder_.group(found == names_.end() ? "" : found->second, number, dimension);
  }

  void read_entities4() {
    std::int64_t counts[4];
    for (std::int64_t& count : counts)
      count = count_of(large("the number of entities"), "the number of entities");
    for (int dimension = 0; dimension < 4; ++dimension)
      for (std::int64_t i = 0; i < counts[dimension]; ++i) {
        const std::int64_t tag = small("an entity's number");
        for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) real("an entity's bounds");
        int& groups = entity_groups_[{dimension, tag}];
        for (std::int64_t k = large("an entity's number of groups"); k > 0; --k) {
          const int group = group_of(dimension, small("an entity's group"));
          if (group >= 0) groups = builder_.joined(groups, group);
        }
        if (dimension == 0) continue;
        for (std::int64_t k = large("an entity's number of bounds"); k > 0; --k) small("an entity's bound");
      }
  }

  Vector3 position() {
    const double x = real("a node's x"), y = real("a node's y"), z = real("a node's z");
    return {x, y, z};
  }

  void read_nodes2() {
    const std::int64_t count = count_of(cursor_.integer("the number of nodes"), "the number of nodes");
    cursor_.line();
    for (std::int64_t i = 0; i < count; ++i) {
      const std::int64_t number = small("a node's number");
      builder_.add_node(number, position());
    }
  }

  void read_nodes4() {
    const std::int64_t blocks = large("the number of node blocks");
    for (int i = 0; i < 3; ++i) large("the node counts");
    for (std::int64_t block = 0; block < blocks; ++block) {
      const std::int64_t dimension = small("a block's dimension");
      small("a block's entity");
      const bool parametric = small("a block's parametric flag") != 0;
      const std::int64_t count = count_of(large("a block's number of nodes"), "a block's number of nodes");
      std::vector<std::int64_t> numbers(static_cast<std::size_t>(count));
      for (std::int64_t& number : numbers) number = large("a node's number");
      for (const std::int64_t number : numbers) {
        builder_.add_node(number, position());
        for (std::int64_t i = 0; parametric && i < std::min<std::int64_t>(dimension, 3); ++i)
          real("a node's parameter");
      }
    }
  }

  /// Version 1 has no header: it begins with its nodes.
  void read_nodes1() {
    old_ = true;
    begin_once(has_nodes_, "$NOD");
    read_nodes2();
    expect_end("$ENDNOD");
  }

  /// Lines such as: number, type, physical group, elementary entity, number of nodes, nodes.
  void read_elements1() {
    const std::int64_t count = count_of(cursor_.integer("the number of elements"), "the number of elements");
    for (std::int64_t i = 0; i < count; ++i) {
      const std::int64_t number = cursor_.integer("an element's number");
      const std::int64_t type = cursor_.integer("an element's type");
      const std::int64_t physical = cursor_.integer("an element's group");
      const std::int64_t entity = cursor_.integer("an element's entity");
      const ElementType& known = type_of(type, number);
      if (cursor_.integer("an element's number of nodes") != known.file_nodes)
        throw cursor_.error(fmt::format("element {} has a wrong number of nodes", number));
      add_element(known, number, physical, cad_number(entity));
    }
  }

  const ElementType& type_of(std::int64_t type, std::int64_t element) const {
    for (const ElementType& known : element_types)
      if (known.type == type) return known;
    if (is_volume(type))
      throw cursor_.error(
          fmt::format("element {} is a volume (type {}): only surface meshes are read", element, type));
    throw cursor_.error(fmt::format("element {} has type {}, which is not read", element, type));
  }

  int cad_number(std::int64_t tag) const {
    return tag > 0 && tag <= std::numeric_limits<int>::max() ? static_cast<int>(tag) : 0;
  }

  template <class ReadNode>
  void read_element_nodes(const ElementType& type, FileElement& element, ReadNode read_node) {
    element.shape = type.shape;
    element.node_count = type.kept_nodes;
    for (int i = 0; i < type.file_nodes; ++i) {
      const std::int64_t node = read_node();
      if (i < type.kept_nodes) element.nodes[i] = node;
    }
    builder_.add_element(element);
  }

  void read_element2(std::int64_t number, std::int64_t type, std::int64_t tags) {
    const ElementType& known = type_of(type, number);
    std::int64_t physical = 0;
    int entity = 0;
    for (std::int64_t i = 0; i < count_of(tags, "an element's number of tags"); ++i) {
      const std::int64_t tag = small("an element's tag");
      if (i == 0) physical = tag;
      if (i == 1) entity = cad_number(tag);
    }
    add_element(known, number, physical, entity);
  }

  /// Adds an element of version 1 or 2.2, whose nodes follow.
  void add_element(const ElementType& known, std::int64_t number, std::int64_t physical, int entity) {
    FileElement element;
    element.number = number;
    element.cad = entity;
    const int dimension = std::min(static_cast<int>(known.shape), 2);
    // Consecutive elements often have the same tags.
    if (const std::array<std::int64_t, 3> tagged{dimension, element.cad, physical}; tagged != last_tags_) {
      last_tags_ = tagged;
      const int group = group_of(dimension, physical);
      last_groups_ = group < 0 ? 0 : builder_.joined(0, group);
      const auto [found, is_new] = physical_of_.try_emplace({dimension, element.cad}, physical);
      repeated_ |= !is_new && found->second != physical;
    }
    element.groups = last_groups_;
    read_element_nodes(known, element, [this] { return small("an element's node"); });
  }

  void read_elements2() {
    const std::int64_t count = count_of(cursor_.integer("the number of elements"), "the number of elements");
    cursor_.line();
    std::int64_t done = 0;
    while (done < count) {
      if (!binary_) {
        const std::int64_t number = cursor_.integer("an element's number");
        const std::int64_t type = cursor_.integer("an element's type");
        read_element2(number, type, cursor_.integer("an element's number of tags"));
        ++done;
        continue;
      }
      const std::int64_t type = small("a block's element type");
      const std::int64_t in_block = small("a block's number of elements");
      const std::int64_t tags = small("a block's number of tags");
      if (in_block < 1 || in_block > count - done)
        throw cursor_.error("a block of elements has a wrong count");
      for (std::int64_t i = 0; i < in_block; ++i) read_element2(small("an element's number"), type, tags);
      done += in_block;
    }
  }

  void read_elements4() {
    const std::int64_t blocks = large("the number of element blocks");
    for (int i = 0; i < 3; ++i) large("the element counts");
    for (std::int64_t block = 0; block < blocks; ++block) {
      const std::int64_t dimension = small("a block's dimension"), entity = small("a block's entity");
      FileElement element;
      element.cad = cad_number(entity);
      if (const auto found = entity_groups_.find({dimension, entity}); found != entity_groups_.end())
        element.groups = found->second;
      const std::int64_t type = small("a block's element type");
      const std::int64_t count =
          count_of(large("a block's number of elements"), "a block's number of elements");
      for (std::int64_t i = 0; i < count; ++i) {
        element.number = large("an element's number");
        read_element_nodes(type_of(type, element.number), element,
                           [this] { return large("an element's node"); });
      }
    }
  }

  TextCursor cursor_;
  MeshBuilder builder_;
  bool old_ = false;  // version 1
  bool new_ = false;  // version 4.1
  bool binary_ = false;
  bool has_nodes_ = false, has_elements_ = false;
  using DimensionAndTag = std::pair<std::int64_t, std::int64_t>;
  std::map<DimensionAndTag, std::string> names_;         // names of physical groups
  std::map<DimensionAndTag, int> entity_groups_;         // 4.1: set of groups of each entity
  std::map<DimensionAndTag, std::int64_t> physical_of_;  // 2.2: first physical number of each entity
  std::array<std::int64_t, 3> last_tags_{-1, -1, -1};
  int last_groups_ = 0;
  bool repeated_ = false;  // 2.2: an entity is in several groups
};

}  // namespace

ShellMesh read_msh(std::string_view bytes, const std::string& name, std::vector<std::string>* notes) {
  return MshReader(bytes, name).read(notes);
}

}  // namespace quadrille
