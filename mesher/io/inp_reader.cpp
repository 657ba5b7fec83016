/// Abaqus / CalculiX .inp: *NODE, *ELEMENT with shells or plane elements, *ELSET. Other keywords are passed
/// over.

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <limits>

#include "mesher/io/mesh_builder.hpp"
#include "mesher/io/readers.hpp"
#include "mesher/io/text_cursor.hpp"

namespace quadrille {

namespace {

std::string upper_trimmed(std::string_view text) {
  std::string result;
  for (const char c : text)
    if (c != ' ' && c != '\t' && c != '"')
      result += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return result;
}

/// "FACE3" -> 3, anything else 0.
int face_number(std::string_view set) {
  if (set.substr(0, 4) != "FACE") return 0;
  set.remove_prefix(4);
  int number = 0;
  const auto [end, error] = std::from_chars(set.data(), set.data() + set.size(), number);
  return error == std::errc() && end == set.data() + set.size() && number > 0 ? number : 0;
}

class InpReader {
 public:
  InpReader(std::string_view bytes, const std::string& name) : cursor_(bytes, name), builder_(name) {}

  ShellMesh read() {
    while (!cursor_.at_end()) {
      const std::string_view line = cursor_.line();
      if (line.substr(0, 2) == "**") continue;
      if (!line.empty() && line.front() == '*')
        begin_keyword(line);
      else
        read_data(line);
    }
    finish_element();
    assign_sets();
    return builder_.finish();
  }

 private:
  enum class Block { other, nodes, elements, element_set };

  void begin_keyword(std::string_view line) {
    finish_element();
    std::string text = upper_trimmed(line);
    const auto keyword = std::string_view(text).substr(0, text.find(','));
    block_ = Block::other;
    if (keyword == "*NODE") {
      block_ = Block::nodes;
    } else if (keyword == "*ELEMENT") {
      begin_elements(text);
    } else if (keyword == "*ELSET") {
      set_face_ = face_number(parameter(text, "ELSET"));
      generated_ = text.find(",GENERATE") != std::string::npos;
      if (set_face_ > 0) block_ = Block::element_set;
    } else if (keyword == "*INCLUDE") {
      throw cursor_line("*INCLUDE is not followed: put the mesh into one file");
    }
  }

  static std::string parameter(const std::string& text, const std::string& key) {
    const std::size_t found = text.find("," + key + "=");
    if (found == std::string::npos) return {};
    const std::size_t begin = found + key.size() + 2;
    return text.substr(begin, text.find(',', begin) - begin);
  }

  void begin_elements(const std::string& text) {
    const std::string type = parameter(text, "TYPE");
    pending_ = {};
    pending_.cad = face_number(parameter(text, "ELSET"));
    const auto is_one_of = [&](std::initializer_list<std::string_view> names) {
      return std::find(names.begin(), names.end(), type) != names.end();
    };
    if (is_one_of({"S4", "S4R", "S4R5", "M3D4", "M3D4R", "CPS4", "CPS4R", "CPE4", "CPE4R", "CAX4", "CAX4R",
                   "R3D4"}))
      set_shape(ElementShape::quad, 4);
    else if (is_one_of(
                 {"S8", "S8R", "S8R5", "M3D8", "M3D8R", "CPS8", "CPS8R", "CPE8", "CPE8R", "CAX8", "CAX8R"}))
      set_shape(ElementShape::quad, 8);
    else if (is_one_of({"S3", "S3R", "STRI3", "M3D3", "CPS3", "CPE3", "CAX3", "R3D3"}))
      set_shape(ElementShape::triangle, 3);
    else if (is_one_of({"S6", "STRI65", "M3D6", "CPS6", "CPE6", "CAX6"}))
      set_shape(ElementShape::triangle, 6);
    else if (is_one_of({"T3D2", "T2D2", "B31", "B31R", "B21"}))
      set_shape(ElementShape::line, 2);
    else if (is_one_of({"T3D3", "T2D3", "B32", "B32R", "B22"}))
      set_shape(ElementShape::line, 3);
    else if (type.substr(0, 2) == "C3" || type.substr(0, 2) == "DC")
      throw cursor_line(fmt::format("elements of type {} are volumes: only surface meshes are read", type));
    else
      throw cursor_line(
          fmt::format("elements of type {} are not read", type.empty() ? "(none given)" : type));
    block_ = Block::elements;
  }

  void set_shape(ElementShape shape, int nodes) {
    pending_.shape = shape;
    pending_.node_count = nodes;
    read_numbers_ = 0;
  }

  void read_data(std::string_view line) {
    if (line.find_first_not_of(" \t,") == std::string_view::npos) return;
    switch (block_) {
      case Block::nodes:
        return read_node(line);
      case Block::elements:
        return read_element(line);
      case Block::element_set:
        return read_set(line);
      case Block::other:
        return;
    }
  }

  /// Cuts the next comma-separated field off the line, without blanks around.
  static std::string_view field(std::string_view& line) {
    const std::size_t comma = line.find(',');
    std::string_view result = line.substr(0, comma);
    line = comma == std::string_view::npos ? std::string_view{} : line.substr(comma + 1);
    const std::size_t begin = result.find_first_not_of(" \t");
    if (begin == std::string_view::npos) return {};
    return result.substr(begin, result.find_last_not_of(" \t") - begin + 1);
  }

  template <class T>
  T number(std::string_view text, const char* what) const {
    T value{};
    if (!text.empty() && text.front() == '+') text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
      throw cursor_line(fmt::format("expected {}, found \"{}\"", what, text.substr(0, 30)));
    return value;
  }

  void read_node(std::string_view line) {
    const auto node = number<std::int64_t>(field(line), "a node's number");
    Vector3 position = Vector3::Zero();
    // Coordinates that are left out are zero.
    for (int i = 0; i < 3; ++i)
      if (const std::string_view text = field(line); !text.empty())
        position[i] = number<double>(text, "a coordinate");
    builder_.add_node(node, position);
  }

  /// An element may go over several lines.
  void read_element(std::string_view line) {
    while (!line.empty()) {
      const std::string_view text = field(line);
      if (text.empty()) continue;
      const auto value = number<std::int64_t>(text, "an element's node");
      if (read_numbers_ == 0)
        pending_.number = value;
      else
        pending_.nodes[read_numbers_ - 1] = value;
      if (++read_numbers_ <= pending_.node_count) continue;
      builder_.add_element(pending_);
      read_numbers_ = 0;
      if (line.find_first_not_of(" \t,") != std::string_view::npos)
        throw cursor_line(
            fmt::format("element {} has more than {} nodes", pending_.number, pending_.node_count));
      return;
    }
  }

  void finish_element() {
    if (block_ == Block::elements && read_numbers_ != 0)
      throw failure(cursor_.name(), fmt::format("{}: element {} has {} nodes instead of {}", cursor_.name(),
                                                pending_.number, read_numbers_ - 1, pending_.node_count));
  }

  void read_set(std::string_view line) {
    if (generated_) {
      const auto first = number<std::int64_t>(field(line), "the first element of the range");
      const auto last = number<std::int64_t>(field(line), "the last element of the range");
      const std::string_view step_text = field(line);
      const auto step = step_text.empty() ? 1 : number<std::int64_t>(step_text, "the step of the range");
      if (step < 1) throw cursor_line("the step of the range must be positive");
      ranges_.push_back({first, last, step, set_face_});
      return;
    }
    while (!line.empty()) {
      const std::string_view text = field(line);
      std::int64_t element = 0;
      // Sets may hold the names of other sets: those are passed over.
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), element);
      if (error == std::errc() && end == text.data() + text.size())
        ranges_.push_back({element, element, 1, set_face_});
    }
  }

  void assign_sets() {
    for (const Range& range : ranges_)
      for (std::int64_t element = range.first; element <= range.last; element += range.step) {
        if (!builder_.set_cad(element, range.face))
          throw failure(cursor_.name(),
                        fmt::format("{}: the set Face{} holds element {}, which the file does not define",
                                    cursor_.name(), range.face, element));
        if (element > std::numeric_limits<std::int64_t>::max() - range.step) break;
      }
  }

  /// An error in the line that was read last.
  Error cursor_line(const std::string& sentence) const { return cursor_.error_before(sentence); }

  struct Range {
    std::int64_t first, last, step;
    int face;
  };

  TextCursor cursor_;
  MeshBuilder builder_;
  Block block_ = Block::other;
  FileElement pending_;
  int read_numbers_ = 0;  // of the element that is being read, its own number included
  int set_face_ = 0;
  bool generated_ = false;
  std::vector<Range> ranges_;
};

}  // namespace

ShellMesh read_inp(std::string_view bytes, const std::string& name) {
  return InpReader(bytes, name).read();
}

}  // namespace quadrille
