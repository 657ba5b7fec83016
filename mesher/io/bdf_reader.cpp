/// Nastran bulk data. Based on: the MSC Nastran quick reference guide, "Format of bulk data entries".

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "mesher/io/mesh_builder.hpp"
#include "mesher/io/readers.hpp"
#include "mesher/io/text_cursor.hpp"

namespace quadrille {

namespace {

/// An entry: its name and its fields, followed by those of its continuation lines.
struct Card {
  std::string name;
  std::vector<std::string> fields;

  std::string_view field(std::size_t i) const { return i < fields.size() ? fields[i] : std::string_view(); }
};

struct CardShape {
  std::string_view name;
  ElementShape shape;
  int nodes;
};
constexpr CardShape card_shapes[] = {
    {"CTRIA3", ElementShape::triangle, 3},
    {"CTRIAR", ElementShape::triangle, 3},
    {"CTRIA6", ElementShape::triangle, 6},
    {"CQUAD4", ElementShape::quad, 4},
    {"CQUADR", ElementShape::quad, 4},
    {"CQUAD8", ElementShape::quad, 8},
    {"CSHEAR", ElementShape::quad, 4},
    {"CQUAD9", ElementShape::quad, 8},  // written by Gmsh, with a middle node
    {"CQUAD", ElementShape::quad, 8},
};
/// Elements that a surface mesh cannot hold: they are only counted.
constexpr std::string_view left_out[] = {"CBAR",   "CBEAM",   "CROD",   "CONROD", "CTUBE",
                                         "CBUSH",  "CTRAX3",  "CTRAX6", "CTRIAX", "CTRIAX6",
                                         "CQUADX", "CQUADX4", "CQUADX8"};
constexpr std::string_view volumes[] = {"CTETRA", "CHEXA", "CPENTA", "CPYRAM", "CPYRA"};

class BdfReader {
 public:
  BdfReader(std::string_view bytes, const std::string& name) : cursor_(bytes, name), builder_(name) {}

  ShellMesh read(std::vector<std::string>* notes) {
    while (!cursor_.at_end()) {
      const std::string_view line = cursor_.line();
      if (!line.empty() && line.front() == '$')
        read_comment(line);
      else if (!read_line(line.substr(0, line.find('$'))))
        break;
    }
    finish_card();
    name_properties();
    for (const auto& [name, count] : left_out_)
      builder_.note(fmt::format("{} elements {} are left out", count, name));
    return builder_.finish(notes);
  }

 private:
  /// False at the end of the data.
  bool read_line(std::string_view line) {
    if (trimmed(line).empty()) return true;
    const std::string first = upper(trimmed(line).substr(0, 10));
    if (first == "ENDDATA") return false;
    // The lines before the bulk data are for the solver.
    if (first == "BEGIN BULK" || first == "BEGIN,BULK") {
      card_ = {};
      return true;
    }
    if (first.substr(0, 7) == "INCLUDE")
      throw cursor_.error_before("INCLUDE is not supported: put the mesh into one file");
    std::vector<std::string_view> fields = fields_of(line);
    std::string_view name = trimmed(fields.front());
    const bool goes_on = name.empty() || name.front() == '+' || name.front() == '*';
    if (!goes_on) {
      finish_card();
      if (!name.empty() && name.back() == '*') name.remove_suffix(1);
      card_.name = upper(trimmed(name));
    }
    for (std::size_t i = 1; i < fields.size(); ++i) card_.fields.emplace_back(trimmed(fields[i]));
    return true;
  }

  /// The name and the fields of a line: separated by commas, or 8 columns wide, 16 after a name with an
  /// asterisk. The last field, which names the continuation, is left out.
  static std::vector<std::string_view> fields_of(std::string_view line) {
    std::vector<std::string_view> fields;
    constexpr std::size_t narrow = 8, wide = 16;
    if (const std::size_t comma = line.find(','); comma != std::string_view::npos) {
      const bool is_wide = trimmed(line.substr(0, comma)).find('*') != std::string_view::npos;
      while (fields.size() <= (is_wide ? 4 : 8)) {
        const std::size_t end = std::min(line.find(','), line.size());
        fields.push_back(line.substr(0, end));
        line.remove_prefix(std::min(end + 1, line.size()));
        if (line.empty() && end == 0) break;
      }
      fields.resize(is_wide ? 5 : 9);
      return fields;
    }
    fields.push_back(line.substr(0, narrow));
    const bool is_wide = fields.front().find('*') != std::string_view::npos;
    const std::size_t columns = is_wide ? wide : narrow;
    for (std::size_t begin = narrow; begin < 9 * narrow; begin += columns)
      fields.push_back(begin < line.size() ? line.substr(begin, columns) : std::string_view());
    return fields;
  }

  void finish_card() {
    const Card card = std::exchange(card_, {});
    if (card.name.empty()) return;
    if (card.name == "GRID") return add_node(card);
    if (std::find(std::begin(volumes), std::end(volumes), card.name) != std::end(volumes))
      throw cursor_.error_before(
          fmt::format("{} is a volume, in a line before this one: only surface meshes are read", card.name));
    for (const CardShape& shape : card_shapes)
      if (card.name == shape.name) return add_element(card, shape);
    if (std::find(std::begin(left_out), std::end(left_out), card.name) != std::end(left_out))
      ++left_out_[std::string(card.name)];
  }

  std::int64_t whole(std::string_view text, const char* what, const Card& card) const {
    if (const std::optional<std::int64_t> value = exactly<std::int64_t>(text)) return *value;
    throw cursor_.error_before(fmt::format("expected {} in the {} before this line, found \"{}\"", what,
                                           card.name, text.substr(0, 20)));
  }

  /// Reads "1.5", "-.5", "1.5E3", "1.5D3" and, without a letter, "1.5+3". Blank is 0.
  double real(std::string_view given, const Card& card) const {
    if (given.empty()) return 0;
    std::string text = upper(given);
    std::replace(text.begin(), text.end(), 'D', 'E');
    if (text.find('E') == std::string::npos) {
      if (const std::size_t sign = text.find_last_of("+-"); sign != std::string::npos && sign > 0)
        text.insert(sign, 1, 'E');
    }
    if (const std::optional<double> value = parsed<double>(text)) return *value;
    throw cursor_.error_before(
        fmt::format("expected a coordinate in the {} before this line, found \"{}\"", card.name, given));
  }

  void add_node(const Card& card) {
    const std::int64_t number = whole(card.field(0), "a node's number", card);
    if (!card.field(1).empty() && whole(card.field(1), "a coordinate system", card) != 0)
      throw cursor_.error_before(fmt::format(
          "node {} is given in the coordinate system {}: only the basic one is read", number, card.field(1)));
    builder_.add_node(number,
                      {real(card.field(2), card), real(card.field(3), card), real(card.field(4), card)});
  }

  void add_element(const Card& card, const CardShape& shape) {
    FileElement element;
    element.number = whole(card.field(0), "an element's number", card);
    // For a blank property Nastran uses the element's own number. Programs without properties (meshio) leave
    // it blank and mean none.
    const std::int64_t property =
        card.field(1).empty() ? 0 : whole(card.field(1), "an element's property", card);
    if (property > 0 && property <= std::numeric_limits<int>::max()) element.cad = static_cast<int>(property);
    element.shape = shape.shape;
    element.node_count = shape.nodes;
    const int corners = static_cast<int>(shape.shape) + 1;
    for (int i = 0; i < shape.nodes; ++i) {
      const std::string_view text = card.field(2 + i);
      if (text.empty() && i >= corners) {
        // Single midside nodes may be left out; the element then counts as first order.
        element.node_count = corners;
        break;
      }
      element.nodes[i] = whole(text, "an element's node", card);
    }
    elements_of_[element.cad].push_back(element.number);
    builder_.add_element(element);
  }

  /// Property names: $HMNAME COMP 3"name", $HMNAME PROP 3"name" or (ANSA) $ANSA_NAME_COMMENT;3;PSHELL;name;
  void read_comment(std::string_view line) {
    const auto add = [&](std::string_view number, std::string_view name) {
      const std::optional<int> property = parsed<int>(trimmed(number));
      if (property && !trimmed(name).empty()) names_[*property] = trimmed(name);
    };
    const auto cut = [&](char mark) {
      const std::size_t end = std::min(line.find(mark), line.size());
      const std::string_view part = line.substr(0, end);
      line.remove_prefix(std::min(end + 1, line.size()));
      return part;
    };
    if (line.substr(0, 13) == "$HMNAME PROP " || line.substr(0, 13) == "$HMNAME COMP ") {
      line.remove_prefix(13);
      const std::string_view number = cut('"');
      add(number, cut('"'));
    } else if (line.substr(0, 19) == "$ANSA_NAME_COMMENT;") {
      line.remove_prefix(19);
      const std::string_view number = cut(';'), kind = cut(';');
      if (kind == "PSHELL" || kind == "PCOMP") add(number, cut(';'));
    }
  }

  void name_properties() {
    for (const auto& [property, name] : names_) {
      const auto elements = elements_of_.find(property);
      if (elements == elements_of_.end()) continue;
      const int group = builder_.group(name, property, 2);
      for (const std::int64_t element : elements->second) builder_.put_element(element, group);
    }
  }

  TextCursor cursor_;
  MeshBuilder builder_;
  Card card_;
  std::map<int, std::string> names_;  // of properties
  std::map<std::string, int> left_out_;
  std::map<int, std::vector<std::int64_t>> elements_of_;  // by property
};

}  // namespace

ShellMesh read_bdf(std::string_view bytes, const std::string& name, std::vector<std::string>* notes) {
  return BdfReader(bytes, name).read(notes);
}

}  // namespace quadrille
