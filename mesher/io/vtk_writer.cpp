/// Legacy .vtk as text, version 2.0, which all readers know, unlike binary files: the shell elements with
/// their CAD face and q. Based on: the VTK User's Guide, "VTK file formats".

#include <fmt/format.h>

#include <string>

#include "mesher/io/mesh_arrays.hpp"

namespace quadrille {

namespace {

/// The name of an array as VTK writes it: special characters as % and their codes.
std::string array_name(const std::string& name) {
  std::string result;
  for (const char c : name) {
    const bool plain = c > ' ' && c < 127 && c != '"' && c != '%';
    result += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return result;
}

void write_arrays(const Writing& writing, TextWriter& out) {
  constexpr const char* types[] = {"unsigned_char", "int", "double"};
  const OutputMesh& mesh = writing.output;
  out << "CELL_DATA " << mesh.shell_count() << '\n';
  bool of_nodes = false;
  for (const MeshArray& array : mesh_arrays(writing)) {
    if (array.of_nodes && !of_nodes) out << "POINT_DATA " << mesh.nodes().size() << '\n';
    of_nodes = array.of_nodes;
    out << "SCALARS " << array_name(array.name) << ' ' << types[static_cast<int>(array.type)]
        << " 1\nLOOKUP_TABLE default\n";
    write_numbers(array, mesh, out);
  }
}

}  // namespace

void write_vtk(const Writing& writing, TextWriter& out) {
  const OutputMesh& mesh = writing.output;
  constexpr std::size_t longest_title = 255;
  const std::size_t nodes = mesh.nodes().size();
  out << "# vtk DataFile Version 2.0\n"
      << std::string_view(writing.options.title).substr(0, longest_title)
      << "\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS " << nodes << " double\n";
  write_in_order(nodes, out, [&](int i, TextWriter& to) { to << mesh.point(i) << '\n'; });
  std::size_t numbers = 0;
  for (int i = 0; i < mesh.shell_count(); ++i) numbers += 1 + mesh.element_nodes(2, i).count;
  out << "CELLS " << mesh.shell_count() << ' ' << numbers << '\n';
  write_in_order(mesh.shell_count(), out, [&](int i, TextWriter& to) {
    const ElementNodes element = mesh.element_nodes(2, i);
    to << element.count;
    for (const int node : element) to << ' ' << mesh.number(node) - 1;
    to << '\n';
  });
  out << "CELL_TYPES " << mesh.shell_count() << '\n';
  write_in_order(mesh.shell_count(), out,
                 [&](int i, TextWriter& to) { to << mesh.element_nodes(2, i).type().vtk << '\n'; });
  write_arrays(writing, out);
}

}  // namespace quadrille
