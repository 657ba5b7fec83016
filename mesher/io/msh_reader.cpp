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

bool is_volume(std::int64_t type) {
  return (type >= 4 && type <= 7) || (type >= 11 && type <= 14) || (type >= 17 && type <= 19);
}

const ElementType& type_of(const TextCursor& cursor, std::int64_t type, std::int64_t element) {
  if (const ElementType* known = find_element_type(&ElementType::msh, type)) return *known;
  if (is_volume(type))
    throw cursor.error(
        fmt::format("element {} is a volume (type {}): only surface meshes are read", element, type));
  throw cursor.error(fmt::format("element {} has type {}, which is not read", element, type));
}

int cad_number(std::int64_t tag) {
  return tag > 0 && tag <= std::numeric_limits<int>::max() ? static_cast<int>(tag) : 0;
}

/// Steps through the numbers of a file, which are text or binary.
class MshCursor : public TextCursor {
 public:
  using TextCursor::TextCursor;

  bool is_binary = false;

  /// A count or tag, which has 4 or 8 bytes in binary files.
  std::int64_t small(const char* what) { return is_binary ? binary<std::int32_t>(what) : integer(what); }
  std::int64_t large(const char* what) {
    if (!is_binary) return integer(what);
    const auto value = binary<std::uint64_t>(what);
    if (value > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
      throw error(fmt::format("{} is out of range", what));
    return static_cast<std::int64_t>(value);
  }
  double real(const char* what) { return is_binary ? binary<double>(what) : TextCursor::real(what); }

  /// No item takes less than a byte: a larger count can only be wrong, and must not cost memory or time.
  std::int64_t count_of(std::int64_t count, const char* what) const {
    if (count < 0 || count > static_cast<std::int64_t>(remaining()))
      throw error(fmt::format("{} ({}) does not fit the file's length", what, count));
    return count;
  }
  /// A count in a line of text, also of binary files.
  std::int64_t count(const char* what) { return count_of(integer(what), what); }
  std::int64_t large_count(const char* what) { return count_of(large(what), what); }

  void expect_end(const char* marker) {
    const std::string_view found = word();
    if (found.empty()) throw truncated(marker);
    if (found != marker) throw error(fmt::format("expected {}", marker));
  }
};

using DimensionAndTag = std::pair<std::int64_t, std::int64_t>;

/// The physical groups, and which of them the elements of versions 1 and 2.2 belong to.
class PhysicalGroups {
 public:
  explicit PhysicalGroups(MeshBuilder& builder) : builder_(builder) {}

  void set_name(std::int64_t dimension, int number, std::string_view name) {
    names_[{dimension, number}] = name;
  }

  /// The group of a physical number; -1 = none. \param tag negative where Gmsh reverses the elements.
  int group_of(int dimension, std::int64_t tag) {
    const int number = cad_number(tag < 0 ? -tag : tag);
    if (number == 0) return -1;
    const auto found = names_.find({dimension, number});
    return builder_.group(found == names_.end() ? "" : found->second, number, dimension);
  }

  /// The set of groups of an element with these tags.
  int set_of(int dimension, int cad, std::int64_t physical) {
    // Consecutive elements often have the same tags.
    if (const std::array<std::int64_t, 3> tagged{dimension, cad, physical}; tagged != last_tags_) {
      last_tags_ = tagged;
      const int group = group_of(dimension, physical);
      last_groups_ = group < 0 ? 0 : builder_.joined(0, group);
      const auto [found, is_new] = physical_of_.try_emplace({dimension, cad}, physical);
      repeated_ |= !is_new && found->second != physical;
    }
    return last_groups_;
  }

  /// Whether an entity is in several groups.
  bool repeated() const { return repeated_; }

 private:
  MeshBuilder& builder_;
  std::map<DimensionAndTag, std::string> names_;
  std::map<DimensionAndTag, std::int64_t> physical_of_;  // first physical number of each entity
  std::array<std::int64_t, 3> last_tags_{-1, -1, -1};
  int last_groups_ = 0;
  bool repeated_ = false;
};

class MshReader {
 public:
  MshReader(std::string_view bytes, const std::string& name) : cursor_(bytes, name), builder_(name) {}

  ShellMesh read(std::vector<std::string>* notes) {
    read_format();
    while (!cursor_.at_end()) read_section();
    if (!has_nodes_) throw cursor_.truncated("$Nodes");
    if (!has_elements_) throw cursor_.truncated("$Elements");
    if (groups_.repeated()) builder_.unite_repeated();
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
    cursor_.is_binary = mode == 1;
    if (cursor_.integer("the size of numbers") != 8)
      throw cursor_.error("only files with 8-byte numbers are read");
    cursor_.line();
    if (cursor_.is_binary && cursor_.binary<std::int32_t>("the mark of byte order") != 1)
      throw cursor_.error("the file was written with another byte order");
    cursor_.expect_end("$EndMeshFormat");
  }

  void read_section() {
    const std::string_view heading = cursor_.word();
    if (heading.empty()) return;
    const std::string end = heading == "$ELM" && old_ ? "$ENDELM" : "$End" + std::string(heading.substr(1));
    if (heading == "$ELM" && old_) {
      begin_once(has_elements_, "$ELM");
      read_elements1();
    } else if (heading == "$Nodes") {
      begin_once(has_nodes_, "$Nodes");
      new_ ? read_nodes4() : read_nodes2();
    } else if (heading == "$Elements") {
      begin_once(has_elements_, "$Elements");
      new_ ? read_elements4() : read_elements2();
    } else if (heading == "$PhysicalNames") {
      read_names();
    } else if (heading == "$Entities" && new_) {
      cursor_.line();
      read_entities4();
    } else if (heading.front() == '$' && heading.size() < 80) {
      if (!cursor_.skip_past(end)) throw cursor_.truncated(end.c_str());
      return;
    } else {
      throw cursor_.error("expected the beginning of a section, such as $Nodes");
    }
    cursor_.expect_end(end.c_str());
  }

  void begin_once(bool& flag, const char* section) {
    if (flag) throw cursor_.error(fmt::format("a second {} section", section));
    flag = true;
    cursor_.line();
  }

  /// Lines such as: 2 7 "the top".
  void read_names() {
    const std::int64_t count = cursor_.count("the number of names");
    cursor_.line();
    for (std::int64_t i = 0; i < count; ++i) {
      const std::int64_t dimension = cursor_.integer("a group's dimension");
      const int number = cad_number(cursor_.integer("a group's number"));
      const std::string_view rest = cursor_.line();
      const std::size_t begin = rest.find('"'), end = rest.rfind('"');
      if (begin == end) throw cursor_.error_before("expected a name in quotes");
      groups_.set_name(dimension, number, rest.substr(begin + 1, end - begin - 1));
    }
  }

  void read_entities4() {
    std::int64_t counts[4];
    for (std::int64_t& count : counts) count = cursor_.large_count("the number of entities");
    for (int dimension = 0; dimension < 4; ++dimension)
      for (std::int64_t i = 0; i < counts[dimension]; ++i) {
        const std::int64_t tag = cursor_.small("an entity's number");
        for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) cursor_.real("an entity's bounds");
        int& groups = entity_groups_[{dimension, tag}];
        for (std::int64_t k = cursor_.large("an entity's number of groups"); k > 0; --k) {
          const int group = groups_.group_of(dimension, cursor_.small("an entity's group"));
          if (group >= 0) groups = builder_.joined(groups, group);
        }
        if (dimension == 0) continue;
        for (std::int64_t k = cursor_.large("an entity's number of bounds"); k > 0; --k)
          cursor_.small("an entity's bound");
      }
  }

  Vector3 position() {
    return Vector3{cursor_.real("a node's x"), cursor_.real("a node's y"), cursor_.real("a node's z")};
  }

  void read_nodes2() {
    const std::int64_t count = cursor_.count("the number of nodes");
    cursor_.line();
    for (std::int64_t i = 0; i < count; ++i) {
      const std::int64_t number = cursor_.small("a node's number");
      builder_.add_node(number, position());
    }
  }

  void read_nodes4() {
    const std::int64_t blocks = cursor_.large("the number of node blocks");
    for (int i = 0; i < 3; ++i) cursor_.large("the node counts");
    for (std::int64_t block = 0; block < blocks; ++block) {
      const std::int64_t dimension = cursor_.small("a block's dimension");
      cursor_.small("a block's entity");
      const bool parametric = cursor_.small("a block's parametric flag") != 0;
      const std::int64_t count = cursor_.large_count("a block's number of nodes");
      std::vector<std::int64_t> numbers(static_cast<std::size_t>(count));
      for (std::int64_t& number : numbers) number = cursor_.large("a node's number");
      for (const std::int64_t number : numbers) {
        builder_.add_node(number, position());
        for (std::int64_t i = 0; parametric && i < std::min<std::int64_t>(dimension, 3); ++i)
          cursor_.real("a node's parameter");
      }
    }
  }

  /// Version 1 has no header: it begins with its nodes.
  void read_nodes1() {
    old_ = true;
    begin_once(has_nodes_, "$NOD");
    read_nodes2();
    cursor_.expect_end("$ENDNOD");
  }

  /// Lines such as: number, type, physical group, elementary entity, number of nodes, nodes.
  void read_elements1() {
    const std::int64_t count = cursor_.count("the number of elements");
    for (std::int64_t i = 0; i < count; ++i) {
      const std::int64_t number = cursor_.integer("an element's number");
      const std::int64_t type = cursor_.integer("an element's type");
      const std::int64_t physical = cursor_.integer("an element's group");
      const std::int64_t entity = cursor_.integer("an element's entity");
      const ElementType& known = type_of(cursor_, type, number);
      if (cursor_.integer("an element's number of nodes") != known.nodes)
        throw cursor_.error(fmt::format("element {} has a wrong number of nodes", number));
      add_element(known, number, physical, cad_number(entity));
    }
  }

  /// Adds an element, whose nodes follow.
  void read_element_nodes(const ElementType& type, FileElement& element) {
    constexpr const char* what = "an element's node";
    element.shape = type.shape;
    element.node_count = type.kept_nodes();
    for (int i = 0; i < type.nodes; ++i) {
      const std::int64_t node = new_ ? cursor_.large(what) : cursor_.small(what);
      if (i < element.node_count) element.nodes[i] = node;
    }
    builder_.add_element(element);
  }

  void read_element2(std::int64_t number, std::int64_t type, std::int64_t tags) {
    const ElementType& known = type_of(cursor_, type, number);
    std::int64_t physical = 0;
    int entity = 0;
    for (std::int64_t i = 0; i < cursor_.count_of(tags, "an element's number of tags"); ++i) {
      const std::int64_t tag = cursor_.small("an element's tag");
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
    element.groups = groups_.set_of(dimension_of(known.shape), entity, physical);
    read_element_nodes(known, element);
  }

  void read_elements2() {
    const std::int64_t count = cursor_.count("the number of elements");
    cursor_.line();
    std::int64_t done = 0;
    while (done < count) {
      if (!cursor_.is_binary) {
        const std::int64_t number = cursor_.integer("an element's number");
        const std::int64_t type = cursor_.integer("an element's type");
        read_element2(number, type, cursor_.integer("an element's number of tags"));
        ++done;
        continue;
      }
      const std::int64_t type = cursor_.small("a block's element type");
      const std::int64_t in_block = cursor_.small("a block's number of elements");
      const std::int64_t tags = cursor_.small("a block's number of tags");
      if (in_block < 1 || in_block > count - done)
        throw cursor_.error("a block of elements has a wrong count");
      for (std::int64_t i = 0; i < in_block; ++i)
        read_element2(cursor_.small("an element's number"), type, tags);
      done += in_block;
    }
  }

  void read_elements4() {
    const std::int64_t blocks = cursor_.large("the number of element blocks");
    for (int i = 0; i < 3; ++i) cursor_.large("the element counts");
    for (std::int64_t block = 0; block < blocks; ++block) {
      const std::int64_t dimension = cursor_.small("a block's dimension"),
                         entity = cursor_.small("a block's entity");
      FileElement element;
      element.cad = cad_number(entity);
      if (const auto found = entity_groups_.find({dimension, entity}); found != entity_groups_.end())
        element.groups = found->second;
      const std::int64_t type = cursor_.small("a block's element type");
      const std::int64_t count = cursor_.large_count("a block's number of elements");
      for (std::int64_t i = 0; i < count; ++i) {
        element.number = cursor_.large("an element's number");
        read_element_nodes(type_of(cursor_, type, element.number), element);
      }
    }
  }

  MshCursor cursor_;
  MeshBuilder builder_;
  PhysicalGroups groups_{builder_};
  bool old_ = false;  // version 1
  bool new_ = false;  // version 4.1
  bool has_nodes_ = false, has_elements_ = false;
  std::map<DimensionAndTag, int> entity_groups_;  // 4.1: set of groups of each entity
};

}  // namespace

ShellMesh read_msh(std::string_view bytes, const std::string& name, std::vector<std::string>* notes) {
  return MshReader(bytes, name).read(notes);
}

}  // namespace quadrille
