/// Nastran bulk data in free format: GRID*, CQUAD4, CQUAD8, CTRIA3, with a SET for each CAD entity in the
/// case control. The property number of an element is its CAD face.

#include <algorithm>
#include <charconv>
#include <string>

#include "mesher/io/writers.hpp"

namespace quadrille {

namespace {

/// The number in at most 16 columns, the widest field of the format, with as many digits as fit.
std::string_view field16(double value, char (&text)[40]) {
  constexpr int columns = 16;
  char* end = std::to_chars(text, text + sizeof text, value).ptr;
  // A real number must have a point, which to_chars leaves out where it can.
  const auto lacks_point = [&] { return std::find(text, end, '.') == end; };
  for (int digits = columns - 1; end - text > columns - (lacks_point() ? 1 : 0); --digits)
    end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits).ptr;
  if (lacks_point()) {
    char* place = std::find(text, end, 'e');
    std::copy_backward(place, end, end + 1);
    *place = '.';
    ++end;
  }
  return {text, static_cast<std::size_t>(end - text)};
}

void write_real(double value, TextWriter& out) {
  char text[40];
  out << field16(value, text);
}

/// "SET 3 = 1 THRU 7, 9": consecutive numbers are joined, lines stay under 72 columns.
void write_set(int set, const char* kind, int cad, const char* of_what, const std::vector<int>& numbers,
               TextWriter& out) {
  out << "$ " << kind << cad << ": " << of_what << "\n";
  std::string line = "SET " + std::to_string(set) + " = ";
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    // Two neighbours are no range.
    if (last < i + 2) last = i;
    std::string item = std::to_string(numbers[i]);
    if (last > i) item += " THRU " + std::to_string(numbers[last]);
    if (last + 1 < numbers.size()) item += ",";
    if (line.size() + item.size() > 70) {
      out << line << '\n';
      line = "     ";
    }
    line += item;
    i = last + 1;
  }
  out << line << '\n';
}

void write_sets(const OutputMesh& mesh, TextWriter& out) {
  int set = 0;
  for (const CadGroup& group : mesh.faces()) {
    std::vector<int> numbers;
    for (const int shell : group.members) numbers.push_back(shell + 1);
    if (group.number > 0) write_set(++set, "Face", group.number, "elements", numbers, out);
  }
  for (const CadGroup& group : mesh.edges())
    if (group.number > 0)
      write_set(++set, "Edge", group.number, "grids", mesh.segment_node_numbers(group), out);
  for (const CadGroup& group : mesh.vertices()) {
    std::vector<int> numbers;
    for (const int corner : group.members) numbers.push_back(mesh.number(mesh.mesh().corners[corner].node));
    if (group.number > 0) write_set(++set, "Vertex", group.number, "grids", numbers, out);
  }
}

const char* card(const ElementNodes& element) {
  if (element.count == 3) return "CTRIA3";
  return element.count == 8 ? "CQUAD8" : "CQUAD4";
}

}  // namespace

void write_bdf(const OutputMesh& mesh, const WriteOptions& options, TextWriter& out) {
  out << "$ " << options.title << "\nCEND\n";
  write_sets(mesh, out);
  out << "BEGIN BULK\n";
  write_in_order(mesh.nodes().size(), out, [&](std::size_t i, TextWriter& to) {
    const Vector3& point = mesh.point(static_cast<int>(i));
    to << "GRID*," << i + 1 << ",,";
    write_real(point.x(), to);
    to << ',';
    write_real(point.y(), to);
    to << "\n*,";
    write_real(point.z(), to);
    to << '\n';
  });
  write_in_order(mesh.shell_count(), out, [&](std::size_t i, TextWriter& to) {
    const int shell = static_cast<int>(i);
    const ElementNodes element = mesh.shell_nodes(shell);
    // A property number is positive; elements of no face share the number after the largest.
    const int property = mesh.face(shell) > 0 ? mesh.face(shell) : mesh.faces().back().number + 1;
    to << card(element) << ',' << shell + 1 << ',' << std::max(property, 1);
    for (int k = 0; k < element.count; ++k) to << (k == 6 ? "\n," : ",") << mesh.number(element.nodes[k]);
    to << '\n';
  });
  out << "ENDDATA\n";
}

}  // namespace quadrille
