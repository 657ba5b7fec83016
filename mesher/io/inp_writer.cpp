/// Abaqus / CalculiX .inp: nodes, shells, and a set for each CAD entity. Based on: the CalculiX 2.20 manual.

#include <algorithm>

#include "mesher/io/writers.hpp"

namespace quadrille {

namespace {

constexpr int numbers_per_line = 16;        // what Abaqus and CalculiX read of one line
constexpr int characters_of_a_number = 20;  // what they read of one number

void write_list(const std::vector<int>& numbers, TextWriter& out) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const bool last = i + 1 == numbers.size() || (i + 1) % numbers_per_line == 0;
    out << numbers[i] << (last ? "\n" : ", ");
  }
}

const char* element_type(const OutputMesh& mesh, bool quad) {
  if (!quad) return "S3";
  return mesh.mesh().order == 2 ? "S8R" : "S4";
}

/// The quads, or the triangles, of one face.
void write_elements(const OutputMesh& mesh, const CadGroup& group, bool quads, TextWriter& out) {
  const auto is_wanted = [&](int shell) { return mesh.is_quad(shell) == quads; };
  if (std::none_of(group.members.begin(), group.members.end(), is_wanted)) return;
  out << "*ELEMENT, TYPE=" << element_type(mesh, quads) << ", ELSET=";
  if (group.number > 0)
    out << "Face" << group.number << '\n';
  else
    out << "Eother\n";
  write_in_order(group.members.size(), out, [&](std::size_t i, TextWriter& to) {
    const int shell = group.members[i];
    if (!is_wanted(shell)) return;
    to << shell + 1;
    for (const int node : mesh.shell_nodes(shell)) to << ", " << mesh.number(node);
    to << '\n';
  });
}

void write_all_elements_set(const OutputMesh& mesh, TextWriter& out) {
  out << "*ELSET, ELSET=Eall\n";
  for (const CadGroup& group : mesh.faces()) {
    if (group.number > 0)
      out << "Face" << group.number << '\n';
    else
      out << "Eother\n";
  }
}

void write_node_set(const char* kind, int cad, const std::vector<int>& numbers, TextWriter& out) {
  if (cad <= 0) return;
  out << "*NSET, NSET=" << kind << cad << '\n';
  write_list(numbers, out);
}

/// A set and a section for each thickness. Whoever includes the file defines the material before.
void write_sections(const OutputMesh& mesh, TextWriter& out) {
  for (const ThicknessGroup& group : mesh.thicknesses()) {
    out << "*ELSET, ELSET=" << group.name << '\n';
    for (const int face : group.faces) out << "Face" << face << '\n';
    out << "*SHELL SECTION, ELSET=" << group.name << ", MATERIAL=Material\n" << group.thickness << '\n';
  }
}

}  // namespace

void write_inp(const OutputMesh& mesh, const WriteOptions& options, TextWriter& out) {
  // What opens with an asterisk would be a card, not a heading.
  const bool like_card = options.title.find_first_not_of(' ') == options.title.find('*');
  out << "*HEADING\n" << (like_card ? "Title: " : "") << options.title << '\n';
  out << "*NODE, NSET=Nall\n";
  write_in_order(mesh.nodes().size(), out, [&](std::size_t i, TextWriter& to) {
    to << i + 1;
    for (const double coordinate : mesh.point(static_cast<int>(i))) {
      to << ", ";
      to.within(coordinate, characters_of_a_number);
    }
    to << '\n';
  });
  for (const CadGroup& group : mesh.faces()) {
    write_elements(mesh, group, true, out);
    write_elements(mesh, group, false, out);
  }
  write_all_elements_set(mesh, out);
  for (const CadGroup& group : mesh.faces())
    write_node_set("Face", group.number, mesh.shell_node_numbers(group), out);
  for (const CadGroup& group : mesh.edges())
    write_node_set("Edge", group.number, mesh.segment_node_numbers(group), out);
  for (const CadGroup& group : mesh.vertices()) {
    std::vector<int> numbers;
    for (const int corner : group.members) numbers.push_back(mesh.number(mesh.mesh().corners[corner].node));
    write_node_set("Vertex", group.number, numbers, out);
  }
  // The side that the element normals point to.
  for (const CadGroup& group : mesh.faces())
    if (group.number > 0)
      out << "*SURFACE, NAME=Surface_Face" << group.number << ", TYPE=ELEMENT\nFace" << group.number
          << ", SPOS\n";
  write_sections(mesh, out);
}

}  // namespace quadrille
