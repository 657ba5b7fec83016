/// Gmsh .msh in ASCII, versions 2.2 and 4.1. Based on: the Gmsh reference manual, "MSH file format".

#include <algorithm>
#include <span>
#include <unordered_map>

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
class PhysicalNumbers {
 public:
  /// \param several whether an element may belong to more groups than that of its CAD entity. If not,
  /// thicknesses and the solid's faces are not groups: version 2.2 would repeat the elements, which few
  /// programs accept.
  PhysicalNumbers(const OutputMesh& mesh, bool several);
  /// Number of a group; 0 if it is not a physical group. \param group index in OutputMesh::groups(dimension).
  int of_group(int dimension, std::size_t group) const { return numbers_[dimension][group]; }
  /// Numbers of the groups OutputMesh::thicknesses(); empty if these are not physical groups.
  const std::vector<int>& of_thicknesses() const { return of_thicknesses_; }
  /// Numbers of the groups that a CAD face (dimension 2), edge (1) or vertex (0) belongs to, ascending.
  std::span<const int> of_entity(int dimension, int cad) const;

 private:
  std::vector<int> numbers_[3];                               ///< by dimension and group
  std::unordered_map<int, std::vector<int>> of_entities_[3];  ///< by dimension and CAD number
  std::vector<int> of_thicknesses_;
};

PhysicalNumbers::PhysicalNumbers(const OutputMesh& mesh, bool several) {
  const int first[] = {mesh.cad_face_count() + largest_number(mesh.entities(1)), mesh.cad_face_count(), 0};
  const int last_entity = first[0] + largest_number(mesh.entities(0));
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

/// Writes the section $PhysicalNames: Face3, Edge7, Vertex2. Writes nothing if there are no names.
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

/// Writes the numbers of an element's nodes and the end of the line.
void write_msh_nodes(const OutputMesh& mesh, const ElementNodes& element, TextWriter& out) {
  for (const int node : element) out << ' ' << mesh.number(node);
  out << '\n';
}

/// The elements of one dimension. In this version an element has one physical number, so like Gmsh this
/// repeats the elements of a mesh that was read, once for each further group.
class ElementLines {
 public:
  ElementLines(const OutputMesh& mesh, const PhysicalNumbers& physical, int dimension)
      : mesh_(mesh), physical_(physical), dimension_(dimension), count_(mesh.count(dimension)) {
    for (int i = 0; i < count_ && mesh.groups_were_read(); ++i) {
      const std::size_t groups = physical.of_entity(dimension, entity(i)).size();
      for (std::size_t k = 1; k < groups; ++k) repeated_.emplace_back(i, k);
    }
  }

  std::size_t size() const { return count_ + repeated_.size(); }

  /// \param before number of elements in the file before these.
  void write(std::size_t before, TextWriter& out) const {
    write_in_order(size(), out, [&](int line, TextWriter& to) {
      const auto [i, group] = line < count_ ? std::pair(line, std::size_t{0}) : repeated_[line - count_];
      const std::span<const int> numbers = physical_.of_entity(dimension_, entity(i));
      const ElementNodes element = mesh_.element_nodes(dimension_, i);
      to << before + line + 1 << ' ' << element.type().msh << " 2 " << (numbers.empty() ? 0 : numbers[group])
         << ' ' << entity(i);
      write_msh_nodes(mesh_, element, to);
    });
  }

 private:
  int entity(int i) const { return mesh_.entity(dimension_, i); }

  const OutputMesh& mesh_;
  const PhysicalNumbers& physical_;
  int dimension_, count_;
  std::vector<std::pair<int, std::size_t>> repeated_;  // element, index into its groups
};

/// The CAD entities of one dimension. Members without a CAD number form an entity under a free number.
struct Entities {
  int dimension = 0;
  std::vector<CadGroup> elements;
  std::vector<std::vector<int>> nodes;  // file numbers of the nodes inside each entity
  std::vector<int> tags;
  std::vector<std::vector<int>> boundaries;  // signed numbers of the entities that bound each entity
};

Entities make_entities(const OutputMesh& mesh, int dimension,
                       const std::vector<std::vector<int>>& boundaries) {
  const std::vector<CadGroup>& groups = mesh.entities(dimension);
  Entities entities{dimension, groups, std::vector<std::vector<int>>(groups.size()), {}, boundaries};
  const int largest = largest_number(groups);
  for (const CadGroup& group : groups) entities.tags.push_back(group.number > 0 ? group.number : largest + 1);
  return entities;
}

/// Assigns each unclaimed node to the first entity that has it. Call it by ascending dimension.
void claim_nodes(const OutputMesh& mesh, Entities& entities, std::vector<char>& claimed) {
  for (std::size_t i = 0; i < entities.elements.size(); ++i)
    for (const int member : entities.elements[i].members)
      for (const int node : mesh.element_nodes(entities.dimension, member)) {
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
    for (const int node : mesh.element_nodes(entities.dimension, member)) box.extend(mesh.position(node));
  out << entities.tags[index] << ' ' << Vector3(box.min());
  if (entities.dimension > 0) out << ' ' << Vector3(box.max());
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
      write_in_order(nodes.size(), out,
                     [&](int k, TextWriter& to) { to << mesh.point(nodes[k] - 1) << '\n'; });
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
        const int type = mesh.element_nodes(entities.dimension, member).type().msh;
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
    write_in_order(block.members.size(), out, [&](int i, TextWriter& to) {
      to << number + i + 1;
      write_msh_nodes(mesh, mesh.element_nodes(block.dimension, block.members[i]), to);
    });
    number += block.members.size();
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
  const ElementLines kinds[] = {{mesh, physical, 0}, {mesh, physical, 1}, {mesh, physical, 2}};
  out << "$EndNodes\n$Elements\n" << kinds[0].size() + kinds[1].size() + kinds[2].size() << '\n';
  std::size_t before = 0;
  for (const ElementLines& kind : kinds) {
    kind.write(before, out);
    before += kind.size();
  }
  out << "$EndElements\n";
}

void write_msh4(const OutputMesh& mesh, TextWriter& out) {
  const PhysicalNumbers physical(mesh, true);
  const EntityBoundaries boundaries = entity_boundaries(mesh);
  std::vector<Entities> all{make_entities(mesh, 0, {}), make_entities(mesh, 1, boundaries.edges),
                            make_entities(mesh, 2, boundaries.faces)};
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
}

}  // namespace

void write_msh(const Writing& writing, TextWriter& out) {
  if (writing.options.msh_version == MshVersion::v4_1)
    write_msh4(writing.output, out);
  else
    write_msh2(writing.output, out);
}

}  // namespace quadrille
