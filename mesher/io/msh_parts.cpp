/// Element types, node order, physical groups and points, formatted alike for versions 2.2 and 4.1.

#include "mesher/io/msh_parts.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace quadrille {

namespace {

constexpr int type_point = 15, type_line = 1, type_line3 = 8, type_triangle = 2, type_quad = 3,
              type_quad9 = 10, type_quad8 = 16;

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

ElementNodes element_nodes(const OutputMesh& mesh, int dimension, int member) {
  if (dimension == 0) return {{mesh.corner_node(member)}, 1};
  return dimension == 1 ? mesh.segment_nodes(member) : mesh.shell_nodes(member);
}

PhysicalNumbers::PhysicalNumbers(const OutputMesh& mesh, bool several) {
  const int first[] = {mesh.cad_face_count() + largest_number(mesh.edges()), mesh.cad_face_count(), 0};
  const int last_entity = first[0] + largest_number(mesh.vertices());
  int last = mesh.groups_were_read() ? 0 : last_entity;
  for (int dimension = 0; dimension < 3; ++dimension)
    for (const NamedGroup& group : mesh.groups(dimension)) last = std::max(last, group.number);
  for (const int dimension : {2, 1, 0}) {
    for (const NamedGroup& group : mesh.groups(dimension)) {
      if (group.is_extra && !several) {
        numbers_[dimension].push_back(0);
        continue;
      }
      int number = group.number;
      if (!mesh.groups_were_read() && !group.is_extra) number = first[dimension] + group.entities.front();
      if (number == 0) number = ++last;
      numbers_[dimension].push_back(number);
      for (const int entity : group.entities) of_entities_[dimension][entity].push_back(number);
    }
  }
  last = std::max(last, last_entity);
  for (const ThicknessGroup& group : mesh.thicknesses()) {
    if (!several) break;
    of_thicknesses_.push_back(++last);
    for (const int face : group.faces) of_entities_[2][face].push_back(last);
  }
  for (const int dimension : {2, 1, 0}) {
    for (auto& [entity, numbers] : of_entities_[dimension]) std::sort(numbers.begin(), numbers.end());
  }
}

std::span<const int> PhysicalNumbers::of_entity(int dimension, int cad) const {
  const auto found = of_entities_[dimension].find(cad);
  return found == of_entities_[dimension].end() ? std::span<const int>() : found->second;
}

void write_physical_names(const OutputMesh& mesh, const PhysicalNumbers& physical, TextWriter& out) {
  const auto each = [&](auto&& visit) {
    for (int dimension = 0; dimension < 3; ++dimension) {
      const std::vector<NamedGroup>& groups = mesh.groups(dimension);
      for (std::size_t i = 0; i < groups.size(); ++i)
        if (groups[i].has_name && physical.of_group(dimension, i) > 0)
          visit(dimension, physical.of_group(dimension, i), groups[i].name);
    }
    for (std::size_t i = 0; i < physical.of_thicknesses().size(); ++i)
      visit(2, physical.of_thicknesses()[i], mesh.thicknesses()[i].name);
  };
  std::size_t count = 0;
  each([&](int, int, const std::string&) { ++count; });
  if (count == 0) return;
  out << "$PhysicalNames\n" << count << '\n';
  each([&](int dimension, int number, const std::string& name) {
    out << dimension << ' ' << number << " \"" << name << "\"\n";
  });
  out << "$EndPhysicalNames\n";
}

void write_periodic(const OutputMesh& mesh, bool version4, TextWriter& out) {
  std::vector<ShellMesh::Match> matches = mesh.matches();
  // Without groups of edges the file has no edges.
  std::erase_if(matches,
                [&](const auto& match) { return match.dimension == 1 && mesh.segment_count() == 0; });
  if (matches.empty()) return;
  out << "$Periodic\n" << matches.size() << '\n';
  for (const ShellMesh::Match& match : matches) {
    out << match.dimension << ' ' << match.entities[1] << ' ' << match.entities[0] << '\n';
    const Eigen::Matrix4d matrix = match.motion.matrix();
    out << (version4 ? "16" : "Affine");
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column) out << fmt::format(" {}", matrix(row, column));
    out << '\n' << match.nodes.size() << '\n';
    for (const auto& [from, to] : match.nodes) out << mesh.number(to) << ' ' << mesh.number(from) << '\n';
  }
  out << "$EndPeriodic\n";
}

void write_msh_nodes(const OutputMesh& mesh, const ElementNodes& element, TextWriter& out) {
  for (const int node : element) out << ' ' << mesh.number(node);
  out << '\n';
}

void write_msh_point(const Vector3& point, TextWriter& out) {
  out << point.x() << ' ' << point.y() << ' ' << point.z();
}

}  // namespace quadrille
