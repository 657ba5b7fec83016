#include "mesher/shell/assembly.hpp"

#include <algorithm>
#include <unordered_map>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include "geometry/surfaces/edge_curve.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/mesh/side_key.hpp"
#include "mesher/shell/second_order.hpp"

namespace quadrille {

namespace {

/// Moves the midside nodes inside one face where curved boundary sides make second-order elements invalid.
class MidsideRepair {
 public:
  /// \param first_quad,end_quad the face's elements
  /// \param first_inner index of the first midside node inside a face; `parameters` are theirs
  MidsideRepair(ShellMesh& mesh, const FaceSurface& surface, std::size_t first_quad, std::size_t end_quad,
                std::size_t first_inner, std::vector<Vector2>& parameters, const ExecutionContext& context)
      : mesh_(mesh),
        surface_(surface),
        first_inner_(first_inner),
        parameters_(parameters),
        check_(context, 256) {
    for (std::size_t quad = first_quad; quad < end_quad; ++quad) {
      check_();
      for (const int node : mesh_.midsides[quad]) users_[node].push_back(quad);
    }
  }

  void run(const std::vector<std::size_t>& bad) {
    constexpr int sweeps = 4;
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      for (const std::size_t quad : bad) repair(quad);
    }
  }

 private:
  void repair(std::size_t quad) {
    for (int k = 0; k < 4 && jacobian_bound(mesh_, quad) <= 0; ++k) {
      const int node = mesh_.midsides[quad][k];
      if (node >= static_cast<int>(first_inner_))
        search(node, mesh_.quads[quad][k], mesh_.quads[quad][(k + 1) % 4]);
    }
  }

  double worst(int node) const {
    double result = 1;
    for (const std::size_t quad : users_.at(node)) result = std::min(result, jacobian_bound(mesh_, quad));
    return result;
  }

  /// Compass search in the tangent plane for the best of the node's elements at their worst.
  void search(int node, int a, int b) {
    check_();
    Vector2& uv = parameters_[node - first_inner_];
    const Vector3 along = mesh_.points[b] - mesh_.points[a];
    const Vector3 across = surface_.normal(uv).cross(along);
    double best = worst(node);
    constexpr int halvings = 5;
    double step = 0.25;
    for (int i = 0; i < halvings; ++i, step *= 0.5) {
      for (const Vector3& direction : {across, Vector3(-across), along, Vector3(-along)}) {
        const Vector3 old = mesh_.points[node];
        Vector2 moved = uv;
        mesh_.points[node] = surface_.project(moved, old + step * direction).point;
        const double now = worst(node);
        if (now > best) {
          best = now;
          uv = moved;
        } else {
          mesh_.points[node] = old;
        }
      }
    }
  }

  ShellMesh& mesh_;
  const FaceSurface& surface_;
  std::size_t first_inner_;
  std::vector<Vector2>& parameters_;
  SparseCheck check_;
  std::unordered_map<int, std::vector<std::size_t>> users_;
};

class Assembler {
 public:
  Assembler(const CadShape& shape, const BoundaryNodes& nodes,
            const std::vector<std::optional<FaceMesh>>& faces, const ExecutionContext& context)
      : shape_(shape),
        nodes_(nodes),
        faces_(faces),
        context_(context),
        check_(context),
        renumbered_(nodes.points.size(), -1) {}

  ShellMesh run(int order) {
    number_boundary();
    add_faces();
    add_segments();
    if (order == 2) add_midsides();
    return std::move(mesh_);
  }

  /// (faces) how many second-order elements fold; empty at first order.
  const std::vector<int>& folded() const { return folded_; }

 private:
  /// On all threads, for those that are meshed.
  template <class Work>
  void for_each_face(Work&& work) const {
    oneapi::tbb::parallel_for(std::size_t{0}, faces_.size(), [&](std::size_t face) {
      if (faces_[face]) work(face);
    });
  }

  void number_boundary() {
    std::vector<std::vector<char>> used_by(faces_.size());
    for_each_face([&](std::size_t index) {
      const FaceMesh& face = *faces_[index];
      const int fixed = static_cast<int>(face.nodes.size());
      std::vector<char>& used = used_by[index];
      used.assign(fixed, 0);
      SparseCheck check(context_);
      for (const auto& quad : face.quads) {
        check();
        for (const int corner : quad) {
          if (corner < fixed) used[corner] = 1;
        }
      }
    });
    std::vector<char> used(nodes_.points.size(), 0);
    for (std::size_t face = 0; face < faces_.size(); ++face) {
      for (std::size_t i = 0; i < used_by[face].size(); ++i) used[faces_[face]->nodes[i]] |= used_by[face][i];
    }
    for (std::size_t i = 0; i < used.size(); ++i) {
      if (!used[i]) continue;
      renumbered_[i] = static_cast<int>(mesh_.points.size());
      mesh_.points.push_back(nodes_.points[i]);
    }
    std::vector<char> listed(nodes_.points.size(), 0);
    for (std::size_t vertex = 0; vertex < nodes_.vertex_nodes.size(); ++vertex) {
      const int node = nodes_.vertex_nodes[vertex];
      // The ends of edges that became points share a node: it is the first one's.
      if (node >= 0 && renumbered_[node] >= 0 && !listed[node]) {
        listed[node] = 1;
        mesh_.corners.push_back({renumbered_[node], static_cast<int>(vertex) + 1});
      }
    }
  }

  void add_faces() {
    std::vector<std::size_t> first_point(faces_.size());
    std::size_t points = mesh_.points.size();
    first_quad_.assign(faces_.size() + 1, 0);
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      first_point[i] = points;
      first_quad_[i + 1] = first_quad_[i];
      if (!faces_[i]) continue;
      points += faces_[i]->points.size() - faces_[i]->nodes.size();
      first_quad_[i + 1] += faces_[i]->quads.size();
    }
    mesh_.points.resize(points);
    mesh_.quads.resize(first_quad_.back());
    mesh_.quad_faces.resize(first_quad_.back());
    for_each_face([&](std::size_t face) { add_face(face, first_point[face]); });
  }

  void add_face(std::size_t index, std::size_t first_point) {
    const FaceMesh& face = *faces_[index];
    const std::size_t fixed = face.nodes.size();
    SparseCheck check(context_);
    std::vector<int> global(face.points.size());
    for (std::size_t i = 0; i < fixed; ++i) global[i] = renumbered_[face.nodes[i]];
    for (std::size_t i = fixed; i < face.points.size(); ++i) {
      check();
      const std::size_t node = first_point + i - fixed;
      global[i] = static_cast<int>(node);
      mesh_.points[node] = face.points[i];
    }
    std::size_t at = first_quad_[index];
    for (const auto& quad : face.quads) {
      check();
      mesh_.quads[at] = {global[quad[0]], global[quad[1]], global[quad[2]], global[quad[3]]};
      mesh_.quad_faces[at++] = static_cast<int>(index) + 1;
    }
  }

  void add_segments() {
    for (std::size_t i = 0; i < nodes_.edges.size(); ++i) {
      const auto& edge = nodes_.edges[i];
      if (edge.borrowed) continue;
      for (int k = 0; k < edge.segments(); ++k) {
        const int a = renumbered_[edge.nodes[k]], b = renumbered_[edge.nodes[k + 1]];
        if (a < 0 || b < 0) continue;
        mesh_.segments.push_back({{a, b}, -1, shape_.edges[i].number});
        segment_origins_.push_back({static_cast<int>(i), k});
      }
    }
  }

  /// The midside nodes of one face that are not on CAD edges.
  struct FaceMidsides {
    std::vector<std::array<int, 4>> of_quads;  ///< index of each side's, or -1 - node on a CAD edge
    std::vector<Vector3> points;
    std::vector<Vector2> parameters;
    /// Sides between two nodes on the boundary: index and key, ascending. Another face may have them, too.
    std::vector<std::pair<int, std::uint64_t>> chords;
  };

  /// Midside nodes of CAD edges on their curves, of other sides on the surface of their face.
  void add_midsides() {
    mesh_.order = 2;
    for (std::size_t s = 0; s < mesh_.segments.size(); ++s) {
      check_();
      auto& segment = mesh_.segments[s];
      const auto [edge, k] = segment_origins_[s];
      const EdgeCurve curve(shape_.edges[edge]);
      const auto& t = nodes_.edges[edge].parameters;
      segment.middle = static_cast<int>(mesh_.points.size());
      mesh_.points.push_back(curve_middle(curve, t[k], t[k + 1]));
      middles_.emplace(side_key(segment.nodes[0], segment.nodes[1]), segment.middle);
    }
    const std::size_t first_inner = mesh_.points.size();
    std::vector<FaceMidsides> midsides(faces_.size());
    for_each_face([&](std::size_t face) { midsides[face] = place_midsides(face); });
    std::vector<Vector2> parameters;  // of the midside nodes inside faces
    for (FaceMidsides& face : midsides) {
      number_midsides(face, parameters);
      face = {};
    }
    mend_midsides(first_inner, parameters);
  }

  std::shared_ptr<const FaceSurface> surface_of(std::size_t face) const {
    return faces_[face]->surface ? faces_[face]->surface
                                 : std::make_shared<const FaceSurface>(shape_.faces[face]);
  }

  FaceMidsides place_midsides(std::size_t index) const {
    const FaceMesh& face = *faces_[index];
    const auto surface = surface_of(index);
    SparseCheck check(context_, 256);
    // Sides in rows by their lower end; a row ends at the first place that is free.
    struct Side {
      int high = -1, midside = -1;
    };
    std::vector<int> rows(face.points.size() + 1, 0);
    for (const auto& quad : face.quads) {
      for (int k = 0; k < 4; ++k) ++rows[std::min(quad[k], quad[(k + 1) % 4]) + 1];
    }
    for (std::size_t i = 1; i < rows.size(); ++i) rows[i] += rows[i - 1];
    std::vector<Side> sides(rows.back());
    FaceMidsides result;
    result.of_quads.reserve(face.quads.size());
    result.points.reserve(2 * face.quads.size());
    result.parameters.reserve(2 * face.quads.size());
    const int fixed = static_cast<int>(face.nodes.size());
    const auto place = [&](int a, int b) {
      result.points.push_back(surface_middle(*surface, face, a, b, result.parameters.emplace_back()));
      return static_cast<int>(result.points.size()) - 1;
    };
    for (const auto& quad : face.quads) {
      check();
      std::array<int, 4>& of_quad = result.of_quads.emplace_back();
      for (int k = 0; k < 4; ++k) {
        const int a = quad[k], b = quad[(k + 1) % 4], high = std::max(a, b);
        if (high < fixed) {
          const std::uint64_t key = side_key(renumbered_[face.nodes[a]], renumbered_[face.nodes[b]]);
          const auto on_edge = middles_.find(key);
          of_quad[k] = on_edge != middles_.end() ? -1 - on_edge->second : place(a, b);
          if (of_quad[k] >= 0) result.chords.emplace_back(of_quad[k], key);
          continue;
        }
        auto side = sides.begin() + rows[std::min(a, b)];
        while (side->high >= 0 && side->high != high) ++side;
        if (side->high < 0) *side = {high, place(a, b)};
        of_quad[k] = side->midside;
      }
    }
    return result;
  }

  void number_midsides(const FaceMidsides& face, std::vector<Vector2>& parameters) {
    std::vector<int> numbers;
    numbers.reserve(face.points.size());
    auto chord = face.chords.begin();
    for (std::size_t i = 0; i < face.points.size(); ++i) {
      check_();
      const int next = static_cast<int>(mesh_.points.size());
      numbers.push_back(next);
      if (chord != face.chords.end() && chord->first == static_cast<int>(i)) {
        numbers.back() = middles_.emplace(chord++->second, next).first->second;
        if (numbers.back() != next) continue;
      }
      mesh_.points.push_back(face.points[i]);
      parameters.push_back(face.parameters[i]);
    }
    for (const auto& of_quad : face.of_quads) {
      check_();
      auto& midsides = mesh_.midsides.emplace_back();
      for (int k = 0; k < 4; ++k) midsides[k] = of_quad[k] < 0 ? -1 - of_quad[k] : numbers[of_quad[k]];
    }
  }

  /// Moves midside nodes where elements fold, and counts those that still do.
  void mend_midsides(std::size_t first_inner, std::vector<Vector2>& parameters) {
    std::vector<std::vector<std::size_t>> folded(faces_.size());
    const auto find_folded = [&](std::size_t face) {
      SparseCheck check(context_, 256);
      folded[face].clear();
      for (std::size_t quad = first_quad_[face]; quad < first_quad_[face + 1]; ++quad) {
        check();
        if (jacobian_bound(mesh_, quad) <= 0) folded[face].push_back(quad);
      }
    };
    for_each_face(find_folded);
    folded_.assign(faces_.size(), 0);
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      if (folded[i].empty()) continue;
      const auto surface = surface_of(i);
      MidsideRepair(mesh_, *surface, first_quad_[i], first_quad_[i + 1], first_inner, parameters, context_)
          .run(folded[i]);
      find_folded(i);
      folded_[i] = static_cast<int>(folded[i].size());
    }
  }

  /// The point of a curve as far from both ends: half the arc for the short pieces here.
  static Vector3 curve_middle(const EdgeCurve& curve, double a, double b) {
    const Vector3 from = curve.point(a), to = curve.point(b);
    double low = a, high = b;
    constexpr int bisections = 30;
    for (int i = 0; i < bisections; ++i) {
      const double t = 0.5 * (low + high);
      Vector3 p = curve.point(t);
      const double difference = (p - from).norm() - (p - to).norm();
      if (std::abs(difference) < 1e-9 * (to - from).norm()) return p;
      (difference < 0 ? low : high) = t;
    }
    return curve.point(0.5 * (low + high));
  }

  static Vector3 surface_middle(const FaceSurface& surface, const FaceMesh& face, int a, int b, Vector2& uv) {
    const Vector3 target = 0.5 * (face.points[a] + face.points[b]);
    uv = 0.5 * (face.uv[a] + face.uv[b]);
    if (face.pole[a]) uv = face.uv[b];
    if (face.pole[b]) uv = face.uv[a];
    return surface.project(uv, target).point;
  }

  const CadShape& shape_;
  const BoundaryNodes& nodes_;
  const std::vector<std::optional<FaceMesh>>& faces_;
  const ExecutionContext& context_;
  SparseCheck check_;
  std::vector<int> renumbered_;
  std::vector<std::size_t> first_quad_;  ///< (faces and one more)
  std::vector<std::pair<int, int>> segment_origins_;
  std::unordered_map<std::uint64_t, int> middles_;  ///< of sides between nodes on the boundary
  std::vector<int> folded_;
  ShellMesh mesh_;
};

/// Says where second-order elements stay invalid: between curves that touch each other (a cusp) no position
/// of the midside nodes mends them. \param folded (faces) how many elements do.
void note_folded(ShellMesh& mesh, const std::vector<int>& folded) {
  for (std::size_t face = 0; face < folded.size(); ++face) {
    if (folded[face] == 0) continue;
    std::string& note = mesh.faces[face].note;
    if (!note.empty()) note += "; ";
    note += fmt::format("{} second-order elements fold: choose a smaller size on this face", folded[face]);
  }
}

}  // namespace

ShellMesh assemble(const CadShape& shape, const BoundaryNodes& nodes,
                   const std::vector<std::optional<FaceMesh>>& faces,
                   std::vector<ShellMesh::FaceStatus> statuses, const MeshOptions& options,
                   ExecutionContext& context) {
  const StageTimer timer(context, "assemble");
  Assembler assembler(shape, nodes, faces, context);
  ShellMesh mesh = assembler.run(options.order);
  mesh.faces = std::move(statuses);
  note_folded(mesh, assembler.folded());
  return mesh;
}

}  // namespace quadrille
