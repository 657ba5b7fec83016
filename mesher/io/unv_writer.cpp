/// I-deas universal file: datasets 164 (units), 2420 (coordinate system), 2411 (nodes), 2412 (elements) and
/// 2467 (groups), as FreeCAD and Salome read them. Eight-node quads have descriptor 45 (plane stress), which
/// FreeCAD, Salome, Gmsh and ElmerGrid read; ElmerGrid does not know 95 (thin shell). Based on: the dataset
/// descriptions of the University of Cincinnati's SDRL.

#include <algorithm>
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
class Fields {
 public:
  explicit Fields(TextWriter& out) : out_(out) {}
  /// Must be called after the last number.
  void end() {
    if (count_ > 0) out_ << '\n';
    count_ = 0;
  }
  void add(int value) {
    out_.padded(value, 10);
    if (++count_ < 8) return;
    out_ << '\n';
    count_ = 0;
  }

 private:
  TextWriter& out_;
  int count_ = 0;
};

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
  Fields fields(out);
  for (const int value : {number, element.type().unv, cad, 1, 7, element.count}) fields.add(value);
  fields.end();
  if (line) out << "         0         1         1\n";
  const int corners = line ? 2 : element.count == 3 ? 3 : 4;
  for (int i = 0; i < corners; ++i) {
    fields.add(mesh.number(element.nodes[i]));
    if (corners + i < element.count) fields.add(mesh.number(element.nodes[corners + i]));
  }
  fields.end();
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
  Fields fields(out);
  for (const int value : {number, 0, 0, 0, 0, 0, 0, static_cast<int>(members.size())}) fields.add(value);
  out << name << '\n';
  for (const int member : members)
    for (const int value : {entity_type, member, 0, 0}) fields.add(value);
  fields.end();
}

void write_groups(const OutputMesh& mesh, TextWriter& out) {
  const bool named = !mesh.groups(2).empty() || !mesh.groups(1).empty() || !mesh.groups(0).empty();
  if (!named && mesh.thicknesses().empty()) return;
  begin_dataset(2467, out);
  int number = 0;
  for (const int dimension : {2, 1, 0})
    for (const NamedGroup& group : mesh.groups(dimension)) {
      std::vector<int> members = mesh.members(dimension, group);
      for (int& member : members)
        member = dimension == 0 ? mesh.number(mesh.corner_node(member))
                                : member + 1 + (dimension == 1 ? mesh.shell_count() : 0);
      write_group(++number, group.name, members, dimension == 0 ? entity_node : entity_element, out);
    }
  for (const ThicknessGroup& group : mesh.thicknesses()) {
    std::vector<int> members = group.members;
    for (int& member : members) ++member;
    write_group(++number, group.name, members, entity_element, out);
  }
  end_dataset(out);
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
