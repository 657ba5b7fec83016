/// Maps file numbers to indices, finds the order, and numbers each combination of entity and groups.

#include "mesher/io/mesh_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "geometry/base/error.hpp"
#include "geometry/base/printable.hpp"
#include "mesher/mesh/entity_name.hpp"

namespace quadrille {

void MeshBuilder::add_node(std::int64_t number, const Vector3& position) {
  if (number <= 0) throw failure(name_, fmt::format("{}: node number {} is not positive", name_, number));
  // Farther out, products of lengths such as those in areas and volumes become infinite.
  constexpr double farthest = 1e75;
  if (!(position.cwiseAbs().maxCoeff() < farthest) || !position.allFinite())
    throw failure(name_, fmt::format("{}: node {} has no finite position", name_, number));
  if (index_of(number) >= 0) throw failure(name_, fmt::format("{}: node {} is defined twice", name_, number));
  const int index = static_cast<int>(points_.size());
  points_.push_back(position);
  // Numbers are dense in most files. If they are not, memory must not grow with the largest number.
  const std::int64_t dense_limit = 1024 + 8 * static_cast<std::int64_t>(points_.size());
  if (number > dense_limit) {
    scattered_[number] = index;
    return;
  }
  if (number >= static_cast<std::int64_t>(dense_.size()))
    dense_.resize(static_cast<std::size_t>(number) * 3 / 2 + 1, -1);
  dense_[static_cast<std::size_t>(number)] = index;
}

int MeshBuilder::index_of(std::int64_t number) const {
  if (number > 0 && number < static_cast<std::int64_t>(dense_.size()) && dense_[number] >= 0)
    return dense_[number];
  if (scattered_.empty()) return -1;
  const auto found = scattered_.find(number);
  return found == scattered_.end() ? -1 : found->second;
}

int MeshBuilder::group(const std::string& given, int number, int dimension) {
  const std::string name = printable(given, "_");  // names go to terminals and to files of lines
  const auto [found, is_new] =
      group_places_.try_emplace({name, number, dimension}, static_cast<int>(groups_.size()));
  if (is_new) groups_.push_back({name, number, dimension});
  return found->second;
}

int MeshBuilder::joined(int groups, int group) {
  std::vector<int> set = group_sets_[groups];
  const auto place = std::lower_bound(set.begin(), set.end(), group);
  if (place != set.end() && *place == group) return groups;
  set.insert(place, group);
  const auto [found, is_new] = set_places_.try_emplace(set, static_cast<int>(group_sets_.size()));
  if (is_new) group_sets_.push_back(std::move(set));
  return found->second;
}

bool MeshBuilder::put_element(std::int64_t element_number, int group) {
  if (element_places_.empty())
    for (std::size_t i = 0; i < elements_.size(); ++i) element_places_[elements_[i].number] = i;
  const auto found = element_places_.find(element_number);
  if (found == element_places_.end()) return false;
  FileElement& element = elements_[found->second];
  element.groups = joined(element.groups, group);
  return true;
}

bool MeshBuilder::put_node(std::int64_t node_number, int group) {
  const int node = index_of(node_number);
  if (node < 0) return false;
  if (node_groups_.size() <= static_cast<std::size_t>(node)) node_groups_.resize(points_.size(), 0);
  node_groups_[node] = joined(node_groups_[node], group);
  return true;
}

void MeshBuilder::unite_repeated() {
  std::map<std::array<std::int64_t, 4>, std::size_t> places;
  std::size_t kept = 0;
  for (const FileElement& element : elements_) {
    std::array<std::int64_t, 4> corners{};
    std::copy_n(element.nodes.begin(), corner_count(element.shape), corners.begin());
    std::sort(corners.begin(), corners.end());
    const auto [found, is_new] = places.try_emplace(corners, kept);
    if (is_new) {
      elements_[kept++] = element;
      continue;
    }
    FileElement& first = elements_[found->second];
    for (const int group : std::vector<int>(group_sets_[element.groups]))
      first.groups = joined(first.groups, group);
  }
  elements_.resize(kept);
  element_places_.clear();
}

void MeshBuilder::resolve(FileElement& element) const {
  const auto begin = element.nodes.begin();
  for (auto node = begin; node != begin + element.node_count; ++node) {
    const std::int64_t number = std::exchange(*node, index_of(*node));
    if (*node < 0)
      throw failure(name_, fmt::format("{}: element {} refers to node {}, which the file does not define",
                                       name_, element.number, number));
    if (std::find(begin, node, *node) != node)
      throw failure(name_, fmt::format("{}: element {} uses node {} twice", name_, element.number, number));
  }
}

void MeshBuilder::find_order() {
  int order = 0;
  for (const FileElement& element : elements_) {
    if (element.shape != ElementShape::quad) continue;
    const int own = element.node_count == 8 ? 2 : 1;
    if (order != 0 && own != order)
      throw failure(name_, fmt::format("{}: element {} has {} nodes, but the quads before it have {}", name_,
                                       element.number, element.node_count, order == 2 ? 8 : 4));
    order = own;
  }
  mesh_.order = order == 2 ? 2 : 1;
}

void MeshBuilder::renumber() {
  enum : char { unused, midside, corner };
  std::vector<char> use(points_.size(), unused);
  bool has_curved_triangles = false;
  for (FileElement& element : elements_) {
    resolve(element);
    const int corners = corner_count(element.shape);
    const bool keeps_midsides = mesh_.order == 2 && element.shape != ElementShape::triangle;
    has_curved_triangles |= element.shape == ElementShape::triangle && element.node_count == 6;
    for (int i = 0; i < (keeps_midsides ? element.node_count : corners); ++i) {
      char& mark = use[element.nodes[i]];
      mark = std::max<char>(mark, i < corners ? corner : midside);
    }
  }
  if (has_curved_triangles) note("the midside nodes of triangles are left out");
  new_index_.assign(points_.size(), -1);
  for (const char kind : {corner, midside})
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (use[i] != kind) continue;
      new_index_[i] = static_cast<int>(mesh_.points.size());
      mesh_.points.push_back(points_[i]);
    }
}

void MeshBuilder::append(const FileElement& element) {
  const auto node = [&](int place) { return new_index_[element.nodes[place]]; };
  switch (element.shape) {
    case ElementShape::point:
      mesh_.corners.push_back({node(0), element.cad});
      break;
    case ElementShape::line: {
      const bool has_middle = mesh_.order == 2 && element.node_count == 3;
      mesh_.segments.push_back({{node(0), node(1)}, has_middle ? node(2) : -1, element.cad});
      break;
    }
    case ElementShape::triangle:
      mesh_.triangles.push_back({node(0), node(1), node(2)});
      mesh_.triangle_faces.push_back(element.cad);
      break;
    case ElementShape::quad:
      mesh_.quads.push_back({node(0), node(1), node(2), node(3)});
      mesh_.quad_faces.push_back(element.cad);
      if (mesh_.order == 2) mesh_.midsides.push_back({node(4), node(5), node(6), node(7)});
      break;
  }
}

int MeshBuilder::number_in_name(int groups, int dimension) const {
  const std::string_view kind = entity_kinds[dimension];
  const std::vector<int>& set = group_sets_[groups];
  for (auto group = set.rbegin(); group != set.rend(); ++group) {
    const std::string_view name = groups_[*group].name;
    if (name.size() <= kind.size() || upper(name.substr(0, kind.size())) != upper(kind)) continue;
    const std::optional<int> number = exactly<int>(name.substr(kind.size()));
    if (number && *number > 0) return *number;
  }
  return 0;
}

namespace {

/// A CAD number, 0 = none, and a set of groups.
using Combination = std::pair<int, int>;

/// Gives each combination a number of its own: the CAD number if that is free, else a new one.
std::map<Combination, int> numbers_of(const std::vector<Combination>& in_order) {
  std::map<Combination, int> numbers;
  int largest = 0;
  std::set<int> taken{0};
  std::vector<int*> waiting;
  for (const Combination& key : in_order) {
    const auto [place, is_new] = numbers.try_emplace(key, key.first);
    largest = std::max(largest, key.first);
    if (is_new && key != Combination(0, 0) && !taken.insert(key.first).second)
      waiting.push_back(&place->second);
  }
  for (int* number : waiting) *number = ++largest;
  return numbers;
}

}  // namespace

void MeshBuilder::number_entities() {
  std::vector<Combination> found[3];
  for (FileElement& element : elements_) {
    const int dimension = dimension_of(element.shape);
    if (element.cad == 0 && element.groups != 0) element.cad = number_in_name(element.groups, dimension);
    found[dimension].emplace_back(element.cad, element.groups);
  }
  for (const int groups : node_groups_)
    if (groups != 0) found[0].emplace_back(number_in_name(groups, 0), groups);
  std::map<Combination, int> numbers[3];
  std::map<std::pair<int, int>, std::vector<int>> entities;  // by group and dimension
  for (const int dimension : {2, 1, 0}) {
    numbers[dimension] = numbers_of(found[dimension]);
    for (const auto& [key, number] : numbers[dimension])
      for (const int group : group_sets_[key.second]) entities[{group, dimension}].push_back(number);
  }
  for (auto& [key, members] : entities) {
    std::sort(members.begin(), members.end());
    const Group& group = groups_[key.first];
    mesh_.groups.push_back({group.name, key.second, group.number, std::move(members)});
  }
  for (FileElement& element : elements_)
    element.cad = numbers[dimension_of(element.shape)].at({element.cad, element.groups});
  for (std::size_t node = 0; node < node_groups_.size(); ++node) {
    const int groups = node_groups_[node];
    if (groups != 0 && new_index_[node] >= 0)
      mesh_.corners.push_back({new_index_[node], numbers[0].at({number_in_name(groups, 0), groups})});
  }
}

ShellMesh MeshBuilder::finish(std::vector<std::string>* notes) {
  find_order();
  renumber();
  number_entities();
  for (const FileElement& element : elements_) append(element);
  if (mesh_.quads.empty() && mesh_.triangles.empty())
    throw failure(name_, fmt::format("{}: holds neither quads nor triangles", name_));
  if (notes != nullptr) notes->insert(notes->end(), notes_.begin(), notes_.end());
  return std::move(mesh_);
}

}  // namespace quadrille
