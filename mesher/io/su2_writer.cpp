/// SU2's native mesh: nodes, quads, and lines on edges as its markers. SU2 solves meshes in the plane z = 0,
/// which have two coordinates; it numbers from 0 and has no groups of quads, none of nodes and no second
/// order. Based on: the SU2 documentation, "Mesh File".

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "mesher/io/writers.hpp"

namespace quadrille {

namespace {

/// 2 if the mesh lies in the plane z = 0 but for rounding, else 3.
int dimension_of(const OutputMesh& mesh) {
  double across = 0, above = 0;
  for (const int node : mesh.nodes()) {
    const Vector3& point = mesh.position(node);
    across = std::max({across, std::abs(point.x()), std::abs(point.y())});
    above = std::max(above, std::abs(point.z()));
  }
  return above <= 1e-9 * across ? 2 : 3;
}

void write_element(const OutputMesh& mesh, const ElementNodes& element, TextWriter& out) {
  out << element.type().vtk;
  for (const int node : element) out << ' ' << mesh.number(node) - 1;
  out << '\n';
}

/// A name that SU2 reads as one word, in the mesh and in the list of a setting: MARKER_WALL= (Edge1, Edge3).
std::string marker_name(std::string name) {
  for (char& c : name)
    if (std::string_view(" ,=()%\"").find(c) != std::string_view::npos) c = '_';
  return name;
}

/// SU2 expects each line in one marker, so groups whose edges have groups of their own are left out.
void write_markers(const OutputMesh& mesh, TextWriter& out) {
  std::vector<NamedGroup> groups = mesh.groups(1);
  std::erase_if(groups, [](const NamedGroup& group) { return group.is_extra; });
  out << "NMARK= " << groups.size() << '\n';
  for (const NamedGroup& group : groups) {
    const std::vector<int> members = mesh.members(1, group);
    out << "MARKER_TAG= " << marker_name(group.name) << "\nMARKER_ELEMS= " << members.size() << '\n';
    for (const int member : members) write_element(mesh, mesh.element_nodes(1, member), out);
  }
}

}  // namespace

void write_su2(const Writing& writing, TextWriter& out) {
  const OutputMesh& mesh = writing.output;
  const int dimension = dimension_of(mesh);
  out << "% " << writing.options.title << "\nNDIME= " << dimension << '\n';
  // Nodes come first: meshio cannot find them after elements.
  out << "NPOIN= " << mesh.nodes().size() << '\n';
  write_in_order(mesh.nodes().size(), out, [&](int i, TextWriter& to) {
    const Vector3& point = mesh.point(i);
    to << point.x() << ' ' << point.y();
    if (dimension == 3) to << ' ' << point.z();
    to << '\n';
  });
  out << "NELEM= " << mesh.shell_count() << '\n';
  write_in_order(mesh.shell_count(), out,
                 [&](int i, TextWriter& to) { write_element(mesh, mesh.element_nodes(2, i), to); });
  write_markers(mesh, out);
}

}  // namespace quadrille
