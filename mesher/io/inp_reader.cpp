/// Abaqus / CalculiX .inp: *NODE, *ELEMENT with shells or plane elements, *ELSET, *NSET. Other keywords are
/// skipped.

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <regex>
#include <set>

#include "mesher/io/mesh_builder.hpp"
#include "mesher/io/readers.hpp"
#include "mesher/io/text_cursor.hpp"

namespace quadrille {

namespace {

std::string without_blanks_and_quotes(std::string_view text) {
  std::string result(text);
  std::erase_if(result, [](char c) { return c == ' ' || c == '\t' || c == '"'; });
  return result;
}

/// A set as in the file: numbers, and names of other sets.
struct FileSet {
  struct Range {
    std::int64_t first, last, step;
  };
  std::string name;  // in the upper and lower case of its first occurrence
  std::vector<Range> ranges;
  std::vector<std::string> sets;  // in upper case
};

using Sets = std::map<std::string, FileSet>;  // by name in upper case

/// A parameter of a keyword, as it is written. \param line without blanks and quotes
std::string parameter(const std::string& line, const std::string& key) {
  const std::size_t found = upper(line).find("," + key + "=");
  if (found == std::string::npos) return {};
  const std::size_t begin = found + key.size() + 2;
  return line.substr(begin, line.find(',', begin) - begin);
}

/// The set that the keyword's parameter names; null if there is no such parameter.
FileSet* set_named(Sets& sets, const std::string& line, const std::string& key) {
  const std::string name = parameter(line, key);
  if (name.empty()) return nullptr;
  FileSet& set = sets[upper(name)];
  if (set.name.empty()) set.name = name;
  return &set;
}

/// 3, 4, 6, 8 or 9 for shells, membranes, rigid and plane elements of all kinds (S4R, CPS6M, CAX4P, DC2D4);
/// 0 for others.
int nodes_of_surface_element(const std::string& type) {
  const std::regex pattern(
      "(?:S|STRI|M3D|SFM3D|R3D|DS|CPS|CPE|CPEG|CAX|CGAX|DC2D|DCAX|AC2D|ACAX)([34689])"
      "[A-Z]*5?");
  std::smatch match;
  if (type.size() > 16) return 0;  // matching a long text takes too much stack
  return std::regex_match(type, match, pattern) ? match[1].str()[0] - '0' : 0;
}

/// Cuts the next comma-separated field off the line and trims it.
std::string_view field(std::string_view& line) {
  const std::size_t comma = line.find(',');
  const std::string_view result = trimmed(line.substr(0, comma));
  line = comma == std::string_view::npos ? std::string_view{} : line.substr(comma + 1);
  return result;
}

/// Calls `visit` for the ranges of a set and of the sets that make it up. Those that are not in the file are
/// skipped.
template <class Visit>
void for_each_range(const Sets& sets, const std::string& upper_name, Visit&& visit) {
  std::vector<std::string> names{upper_name};
  std::set<std::string> known{upper_name};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto found = sets.find(names[i]);
    if (found == sets.end()) continue;
    for (const FileSet::Range& range : found->second.ranges) visit(range);
    for (const std::string& other : found->second.sets)
      if (known.insert(other).second) names.push_back(other);
  }
}

class InpReader {
 public:
  InpReader(std::string_view bytes, const std::string& name) : cursor_(bytes, name), builder_(name) {}

  ShellMesh read(std::vector<std::string>* notes) {
    while (!cursor_.at_end()) {
      const std::string_view line = cursor_.line();
      if (line.substr(0, 2) == "**") continue;
      if (!line.empty() && line.front() == '*')
        begin_keyword(line);
      else
        read_data(line);
    }
    finish_element();
    // Our files repeat a set of elements as the set of their nodes under the same name.
    assign(of_elements_, "element", &MeshBuilder::put_element, {});
    assign(of_nodes_, "node", &MeshBuilder::put_node, of_elements_);
    return builder_.finish(notes);
  }

 private:
  enum class Block { other, nodes, elements, set };

  /// Whether our own files always contain this set: of everything, or of the elements with a certain side on
  /// an edge. Such sets are written anew, so they are not read.
  bool is_made_anew(const std::string& upper_name) const {
    if (upper_name == "NALL" || upper_name == "EALL" || upper_name == "EOTHER") return true;
    const std::size_t side = upper_name.rfind("_SIDE");
    return side != std::string::npos && side + 6 == upper_name.size() &&
           of_nodes_.contains(upper_name.substr(0, side));
  }

  /// Puts the members of sets into groups of the mesh, but for the sets in `others`.
  void assign(const Sets& sets, const char* what, bool (MeshBuilder::*put)(std::int64_t, int),
              const Sets& others) {
    for (const auto& [upper_name, set] : sets) {
      if (is_made_anew(upper_name) || others.contains(upper_name)) continue;
      const int group = builder_.group(set.name, 0);
      for_each_range(sets, upper_name, [&, &name = set.name](const FileSet::Range& range) {
        for (std::int64_t member = range.first; member <= range.last; member += range.step) {
          if (!(builder_.*put)(member, group))
            throw failure(cursor_.name(),
                          fmt::format("{}: the set {} holds {} {}, which the file does not define",
                                      cursor_.name(), name, what, member));
          if (member > std::numeric_limits<std::int64_t>::max() - range.step) break;
        }
      });
    }
  }

  void begin_keyword(std::string_view given) {
    finish_element();
    const std::string line = without_blanks_and_quotes(given);
    const std::string keyword = upper(line.substr(0, line.find(',')));
    block_ = Block::other;
    if (keyword == "*NODE") {
      block_ = Block::nodes;
      set_ = set_named(of_nodes_, line, "NSET");
    } else if (keyword == "*ELEMENT") {
      begin_elements(upper(parameter(line, "TYPE")));
      set_ = set_named(of_elements_, line, "ELSET");
    } else if (keyword == "*ELSET" || keyword == "*NSET") {
      set_ = set_named(keyword == "*ELSET" ? of_elements_ : of_nodes_, line, keyword.substr(1));
      generated_ = upper(line).find(",GENERATE") != std::string::npos;
      if (set_ != nullptr) block_ = Block::set;
    } else if (keyword == "*INCLUDE") {
      throw cursor_.error_before("*INCLUDE is not supported: put the mesh into one file");
    }
  }

  void begin_elements(const std::string& type) {
    pending_ = {};
    const auto is_one_of = [&](std::initializer_list<std::string_view> names) {
      return std::find(names.begin(), names.end(), type) != names.end();
    };
    if (const int nodes = nodes_of_surface_element(type); nodes > 0)
      expect(element_type(2, nodes));
    else if (is_one_of({"T3D2", "T2D2", "B31", "B31R", "B21"}))
      expect(element_type(1, 2));
    else if (is_one_of({"T3D3", "T2D3", "B32", "B32R", "B22"}))
      expect(element_type(1, 3));
    else if (type.substr(0, 2) == "C3" || type.substr(0, 2) == "DC")
      throw cursor_.error_before(
          fmt::format("elements of type {} are volumes: only surface meshes are read", type));
    else
      throw cursor_.error_before(
          fmt::format("elements of type {} are not read", type.empty() ? "(none given)" : type));
    block_ = Block::elements;
  }

  void expect(const ElementType& type) {
    pending_.shape = type.shape;
    pending_.node_count = type.kept_nodes();
    file_nodes_ = type.nodes;
    read_numbers_ = 0;
  }

  void read_data(std::string_view line) {
    if (line.find_first_not_of(" \t,") == std::string_view::npos) return;
    switch (block_) {
      case Block::nodes:
        return read_node(line);
      case Block::elements:
        return read_element(line);
      case Block::set:
        return read_set(line);
      case Block::other:
        return;
    }
  }

  template <class T>
  T number(std::string_view text, const char* what) const {
    if (const std::optional<T> value = parsed<T>(text)) return *value;
    if (!text.empty() && text.front() == '+') text.remove_prefix(1);
    throw cursor_.error_before(fmt::format("expected {}, found \"{}\"", what, text.substr(0, 30)));
  }

  void read_node(std::string_view line) {
    const auto node = number<std::int64_t>(field(line), "a node's number");
    Vector3 position = Vector3::Zero();
    // Coordinates that are left out are zero.
    for (int i = 0; i < 3; ++i)
      if (const std::string_view text = field(line); !text.empty())
        position[i] = number<double>(text, "a coordinate");
    builder_.add_node(node, position);
    if (set_ != nullptr) add_to_set(node);
  }

  void add_to_set(std::int64_t number) {
    if (!set_->ranges.empty() && set_->ranges.back().step == 1 && set_->ranges.back().last == number - 1)
      set_->ranges.back().last = number;
    else
      set_->ranges.push_back({number, number, 1});
  }

  /// An element may span several lines.
  void read_element(std::string_view line) {
    while (!line.empty()) {
      const std::string_view text = field(line);
      if (text.empty()) continue;
      const auto value = number<std::int64_t>(text, "an element's node");
      if (read_numbers_ == 0)
        pending_.number = value;
      else if (read_numbers_ <= pending_.node_count)
        pending_.nodes[read_numbers_ - 1] = value;
      if (++read_numbers_ <= file_nodes_) continue;
      // Beams and trusses have their middle node between the ends.
      if (pending_.shape == ElementShape::line && pending_.node_count == 3)
        std::swap(pending_.nodes[1], pending_.nodes[2]);
      builder_.add_element(pending_);
      if (set_ != nullptr) add_to_set(pending_.number);
      read_numbers_ = 0;
      if (line.find_first_not_of(" \t,") != std::string_view::npos)
        throw cursor_.error_before(
            fmt::format("element {} has more than {} nodes", pending_.number, file_nodes_));
      return;
    }
  }

  void finish_element() {
    if (block_ == Block::elements && read_numbers_ != 0)
      throw failure(cursor_.name(), fmt::format("{}: element {} has {} nodes instead of {}", cursor_.name(),
                                                pending_.number, read_numbers_ - 1, file_nodes_));
  }

  void read_set(std::string_view line) {
    if (generated_) {
      const auto first = number<std::int64_t>(field(line), "the first number of the range");
      const auto last = number<std::int64_t>(field(line), "the last number of the range");
      const std::string_view step_text = field(line);
      const auto step = step_text.empty() ? 1 : number<std::int64_t>(step_text, "the step of the range");
      if (step < 1) throw cursor_.error_before("the step of the range must be positive");
      set_->ranges.push_back({first, last, step});
      return;
    }
    while (!line.empty()) {
      const std::string_view text = field(line);
      if (text.empty()) continue;
      if (const std::optional<std::int64_t> member = exactly<std::int64_t>(text))
        add_to_set(*member);
      else
        set_->sets.push_back(upper(without_blanks_and_quotes(text)));
    }
  }

  TextCursor cursor_;
  MeshBuilder builder_;
  Block block_ = Block::other;
  FileElement pending_;
  int file_nodes_ = 0;      // of each element in the file: those kept, and the middle of nine-node quads
  int read_numbers_ = 0;    // numbers read of the current element, with its own number
  FileSet* set_ = nullptr;  // receives the nodes, elements or numbers that follow
  bool generated_ = false;
  Sets of_elements_, of_nodes_;
};

}  // namespace

ShellMesh read_inp(std::string_view bytes, const std::string& name, std::vector<std::string>* notes) {
  return InpReader(bytes, name).read(notes);
}

}  // namespace quadrille
