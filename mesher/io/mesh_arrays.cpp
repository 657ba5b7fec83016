/// Each array has a function that writes one of its numbers, so that all threads can write it.

#include "mesher/io/mesh_arrays.hpp"

#include <iterator>
#include <utility>

#include "mesher/mesh/quality.hpp"

namespace quadrille {

namespace {

MeshArray set_array(const std::string& name, bool of_nodes, std::vector<char> members) {
  return {array_of_set(name), MeshArray::Type::set, of_nodes,
          [members = std::move(members)](int i, TextWriter& to) { to << static_cast<int>(members[i]); }};
}

}  // namespace

std::vector<MeshArray> mesh_arrays(const Writing& writing) {
  using Type = MeshArray::Type;
  const OutputMesh& mesh = writing.output;
  std::vector<MeshArray> arrays{
      {"face", Type::integer, false, [&mesh](int i, TextWriter& to) { to << mesh.face(i); }},
      {"q", Type::real, false, [&mesh, q = quad_qualities(writing.mesh)](int i, TextWriter& to) {
         to << (mesh.is_quad(i) ? q[i] : 0.0);
       }}};
  if (!mesh.thicknesses().empty())
    arrays.push_back(
        {"thickness", Type::real, false, [&mesh](int i, TextWriter& to) { to << mean_thickness(mesh, i); }});
  std::vector<MeshArray> of_nodes;
  for (const std::string& name : mesh.set_names()) {
    std::vector<char> shells, nodes;  // empty = no group of them has this name
    for (const NamedGroup& group : mesh.groups(2))
      if (group.name == name) shells = mesh.is_in_set(2, name);
    for (const int dimension : {1, 0})
      for (const NamedGroup& group : mesh.groups(dimension)) {
        if (group.name != name) continue;
        nodes.resize(mesh.nodes().size(), 0);
        for (const int number : mesh.node_numbers(dimension, group)) nodes[number - 1] = 1;
      }
    if (!shells.empty()) arrays.push_back(set_array(name, false, std::move(shells)));
    if (!nodes.empty()) of_nodes.push_back(set_array(name, true, std::move(nodes)));
  }
  std::move(of_nodes.begin(), of_nodes.end(), std::back_inserter(arrays));
  return arrays;
}

void write_numbers(const MeshArray& array, const OutputMesh& mesh, TextWriter& out) {
  write_in_order(array.of_nodes ? mesh.nodes().size() : mesh.shell_count(), out, [&](int i, TextWriter& to) {
    array.write(i, to);
    to << '\n';
  });
}

}  // namespace quadrille
