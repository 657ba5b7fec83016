/// Gmsh .msh in ASCII, versions 2.2 and 4.1. Based on: the Gmsh reference manual, "MSH file format".

#include <algorithm>
#include <span>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "mesher/io/segment_sides.hpp"
#include "mesher/io/writers.hpp"

namespace quadrille {

namespace {

int largest_number(const std::vector<CadGroup>& groups) {
  int largest = 0;
  for (const CadGroup& group : groups) largest = std::max(largest, group.number);
  return largest;
}

/// Numbers of physical groups. A mesh that was read keeps its numbers. Else the number of a face is its CAD
/// number; edges follow after the last face of the model, and vertices after the last edge, since several
/// programs take groups with the same number for one group, whatever their dimensions. The groups of the
/// solid's faces come next, thicknesses last.
struct PhysicalNumbers {
  /// \param several whether an element may belong to more groups than that of its CAD entity. If not,
  /// thicknesses and the solid's faces are not groups: version 2.2 would repeat the elements, which few
  /// programs accept.
  PhysicalNumbers(const OutputMesh& mesh, bool several);
  /// Numbers of the groups that a CAD face (dimension 2), edge (1) or vertex (0) belongs to, ascending.
  std::span<const int> of_entity(int dimension, int cad) const;

  std::vector<int> of_groups[3];    ///< by dimension, as OutputMesh::groups(); 0 = not a physical group
  std::vector<int> of_thicknesses;  ///< as OutputMesh::thicknesses(); empty if these are not physical groups

 private:
  std::unordered_map<int, std::vector<int>> of_entities_[3];  ///< by dimension and CAD number
};

PhysicalNumbers::PhysicalNumbers(const OutputMesh& mesh, bool several) {
  const int first[] = {mesh.cad_face_count() + largest_number(mesh.entities(1)), mesh.cad_face_count(), 0};
  const int last_entity = first[0] + largest_number(mesh.entities(0));
  int last = mesh.groups_were_read() ? 0 : last_entity;
  for (int dimension = 0; dimension < 3; ++dimension)
    for (const NamedGroup& group : mesh.groups(dimension)) last = std::max(last, group.number);
  const auto add = [&](int dimension, const NamedGroup& group, int number) {
    for (const int entity : group.entities) of_entities_[dimension][entity].push_back(number);
    return number;
  };
  for (const int dimension : {2, 1, 0}) {
    for (const NamedGroup& group : mesh.groups(dimension)) {
      int number = group.number;
      if (!mesh.groups_were_read() && !group.is_extra) number = first[dimension] + group.entities.front();
      const bool is_physical = several || !group.is_extra;
      if (number == 0 && is_physical) number = ++last;
      of_groups[dimension].push_back(is_physical ? add(dimension, group, number) : 0);
    }
  }
  last = std::max(last, last_entity);
  for (const ThicknessGroup& group : mesh.thicknesses())
    if (several) of_thicknesses.push_back(add(2, group, ++last));
  for (auto& entities : of_entities_)
    for (auto& [entity, numbers] : entities) std::sort(numbers.begin(), numbers.end());
}

std::span<const int> PhysicalNumbers::of_entity(int dimension, int cad) const {
  const auto found = of_entities_[dimension].find(cad);
  return found == of_entities_[dimension].end() ? std::span<const int>() : found->second;
}

/// Writes the section $PhysicalNames: Face3, Edge7, Vertex2. Writes nothing if there are no names.
void write_physical_names(const OutputMesh& mesh, const PhysicalNumbers& physical, TextWriter& out) {
  const auto each = [&](auto&& visit) {
    for (int dimension = 0; dimension < 3; ++dimension) {
      const std::vector<NamedGroup>& groups = mesh.groups(dimension);
      for (std::size_t i = 0; i < groups.size(); ++i)
        if (groups[i].has_name && physical.of_groups[dimension][i] > 0)
          visit(dimension, physical.of_groups[dimension][i], groups[i].name);
    }
    for (std::size_t i = 0; i < physical.of_thicknesses.size(); ++i)
      visit(2, physical.of_thicknesses[i], mesh.thicknesses()[i].name);
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

/// Writes the numbers of an element's nodes and the end of the line.
void write_msh_nodes(const OutputMesh& mesh, const ElementNodes& element, TextWriter& out) {
  for (const int node : element) out << ' ' << mesh.number(node);
  out << '\n';
}

/// A CAD entity. Members without a CAD number form an entity under a free number.
struct Entity {
  int dimension, tag;
  const CadGroup& elements;
  std::vector<int> boundary;  // signed numbers of the entities that bound it
  std::vector<int> nodes;     // file numbers of the nodes inside it
};

/// The entities by ascending dimension; each node is inside the first one that has it.
std::vector<Entity> entities_of(const OutputMesh& mesh) {
  const EntityBoundaries boundaries = entity_boundaries(mesh);
  std::vector<char> claimed(mesh.nodes().empty() ? 0 : static_cast<std::size_t>(mesh.nodes().back()) + 1, 0);
  std::vector<Entity> entities;
  for (const int dimension : {0, 1, 2}) {
    const std::vector<CadGroup>& groups = mesh.entities(dimension);
    for (std::size_t i = 0; i < groups.size(); ++i) {
      const int number = groups[i].number;
      Entity& entity = entities.emplace_back(
          Entity{dimension, number > 0 ? number : largest_number(groups) + 1, groups[i], {}, {}});
      if (dimension > 0) entity.boundary = (dimension == 1 ? boundaries.edges : boundaries.faces)[i];
      for (const int member : groups[i].members)
        for (const int node : mesh.element_nodes(dimension, member))
          if (!std::exchange(claimed[node], 1)) entity.nodes.push_back(mesh.number(node));
    }
  }
  return entities;
}

void write_list(std::span<const int> numbers, TextWriter& out) {
  out << ' ' << numbers.size();
  for (const int number : numbers) out << ' ' << number;
}

void write_entities(const OutputMesh& mesh, const std::vector<Entity>& entities,
                    const PhysicalNumbers& physical, TextWriter& out) {
  out << "$Entities\n";
  for (const int dimension : {0, 1, 2}) out << mesh.entities(dimension).size() << ' ';
  out << "0\n";
  for (const Entity& entity : entities) {
    Eigen::AlignedBox3d box;
    for (const int member : entity.elements.members)
      for (const int node : mesh.element_nodes(entity.dimension, member)) box.extend(mesh.position(node));
    out << entity.tag << ' ' << Vector3(box.min());
    if (entity.dimension > 0) out << ' ' << Vector3(box.max());
    write_list(physical.of_entity(entity.dimension, entity.elements.number), out);
    if (entity.dimension > 0) write_list(entity.boundary, out);
    out << '\n';
  }
  out << "$EndEntities\n";
}

void write_node_blocks(const OutputMesh& mesh, const std::vector<Entity>& entities, TextWriter& out) {
  const auto blocks = std::count_if(entities.begin(), entities.end(),
                                    [](const Entity& entity) { return !entity.nodes.empty(); });
  const std::size_t count = mesh.nodes().size();
  out << "$Nodes\n" << static_cast<std::size_t>(blocks) << ' ' << count << " 1 " << count << '\n';
  for (const Entity& entity : entities) {
    const std::vector<int>& nodes = entity.nodes;
    if (nodes.empty()) continue;
    out << entity.dimension << ' ' << entity.tag << " 0 " << nodes.size() << '\n';
    for (const int number : nodes) out << number << '\n';
    write_in_order(nodes.size(), out, [&](int k, TextWriter& to) { to << mesh.point(nodes[k] - 1) << '\n'; });
  }
  out << "$EndNodes\n";
}

/// Elements of one entity and one type: the quads and the triangles of a face are separate blocks.
struct ElementBlock {
  int dimension, tag, type;
  std::vector<int> members;
};

void write_element_blocks(const OutputMesh& mesh, const std::vector<Entity>& entities, TextWriter& out) {
  std::vector<ElementBlock> blocks;
  std::size_t count = 0, before = 0;
  for (const Entity& entity : entities) {
    int last_type = 0;
    for (const int member : entity.elements.members) {
      const int type = mesh.element_nodes(entity.dimension, member).type().msh;
      if (type != last_type) blocks.push_back({entity.dimension, entity.tag, type, {}});
      last_type = type;
      blocks.back().members.push_back(member);
      ++count;
    }
  }
  out << "$Elements\n" << blocks.size() << ' ' << count << " 1 " << count << '\n';
  for (const ElementBlock& block : blocks) {
    out << block.dimension << ' ' << block.tag << ' ' << block.type << ' ' << block.members.size() << '\n';
    write_in_order(block.members.size(), out, [&](int i, TextWriter& to) {
      to << before + i + 1;
      write_msh_nodes(mesh, mesh.element_nodes(block.dimension, block.members[i]), to);
    });
    before += block.members.size();
  }
  out << "$EndElements\n";
}

void write_msh2(const OutputMesh& mesh, TextWriter& out) {
  const PhysicalNumbers physical(mesh, false);
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  write_physical_names(mesh, physical, out);
  out << "$Nodes\n" << mesh.nodes().size() << '\n';
  write_in_order(mesh.nodes().size(), out,
                 [&](int i, TextWriter& to) { to << i + 1 << ' ' << mesh.point(i) << '\n'; });
  // In this version an element has one physical number, so like Gmsh this repeats the elements of a mesh that
  // was read, once for each further group.
  struct Line {
    int dimension, member;
    std::size_t group;  // index into the numbers of its entity
  };
  std::vector<Line> lines;
  for (const int dimension : {0, 1, 2}) {
    for (int i = 0; i < mesh.count(dimension); ++i) lines.push_back({dimension, i, 0});
    for (int i = 0; i < mesh.count(dimension) && mesh.groups_were_read(); ++i)
      for (std::size_t k = 1; k < physical.of_entity(dimension, mesh.entity(dimension, i)).size(); ++k)
        lines.push_back({dimension, i, k});
  }
  out << "$EndNodes\n$Elements\n" << lines.size() << '\n';
  write_in_order(lines.size(), out, [&](int i, TextWriter& to) {
    const auto& [dimension, member, group] = lines[i];
    const int entity = mesh.entity(dimension, member);
    const std::span<const int> numbers = physical.of_entity(dimension, entity);
    const ElementNodes element = mesh.element_nodes(dimension, member);
    to << i + 1 << ' ' << element.type().msh << " 2 " << (numbers.empty() ? 0 : numbers[group]) << ' '
       << entity;
    write_msh_nodes(mesh, element, to);
  });
  out << "$EndElements\n";
}

void write_msh4(const OutputMesh& mesh, TextWriter& out) {
  const PhysicalNumbers physical(mesh, true);
  const std::vector<Entity> entities = entities_of(mesh);
  out << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
  write_physical_names(mesh, physical, out);
  write_entities(mesh, entities, physical, out);
  write_node_blocks(mesh, entities, out);
  write_element_blocks(mesh, entities, out);
}

}  // namespace

void write_msh(const Writing& writing, TextWriter& out) {
  if (writing.options.msh_version == MshVersion::v4_1)
    write_msh4(writing.output, out);
  else
    write_msh2(writing.output, out);
}

}  // namespace quadrille
