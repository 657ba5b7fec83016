/// Looks each side of a shell up among the segments, which are sorted by the nodes of their ends.

#include "mesher/io/segment_sides.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "geometry/base/side_key.hpp"

namespace quadrille {

namespace {

using KeyedSegment = std::pair<std::uint64_t, int>;

/// For each edge, the vertices at the ends of its chain of segments: first positive, last negative.
std::vector<std::vector<int>> ends_of_edges(const OutputMesh& mesh) {
  std::unordered_map<int, int> vertex_at;
  for (int corner = 0; corner < mesh.count(0); ++corner)
    vertex_at.emplace(mesh.corner_node(corner), mesh.entity(0, corner));
  std::vector<std::vector<int>> ends;
  for (const CadGroup& edge : mesh.entities(1)) {
    ends.emplace_back();
    if (edge.number == 0) continue;
    // A closed edge begins and ends at its vertex, wherever that is in the chain.
    for (const int end : {0, 1})
      for (const int segment : edge.members) {
        const auto found = vertex_at.find(mesh.element_nodes(1, segment).nodes[end]);
        if (found != vertex_at.end() && found->second > 0)
          ends.back().push_back(end == 0 ? found->second : -found->second);
      }
  }
  return ends;
}

}  // namespace

std::vector<SegmentSide> segment_sides(const OutputMesh& mesh) {
  std::vector<KeyedSegment> keyed;
  // Most sides end at a node that is on no segment, so this is checked first.
  std::vector<char> on_segment(mesh.nodes().empty() ? 0 : mesh.nodes().back() + 1, 0);
  for (int segment = 0; segment < mesh.count(1); ++segment) {
    const ElementNodes nodes = mesh.element_nodes(1, segment);
    keyed.emplace_back(side_key(nodes.nodes[0], nodes.nodes[1]), segment);
    for (const int node : nodes) on_segment[node] = 1;
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<SegmentSide> sides;
  for (int shell = 0; shell < mesh.shell_count(); ++shell) {
    const ElementNodes nodes = mesh.element_nodes(2, shell);
    const int corners = mesh.is_quad(shell) ? 4 : 3;
    for (int side = 0; side < corners; ++side) {
      const int a = nodes.nodes[side], b = nodes.nodes[(side + 1) % corners];
      if (!on_segment[a] || !on_segment[b]) continue;
      const std::uint64_t key = side_key(a, b);
      for (auto at = std::lower_bound(keyed.begin(), keyed.end(), KeyedSegment(key, 0));
           at != keyed.end() && at->first == key; ++at)
        sides.push_back({at->second, shell, side, mesh.element_nodes(1, at->second).nodes[0] == a});
    }
  }
  std::stable_sort(sides.begin(), sides.end(),
                   [](const SegmentSide& a, const SegmentSide& b) { return a.segment < b.segment; });
  return sides;
}

EntityBoundaries entity_boundaries(const OutputMesh& mesh) {
  EntityBoundaries boundaries{std::vector<std::vector<int>>(mesh.entities(2).size()), ends_of_edges(mesh)};
  std::unordered_map<int, std::size_t> place;
  for (std::size_t i = 0; i < mesh.entities(2).size(); ++i) place[mesh.entities(2)[i].number] = i;
  for (const SegmentSide& side : segment_sides(mesh)) {
    const int edge = mesh.entity(1, side.segment), face = mesh.face(side.shell);
    if (edge > 0 && face > 0) boundaries.faces[place[face]].push_back(side.forward ? edge : -edge);
  }
  for (std::vector<int>& edges : boundaries.faces) {
    std::sort(edges.begin(), edges.end(),
              [](int a, int b) { return std::pair(std::abs(a), a < 0) < std::pair(std::abs(b), b < 0); });
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  }
  return boundaries;
}

}  // namespace quadrille
