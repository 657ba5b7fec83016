/// Meshes the faces on all threads, then numbers their nodes and elements face by face.

#include "mesher/shell/assembly.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "geometry/base/error.hpp"
#include "geometry/base/place_text.hpp"
#include "geometry/cad/parallel_ids.hpp"
#include "mesher/mesh/sides.hpp"

namespace quadrille {

namespace {

/// Numbers the nodes and elements of a first-order shell.
class Assembler {
 public:
  Assembler(const MeshedFaces& meshed, const ExecutionContext& context)
      : geometry_(meshed.geometry), nodes_(meshed.nodes), faces_(meshed.faces), context_(context) {}

  ShellMesh run() {
    number_boundary();
    add_faces();
    add_segments();
    note_off_surface();
    return std::move(mesh_);
  }

  const ShellNumbering& numbering() const { return numbering_; }

 private:
  void number_boundary() {
    std::vector<char> used(nodes_.points.size(), 0);
    SparseCheck check(context_);
    for (const auto& face : faces_) {
      for (std::size_t i = 0; face && i < face->quads.size(); ++i) {
        check();
        for (const int corner : face->quads[i])
          if (corner < static_cast<int>(face->nodes.size())) used[face->nodes[corner]] = 1;
      }
    }
    numbering_.nodes.assign(used.size(), -1);
    for (std::size_t i = 0; i < used.size(); ++i) {
      if (!used[i]) continue;
      numbering_.nodes[i] = static_cast<int>(mesh_.points.size());
      mesh_.points.push_back(nodes_.points[i]);
    }
    std::vector<char> listed(nodes_.points.size(), 0);
    for (const VertexId vertex : nodes_.vertex_nodes.ids()) {
      const int node = nodes_.vertex_nodes[vertex];
      // The ends of an edge that became a point share a node: it is listed for the first vertex.
      if (node >= 0 && numbering_.nodes[node] >= 0 && !listed[node]) {
        listed[node] = 1;
        mesh_.corners.push_back({numbering_.nodes[node], vertex.number()});
      }
    }
  }

  void add_faces() {
    std::size_t points = mesh_.points.size();
    std::size_t quads = 0;
    for (const FaceId face : faces_.ids()) {
      first_point_[face] = points;
      numbering_.first_quad.push_back(quads);
      if (!faces_[face]) continue;
      points += faces_[face]->points.size() - faces_[face]->nodes.size();
      quads += faces_[face]->quads.size();
    }
    numbering_.first_quad.push_back(quads);
    mesh_.points.resize(points);
    mesh_.quads.resize(quads);
    mesh_.quad_faces.resize(quads);
    for_each_id(faces_, [&](FaceId face) {
      if (faces_[face]) add_face(face);
    });
  }

  void add_face(FaceId id) {
    const FaceMesh& face = *faces_[id];
    SparseCheck check(context_);
    std::vector<int> global;
    global.reserve(face.points.size());
    for (const int node : face.nodes) global.push_back(numbering_.nodes[node]);
    for (std::size_t i = face.nodes.size(); i < face.points.size(); ++i) {
      check();
      global.push_back(number_inside(id, i));
      mesh_.points[global.back()] = face.points[i];
    }
    std::size_t at = numbering_.first_quad[id.index()];
    const int number = geometry_.number(id);
    for (const auto& quad : face.quads) {
      check();
      mesh_.quads[at] = with_numbers(quad, global);
      mesh_.quad_faces[at++] = number;
    }
  }

  /// The node of the shell at point i of a face, which lies inside the face.
  int number_inside(FaceId face, std::size_t i) const {
    return static_cast<int>(first_point_[face] + i - faces_[face]->nodes.size());
  }

  void add_segments() {
    for (const EdgeId id : nodes_.edges.ids()) {
      const auto& edge = nodes_.edges[id];
      for (int k = 0; !edge.borrows && k < edge.segments(); ++k) {
        const int a = numbering_.nodes[edge.nodes[k]], b = numbering_.nodes[edge.nodes[k + 1]];
        if (a < 0 || b < 0) continue;
        mesh_.segments.push_back({{a, b}, -1, geometry_.number(id)});
        numbering_.segments.push_back({id, k});
      }
    }
  }

  void note_off_surface() {
    for (const auto& [node, distance] : nodes_.off)
      if (numbering_.nodes[node] >= 0) mesh_.off_geometry.push_back({numbering_.nodes[node], distance});
    for (const FaceId id : faces_.ids()) {
      if (!faces_[id]) continue;
      const FaceMesh& face = *faces_[id];
      for (std::size_t i = face.nodes.size(); i < face.off.size(); ++i)
        if (face.off[i] > 0) mesh_.off_geometry.push_back({number_inside(id, i), face.off[i]});
    }
  }

  const ShellGeometry& geometry_;
  const BoundaryNodes& nodes_;
  const FaceMeshes& faces_;
  const ExecutionContext& context_;
  IdVector<FaceId, std::size_t> first_point_{faces_.size()};  ///< inside the face
  ShellNumbering numbering_;
  ShellMesh mesh_;
};

/// Adds midside nodes on the geometry, or off it where elements would fold. Throws if some still fold.
void make_second_order(const MeshedFaces& meshed, const ShellNumbering& numbering, ShellMesh& mesh,
                       const ExecutionContext& context) {
  Midsides midsides = add_midsides(meshed, numbering, mesh, context);
  const std::vector<std::size_t> folded = unfold(meshed, numbering, midsides, mesh, context);
  std::stable_sort(mesh.off_geometry.begin(), mesh.off_geometry.end(),
                   [](const auto& a, const auto& b) { return a.node < b.node; });
  if (folded.empty()) return;
  const int face = mesh.quad_faces[folded.front()];
  const auto count = std::count_if(folded.begin(), folded.end(),
                                   [&](std::size_t quad) { return mesh.quad_faces[quad] == face; });
  const std::string name = fmt::format("Face{}", face);
  throw failure(
      name,
      fmt::format(
          "{} has {} second-order elements that fold even with straight sides: use a smaller size on it",
          name, count));
}

}  // namespace

void note_off_geometry(ShellMesh& mesh) {
  if (mesh.off_geometry.empty()) return;
  std::vector<double> distance(mesh.points.size(), -1);
  for (const auto& off : mesh.off_geometry) distance[off.node] = off.distance;
  std::set<std::pair<int, int>> met;  // (face, node)
  for (std::size_t quad = 0; quad < mesh.quads.size(); ++quad) {
    const auto look_at = [&](const std::array<int, 4>& nodes) {
      for (const int node : nodes)
        if (distance[node] >= 0) met.emplace(mesh.quad_faces[quad], node);
    };
    look_at(mesh.quads[quad]);
    if (mesh.order == 2) look_at(mesh.midsides[quad]);
  }
  for (const auto& [face, node] : met) {
    ShellMesh::Face& status = mesh.faces[face - 1];
    ++status.off_geometry;
    status.off_geometry_max = std::max(status.off_geometry_max, distance[node]);
  }
  for (ShellMesh::Face& face : mesh.faces) {
    if (face.off_geometry == 0) continue;
    if (!face.note.empty()) face.note += ", ";
    face.note += fmt::format("{} nodes up to {} off the geometry, where elements would be invalid",
                             face.off_geometry, number_text(face.off_geometry_max));
  }
}

ShellMesh assemble(const ShellGeometry& geometry, const BoundaryNodes& nodes, const FaceMeshes& faces,
                   int order, ExecutionContext& context) {
  const StageTimer timer(context, Stage::assemble);
  context.report(Stage::assemble, 0);
  const MeshedFaces meshed{geometry, nodes, faces};
  Assembler assembler(meshed, context);
  ShellMesh mesh = assembler.run();
  if (order == 2) make_second_order(meshed, assembler.numbering(), mesh, context);
  return mesh;
}

}  // namespace quadrille
