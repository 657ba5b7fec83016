/// Chooses the reader by the ending: .vtu goes to VTK's module, everything else is read as .frd of CalculiX.
/// Based on: CalculiX CrunchiX/GraphiX manuals, "Result Format". Fields have fixed widths, so
/// numbers may touch each other.

#include "mesher/io/result_reader.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include <fmt/format.h>

#include "geometry/base/error.hpp"
#include "geometry/base/file_access.hpp"
#include "mesher/io/modules.hpp"
#include "mesher/io/readers.hpp"
#include "mesher/io/text_cursor.hpp"

namespace quadrille {

namespace {

class FrdReader {
 public:
  FrdReader(std::string_view bytes, const std::string& name) : cursor_(bytes, name) {}

  SolverResult read() {
    while (next_line()) {
      const std::string_view key = field(0, 6);
      if (key == "    2C") read_nodes();
      if (key == "    3C") read_elements();
      if (key == "  100C") read_block();
    }
    if (result_.points.empty()) throw bad("holds no nodes: is it a .frd file?");
    if (result_.elements.empty()) throw bad("holds no elements");
    if (result_.displacements.empty()) throw bad("holds no displacements: request U with *NODE FILE");
    std::sort(result_.elements.begin(), result_.elements.end(),
              [](const auto& a, const auto& b) { return a.number < b.number; });
    return std::move(result_);
  }

 private:
  Error bad(const std::string& what) const {
    return failure(cursor_.name(), fmt::format("{} {}", cursor_.name(), what));
  }

  bool next_line() {
    if (cursor_.at_end()) return false;
    line_ = cursor_.line();
    return true;
  }

  std::string_view field(std::size_t start, std::size_t width) const {
    return start < line_.size() ? line_.substr(start, width) : std::string_view();
  }

  template <class Number>
  Number number(std::size_t start, std::size_t width) const {
    std::string_view text = trimmed(field(start, width));
    if (const std::optional<Number> value = parsed<Number>(text)) return *value;
    if (!text.empty() && text.front() == '+') text.remove_prefix(1);
    throw cursor_.error_before(fmt::format("'{}' is not a number", text));
  }

  /// Column where values start in the lines of the block that the current line begins, from 0: 13 or 8.
  std::size_t begin_block() {
    const std::string_view header = trimmed(line_);
    const char format = header.empty() ? ' ' : header.back();
    if (format == '2' || format == '3') throw bad("is binary: use *NODE FILE and *EL FILE, which write text");
    return format == '0' ? 8 : 13;
  }

  bool next_of_block() {
    if (!next_line()) throw bad("ends in the middle of a block");
    return field(0, 3) != " -3";
  }

  Vector3 vector(std::size_t start) const {
    Vector3 v(number<double>(start, 12), number<double>(start + 12, 12), number<double>(start + 24, 12));
    if (!v.allFinite()) throw cursor_.error_before("a value is not finite");
    return v;
  }

  void read_nodes() {
    const std::size_t start = begin_block();
    while (next_of_block()) {
      if (field(0, 3) != " -1") throw cursor_.error_before("a node was expected");
      if (!indices_.emplace(number<int>(3, start - 3), static_cast<int>(result_.points.size())).second)
        throw cursor_.error_before(fmt::format("node {} occurs twice", number<int>(3, start - 3)));
      result_.points.push_back(vector(start));
    }
  }

  int index_of(int node) const {
    const auto it = indices_.find(node);
    if (it == indices_.end()) throw cursor_.error_before(fmt::format("there is no node {}", node));
    return it->second;
  }

  void read_elements() {
    const std::size_t start = begin_block(), width = start - 3;
    while (next_of_block()) {
      if (field(0, 3) == " -1") {
        result_.elements.push_back({number<int>(3, width), number<int>(start, 5), {}});
      } else if (field(0, 3) == " -2" && !result_.elements.empty()) {
        for (std::size_t at = 3; at < line_.size(); at += width)
          result_.elements.back().nodes.push_back(index_of(number<int>(at, width)));
      } else {
        throw cursor_.error_before("an element was expected");
      }
    }
  }

  /// Reads values at nodes: later displacements replace earlier ones, so those of the last step remain.
  void read_block() {
    const std::size_t start = begin_block();
    bool wanted = false;
    std::vector<Vector3> values;
    while (next_of_block()) {
      const std::string_view key = field(0, 3);
      if (key == " -4") wanted = field(5, 8).substr(0, 4) == "DISP";
      if (!wanted || key != " -1") continue;
      if (values.empty()) values.assign(result_.points.size(), Vector3::Constant(missing));
      values[index_of(number<int>(3, start - 3))] = vector(start);
    }
    if (values.empty()) return;
    for (const Vector3& value : values) {
      if (std::isnan(value.x())) throw bad("lacks the displacements of some nodes");
    }
    result_.displacements = std::move(values);
  }

  static constexpr double missing = std::numeric_limits<double>::quiet_NaN();
  TextCursor cursor_;
  std::string_view line_;
  std::unordered_map<int, int> indices_;
  SolverResult result_;
};

}  // namespace

SolverResult read_frd(std::string_view bytes, const std::string& name) {
  return FrdReader(bytes, name).read();
}

SolverResult read_result(const std::filesystem::path& path) {
  const std::string name = path.string();
  if (lower_ending(path) == ".vtu") {
    try {
      return vtk_result(name);
    } catch (const Error& problem) {
      throw failure(name, fmt::format("{}: {}", name, problem.what()));
    }
  }
  return read_frd(whole_file(path), name);
}

}  // namespace quadrille
