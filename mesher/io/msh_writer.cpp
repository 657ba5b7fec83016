/// Gmsh .msh, versions 2.2 and 4.1 in ASCII. Based on: the Gmsh reference manual, "MSH file format".

#include <algorithm>

#include "mesher/io/writers.hpp"

namespace quadrille {

namespace {

constexpr int type_point = 15, type_line = 1, type_line3 = 8, type_triangle = 2, type_quad = 3,
              type_quad8 = 16;

int element_type(const ElementNodes& element, int dimension) {
  if (dimension == 1) return element.count == 3 ? type_line3 : type_line;
  if (element.count == 3) return type_triangle;
  return element.count == 8 ? type_quad8 : type_quad;
}

/// Elements of no CAD entity belong to no physical group.
std::size_t named_count(const std::vector<CadGroup>& groups) {
  return std::count_if(groups.begin(), groups.end(), [](const CadGroup& group) { return group.number > 0; });
}

void write_names(const std::vector<CadGroup>& groups, int dimension, const char* kind, TextWriter& out) {
  for (const CadGroup& group : groups)
    if (group.number > 0) out << dimension << ' ' << group.number << " \"" << kind << group.number << "\"\n";
}

void write_physical_names(const OutputMesh& mesh, TextWriter& out) {
  out << "$PhysicalNames\n"
      << named_count(mesh.vertices()) + named_count(mesh.edges()) + named_count(mesh.faces()) << '\n';
  write_names(mesh.vertices(), 0, "Vertex", out);
  write_names(mesh.edges(), 1, "Edge", out);
  write_names(mesh.faces(), 2, "Face", out);
  out << "$EndPhysicalNames\n";
}

void write_node_numbers(const OutputMesh& mesh, const ElementNodes& element, TextWriter& out) {
  for (const int node : element) out << ' ' << mesh.number(node);
  out << '\n';
}

// ---- version 4.1: nodes and elements come in blocks, one a CAD entity ----

/// The blocks of one dimension: CAD entities, the one without a number under a free number at the end.
struct Entities {
  int dimension = 0;
  std::vector<CadGroup> elements;
  std::vector<std::vector<int>> nodes;  // file numbers of the nodes inside each entity
  std::vector<int> tags;
};

Entities make_entities(int dimension, const std::vector<CadGroup>& groups) {
  Entities entities{dimension, groups, std::vector<std::vector<int>>(groups.size()), {}};
  int largest = 0;
  for (const CadGroup& group : groups) largest = std::max(largest, group.number);
  for (const CadGroup& group : groups) entities.tags.push_back(group.number > 0 ? group.number : largest + 1);
  return entities;
}

ElementNodes element_nodes(const OutputMesh& mesh, int dimension, int member) {
  if (dimension == 0) return {{mesh.mesh().corners[member].node}, 1};
  return dimension == 1 ? mesh.segment_nodes(member) : mesh.shell_nodes(member);
}

/// Gives each node to the entity of lowest dimension that has it.
void claim_nodes(const OutputMesh& mesh, Entities& entities, std::vector<char>& claimed) {
  for (std::size_t i = 0; i < entities.elements.size(); ++i)
    for (const int member : entities.elements[i].members)
      for (const int node : element_nodes(mesh, entities.dimension, member)) {
        if (claimed[node]) continue;
        claimed[node] = 1;
        entities.nodes[i].push_back(mesh.number(node));
      }
}

void write_point(const Vector3& point, TextWriter& out) {
  out << point.x() << ' ' << point.y() << ' ' << point.z();
}

void write_entity(const OutputMesh& mesh, const Entities& entities, std::size_t index, TextWriter& out) {
  const CadGroup& group = entities.elements[index];
  Vector3 low = Vector3::Constant(std::numeric_limits<double>::max()), high = -low;
  for (const int member : group.members)
    for (const int node : element_nodes(mesh, entities.dimension, member)) {
      low = low.cwiseMin(mesh.mesh().points[node]);
      high = high.cwiseMax(mesh.mesh().points[node]);
    }
  out << entities.tags[index] << ' ';
  write_point(low, out);
  if (entities.dimension > 0) {
    out << ' ';
    write_point(high, out);
  }
  if (group.number > 0)
    out << " 1 " << group.number;
  else
    out << " 0";
  // The entities that bound it: not told.
  out << (entities.dimension > 0 ? " 0\n" : "\n");
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
        write_point(mesh.point(nodes[k] - 1), to);
        to << '\n';
      });
    }
  out << "$EndNodes\n";
}

/// A face's quads and triangles are blocks of their own: a block has one type.
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
        const int type = entities.dimension == 0 ? type_point : element_type(element, entities.dimension);
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
      write_node_numbers(mesh, element_nodes(mesh, block.dimension, block.members[i]), to);
    });
    number += block.members.size();
  }
  out << "$EndElements\n";
}

}  // namespace

void write_msh2(const OutputMesh& mesh, TextWriter& out) {
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  write_physical_names(mesh, out);
  out << "$Nodes\n" << mesh.nodes().size() << '\n';
  write_in_order(mesh.nodes().size(), out, [&](std::size_t i, TextWriter& to) {
    to << i + 1 << ' ';
    write_point(mesh.point(static_cast<int>(i)), to);
    to << '\n';
  });
  const ShellMesh& source = mesh.mesh();
  out << "$EndNodes\n$Elements\n"
      << source.corners.size() + source.segments.size() + mesh.shell_count() << '\n';
  std::size_t number = 0;
  // Tags: the physical group and the CAD entity, which are the same number.
  const auto begin_element = [](std::size_t element, int type, int cad, TextWriter& to) {
    to << element << ' ' << type << " 2 " << cad << ' ' << cad;
  };
  for (const ShellMesh::Corner& corner : source.corners) {
    begin_element(++number, type_point, corner.vertex, out);
    out << ' ' << mesh.number(corner.node) << '\n';
  }
  for (std::size_t i = 0; i < source.segments.size(); ++i) {
    const ElementNodes element = mesh.segment_nodes(static_cast<int>(i));
    begin_element(++number, element_type(element, 1), source.segments[i].edge, out);
    write_node_numbers(mesh, element, out);
  }
  write_in_order(mesh.shell_count(), out, [&](std::size_t i, TextWriter& to) {
    const int shell = static_cast<int>(i);
    const ElementNodes element = mesh.shell_nodes(shell);
    begin_element(number + i + 1, element_type(element, 2), mesh.face(shell), to);
    write_node_numbers(mesh, element, to);
  });
  out << "$EndElements\n";
}

void write_msh4(const OutputMesh& mesh, TextWriter& out) {
  std::vector<Entities> all{make_entities(0, mesh.vertices()), make_entities(1, mesh.edges()),
                            make_entities(2, mesh.faces())};
  std::vector<char> claimed(mesh.mesh().points.size(), 0);
  for (Entities& entities : all) claim_nodes(mesh, entities, claimed);
  out << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
  write_physical_names(mesh, out);
  out << "$Entities\n";
  for (const Entities& entities : all) out << entities.tags.size() << ' ';
  out << "0\n";
  for (const Entities& entities : all)
    for (std::size_t i = 0; i < entities.tags.size(); ++i) write_entity(mesh, entities, i, out);
  out << "$EndEntities\n";
  write_node_blocks(mesh, all, out);
  write_element_blocks(mesh, all, out);
}

}  // namespace quadrille
