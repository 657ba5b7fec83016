#include "mesher/io/msh_parts.hpp"

#include <algorithm>

namespace quadrille {

namespace {

constexpr int type_point = 15, type_line = 1, type_line3 = 8, type_triangle = 2, type_quad = 3,
              type_quad9 = 10, type_quad8 = 16;

/// Elements of no CAD entity belong to no physical group.
std::size_t named_count(const std::vector<CadGroup>& groups) {
  return std::count_if(groups.begin(), groups.end(), [](const CadGroup& group) { return group.number > 0; });
}

int largest_number(const std::vector<CadGroup>& groups) {
  int largest = 0;
  for (const CadGroup& group : groups) largest = std::max(largest, group.number);
  return largest;
}

}  // namespace

int msh_element_type(const ElementNodes& element, int dimension) {
  if (dimension == 0) return type_point;
  if (dimension == 1) return element.count == 3 ? type_line3 : type_line;
  switch (element.count) {
    case 3:
      return type_triangle;
    case 4:
      return type_quad;
    case 8:
      return type_quad8;
    default:
      return type_quad9;
  }
}

PhysicalNumbers::PhysicalNumbers(const OutputMesh& mesh)
    : first_{mesh.cad_face_count() + largest_number(mesh.edges()), mesh.cad_face_count(), 0} {}

void write_physical_names(const OutputMesh& mesh, const PhysicalNumbers& physical, TextWriter& out) {
  const std::vector<CadGroup>* const kinds[] = {&mesh.vertices(), &mesh.edges(), &mesh.faces()};
  constexpr const char* names[] = {"Vertex", "Edge", "Face"};
  std::size_t count = 0;
  for (const auto* groups : kinds) count += named_count(*groups);
  if (count == 0) return;
  out << "$PhysicalNames\n" << count << '\n';
  for (int dimension = 0; dimension < 3; ++dimension)
    for (const CadGroup& group : *kinds[dimension])
      if (group.number > 0)
        out << dimension << ' ' << physical.of(dimension, group.number) << " \"" << names[dimension]
            << group.number << "\"\n";
  out << "$EndPhysicalNames\n";
}

void write_msh_nodes(const OutputMesh& mesh, const ElementNodes& element, TextWriter& out) {
  for (const int node : element) out << ' ' << mesh.number(node);
  out << '\n';
}

void write_msh_point(const Vector3& point, TextWriter& out) {
  out << point.x() << ' ' << point.y() << ' ' << point.z();
}

}  // namespace quadrille
