#include "mesher/shell/mirror_images.hpp"

#include <algorithm>
#include <bit>
#include <numeric>
#include <set>
#include <string>
#include <utility>

#include "geometry/base/side_key.hpp"

namespace quadrille {

namespace {

bool is_reversed(unsigned image, bool turned) {
  return (std::popcount(image) % 2 != 0) != turned;
}

class Mirror {
 public:
  Mirror(const ShellMesh& mesh, const ModelPart& part, const CadShape& whole)
      : mesh_(mesh), part_(part), whole_(whole), images_(static_cast<unsigned>(part.images.size())) {}

  std::optional<ShellMesh> run() {
    find_nodes_in_planes();
    if (!nodes_are_in_planes() || !ends_in_planes()) return std::nullopt;
    result_.order = mesh_.order;
    add_points();
    add_quads();
    add_segments();
    add_corners();
    add_faces();
    add_off_geometry();
    if (!add_let_go()) return std::nullopt;
    for (const MirrorPlane& plane : part_.planes) result_.symmetry.planes.push_back(plane.name());
    return std::move(result_);
  }

 private:
  void find_nodes_in_planes() {
    in_.assign(mesh_.points.size(), 0);
    for (const ShellMesh::Segment& segment : mesh_.segments) {
      const unsigned in = part_.edges_in[EdgeId::from_number(segment.edge)];
      for (const int node : {segment.nodes[0], segment.nodes[1], segment.middle}) {
        if (node >= 0) in_[node] |= in;
      }
    }
    for (const ShellMesh::Corner& corner : mesh_.corners)
      in_[corner.node] |= part_.vertices_in[VertexId::from_number(corner.vertex)];
  }

  bool nodes_are_in_planes() const {
    const double near = 4e-6 * whole_.diagonal();
    for (std::size_t node = 0; node < in_.size(); ++node) {
      for (std::size_t i = 0; i < part_.planes.size(); ++i) {
        if ((in_[node] >> i & 1U) != 0 && std::abs(part_.planes[i].distance(mesh_.points[node])) > near)
          return false;
      }
    }
    return true;
  }

  /// Whether an edge of the part bounds exactly one of the faces asked for.
  bool is_free(EdgeId edge) const {
    const auto& faces = part_.model.shape().edges[edge].faces;
    return std::count_if(faces.begin(), faces.end(), [&](FaceId face) {
             return mesh_.faces[face.index()].status != FaceStatus::skipped;
           }) == 1;
  }

  /// Whether each side with only one quad lies in a plane or on a free edge.
  bool ends_in_planes() const {
    std::vector<std::uint64_t> sides, ends;
    for (const auto& quad : mesh_.quads) {
      for (int j = 0; j < 4; ++j) sides.push_back(side_key(quad[j], quad[(j + 1) % 4]));
    }
    std::sort(sides.begin(), sides.end());
    for (const ShellMesh::Segment& segment : mesh_.segments) {
      const EdgeId edge = EdgeId::from_number(segment.edge);
      if (part_.edges_in[edge] != 0 || is_free(edge))
        ends.push_back(side_key(segment.nodes[0], segment.nodes[1]));
    }
    std::sort(ends.begin(), ends.end());
    for (std::size_t i = 0; i < sides.size();) {
      std::size_t end = i + 1;
      while (end < sides.size() && sides[end] == sides[i]) ++end;
      if (end == i + 1 && !std::binary_search(ends.begin(), ends.end(), sides[i])) return false;
      i = end;
    }
    return true;
  }

  /// Whether an image of an entity repeats another one: the entity lies in a plane that the image mirrors in.
  bool is_repeated(unsigned image, unsigned in) const { return (image & in) != 0; }
  int node(unsigned image, int of_part) const {
    return of_part < 0 ? -1 : nodes_[image & ~in_[of_part]][of_part];
  }

  void add_points() {
    std::size_t corners = mesh_.points.size();
    for (const auto& quad : mesh_.midsides)
      corners = std::min<std::size_t>(corners, *std::min_element(quad.begin(), quad.end()));
    nodes_.assign(images_, std::vector<int>(mesh_.points.size(), -1));
    const std::pair<std::size_t, std::size_t> ranges[] = {{0, corners}, {corners, mesh_.points.size()}};
    for (const auto& [from, to] : ranges) {
      for (unsigned image = 0; image < images_; ++image) {
        for (std::size_t i = from; i < to; ++i) {
          if (is_repeated(image, in_[i])) continue;
          nodes_[image][i] = static_cast<int>(result_.points.size());
          Vector3 point = mesh_.points[i];
          for (std::size_t k = 0; k < part_.planes.size(); ++k) {
            const MirrorPlane& plane = part_.planes[k];
            if ((in_[i] >> k & 1U) != 0) point -= plane.distance(point) * plane.normal;
          }
          result_.points.push_back(part_.mirrored(point, image));
        }
      }
    }
  }

  FaceId face_of(std::size_t quad) const { return FaceId::from_number(mesh_.quad_faces[quad]); }

  /// Quads are in the order of the faces, as in meshes of whole models.
  void add_quads() {
    std::vector<std::pair<unsigned, std::size_t>> order;
    for (unsigned image = 0; image < images_; ++image) {
      for (std::size_t i = 0; i < mesh_.quads.size(); ++i) order.emplace_back(image, i);
    }
    const auto face = [&](const auto& entry) {
      return part_.images[entry.first].faces[face_of(entry.second)];
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](const auto& a, const auto& b) { return face(a) < face(b); });
    for (const auto& entry : order) {
      const auto [image, index] = entry;
      std::array<int, 4> quad = mesh_.quads[index];
      for (int& corner : quad) corner = node(image, corner);
      const bool reversed = is_reversed(image, part_.images[image].turned[face_of(index)] != 0);
      if (reversed) std::swap(quad[1], quad[3]);
      result_.quads.push_back(quad);
      result_.quad_faces.push_back(face(entry).number());
      if (mesh_.order == 1) continue;
      std::array<int, 4> middles = mesh_.midsides[index];
      for (int& middle : middles) middle = node(image, middle);
      if (reversed) std::reverse(middles.begin(), middles.end());
      result_.midsides.push_back(middles);
    }
  }

  void add_segments() {
    for (unsigned image = 0; image < images_; ++image) {
      const ModelPart::Image& names = part_.images[image];
      for (ShellMesh::Segment segment : mesh_.segments) {
        const EdgeId edge = EdgeId::from_number(segment.edge);
        if (is_repeated(image, part_.edges_in[edge]) || !names.edges[edge].exists()) continue;
        for (int& end : segment.nodes) end = node(image, end);
        segment.middle = node(image, segment.middle);
        if (names.against[edge] != 0) std::swap(segment.nodes[0], segment.nodes[1]);
        segment.edge = whole_.edges[names.edges[edge]].number;
        result_.segments.push_back(segment);
      }
    }
    std::stable_sort(result_.segments.begin(), result_.segments.end(),
                     [](const auto& a, const auto& b) { return a.edge < b.edge; });
  }

  void add_corners() {
    for (unsigned image = 0; image < images_; ++image) {
      for (const ShellMesh::Corner& corner : mesh_.corners) {
        const VertexId own = VertexId::from_number(corner.vertex);
        const VertexId vertex = part_.images[image].vertices[own];
        if (vertex.exists() && !is_repeated(image, part_.vertices_in[own]))
          result_.corners.push_back({node(image, corner.node), vertex.number()});
      }
    }
    std::sort(result_.corners.begin(), result_.corners.end(), [](const auto& a, const auto& b) {
      return std::pair(a.vertex, a.node) < std::pair(b.vertex, b.node);
    });
    const auto last = std::unique(result_.corners.begin(), result_.corners.end(),
                                  [](const auto& a, const auto& b) { return a.vertex == b.vertex; });
    result_.corners.erase(last, result_.corners.end());
  }

  /// A face is meshed if a part of it is. Only the part itself took work and time.
  void add_faces() {
    result_.faces.resize(whole_.faces.size());
    for (std::size_t i = 0; i < result_.faces.size(); ++i) result_.faces[i].face = static_cast<int>(i) + 1;
    std::vector<std::vector<std::string>> notes(result_.faces.size());
    for (unsigned image = 0; image < images_; ++image) {
      for (const ShellMesh::Face& piece : mesh_.faces) {
        const int index = part_.images[image].faces[FaceId::from_number(piece.face)].index();
        ShellMesh::Face& face = result_.faces[index];
        if (face.status != FaceStatus::meshed && piece.status != FaceStatus::skipped)
          face.status = piece.status;
        auto& said = notes[index];
        if (!piece.note.empty() && std::find(said.begin(), said.end(), piece.note) == said.end()) {
          face.note += (said.empty() ? "" : "; ") + piece.note;
          said.push_back(piece.note);
        }
        if (piece.quads > 0) face.q_min = face.quads > 0 ? std::min(face.q_min, piece.q_min) : piece.q_min;
        face.quads += piece.quads;
        face.attempts = std::max(face.attempts, piece.attempts);
        if (image != 0) continue;
        face.work += piece.work;
        face.share += piece.share;
        face.seconds += piece.seconds;
      }
    }
  }

  void add_off_geometry() {
    for (unsigned image = 0; image < images_; ++image) {
      for (const ShellMesh::OffGeometry& off : mesh_.off_geometry) {
        if (!is_repeated(image, in_[off.node]))
          result_.off_geometry.push_back({node(image, off.node), off.distance});
      }
    }
    std::sort(result_.off_geometry.begin(), result_.off_geometry.end(),
              [](const auto& a, const auto& b) { return a.node < b.node; });
  }

  /// An edge or vertex is let go if all its pieces are. \return false if the whole lacks its substitute.
  bool add_let_go() {
    using Kind = ShellMesh::LetGo::Kind;
    std::set<int> edges, vertices;
    for (const ShellMesh::Segment& segment : result_.segments) edges.insert(segment.edge);
    for (const ShellMesh::Corner& corner : result_.corners) vertices.insert(corner.vertex);
    for (unsigned image = 0; image < images_; ++image) {
      const ModelPart::Image& names = part_.images[image];
      const auto name = [&](Kind kind, int number) {
        if (kind == Kind::vertex) return names.vertices[VertexId::from_number(number)].number();
        const EdgeId edge = names.edges[EdgeId::from_number(number)];
        return edge.exists() ? whole_.edges[edge].number : 0;
      };
      for (const ShellMesh::LetGo& feature : mesh_.let_go) {
        const int number = name(feature.kind, feature.number), to = name(feature.to_kind, feature.to);
        if (number == 0 || !(feature.kind == Kind::edge ? edges : vertices).insert(number).second) continue;
        if (to == 0) return false;
        result_.let_go.push_back({feature.kind, number, feature.to_kind, to});
      }
    }
    std::sort(result_.let_go.begin(), result_.let_go.end(), [](const auto& a, const auto& b) {
      return std::pair(a.kind, a.number) < std::pair(b.kind, b.number);
    });
    return true;
  }

  const ShellMesh& mesh_;
  const ModelPart& part_;
  const CadShape& whole_;
  const unsigned images_;
  std::vector<unsigned> in_;  // (nodes of the part) bit i: lies in planes[i]
  std::vector<std::vector<int>>
      nodes_;  // (images, nodes of the part) node of the whole; -1 = see nodes_[image & ~in_]
  ShellMesh result_;
};

}  // namespace

std::optional<ShellMesh> with_mirror_images(const ShellMesh& mesh, const ModelPart& part,
                                            const CadShape& whole) {
  return Mirror(mesh, part, whole).run();
}

}  // namespace quadrille
