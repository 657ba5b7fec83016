/// Nastran bulk data in fixed fields, which more programs read than free ones: 16 columns for GRID, 8 for all
/// else. Contains GRID*, CQUAD4, CQUAD8, CTRIA3, a PSHELL for each CAD face, and a SET for each CAD entity
/// in the case control. The property number of an element is its CAD face. Based on: the MSC Nastran quick
/// reference guide, "Format of bulk data entries".

#include <algorithm>
#include <charconv>
#include <string>

#include "geometry/base/error.hpp"
#include "mesher/io/writers.hpp"

namespace quadrille {

namespace {

/// The number in at most `columns` columns, with as many digits as fit.
std::string_view field_of(double value, int columns, char (&text)[40]) {
  char* end = std::to_chars(text, text + sizeof text, value).ptr;
  // A real number must have a decimal point, which to_chars leaves out when it can.
  const auto lacks_point = [&] { return std::find(text, end, '.') == end; };
  for (int digits = columns - 1; digits > 0 && end - text > columns - (lacks_point() ? 1 : 0); --digits)
    end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits).ptr;
  if (lacks_point()) {
    char* place = std::find(text, end, 'e');
    std::copy_backward(place, end, end + 1);
    *place = '.';
    ++end;
  }
  return {text, static_cast<std::size_t>(end - text)};
}

constexpr int narrow = 8, wide = 16;

void write_real(double value, TextWriter& out, int columns = wide) {
  char text[40];
  out.padded(field_of(value, columns, text), columns);
}

/// "SET 3 = 1 THRU 7,9": consecutive numbers become a range, lines stay under 72 columns.
void write_set(int set, const std::string& name, const char* of_what, const std::vector<int>& numbers,
               TextWriter& out) {
  if (numbers.empty()) return;
  out << "$ " << name << ": " << of_what << "\n";
  std::string line = "SET " + std::to_string(set) + " = ";
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    // Two consecutive numbers are written singly.
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
  mesh.for_each_group([&](int dimension, const NamedGroup& group) {
    if (dimension == 2)
      write_set(++set, group.name, "elements", mesh.element_numbers(dimension, group), out);
    else
      write_set(++set, group.name, "grids", mesh.node_numbers(dimension, group), out);
  });
}

/// Property numbers are positive: elements without a face get the number after the last face.
int property(const OutputMesh& mesh, int face) {
  return face > 0 ? face : mesh.cad_face_count() + 1;
}

/// Writes a property for each face, with material 1 and the mean thickness of the shell if that is known. The
/// file that includes this one must define the material and the unknown thicknesses.
void write_properties(const OutputMesh& mesh, TextWriter& out) {
  for (const CadGroup& group : mesh.entities(2)) {
    out << "PSHELL  ";
    out.padded(property(mesh, group.number), narrow);
    if (const double thickness = mesh.face_thickness(group.number); thickness > 0) {
      out.padded(1, narrow);
      write_real(thickness, out, narrow);
    }
    out << '\n';
  }
}

void write_element(const OutputMesh& mesh, int shell, TextWriter& out) {
  const ElementNodes element = mesh.element_nodes(2, shell);
  out << element.type().bdf << "  ";
  out.padded(shell + 1, narrow);
  out.padded(property(mesh, mesh.face(shell)), narrow);
  for (int k = 0; k < element.count; ++k) {
    if (k == 6) out << "\n+       ";
    out.padded(mesh.number(element.nodes[k]), narrow);
  }
  const std::array<double, 4> thicknesses = mesh.corner_thicknesses(shell);
  const auto [thinnest, thickest] = std::minmax_element(thicknesses.begin(), thicknesses.end());
  if (mesh.is_quad(shell) && *thinnest < *thickest) {
    // The thicknesses are on the second line; for CQUAD4 they follow two blank fields.
    if (element.count == 4) out << "\n+                       ";
    for (const double thickness : thicknesses) write_real(thickness, out, narrow);
  }
  out << '\n';
}

}  // namespace

void write_bdf(const Writing& writing, TextWriter& out) {
  const OutputMesh& mesh = writing.output;
  constexpr std::size_t largest_number = 99'999'999;  // the largest number in 8 columns
  if (mesh.nodes().size() > largest_number || static_cast<std::size_t>(mesh.shell_count()) > largest_number)
    throw failure(".bdf", "the mesh has more nodes or elements than .bdf files can number");
  out << "$ " << writing.options.title << "\nCEND\n";
  write_sets(mesh, out);
  out << "BEGIN BULK\n";
  write_properties(mesh, out);
  write_in_order(mesh.nodes().size(), out, [&](int i, TextWriter& to) {
    const Vector3& point = mesh.point(i);
    to << "GRID*   ";
    to.padded(i + 1, wide);
    to.padded("", wide);
    write_real(point.x(), to);
    write_real(point.y(), to);
    to << "\n*       ";
    write_real(point.z(), to);
    to << '\n';
  });
  write_in_order(mesh.shell_count(), out, [&](int i, TextWriter& to) { write_element(mesh, i, to); });
  out << "ENDDATA\n";
}

}  // namespace quadrille
