/// Meshes that VTK reads, converted to ShellMesh.

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <numeric>
#include <tuple>
#include <type_traits>

#include "geometry/base/error.hpp"
#include "geometry/base/file_access.hpp"
#include "geometry/base/isolated_work.hpp"
#include "geometry/base/process_usage.hpp"
#include "geometry/base/text_parts.hpp"
#include "mesher/io/mesh_builder.hpp"
#include "mesher/io/modules.hpp"
#include "mesher/io/readers.hpp"

namespace quadrille {

namespace {

/// The names of the solids in a text .stl file, in order; empty for a binary file, which has no names.
std::vector<std::string> solid_names(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<std::string> names;
  for (std::string line; std::getline(file, line);) {
    const std::size_t begin = std::min(line.find_first_not_of(" \t"), line.size());
    const std::string word = upper(std::string_view(line).substr(begin, 6));
    if (word == "SOLID" || word == "SOLID ") {
      line.erase(0, std::min(begin + 6, line.size()));
      while (!line.empty() && std::isspace(static_cast<unsigned char>(line.back()))) line.pop_back();
      names.push_back(line);
    } else if (names.empty()) {
      break;
    }
  }
  return names;
}

/// Unites points at the same position, and drops elements that lose a corner by that.
void unite_points(ImportedMesh& mesh, MeshBuilder& builder) {
  std::vector<int> order(mesh.points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto before = [&](int a, int b) {
    const Vector3 &p = mesh.points[a], &q = mesh.points[b];
    return std::tie(p.x(), p.y(), p.z(), a) < std::tie(q.x(), q.y(), q.z(), b);
  };
  // The builder reports positions that are not finite and nodes that do not exist.
  for (const Vector3& p : mesh.points)
    if (!p.allFinite()) return;
  const auto is_there = [&](std::int64_t node) { return node >= 1 && node <= std::ssize(mesh.points); };
  for (const FileElement& element : mesh.elements)
    if (!std::all_of(element.nodes.begin(), element.nodes.begin() + element.node_count, is_there)) return;
  std::sort(order.begin(), order.end(), before);
  std::vector<int> first(mesh.points.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool same = k > 0 && mesh.points[order[k]] == mesh.points[order[k - 1]];
    first[order[k]] = same ? first[order[k - 1]] : order[k];
  }
  const std::size_t count = mesh.elements.size();
  std::erase_if(mesh.elements, [&](FileElement& element) {
    const auto end = element.nodes.begin() + element.node_count;
    for (auto node = element.nodes.begin(); node != end; ++node) *node = first[*node - 1] + 1;
    for (auto node = element.nodes.begin(); node != end; ++node)
      if (std::find(node + 1, end, *node) != end) return true;
    return false;
  });
  if (mesh.elements.size() < count)
    builder.note(fmt::format("{} triangles with two corners at the same position are left out",
                             count - mesh.elements.size()));
}

/// (sets) The builder's group for each set.
std::vector<int> groups_of_sets(const ImportedMesh& mesh, MeshBuilder& builder) {
  std::vector<int> groups;
  for (auto begin = mesh.set_names.begin(); begin != mesh.set_names.end();) {
    const auto end = std::find(begin, mesh.set_names.end(), '\0');
    groups.push_back(builder.group(std::string(begin, end), 0));
    begin = std::next(end);
  }
  return groups;
}

template <class Record>
void put(const std::vector<Record>& records, std::ostream& out) {
  static_assert(std::is_trivially_copyable_v<Record> || std::is_same_v<Record, Vector3>);
  const std::size_t count = records.size();
  out.write(reinterpret_cast<const char*>(&count), sizeof count);
  out.write(reinterpret_cast<const char*>(records.data()),
            static_cast<std::streamsize>(count * sizeof(Record)));
}

template <class Record>
void get(std::vector<Record>& records, std::istream& in) {
  std::size_t count = 0;
  in.read(reinterpret_cast<char*>(&count), sizeof count);
  records.resize(count);
  in.read(reinterpret_cast<char*>(records.data()), static_cast<std::streamsize>(count * sizeof(Record)));
}

/// Reads in a child process, since VTK's readers crash on many damaged files.
ImportedMesh read_isolated(const std::string& name, const std::string& ending) {
  IsolatedWork options;
  options.subject = name;
  options.crashed = fmt::format("{}: reading this file crashed: it may be damaged", name);
  // Counts in a damaged file may be larger than the file, and VTK loops as often as they say.
  std::error_code ignored;
  const std::uintmax_t bytes = std::filesystem::file_size(name, ignored);
  const double size = ignored ? 0 : static_cast<double>(bytes);
  options.time_limit = 20 + size / 1e6;
  options.too_long =
      fmt::format("{}: reading it takes longer than {:g} s: it may be damaged", name, options.time_limit);
  // Nor does VTK compare counts with the file before it takes memory for them. Files may be compressed.
  constexpr double base = 1e9, expansion = 200;
  options.memory = static_cast<std::size_t>(std::min(free_memory(), base + expansion * size));
  const auto work = [&](std::ostream& out) {
    try {
      require_library(Library::vtk, ending);
      vtk_mesh(name, ending).each([&](const auto& records) { put(records, out); });
    } catch (const Error& error) {
      throw failure(name, fmt::format("{}: {}", name, error.what()));
    }
  };
  ImportedMesh mesh;
  std::istringstream in(run_isolated(options, work));
  mesh.each([&](auto& records) { get(records, in); });
  return mesh;
}

}  // namespace

ShellMesh read_by_vtk(const std::filesystem::path& path, std::vector<std::string>* notes) {
  require_readable(path);
  const std::string name = path.string(), ending = lower_ending(path);
  ImportedMesh mesh = read_isolated(name, ending);
  MeshBuilder builder(name);
  const std::vector<int> set_groups = groups_of_sets(mesh, builder);
  for (const auto& [element, set] : mesh.in_set)
    mesh.elements[element].groups = builder.joined(mesh.elements[element].groups, set_groups[set]);
  if (ending == ".stl" || ending == ".obj") unite_points(mesh, builder);
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    builder.add_node(static_cast<std::int64_t>(i) + 1, mesh.points[i]);
  std::vector<std::string> solids;
  if (ending == ".stl") solids = solid_names(path);
  const bool has_names = solids.size() > 1;
  for (FileElement& element : mesh.elements) {
    const auto solid = static_cast<std::size_t>(element.cad);
    if (has_names && solid > 0 && solid <= solids.size() && !solids[solid - 1].empty())
      element.groups = builder.joined(element.groups, builder.group(solids[solid - 1], 0));
    builder.add_element(element);
  }
  for (const auto& [point, set] : mesh.node_in_set) builder.put_node(point + 1, set_groups[set]);
  return builder.finish(notes);
}

}  // namespace quadrille
