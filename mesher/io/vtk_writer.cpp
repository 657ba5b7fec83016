/// Legacy .vtk as text, version 2.0 of the format, which all readers know, binary ones not: the shell
/// elements with their CAD face and q. Based on: the VTK User's Guide, "VTK file formats".

#include <algorithm>

#include "mesher/io/writers.hpp"

namespace quadrille {

namespace {

int cell_type(const ElementNodes& element) {
  switch (element.count) {
    case 3:
      return 5;  // VTK_TRIANGLE
    case 4:
      return 9;  // VTK_QUAD
    case 8:
      return 23;  // VTK_QUADRATIC_QUAD
    default:
      return 28;  // VTK_BIQUADRATIC_QUAD
  }
}

/// One line a shell element.
template <class Write>
void write_lines(const OutputMesh& mesh, TextWriter& out, Write write) {
  write_in_order(mesh.shell_count(), out, [&](std::size_t i, TextWriter& to) {
    write(static_cast<int>(i), to);
    to << '\n';
  });
}

}  // namespace

void write_vtk(const OutputMesh& mesh, const WriteOptions& options, const std::vector<double>& qualities,
               TextWriter& out) {
  constexpr std::size_t longest_title = 255;
  const std::size_t nodes = mesh.nodes().size();
  out << "# vtk DataFile Version 2.0\n"
      << std::string_view(options.title).substr(0, longest_title)
      << "\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS " << nodes << " double\n";
  write_in_order(nodes, out, [&](std::size_t i, TextWriter& to) {
    const Vector3& point = mesh.point(static_cast<int>(i));
    to << point.x() << ' ' << point.y() << ' ' << point.z() << '\n';
  });
  std::size_t numbers = 0;
  for (int i = 0; i < mesh.shell_count(); ++i) numbers += 1 + mesh.shell_nodes(i).count;
  out << "CELLS " << mesh.shell_count() << ' ' << numbers << '\n';
  write_lines(mesh, out, [&](int shell, TextWriter& to) {
    const ElementNodes element = mesh.shell_nodes(shell);
    to << element.count;
    for (const int node : element) to << ' ' << mesh.number(node) - 1;
  });
  out << "CELL_TYPES " << mesh.shell_count() << '\n';
  write_lines(mesh, out, [&](int shell, TextWriter& to) { to << cell_type(mesh.shell_nodes(shell)); });
  out << "CELL_DATA " << mesh.shell_count() << "\nSCALARS face int 1\nLOOKUP_TABLE default\n";
  write_lines(mesh, out, [&](int shell, TextWriter& to) { to << mesh.face(shell); });
  out << "SCALARS q double 1\nLOOKUP_TABLE default\n";
  write_lines(mesh, out,
              [&](int shell, TextWriter& to) { to << (mesh.is_quad(shell) ? qualities[shell] : 0.0); });
  if (mesh.thicknesses().empty()) return;
  out << "SCALARS thickness double 1\nLOOKUP_TABLE default\n";
  write_lines(mesh, out, [&](int shell, TextWriter& to) { to << mean_thickness(mesh, shell); });
}

}  // namespace quadrille
