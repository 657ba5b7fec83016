/// Sorts elements into groups by CAD number and numbers only the nodes in use.

#include "mesher/io/output_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "geometry/base/error.hpp"

namespace quadrille {

namespace {

/// Groups 0 .. count - 1 by the CAD number that `number_of` gives. Groups ascend by number; number 0 (none)
/// comes last.
template <class NumberOf>
std::vector<CadGroup> grouped(int count, NumberOf number_of) {
  constexpr int last = std::numeric_limits<int>::max();
  std::map<int, std::vector<int>> members;
  for (int i = 0; i < count; ++i) {
    const int number = number_of(i);
    members[number > 0 ? number : last].push_back(i);
  }
  std::vector<CadGroup> groups;
  groups.reserve(members.size());
  for (auto& [number, own] : members) groups.push_back({number == last ? 0 : number, std::move(own)});
  return groups;
}

}  // namespace

OutputMesh::OutputMesh(const ShellMesh& mesh, const GroupKinds& groups, int quad_nodes)
    : mesh_(mesh), groups_(groups) {
  number_nodes();
  if (quad_nodes == 9 && mesh.order == 2) add_middles();
  for (const int dimension : {0, 1, 2})
    entities_[dimension] = grouped(count(dimension), [&](int i) { return entity(dimension, i); });
  group_by_thickness();
  for (const int dimension : {0, 1, 2}) name_groups(dimension);
}

void OutputMesh::name_groups(int dimension) {
  constexpr const char* unnamed[] = {"PhysicalPoint", "PhysicalCurve", "PhysicalSurface"};
  const bool wanted[] = {groups_.vertices, groups_.edges, groups_.faces};
  if (!wanted[dimension]) return;
  std::vector<NamedGroup>& named = named_[dimension];
  if (!groups_were_read()) {
    std::set<int> added;  // vertices of placed nodes, which are not in the model
    for (const ShellMesh::PlacedNode& node : mesh_.placed_nodes)
      if (dimension == 0 && node.added) added.insert(node.vertex);
    for (const CadGroup& entity : entities(dimension))
      if (entity.number > 0 && !added.contains(entity.number))
        named.push_back({entity_name(dimension, entity.number), true, 0, {entity.number}});
    for (const ShellMesh::PlacedNode& node : mesh_.placed_nodes)
      if (dimension == 0 && node.vertex > 0)
        named.push_back({node.name, true, 0, {node.vertex}, added.erase(node.vertex) == 0});
    for (const ShellMesh::Group& group : mesh_.extra_groups)
      if (group.dimension == dimension) named.push_back({group.name, true, 0, group.entities, true});
    return;
  }
  for (const ShellMesh::Group& group : mesh_.groups) {
    if (group.dimension != dimension) continue;
    const bool has_name = !group.name.empty();
    named.push_back({has_name ? group.name : unnamed[dimension] + std::to_string(group.number), has_name,
                     group.number, group.entities});
  }
}

std::vector<int> OutputMesh::members(int dimension, const NamedGroup& group) const {
  std::vector<int> result;
  for (const CadGroup& entity : entities(dimension)) {
    if (entity.number > 0 && std::binary_search(group.entities.begin(), group.entities.end(), entity.number))
      result.insert(result.end(), entity.members.begin(), entity.members.end());
  }
  if (group.entities.size() > 1) std::sort(result.begin(), result.end());
  return result;
}

std::vector<std::string> OutputMesh::set_names() const {
  std::vector<std::string> names;
  for (const int dimension : {2, 1, 0}) {
    for (const NamedGroup& group : named_[dimension]) {
      const bool is_told =
          group.entities.size() == 1 && group.name == entity_name(dimension, group.entities[0]);
      if (!is_told && std::find(names.begin(), names.end(), group.name) == names.end())
        names.push_back(group.name);
    }
  }
  return names;
}

std::vector<char> OutputMesh::is_in_set(int dimension, const std::string& name) const {
  std::vector<char> result(count(dimension), 0);
  for (const NamedGroup& group : named_[dimension]) {
    if (group.name != name) continue;
    for (const int member : members(dimension, group)) result[member] = 1;
  }
  return result;
}

std::vector<int> OutputMesh::node_numbers(int dimension, const NamedGroup& group) const {
  std::vector<int> numbers;
  for (const int member : members(dimension, group))
    for (const int node : element_nodes(dimension, member)) numbers.push_back(number(node));
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

void OutputMesh::add_middles() {
  middles_.reserve(mesh_.quads.size());
  for (std::size_t i = 0; i < mesh_.quads.size(); ++i) {
    // Shape functions of the eight-node element at its middle: 1/2 at midside nodes, -1/4 at corners.
    Vector3 middle = Vector3::Zero();
    for (int k = 0; k < 4; ++k)
      middle += 0.5 * mesh_.points[mesh_.midsides[i][k]] - 0.25 * mesh_.points[mesh_.quads[i][k]];
    nodes_.push_back(static_cast<int>(mesh_.points.size() + i));
    numbers_.push_back(static_cast<int>(nodes_.size()));
    middles_.push_back(middle);
  }
}

int OutputMesh::cad_face_count() const {
  int count = static_cast<int>(mesh_.faces.size());
  for (const CadGroup& group : entities_[2]) count = std::max(count, group.number);
  return count;
}

void OutputMesh::group_by_thickness() {
  for (const CadGroup& face : entities_[2]) {
    if (face.number < 1 || face.number > static_cast<int>(mesh_.thicknesses.size())) continue;
    const std::string thickness = fmt::format("{:.6g}", mesh_.thicknesses[face.number - 1]);
    const ShellMesh::VaryingThickness* varying = varying_on(face.number);
    const std::string name =
        varying != nullptr ? fmt::format("Thickness{:.4g}to{:.4g}", varying->thinnest, varying->thickest)
                           : "Thickness" + thickness;
    auto group = std::find_if(thicknesses_.begin(), thicknesses_.end(),
                              [&](const ThicknessGroup& other) { return other.name == name; });
    if (group == thicknesses_.end())
      group = thicknesses_.insert(thicknesses_.end(), {{name, true, 0, {}}, thickness, varying != nullptr});
    group->entities.push_back(face.number);
  }
}

const ShellMesh::VaryingThickness* OutputMesh::varying_on(int face) const {
  const auto& varying = mesh_.varying_thicknesses;
  const auto found = std::lower_bound(varying.begin(), varying.end(), face,
                                      [](const auto& entry, int number) { return entry.face < number; });
  return found != varying.end() && found->face == face ? &*found : nullptr;
}

double OutputMesh::face_thickness(int face) const {
  const bool known = face >= 1 && face <= static_cast<int>(mesh_.thicknesses.size());
  return known ? mesh_.thicknesses[face - 1] : 0;
}

std::array<double, 4> OutputMesh::corner_thicknesses(int shell) const {
  std::array<double, 4> result{};
  result.fill(face_thickness(face(shell)));
  const ShellMesh::VaryingThickness* varying = varying_on(face(shell));
  if (varying == nullptr || !is_quad(shell)) return result;
  for (int k = 0; k < 4; ++k) {
    const int node = mesh_.quads[shell][k];
    const auto found = std::lower_bound(varying->nodes.begin(), varying->nodes.end(), node);
    if (found != varying->nodes.end() && *found == node)
      result[k] = varying->thicknesses[found - varying->nodes.begin()];
  }
  return result;
}

std::vector<std::pair<int, double>> OutputMesh::node_thicknesses() const {
  std::vector<std::pair<int, double>> all, result;
  for (const ShellMesh::VaryingThickness& varying : mesh_.varying_thicknesses) {
    for (std::size_t i = 0; i < varying.nodes.size(); ++i)
      all.emplace_back(number(varying.nodes[i]), varying.thicknesses[i]);
  }
  std::sort(all.begin(), all.end());
  for (std::size_t first = 0, last = 0; first < all.size(); first = last) {
    double sum = 0;
    for (last = first; last < all.size() && all[last].first == all[first].first; ++last)
      sum += all[last].second;
    result.emplace_back(all[first].first, sum / static_cast<double>(last - first));
  }
  return result;
}

void OutputMesh::number_nodes() {
  numbers_.assign(mesh_.points.size(), 0);
  if (mesh_.order == 2 && mesh_.midsides.size() != mesh_.quads.size())
    throw failure("", "the second-order mesh does not have midside nodes for each quad");
  const auto use = [&](const char* what, std::size_t index, const auto& nodes) {
    for (const int node : nodes) {
      if (node < 0 || node >= static_cast<int>(mesh_.points.size()))
        throw failure(fmt::format("{} {}", what, index + 1),
                      fmt::format("{} {} of the mesh has node index {}, but there are {} nodes", what,
                                  index + 1, node, mesh_.points.size()));
      numbers_[node] = 1;
    }
  };
  for (std::size_t i = 0; i < mesh_.quads.size(); ++i) {
    use("quad", i, mesh_.quads[i]);
    if (mesh_.order == 2) use("quad", i, mesh_.midsides[i]);
  }
  for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) use("triangle", i, mesh_.triangles[i]);
  for (std::size_t i = 0; i < mesh_.segments.size(); ++i) {
    use("segment", i, mesh_.segments[i].nodes);
    if (mesh_.order == 2 && mesh_.segments[i].middle >= 0)
      use("segment", i, std::array{mesh_.segments[i].middle});
  }
  for (std::size_t i = 0; i < mesh_.corners.size(); ++i) use("corner", i, std::array{mesh_.corners[i].node});
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    if (numbers_[i] == 0) continue;
    if (!mesh_.points[i].allFinite())
      throw failure(fmt::format("node {}", i), fmt::format("node {} of the mesh has no finite position", i));
    nodes_.push_back(static_cast<int>(i));
    numbers_[i] = static_cast<int>(nodes_.size());
  }
}

int OutputMesh::face(int shell) const {
  // Thicknesses belong to faces, so face numbers are needed even if no face groups are written.
  if (!groups_.faces && mesh_.thicknesses.empty()) return 0;
  const std::vector<int>& faces = is_quad(shell) ? mesh_.quad_faces : mesh_.triangle_faces;
  const std::size_t index = is_quad(shell) ? shell : shell - quad_count();
  return index < faces.size() ? faces[index] : 0;
}

int OutputMesh::count(int dimension) const {
  if (dimension == 2) return shell_count();
  if (dimension == 1) return groups_.edges ? static_cast<int>(mesh_.segments.size()) : 0;
  return groups_.vertices ? static_cast<int>(mesh_.corners.size()) : 0;
}

int OutputMesh::entity(int dimension, int member) const {
  if (dimension == 2) return face(member);
  return dimension == 1 ? mesh_.segments[member].edge : mesh_.corners[member].vertex;
}

ElementNodes OutputMesh::element_nodes(int dimension, int member) const {
  ElementNodes result{{}, 0, dimension};
  const auto add = [&](const auto& nodes) {
    std::copy(nodes.begin(), nodes.end(), result.nodes.begin() + result.count);
    result.count += static_cast<int>(nodes.size());
  };
  if (dimension == 0) {
    add(std::array{corner_node(member)});
  } else if (dimension == 1) {
    const ShellMesh::Segment& side = mesh_.segments[member];
    add(side.nodes);
    if (mesh_.order == 2 && side.middle >= 0) add(std::array{side.middle});
  } else if (!is_quad(member)) {
    add(mesh_.triangles[member - quad_count()]);
  } else {
    add(mesh_.quads[member]);
    if (mesh_.order == 2) add(mesh_.midsides[member]);
    if (!middles_.empty()) add(std::array{static_cast<int>(mesh_.points.size()) + member});
  }
  return result;
}

std::vector<int> OutputMesh::element_numbers(int dimension, const NamedGroup& group) const {
  std::vector<int> numbers = members(dimension, group);
  for (int& number : numbers) number += 1 + (dimension == 1 ? shell_count() : 0);
  return numbers;
}

}  // namespace quadrille
