/// I-deas universal files. Based on: the dataset descriptions of the University of Cincinnati's SDRL.

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <limits>

#include "mesher/io/mesh_builder.hpp"
#include "mesher/io/readers.hpp"
#include "mesher/io/text_cursor.hpp"

namespace quadrille {

namespace {

constexpr bool is_one_of(std::int64_t value, std::initializer_list<int> values) {
  for (const int other : values)
    if (value == other) return true;
  return false;
}

/// The meaning of an element descriptor; nodes = 0 if such elements are not read.
struct Descriptor {
  ElementShape shape = ElementShape::line;
  int nodes = 0;
};

Descriptor descriptor_of(std::int64_t number) {
  if (is_one_of(number, {11, 21, 22})) return {ElementShape::line, 2};
  if (is_one_of(number, {23, 24})) return {ElementShape::line, 3};
  if (is_one_of(number, {41, 51, 61, 74, 81, 91})) return {ElementShape::triangle, 3};
  if (is_one_of(number, {42, 52, 62, 72, 82, 92})) return {ElementShape::triangle, 6};
  if (is_one_of(number, {44, 54, 64, 71, 84, 94})) return {ElementShape::quad, 4};
  if (is_one_of(number, {45, 55, 65, 75, 85, 95})) return {ElementShape::quad, 8};
  return {};
}

class UnvReader {
 public:
  UnvReader(std::string_view bytes, const std::string& name) : cursor_(bytes, name), builder_(name) {}

  ShellMesh read(std::vector<std::string>* notes) {
    bool any = false;
    while (!cursor_.at_end()) {
      if (trimmed(cursor_.line()) != "-1") {
        if (!any) throw cursor_.error_before("a universal file begins with -1 in a line of its own");
        continue;
      }
      any = true;
      if (cursor_.at_end()) break;
      read_dataset(whole(cursor_.line(), "a dataset's number"));
    }
    assign_groups();
    return builder_.finish(notes);
  }

 private:
  std::int64_t whole(std::string_view text, const char* what) const {
    text = trimmed(text);
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end == text.data() || (end != text.data() + text.size() && *end != ' '))
      throw cursor_.error_before(fmt::format("expected {}, found \"{}\"", what, text.substr(0, 30)));
    return value;
  }

  /// The line's next number. Fields have fixed columns, but in practice there are blanks between numbers.
  template <class Number>
  Number next(std::string_view& line, const char* what) const {
    const std::size_t begin = line.find_first_not_of(" \t");
    if (begin == std::string_view::npos)
      throw cursor_.error_before(fmt::format("the line ends where {} should be", what));
    std::string word(line.substr(begin, line.find_first_of(" \t", begin) - begin));
    line.remove_prefix(begin + word.size());
    // Exponents of Fortran's double precision.
    for (char& c : word)
      if (c == 'D' || c == 'd') c = 'e';
    if (const std::optional<Number> value = parsed<Number>(word)) return *value;
    throw cursor_.error_before(fmt::format("expected {}, found \"{}\"", what, word.substr(0, 30)));
  }

  /// The next line of a dataset; false at its end.
  bool next_line(std::string_view& line) {
    if (cursor_.at_end()) throw cursor_.truncated("the end of a dataset");
    line = cursor_.line();
    return trimmed(line) != "-1";
  }
  std::string_view needed_line() {
    std::string_view line;
    if (!next_line(line)) throw cursor_.error_before("the dataset ends too early");
    return line;
  }

  void read_dataset(std::int64_t number) {
    std::string_view line;
    while (next_line(line)) {
      if (is_one_of(number, {781, 2411}))
        read_node(line, needed_line());
      else if (number == 15)
        read_old_node(line);
      else if (is_one_of(number, {780, 2412}))
        read_element(number, line);
      else if (is_one_of(number, {2435, 2452, 2467, 2477}))
        read_group(line);
    }
  }

  Vector3 position(std::string_view line) const {
    const double x = next<double>(line, "a node's x"), y = next<double>(line, "a node's y"),
                 z = next<double>(line, "a node's z");
    return {x, y, z};
  }
  void read_node(std::string_view line, std::string_view place) {
    builder_.add_node(next<std::int64_t>(line, "a node's number"), position(place));
  }
  void read_old_node(std::string_view line) {
    const auto number = next<std::int64_t>(line, "a node's number");
    for (int i = 0; i < 3; ++i) next<std::int64_t>(line, "a node's systems");
    builder_.add_node(number, position(line));
  }

  /// Nodes run around elements of second order: corner, midside, corner, ...
  void read_element(std::int64_t dataset, std::string_view line) {
    FileElement element;
    element.number = next<std::int64_t>(line, "an element's number");
    const auto kind = next<std::int64_t>(line, "an element's descriptor");
    if (dataset == 780) next<std::int64_t>(line, "an element's physical table");
    const auto property = next<std::int64_t>(line, "an element's property");
    if (property > 0 && property <= std::numeric_limits<int>::max()) element.cad = static_cast<int>(property);
    for (int i = 0; i < (dataset == 780 ? 3 : 2); ++i) next<std::int64_t>(line, "an element's material");
    const auto count = next<std::int64_t>(line, "an element's number of nodes");
    const Descriptor descriptor = descriptor_of(kind);
    if (kind >= 101 && kind <= 118)
      throw cursor_.error_before(fmt::format(
          "element {} is a volume (descriptor {}): only surface meshes are read", element.number, kind));
    const bool has_middle =
        descriptor.nodes == 8 && count == 9;  // Gmsh's quads of nine nodes, the middle last
    if (descriptor.nodes == 0 || (count != descriptor.nodes && !has_middle))
      throw cursor_.error_before(
          fmt::format("element {} of descriptor {} with {} nodes is not read", element.number, kind, count));
    if (descriptor.shape == ElementShape::line) needed_line();  // beams have a line with their sections
    element.shape = descriptor.shape;
    element.node_count = descriptor.nodes;
    const int corners = static_cast<int>(descriptor.shape) + 1;
    const bool second = descriptor.nodes > corners;
    std::string_view nodes;
    for (int i = 0; i < count; ++i) {
      if (i % 8 == 0) nodes = needed_line();
      const int place = !second ? i : i % 2 == 0 ? i / 2 : corners + i / 2;
      const auto node = next<std::int64_t>(nodes, "an element's node");
      if (i < descriptor.nodes) element.nodes[place] = node;
    }
    builder_.add_element(element);
  }

  void read_group(std::string_view line) {
    std::int64_t count = 0;
    next<std::int64_t>(line, "a group's number");
    for (int i = 0; i < 7; ++i) count = next<std::int64_t>(line, "a group's number of members");
    Group group{std::string(trimmed(needed_line())), {}};
    if (group.name.empty()) throw cursor_.error_before("a group has no name");
    line = {};
    for (std::int64_t i = 0; i < count; ++i) {
      if (trimmed(line).empty())
        line = needed_line();  // of two members; Gmsh may write one member before another kind
      const auto kind = next<std::int64_t>(line, "a member's kind");
      group.members.push_back({kind, next<std::int64_t>(line, "a member's number")});
      for (int k = 0; k < 2; ++k) next<std::int64_t>(line, "a member's component");
    }
    groups_.push_back(std::move(group));
  }

  /// Assigns the members of groups. Gmsh lists points that it does not write as elements: members that are
  /// missing are skipped, with a note.
  void assign_groups() {
    constexpr int node = 7, element = 8;
    for (const Group& group : groups_) {
      const int place = builder_.group(group.name, 0);
      std::size_t missing = 0;
      for (const auto& [kind, number] : group.members) {
        missing += (kind == node && !builder_.put_node(number, place)) ||
                   (kind == element && !builder_.put_element(number, place));
      }
      if (missing > 0)
        builder_.note(
            fmt::format("the group {} holds {} members that the file does not define: they are left out",
                        group.name, missing));
    }
  }

  struct Group {
    std::string name;
    std::vector<std::pair<std::int64_t, std::int64_t>> members;  // kind and number
  };

  TextCursor cursor_;
  MeshBuilder builder_;
  std::vector<Group> groups_;  // kept until all elements are known
};

}  // namespace

ShellMesh read_unv(std::string_view bytes, const std::string& name, std::vector<std::string>* notes) {
  return UnvReader(bytes, name).read(notes);
}

}  // namespace quadrille
