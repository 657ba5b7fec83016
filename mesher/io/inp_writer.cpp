/// Abaqus / CalculiX .inp: nodes, shells, and a set for each CAD entity. Based on: the CalculiX 2.20 manual.

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <string>

#include <fmt/format.h>

#include "geometry/base/error.hpp"
#include "geometry/base/text_parts.hpp"
#include "mesher/io/plane_mesh.hpp"
#include "mesher/io/segment_sides.hpp"
#include "mesher/io/writers.hpp"

namespace quadrille {

namespace {

constexpr int numbers_per_line = 16;        // numbers that Abaqus and CalculiX read per line
constexpr int characters_of_a_number = 20;  // characters that they read per number

/// \param kind ELSET or NSET \param name with parameters that follow it
void write_set(std::string_view kind, std::string_view name, const std::vector<int>& numbers,
               TextWriter& out) {
  out << '*' << kind << ", " << kind << '=' << name << '\n';
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const bool last = i + 1 == numbers.size() || (i + 1) % numbers_per_line == 0;
    out << numbers[i] << (last ? "\n" : ", ");
  }
}

/// The type of the quads, or that of the same family for triangles.
std::string element_type(const OutputMesh& mesh, InpElement element, bool quad) {
  const bool shell = family_of(element) == InpFamily::shell;
  if (!quad) return shell ? "S3" : std::string(name_of(element).substr(0, 3)) + '3';
  if (element == InpElement::shell) return mesh.order() == 2 ? "S8R" : "S4";
  return std::string(name_of(element));
}

/// Whether nodes are already the set of a face or edge with the same name: files of other formats may have a
/// group of elements and a group of its nodes under one name.
bool is_written_already(const OutputMesh& mesh, const NamedGroup& nodes) {
  for (const int other : {2, 1})
    for (const NamedGroup& group : mesh.groups(other))
      if (group.name == nodes.name && mesh.node_numbers(other, group) == mesh.node_numbers(0, nodes))
        return true;
  return false;
}

/// The names of OutputMesh::groups(), by dimension; empty for those that are written already.
using SetNames = std::array<std::vector<std::string>, 3>;

/// Names for Abaqus and CalculiX, which ignore case and tell sets of one kind apart only by their names.
SetNames set_names(const OutputMesh& mesh) {
  constexpr std::size_t longest = 70;  // of 80, with room for a suffix
  SetNames names;
  std::set<std::string> taken{"NALL", "EALL", "EOTHER"};
  for (const int dimension : {2, 1, 0})
    for (const NamedGroup& group : mesh.groups(dimension)) {
      std::string& free = names[dimension].emplace_back();
      if (dimension == 0 && is_written_already(mesh, group)) continue;
      std::string name = group.name.substr(0, longest);
      for (char& c : name)
        if (std::isspace(static_cast<unsigned char>(c)) || c == ',' || c == '=' || c == '"' || c == '*')
          c = '_';
      free = name;
      for (int i = 2; !taken.insert(upper(free)).second; ++i) free = name + '_' + std::to_string(i);
    }
  return names;
}

/// Writes the quads, or the triangles, of one face. \param set name of their set; empty = none.
void write_elements(const OutputMesh& mesh, InpElement element, const CadGroup& group, bool quads,
                    const std::string& set, TextWriter& out) {
  const auto is_wanted = [&](int shell) { return mesh.is_quad(shell) == quads; };
  if (std::none_of(group.members.begin(), group.members.end(), is_wanted)) return;
  out << "*ELEMENT, TYPE=" << element_type(mesh, element, quads);
  if (!set.empty()) out << ", ELSET=" << set;
  out << '\n';
  write_in_order(group.members.size(), out, [&](int i, TextWriter& to) {
    const int shell = group.members[i];
    if (!is_wanted(shell)) return;
    to << shell + 1;
    for (const int node : mesh.element_nodes(2, shell)) to << ", " << mesh.number(node);
    to << '\n';
  });
}

/// Writes the elements, with the sets that consist of one face; then the other sets.
void write_element_sets(const OutputMesh& mesh, InpElement type, const SetNames& names, TextWriter& out) {
  const std::vector<NamedGroup>& groups = mesh.groups(2);
  std::vector<char> written(groups.size(), 0);
  for (const CadGroup& face : mesh.entities(2)) {
    std::string set = face.number > 0 ? "" : "Eother";
    for (std::size_t i = 0; i < groups.size() && set.empty(); ++i) {
      if (written[i] || groups[i].entities != std::vector<int>{face.number}) continue;
      set = names[2][i];
      written[i] = 1;
    }
    write_elements(mesh, type, face, true, set, out);
    write_elements(mesh, type, face, false, set, out);
  }
  out << "*ELSET, ELSET=Eall, GENERATE\n1, " << mesh.shell_count() << ", 1\n";
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (written[i] || mesh.members(2, groups[i]).empty()) continue;
    write_set("ELSET", names[2][i], mesh.element_numbers(2, groups[i]), out);
  }
}

/// Writes sets of the elements whose first side lies on an edge, whose second side does, and so on: the load
/// EDNOR1 is for Edge7_Side1. If several elements share a segment, only the first is in a set, so that a
/// load on all four sets is applied once. Sides of plane and axisymmetric elements can be loaded by pressure,
/// so these also get a surface for each edge.
void write_side_sets(const OutputMesh& mesh, InpElement type, const SetNames& names, TextWriter& out) {
  std::vector<std::array<int, 4>> elements(mesh.count(1), {0, 0, 0, 0});  // from 1; 0 = none
  int last = -1;
  for (const SegmentSide& side : segment_sides(mesh)) {
    if (side.segment != last) elements[side.segment][side.side] = side.shell + 1;
    last = side.segment;
  }
  const std::vector<NamedGroup>& groups = mesh.groups(1);
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const std::vector<int> segments = mesh.members(1, groups[i]);
    std::string surface;
    for (int side = 0; side < 4; ++side) {
      std::vector<int> set;
      for (const int segment : segments)
        if (elements[segment][side] > 0) set.push_back(elements[segment][side]);
      if (set.empty()) continue;
      std::sort(set.begin(), set.end());
      const std::string name = fmt::format("{}_Side{}", names[1][i], side + 1);
      write_set("ELSET", name, set, out);
      surface += fmt::format("{}, S{}\n", name, side + 1);
    }
    if (lies_in_plane(type) && !surface.empty())
      out << "*SURFACE, NAME=Surface_" << names[1][i] << ", TYPE=ELEMENT\n" << surface;
  }
}

void write_node_sets(const OutputMesh& mesh, const SetNames& names, TextWriter& out) {
  for (const int dimension : {2, 1, 0})
    for (std::size_t i = 0; i < mesh.groups(dimension).size(); ++i) {
      const std::vector<int> nodes = mesh.node_numbers(dimension, mesh.groups(dimension)[i]);
      if (!nodes.empty() && !names[dimension][i].empty()) write_set("NSET", names[dimension][i], nodes, out);
    }
}

/// Writes a surface for each set of elements. SPOS is the side to which the element normals point.
void write_surfaces(const OutputMesh& mesh, const SetNames& names, TextWriter& out) {
  for (std::size_t i = 0; i < mesh.groups(2).size(); ++i) {
    if (mesh.members(2, mesh.groups(2)[i]).empty()) continue;
    out << "*SURFACE, NAME=Surface_" << names[2][i] << ", TYPE=ELEMENT\n" << names[2][i] << ", SPOS\n";
  }
}

/// The card of an element's section. CalculiX 2.20 takes the thickness of plane elements by *SOLID SECTION,
/// which for axisymmetric ones has none.
const char* section_card(InpFamily family) {
  if (family == InpFamily::shell) return "*SHELL SECTION";
  return family == InpFamily::membrane ? "*MEMBRANE SECTION" : "*SOLID SECTION";
}

/// CalculiX 2.20 stops at *MEMBRANE SECTION with NODAL THICKNESS.
void check_membrane(const OutputMesh& mesh, InpElement element) {
  if (family_of(element) != InpFamily::membrane) return;
  for (const ThicknessGroup& group : mesh.thicknesses())
    if (group.varies)
      throw usage_error(
          "element",
          fmt::format("`element` {} needs a constant thickness, and that of Face{} varies: choose a shell",
                      name_of(element), group.entities.front()));
}

/// Writes a set and a section for each thickness; varying thicknesses are given at the nodes. A file that
/// includes this one must define the material first.
void write_sections(const OutputMesh& mesh, InpElement type, TextWriter& out) {
  const InpFamily family = family_of(type);
  const bool is_thick = family != InpFamily::axisymmetric;
  for (const ThicknessGroup& group : mesh.thicknesses()) {
    const bool has_faces = !mesh.groups(2).empty();  // sets of faces were asked for
    write_set("ELSET", group.name, has_faces ? std::vector<int>() : mesh.element_numbers(2, group), out);
    for (const int face : group.entities)
      if (has_faces) out << "Face" << face << '\n';
    out << section_card(family) << ", ELSET=" << group.name << ", MATERIAL=Material"
        << (group.varies && is_thick ? ", NODAL THICKNESS\n" : "\n");
    if (is_thick) out << group.thickness << '\n';
  }
  if (!is_thick) return;
  const auto nodes = mesh.node_thicknesses();
  if (!nodes.empty()) out << "*NODAL THICKNESS\n";
  for (const auto& [node, thickness] : nodes) out << node << ", " << fmt::format("{:.6g}\n", thickness);
}

/// \param comment a line for readers of the file; empty = none.
void write_text(const OutputMesh& mesh, const WriteOptions& options, const std::string& comment,
                TextWriter& out) {
  check_membrane(mesh, options.element);
  // A title that starts with an asterisk would be read as a keyword.
  const bool like_card = options.title.find_first_not_of(' ') == options.title.find('*');
  out << "*HEADING\n" << (like_card ? "Title: " : "") << options.title << '\n';
  if (!comment.empty()) out << "** " << comment << '\n';
  out << "*NODE, NSET=Nall\n";
  write_in_order(mesh.nodes().size(), out, [&](int i, TextWriter& to) {
    to << i + 1;
    for (const double coordinate : mesh.point(i)) {
      to << ", ";
      to.within(coordinate, characters_of_a_number);
    }
    to << '\n';
  });
  const SetNames names = set_names(mesh);
  write_element_sets(mesh, options.element, names, out);
  write_node_sets(mesh, names, out);
  write_side_sets(mesh, options.element, names, out);
  // Plane and axisymmetric elements are loaded on their sides.
  if (!lies_in_plane(options.element)) write_surfaces(mesh, names, out);
  write_sections(mesh, options.element, out);
}

}  // namespace

void write_inp(const Writing& writing, TextWriter& out) {
  const WriteOptions& options = writing.options;
  if (!lies_in_plane(options.element)) return write_text(writing.output, options, "", out);
  const PlaneMesh plane = in_plane(writing.mesh, options.element, writing.path.string());
  write_text(OutputMesh(plane.mesh, options.groups), options, plane.turn, out);
}

}  // namespace quadrille
