/// Gmsh .msh, version 2.2 in ASCII. Based on: the Gmsh reference manual, "MSH file format".

#include "mesher/io/msh_parts.hpp"
#include "mesher/io/writers.hpp"

namespace quadrille {

namespace {

/// One element: its tags are the physical group and the CAD entity.
void write_element(const OutputMesh& mesh, std::size_t number, const ElementNodes& element, int dimension,
                   std::array<int, 2> tags, TextWriter& out) {
  out << number << ' ' << msh_element_type(element, dimension) << " 2 " << tags[0] << ' ' << tags[1];
  write_msh_nodes(mesh, element, out);
}

}  // namespace

void write_msh2(const OutputMesh& mesh, TextWriter& out) {
  const PhysicalNumbers physical(mesh);
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  write_physical_names(mesh, physical, out);
  out << "$Nodes\n" << mesh.nodes().size() << '\n';
  write_in_order(mesh.nodes().size(), out, [&](std::size_t i, TextWriter& to) {
    to << i + 1 << ' ';
    write_msh_point(mesh.point(static_cast<int>(i)), to);
    to << '\n';
  });
  out << "$EndNodes\n$Elements\n" << mesh.corner_count() + mesh.segment_count() + mesh.shell_count() << '\n';
  std::size_t number = 0;
  for (int i = 0; i < mesh.corner_count(); ++i) {
    const int cad = mesh.vertex(i);
    write_element(mesh, ++number, {{mesh.corner_node(i)}, 1}, 0, {physical.of(0, cad), cad}, out);
  }
  for (int i = 0; i < mesh.segment_count(); ++i) {
    const int cad = mesh.edge(i);
    write_element(mesh, ++number, mesh.segment_nodes(i), 1, {physical.of(1, cad), cad}, out);
  }
  write_in_order(mesh.shell_count(), out, [&](std::size_t i, TextWriter& to) {
    const int shell = static_cast<int>(i), cad = mesh.face(shell);
    write_element(mesh, number + i + 1, mesh.shell_nodes(shell), 2, {physical.of(2, cad), cad}, to);
  });
  out << "$EndElements\n";
}

}  // namespace quadrille
