/// Legacy .vtk as text, version 2.0, which all readers know, unlike binary files: the shell elements with
/// their CAD face and q. Based on: the VTK User's Guide, "VTK file formats".

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "mesher/io/writers.hpp"
#include "mesher/mesh/quality.hpp"

namespace quadrille {

namespace {

/// Writes one line per shell element.
template <class Write>
void write_lines(const OutputMesh& mesh, TextWriter& out, Write write) {
  write_in_order(mesh.shell_count(), out, [&](std::size_t i, TextWriter& to) {
    write(static_cast<int>(i), to);
    to << '\n';
  });
}

/// The name of an array as VTK writes it: special characters as % and their codes.
std::string array_name(const std::string& name) {
  std::string result;
  for (const char c : name) {
    const bool plain = c > ' ' && c < 127 && c != '"' && c != '%';
    result += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return result;
}

void write_set(const std::string& name, const std::vector<char>& members, TextWriter& out) {
  out << "SCALARS " << array_name(array_of_set(name)) << " unsigned_char 1\nLOOKUP_TABLE default\n";
  for (const char member : members) out << static_cast<int>(member) << '\n';
}

/// Writes sets of shell elements, then those of segments and corners, which are not cells here, as node sets.
void write_set_arrays(const OutputMesh& mesh, TextWriter& out) {
  std::vector<std::string> of_nodes;
  for (const std::string& name : mesh.set_names()) {
    const auto has_it = [&](int dimension) {
      const auto& groups = mesh.groups(dimension);
      return std::any_of(groups.begin(), groups.end(), [&](const auto& group) { return group.name == name; });
    };
    if (has_it(2)) write_set(name, mesh.is_in_set(2, name), out);
    if (has_it(1) || has_it(0)) of_nodes.push_back(name);
  }
  if (!of_nodes.empty()) out << "POINT_DATA " << mesh.nodes().size() << '\n';
  for (const std::string& name : of_nodes) {
    std::vector<char> members(mesh.nodes().size(), 0);
    for (const int dimension : {1, 0})
      for (const NamedGroup& group : mesh.groups(dimension))
        if (group.name == name)
          for (const int number : mesh.node_numbers(dimension, group)) members[number - 1] = 1;
    write_set(name, members, out);
  }
}

}  // namespace

void write_vtk(const Writing& writing, TextWriter& out) {
  const OutputMesh& mesh = writing.output;
  const std::vector<double> qualities = quad_qualities(writing.mesh);
  constexpr std::size_t longest_title = 255;
  const std::size_t nodes = mesh.nodes().size();
  out << "# vtk DataFile Version 2.0\n"
      << std::string_view(writing.options.title).substr(0, longest_title)
      << "\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS " << nodes << " double\n";
  write_in_order(nodes, out,
                 [&](std::size_t i, TextWriter& to) { to << mesh.point(static_cast<int>(i)) << '\n'; });
  std::size_t numbers = 0;
  for (int i = 0; i < mesh.shell_count(); ++i) numbers += 1 + mesh.shell_nodes(i).count;
  out << "CELLS " << mesh.shell_count() << ' ' << numbers << '\n';
  write_lines(mesh, out, [&](int shell, TextWriter& to) {
    const ElementNodes element = mesh.shell_nodes(shell);
    to << element.count;
    for (const int node : element) to << ' ' << mesh.number(node) - 1;
  });
  out << "CELL_TYPES " << mesh.shell_count() << '\n';
  write_lines(mesh, out, [&](int shell, TextWriter& to) { to << vtk_cell_type(mesh.shell_nodes(shell)); });
  out << "CELL_DATA " << mesh.shell_count() << "\nSCALARS face int 1\nLOOKUP_TABLE default\n";
  write_lines(mesh, out, [&](int shell, TextWriter& to) { to << mesh.face(shell); });
  out << "SCALARS q double 1\nLOOKUP_TABLE default\n";
  write_lines(mesh, out,
              [&](int shell, TextWriter& to) { to << (mesh.is_quad(shell) ? qualities[shell] : 0.0); });
  if (!mesh.thicknesses().empty()) {
    out << "SCALARS thickness double 1\nLOOKUP_TABLE default\n";
    write_lines(mesh, out, [&](int shell, TextWriter& to) { to << mean_thickness(mesh, shell); });
  }
  write_set_arrays(mesh, out);
}

}  // namespace quadrille
