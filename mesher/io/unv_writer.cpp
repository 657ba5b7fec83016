/// I-deas universal file: datasets 164 (units), 2420 (coordinate system), 2411 (nodes), 2412 (elements) and
/// 2467 (groups), as FreeCAD and Salome read them. Eight-node quads have descriptor 45 (plane stress), which
/// FreeCAD, Salome, Gmsh and ElmerGrid read; ElmerGrid does not know 95 (thin shell). Based on: the dataset
/// descriptions of the University of Cincinnati's SDRL.

#include <array>
#include <span>
#include <string>

#include "mesher/io/writers.hpp"

namespace quadrille {

namespace {

constexpr int entity_node = 7, entity_element = 8;

void begin_dataset(int number, TextWriter& out) {
  out << "    -1\n";
  out.padded(number, 6) << '\n';
}
void end_dataset(TextWriter& out) {
  out << "    -1\n";
}

/// Writes fields of the format: ten columns per number, eight numbers per line.
void write_fields(std::span<const int> numbers, TextWriter& out) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    out.padded(numbers[i], 10);
    if (i % 8 == 7 || i + 1 == numbers.size()) out << '\n';
  }
}

/// Units and the coordinate system, as FreeCAD and Salome write them. Without them, their reader searches the
/// whole file for each, which takes half of its time. It multiplies coordinates by the first factor, so the
/// units are "user defined", not those of millimeters.
void write_header(TextWriter& out) {
  begin_dataset(164, out);
  out << "         9        User defined         2\n"
         "    1.0000000000000000E+0    1.0000000000000000E+0    1.0000000000000000E+0\n"
         "    2.7314999999999998E+2\n";
  end_dataset(out);
  begin_dataset(2420, out);
  out << "         1\nquadrille\n         1         0         0\nGlobal Cartesian Coordinate System\n"
         "    1.0000000000000000E+0    0.0000000000000000E+0    0.0000000000000000E+0\n"
         "    0.0000000000000000E+0    1.0000000000000000E+0    0.0000000000000000E+0\n"
         "    0.0000000000000000E+0    0.0000000000000000E+0    1.0000000000000000E+0\n"
         "    0.0000000000000000E+0    0.0000000000000000E+0    0.0000000000000000E+0\n";
  end_dataset(out);
}

void write_nodes(const OutputMesh& mesh, TextWriter& out) {
  begin_dataset(2411, out);
  write_in_order(mesh.nodes().size(), out, [&](int i, TextWriter& to) {
    to.padded(i + 1, 10) << "         1         1        11\n";
    for (const double coordinate : mesh.point(i)) to.scientific(coordinate, 25);
    to << '\n';
  });
  end_dataset(out);
}

/// The property number is the CAD number, for readers that use it. Second-order elements list their nodes
/// around the element: corner, midside, corner, ...
void write_element(const OutputMesh& mesh, int dimension, int member, TextWriter& out) {
  const ElementNodes element = mesh.element_nodes(dimension, member);
  const bool line = dimension == 1;
  const int number = member + 1 + (line ? mesh.shell_count() : 0), cad = mesh.entity(dimension, member);
  write_fields(std::array{number, element.type().unv, cad, 1, 7, element.count}, out);
  if (line) out << "         0         1         1\n";
  const int corners = corner_count(element.type().shape);
  std::array<int, 8> around{};
  std::size_t count = 0;
  for (int i = 0; i < corners; ++i)
    for (int node = i; node < element.count; node += corners)
      around[count++] = mesh.number(element.nodes[node]);
  write_fields(std::span(around).first(count), out);
}

void write_elements(const OutputMesh& mesh, TextWriter& out) {
  begin_dataset(2412, out);
  for (const int dimension : {2, 1})
    write_in_order(mesh.count(dimension), out,
                   [&](int i, TextWriter& to) { write_element(mesh, dimension, i, to); });
  end_dataset(out);
}

/// \param members numbers of elements, or of nodes
void write_group(int number, const std::string& name, const std::vector<int>& members, int entity_type,
                 TextWriter& out) {
  write_fields(std::array{number, 0, 0, 0, 0, 0, 0, static_cast<int>(members.size())}, out);
  out << name << '\n';
  std::vector<int> fields;
  for (const int member : members) fields.insert(fields.end(), {entity_type, member, 0, 0});
  write_fields(fields, out);
}

void write_groups(const OutputMesh& mesh, TextWriter& out) {
  int number = 0;
  mesh.for_each_group([&](int dimension, const NamedGroup& group) {
    if (++number == 1) begin_dataset(2467, out);
    if (dimension == 0)
      write_group(number, group.name, mesh.node_numbers(dimension, group), entity_node, out);
    else
      write_group(number, group.name, mesh.element_numbers(dimension, group), entity_element, out);
  });
  if (number > 0) end_dataset(out);
}

}  // namespace

void write_unv(const Writing& writing, TextWriter& out) {
  const OutputMesh& mesh = writing.output;
  write_header(out);
  write_nodes(mesh, out);
  write_elements(mesh, out);
  write_groups(mesh, out);
}

}  // namespace quadrille
