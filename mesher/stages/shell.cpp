/// Assembles the faces, and lists what became of faces, small features, crossed edges and placed nodes.

#include "mesher/stages/stages.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "geometry/base/place_text.hpp"
#include "geometry/cad/parallel_ids.hpp"
#include "mesher/mesh/quad_geometry.hpp"
#include "mesher/shell/assembly.hpp"
#include "mesher/shell/poor_quads.hpp"
#include "mesher/shell/size_fidelity.hpp"

namespace quadrille {

namespace {

/// The farthest that an edge's curve lies from a point, by samples.
double distance_from(const Vector3& place, const CadEdge& edge) {
  double result = 0;
  for (const Vector3& point : points_along(edge)) result = std::max(result, (point - place).norm());
  return result;
}

std::string why_merged(const SimplifiedModel& simple, FaceId face) {
  if (!simple.gone[face]) return "tiny: replaced by an edge or a node of its neighbors";
  const FaceId other = simple.taken_by[face];
  if (!other.exists()) return "in a filled hole";
  return fmt::format("joined with Face{}: coplanar", other.number());
}

ShellMesh::Face status_of(FaceId face, const Prepared& prepared, const Boundary& boundary,
                          const Faces& faces) {
  const FaceRecord& record = faces.records[face];
  const auto& mesh = faces.meshes[face];
  ShellMesh::Face status;
  status.face = face.number();
  status.attempts = record.attempts;
  status.seconds = record.seconds;
  status.work = record.work;
  status.share = record.share();
  status.status = mesh ? FaceStatus::meshed : prepared.asked[face] ? FaceStatus::failed : FaceStatus::skipped;
  std::vector<std::string> notes = record.history;
  if (mesh && mesh->grid) notes.emplace_back("grid");
  if (boundary.plan.tiny.cuts(face))
    notes.emplace_back("ends before a corner that is narrower than the reach");
  status.note = fmt::format("{}", fmt::join(notes, "; "));
  if (boundary.plan.tiny.merged_faces[face]) {
    status.status = FaceStatus::merged;
    status.note = why_merged(prepared.simple, face);
  }
  status.filled_area = prepared.simple.areas[face];
  if (mesh && mesh->quads.empty()) {
    status.status = FaceStatus::merged;
    status.note = "crossed: covered by quads whose centers lie on its neighbors";
  }
  if (record.problem) status.note = record.problem->what();
  if (!mesh) return status;
  status.quads = static_cast<int>(mesh->quads.size());
  status.q_min = 1;
  for (const auto& quad : mesh->quads) status.q_min = std::min(status.q_min, quad_q(mesh->points, quad));
  return status;
}

/// Those inside joined faces too.
std::vector<ShellMesh::CrossedEdge> crossed_edges(const Prepared& prepared,
                                                  const std::vector<EdgeId>& edges) {
  std::vector<ShellMesh::CrossedEdge> result = prepared.simple.inner;
  for (const EdgeId edge : edges) result.push_back(crossed_edge(prepared.shape.edges[edge]));
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

/// By node: the model's vertex in the corner before which a face ends there.
std::map<int, int> cut_corners(const Prepared& prepared, const TinyFeatures& tiny, const ShellMesh& mesh) {
  std::map<int, int> corner_of, result;  // by vertex number
  for (const auto& [face, id] : tiny.folded) {
    const CadEdge& edge = prepared.shape.edges[id];
    const auto [low, high] = std::minmax({edge.first_vertex.number(), edge.last_vertex.number()});
    if (low <= prepared.vertices && high > prepared.vertices) corner_of[high] = low;
  }
  for (const ShellMesh::Corner& corner : mesh.corners)
    if (const auto found = corner_of.find(corner.vertex); found != corner_of.end())
      result[corner.node] = found->second;
  return result;
}

/// Lists the nodes at the places that users chose, and drops the corners at other vertices that are not the
/// model's.
void name_placed_nodes(const Prepared& prepared, ShellMesh& mesh) {
  std::map<int, int> nodes;  // by vertex number
  for (const ShellMesh::Corner& corner : mesh.corners) nodes[corner.vertex] = corner.node;
  std::set<int> added;
  for (const auto& [name, vertex] : prepared.placed.nodes) {
    const Vector3& place = prepared.shape.vertices[vertex];
    const auto found = nodes.find(vertex.number());
    const bool is_there = found != nodes.end() && mesh.points[found->second] == place;
    if (!is_there && !prepared.options.partial)
      throw failure("nodes_at",
                    fmt::format("`nodes_at` {} at {} got no node, because small features around it are "
                                "suppressed: use `keep_features`, or a smaller size there",
                                name, place_text(place)));
    const bool is_added = vertex.number() > prepared.vertices;
    mesh.placed_nodes.push_back({name, is_there ? vertex.number() : 0, is_added});
    if (is_there && is_added) added.insert(vertex.number());
  }
  std::erase_if(mesh.corners, [&](const auto& corner) {
    return corner.vertex > prepared.vertices && !added.contains(corner.vertex);
  });
}

}  // namespace

std::vector<ShellMesh::SuppressedFeature> suppressed_features(const Prepared& prepared,
                                                              const TinyFeatures& tiny) {
  using Kind = ShellMesh::SuppressedFeature::Kind;
  const CadShape& shape = prepared.shape;
  std::vector<ShellMesh::SuppressedFeature> result;
  for (const EdgeId id : tiny.edges.ids()) {
    const CadEdge &edge = shape.edges[id], &other = shape.edges[tiny.edges[id]];
    const VertexId end = tiny.end(edge.first_vertex);
    if (tiny.collapsed_edges[id] && end.number() <= prepared.vertices)
      result.push_back(
          {Kind::edge, edge.number, Kind::vertex, end.number(), distance_from(shape.vertices[end], edge)});
    else if (tiny.edges[id] != id && other.number != edge.number)
      result.push_back({Kind::edge, edge.number, Kind::edge, other.number, distance_between(edge, other)});
  }
  for (const VertexId vertex : tiny.vertices.ids()) {
    const VertexId end = tiny.end(vertex);
    if (end != vertex && std::max(vertex.number(), end.number()) <= prepared.vertices)
      result.push_back({Kind::vertex, vertex.number(), Kind::vertex, end.number(),
                        (shape.vertices[vertex] - shape.vertices[end]).norm()});
  }
  // The pieces of a divided edge come last, and may be suppressed in the same way.
  const auto place = [](const ShellMesh::SuppressedFeature& a) {
    return std::tuple(a.kind, a.number, a.to_kind, a.to);
  };
  std::sort(result.begin(), result.end(), [&](const auto& a, const auto& b) { return place(a) < place(b); });
  result.erase(std::unique(result.begin(), result.end(),
                           [&](const auto& a, const auto& b) { return place(a) == place(b); }),
               result.end());
  return result;
}

std::vector<ShellMesh::Kept> kept_features(const CadShape& shape, const SuppressedFeatures& suppressed) {
  std::vector<ShellMesh::Kept> result;
  for (const auto& [face, why] : suppressed.kept_faces()) result.push_back({2, face.number(), why});
  std::map<int, std::string> edges;  // by number, which the pieces of a divided edge share
  for (const auto& [edge, why] : suppressed.kept_edges()) edges.try_emplace(shape.edges[edge].number, why);
  for (const auto& [number, why] : edges) result.push_back({1, number, why});
  return result;
}

ShellMesh assemble(const Run& run, const Boundary& boundary, const Faces& faces,
                   const std::vector<EdgeId>& crossed) {
  const Prepared& prepared = run.prepared;
  const CadShape& shape = prepared.shape;
  if (prepared.options.partial) run.context.lift_time_limit();
  ShellMesh result =
      assemble(CadGeometry(shape), boundary.nodes, faces.meshes, prepared.options.order, run.context);
  result.faces.resize(shape.faces.size());
  for_each_id(shape.faces,
              [&](FaceId face) { result.faces[face.index()] = status_of(face, prepared, boundary, faces); });
  result.suppressed_features = suppressed_features(prepared, boundary.plan.tiny);
  result.kept = kept_features(shape, boundary.suppressed);
  result.filled_holes = prepared.simple.holes;
  result.crossed_edges = crossed_edges(prepared, crossed);
  const std::map<int, int> corners = cut_corners(prepared, boundary.plan.tiny, result);
  name_placed_nodes(prepared, result);
  result.size_min = prepared.limits.size_min;
  if (prepared.limits.least < prepared.limits.size_min) result.finer_quads = finer_quads(result, run.field);
  result.poor_quads = poor_quads(shape, result, corners);
  return result;
}

}  // namespace quadrille
