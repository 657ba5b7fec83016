#include "mesher/io/mesh_builder.hpp"

#include <fmt/format.h>

#include "geometry/base/error.hpp"

namespace quadrille {

namespace {

int corner_count(ElementShape shape) {
  return static_cast<int>(shape) + 1;
}

}  // namespace

void MeshBuilder::add_node(std::int64_t number, const Vector3& position) {
  if (number <= 0) throw failure(name_, fmt::format("{}: node number {} is not positive", name_, number));
  if (!position.allFinite())
    throw failure(name_, fmt::format("{}: node {} has no finite position", name_, number));
  if (index_of(number) >= 0) throw failure(name_, fmt::format("{}: node {} is defined twice", name_, number));
  const int index = static_cast<int>(points_.size());
  points_.push_back(position);
  // Numbers are dense in most files; where they are not, memory must not grow with the largest.
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

bool MeshBuilder::set_cad(std::int64_t element_number, int cad) {
  if (element_places_.empty())
    for (std::size_t i = 0; i < elements_.size(); ++i) element_places_[elements_[i].number] = i;
  const auto found = element_places_.find(element_number);
  if (found == element_places_.end()) return false;
  elements_[found->second].cad = cad;
  return true;
}

int MeshBuilder::resolve(const FileElement& element, int place) const {
  const int index = index_of(element.nodes[place]);
  if (index < 0)
    throw failure(name_, fmt::format("{}: element {} refers to node {}, which the file does not define",
                                     name_, element.number, element.nodes[place]));
  return index;
}

void MeshBuilder::check(const FileElement& element) const {
  for (int i = 0; i < element.node_count; ++i) {
    resolve(element, i);
    for (int j = 0; j < i; ++j)
      if (element.nodes[i] == element.nodes[j])
        throw failure(
            name_, fmt::format("{}: element {} uses node {} twice", name_, element.number, element.nodes[i]));
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
  for (const FileElement& element : elements_) {
    check(element);
    const int corners = corner_count(element.shape);
    const bool keeps_midsides = mesh_.order == 2 && element.shape != ElementShape::triangle;
    for (int i = 0; i < (keeps_midsides ? element.node_count : corners); ++i) {
      char& mark = use[resolve(element, i)];
      mark = std::max<char>(mark, i < corners ? corner : midside);
    }
  }
  new_index_.assign(points_.size(), -1);
  for (const char kind : {corner, midside})
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (use[i] != kind) continue;
      new_index_[i] = static_cast<int>(mesh_.points.size());
      mesh_.points.push_back(points_[i]);
    }
}

void MeshBuilder::append(const FileElement& element) {
  const auto node = [&](int place) { return kept(element, place); };
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

ShellMesh MeshBuilder::finish() {
  find_order();
  renumber();
  for (const FileElement& element : elements_) append(element);
  if (mesh_.quads.empty() && mesh_.triangles.empty())
    throw failure(name_, fmt::format("{}: holds neither quads nor triangles", name_));
  return std::move(mesh_);
}

}  // namespace quadrille
