/// Gmsh .msh, version 4.1 in ASCII: nodes and elements come in blocks by CAD entity. Based on: the Gmsh
/// reference manual, "MSH file format".

#include <algorithm>

#include "mesher/io/msh_parts.hpp"
#include "mesher/io/segment_sides.hpp"
#include "mesher/io/writers.hpp"

namespace quadrille {

namespace {

/// The CAD entities of one dimension. Members without a CAD number form an entity under a free number.
struct Entities {
  int dimension = 0;
  std::vector<CadGroup> elements;
  std::vector<std::vector<int>> nodes;  // file numbers of the nodes inside each entity
  std::vector<int> tags;
  std::vector<std::vector<int>> boundaries;  // signed numbers of the entities that bound each entity
};

Entities make_entities(int dimension, const std::vector<CadGroup>& groups,
                       const std::vector<std::vector<int>>& boundaries) {
  Entities entities{dimension, groups, std::vector<std::vector<int>>(groups.size()), {}, boundaries};
  int largest = 0;
  for (const CadGroup& group : groups) largest = std::max(largest, group.number);
  for (const CadGroup& group : groups) entities.tags.push_back(group.number > 0 ? group.number : largest + 1);
  return entities;
}

/// Assigns each unclaimed node to the first entity that has it. Call it by ascending dimension.
void claim_nodes(const OutputMesh& mesh, Entities& entities, std::vector<char>& claimed) {
  for (std::size_t i = 0; i < entities.elements.size(); ++i)
    for (const int member : entities.elements[i].members)
      for (const int node : element_nodes(mesh, entities.dimension, member)) {
        if (claimed[node]) continue;
        claimed[node] = 1;
        entities.nodes[i].push_back(mesh.number(node));
      }
}

void write_entity(const OutputMesh& mesh, const Entities& entities, std::size_t index,
                  std::span<const int> physical, TextWriter& out) {
  const CadGroup& group = entities.elements[index];
  Eigen::AlignedBox3d box;
  for (const int member : group.members)
    for (const int node : element_nodes(mesh, entities.dimension, member)) box.extend(mesh.position(node));
  out << entities.tags[index] << ' ';
  write_msh_point(box.min(), out);
  if (entities.dimension > 0) {
    out << ' ';
    write_msh_point(box.max(), out);
  }
  out << ' ' << physical.size();
  for (const int number : physical) out << ' ' << number;
  if (entities.dimension > 0) {
    out << ' ' << entities.boundaries[index].size();
    for (const int boundary : entities.boundaries[index]) out << ' ' << boundary;
  }
  out << '\n';
}

void write_node_blocks(const OutputMesh& mesh, const std::vector<Entities>& all, TextWriter& out) {
  std::size_t blocks = 0;
  for (const Entities& entities : all)
    for (const auto& nodes : entities.nodes) blocks += !nodes.empty();
  const std::size_t count = mesh.nodes().size();
  out << "$Nodes\n" << blocks << ' ' << count << " 1 " << count << '\n';
  for (const Entities& entities : all)
    for (std::size_t i = 0; i < entities.nodes.size(); ++i) {
      const std::vector<int>& nodes = entities.nodes[i];
      if (nodes.empty()) continue;
      out << entities.dimension << ' ' << entities.tags[i] << " 0 " << nodes.size() << '\n';
      for (const int number : nodes) out << number << '\n';
      write_in_order(nodes.size(), out, [&](std::size_t k, TextWriter& to) {
        write_msh_point(mesh.point(nodes[k] - 1), to);
        to << '\n';
      });
    }
  out << "$EndNodes\n";
}

/// Elements of one entity and one type: the quads and the triangles of a face are separate blocks.
struct ElementBlock {
  int dimension, tag, type;
  std::vector<int> members;
};

std::vector<ElementBlock> element_blocks(const OutputMesh& mesh, const std::vector<Entities>& all) {
  std::vector<ElementBlock> blocks;
  for (const Entities& entities : all)
    for (std::size_t i = 0; i < entities.elements.size(); ++i) {
      int last_type = 0;
      for (const int member : entities.elements[i].members) {
        const ElementNodes element = element_nodes(mesh, entities.dimension, member);
        const int type = msh_element_type(element, entities.dimension);
        if (type != last_type) blocks.push_back({entities.dimension, entities.tags[i], type, {}});
        last_type = type;
        blocks.back().members.push_back(member);
      }
    }
  return blocks;
}

void write_element_blocks(const OutputMesh& mesh, const std::vector<Entities>& all, TextWriter& out) {
  const std::vector<ElementBlock> blocks = element_blocks(mesh, all);
  std::size_t count = 0;
  for (const ElementBlock& block : blocks) count += block.members.size();
  out << "$Elements\n" << blocks.size() << ' ' << count << " 1 " << count << '\n';
  std::size_t number = 0;
  for (const ElementBlock& block : blocks) {
    out << block.dimension << ' ' << block.tag << ' ' << block.type << ' ' << block.members.size() << '\n';
    write_in_order(block.members.size(), out, [&](std::size_t i, TextWriter& to) {
      to << number + i + 1;
      write_msh_nodes(mesh, element_nodes(mesh, block.dimension, block.members[i]), to);
    });
    number += block.members.size();
  }
  out << "$EndElements\n";
}

}  // namespace

void write_msh4(const OutputMesh& mesh, TextWriter& out) {
  const PhysicalNumbers physical(mesh, true);
  const EntityBoundaries boundaries = entity_boundaries(mesh);
  std::vector<Entities> all{make_entities(0, mesh.vertices(), {}),
                            make_entities(1, mesh.edges(), boundaries.edges),
                            make_entities(2, mesh.faces(), boundaries.faces)};
  std::vector<char> claimed(mesh.nodes().empty() ? 0 : static_cast<std::size_t>(mesh.nodes().back()) + 1, 0);
  for (Entities& entities : all) claim_nodes(mesh, entities, claimed);
  out << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
  write_physical_names(mesh, physical, out);
  out << "$Entities\n";
  for (const Entities& entities : all) out << entities.tags.size() << ' ';
  out << "0\n";
  for (const Entities& entities : all)
    for (std::size_t i = 0; i < entities.tags.size(); ++i)
      write_entity(mesh, entities, i, physical.of_entity(entities.dimension, entities.elements[i].number),
                   out);
  out << "$EndEntities\n";
  write_node_blocks(mesh, all, out);
  write_element_blocks(mesh, all, out);
  write_periodic(mesh, true, out);
}

}  // namespace quadrille
