/// Abaqus / CalculiX .inp: nodes, shells, and a set for each CAD entity. Based on: the CalculiX 2.20 manual.

#include <algorithm>
#include <array>

#include "mesher/io/segment_sides.hpp"
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
  return mesh.order() == 2 ? "S8R" : "S4";
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

/// Sets of the elements that have their first side on an edge, their second, and so on: Edge7_Side1 takes the
/// load EDNOR1. Where elements on both sides of an edge share it, those of the first face have it: a load on
/// all four sets is one load.
void write_side_sets(const OutputMesh& mesh, TextWriter& out) {
  std::vector<std::array<std::vector<int>, 4>> of_segments(mesh.edges().size());
  std::vector<std::size_t> place(mesh.segment_count());
  for (std::size_t i = 0; i < mesh.edges().size(); ++i) {
    for (const int segment : mesh.edges()[i].members) place[segment] = i;
  }
  int last = -1;
  for (const SegmentSide& side : segment_sides(mesh)) {
    if (side.segment != last) of_segments[place[side.segment]][side.side].push_back(side.shell + 1);
    last = side.segment;
  }
  for (std::size_t i = 0; i < of_segments.size(); ++i) {
    for (int side = 0; side < 4 && mesh.edges()[i].number > 0; ++side) {
      std::vector<int>& elements = of_segments[i][side];
      if (elements.empty()) continue;
      std::sort(elements.begin(), elements.end());
      out << "*ELSET, ELSET=Edge" << mesh.edges()[i].number << "_Side" << side + 1 << '\n';
      write_list(elements, out);
    }
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
  out << "*ELSET, ELSET=Eall, GENERATE\n1, " << mesh.shell_count() << ", 1\n";
  for (const CadGroup& group : mesh.faces())
    write_node_set("Face", group.number, mesh.shell_node_numbers(group), out);
  for (const CadGroup& group : mesh.edges())
    write_node_set("Edge", group.number, mesh.segment_node_numbers(group), out);
  for (const CadGroup& group : mesh.vertices())
    write_node_set("Vertex", group.number, mesh.corner_node_numbers(group), out);
  write_side_sets(mesh, out);
  // The side that the element normals point to.
  for (const CadGroup& group : mesh.faces())
    if (group.number > 0)
      out << "*SURFACE, NAME=Surface_Face" << group.number << ", TYPE=ELEMENT\nFace" << group.number
          << ", SPOS\n";
  write_sections(mesh, out);
}

}  // namespace quadrille
