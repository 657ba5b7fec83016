/// Based on: Johnen, Remacle, Geuzaine, Geometrical validity of curvilinear finite elements (2013), for what
/// counts as valid.

#include "mesher/shell/midsides.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "mesher/mesh/second_order.hpp"
#include "mesher/mesh/sides.hpp"

namespace quadrille {

namespace {

double jacobian_bound_of(const ShellMesh& mesh, std::size_t quad) {
  return jacobian_bound(curved_quad(mesh, quad));
}

bool folds_in(const ShellMesh& mesh, std::size_t quad) {
  return folds(curved_quad(mesh, quad));
}

/// Moves midside nodes of all faces off the geometry, toward the middles of their straight sides.
class Straightening {
 public:
  Straightening(ShellMesh& mesh, std::size_t first_inner, const ExecutionContext& context)
      : mesh_(mesh),
        first_inner_(static_cast<int>(first_inner)),
        check_(context, 256),
        users_(corners_by_node(mesh.points.size(), mesh.midsides)) {}

  /// Ends, because each round raises shares, and their number is bounded by the number of sides.
  void run(std::vector<std::size_t> folded) {
    while (!folded.empty()) {
      std::set<std::size_t> touched;
      for (const std::size_t quad : folded) {
        check_();
        if (folds_in(mesh_, quad)) straighten(quad, touched);
      }
      folded.assign(touched.begin(), touched.end());
    }
    relax();
  }

  struct Straightened {
    std::size_t quad = 0;   ///< one of its elements
    Vector3 place, middle;  ///< the node's first place, on the geometry; middle of the straight side
    double length = 0;      ///< length of the straight side
    int share = 0;          ///< part of the way from `place` to `middle`, in eighths
  };

  /// The sides of all elements that were straightened, by midside node.
  const std::map<int, Straightened>& sides() const { return sides_; }

 private:
  static constexpr int whole = 8;

  static std::size_t quad_of(Side side) { return static_cast<std::size_t>(element_of(side)); }

  Straightened& side_of(std::size_t quad, int k) {
    const int node = mesh_.midsides[quad][k];
    const auto& corners = mesh_.quads[quad];
    const auto [entry, fresh] = sides_.try_emplace(node);
    if (fresh) {
      entry->second.quad = quad;
      entry->second.place = mesh_.points[node];
      const Vector3 &a = mesh_.points[corners[k]], &b = mesh_.points[corners[(k + 1) % 4]];
      entry->second.middle = 0.5 * (a + b);
      entry->second.length = (b - a).norm();
    }
    return entry->second;
  }

  void set(int node, Straightened& side, int share) {
    side.share = share;
    const double part = static_cast<double>(share) / whole;
    mesh_.points[node] =
        share == whole ? side.middle : Vector3(side.place + part * (side.middle - side.place));
  }

  /// The Jacobian bound that a repaired element needs: 0.02, but at most half of that with straight sides.
  double wanted(std::size_t quad) const {
    constexpr double safe_bound = 0.02;
    return std::min(safe_bound, 0.5 * quick_jacobian_bound(straight_quad(mesh_, quad)));
  }

  /// Raises the shares of an element's sides until it does not fold: first those inside faces, then all.
  /// \param touched out: the neighbors across sides that changed are added.
  void straighten(std::size_t quad, std::set<std::size_t>& touched) {
    const double bound = wanted(quad);
    const std::array<int, 4> nodes = mesh_.midsides[quad];
    std::array<int, 4> before{};
    for (int k = 0; k < 4; ++k) before[k] = side_of(quad, k).share;
    for (const bool edges_too : {false, true}) {
      for (int share = 1; share <= whole; ++share) {
        for (int k = 0; k < 4; ++k) {
          if (edges_too || nodes[k] >= first_inner_)
            set(nodes[k], sides_.at(nodes[k]), std::max(before[k], share));
        }
        if (jacobian_bound_of(mesh_, quad) < bound) continue;
        for (int k = 0; k < 4; ++k) {
          if (sides_.at(nodes[k]).share == before[k]) continue;
          for (const Side user : users_[nodes[k]])
            if (quad_of(user) != quad) touched.insert(quad_of(user));
        }
        return;
      }
    }
  }

  /// Moves nodes back toward the geometry as far as their elements allow, those on CAD edges first.
  void relax() {
    for (auto& [node, side] : sides_) {
      check_();
      const int share = side.share;
      std::vector<double> least;
      const std::span<const Side> users = users_[node];
      for (const Side user : users)
        least.push_back(std::min(wanted(quad_of(user)), jacobian_bound_of(mesh_, quad_of(user))));
      const auto holds = [&] {
        for (std::size_t i = 0; i < least.size(); ++i) {
          if (jacobian_bound_of(mesh_, quad_of(users[i])) < least[i]) return false;
        }
        return true;
      };
      for (int less = 0; less <= share; ++less) {
        set(node, side, less);
        if (less == share || holds()) break;
      }
    }
  }

  ShellMesh& mesh_;
  int first_inner_;
  SparseCheck check_;
  Rows<Side> users_;  // the sides of each midside node
  std::map<int, Straightened> sides_;
};

/// The elements that fold, ascending.
std::vector<std::size_t> find_folded(const ShellMesh& mesh, const ExecutionContext& context) {
  std::vector<char> folds(mesh.quads.size(), 0);
  constexpr std::size_t quads_per_check = 256;
  const oneapi::tbb::blocked_range<std::size_t> all(0, folds.size(), quads_per_check);
  const auto look_at = [&](const auto& range) {
    context.check();
    for (std::size_t quad = range.begin(); quad < range.end(); ++quad) folds[quad] = folds_in(mesh, quad);
  };
  oneapi::tbb::parallel_for(all, look_at, oneapi::tbb::simple_partitioner());
  std::vector<std::size_t> result;
  for (std::size_t quad = 0; quad < folds.size(); ++quad)
    if (folds[quad]) result.push_back(quad);
  return result;
}

/// Lists the nodes that are off the geometry now.
void list(const Straightening& straightening, const MeshedFaces& meshed, const ShellNumbering& numbering,
          const Midsides& midsides, ShellMesh& mesh) {
  constexpr double on_geometry = 1e-7;  // share of a side; on a planar face nodes stay on the geometry
  std::shared_ptr<const MeshSurface> surface;
  FaceId face;  // face of `surface`
  for (const auto& [node, side] : straightening.sides()) {
    if (side.share == 0) continue;
    Vector3 nearest = side.place;
    if (node >= static_cast<int>(midsides.first_inner)) {
      if (const FaceId of_side = numbering.face_of(side.quad); of_side != face) {
        face = of_side;
        surface = meshed.surface(face);
      }
      Vector2 uv = midsides.parameters[node - midsides.first_inner];
      nearest = surface->nearest(uv, mesh.points[node]);
    }
    const double distance = (mesh.points[node] - nearest).norm();
    if (distance > on_geometry * side.length) mesh.off_geometry.push_back({node, distance});
  }
}

}  // namespace

std::vector<std::size_t> unfold(const MeshedFaces& meshed, const ShellNumbering& numbering,
                                const Midsides& midsides, ShellMesh& mesh, const ExecutionContext& context) {
  const std::vector<std::size_t> left = find_folded(mesh, context);
  if (left.empty()) return {};
  Straightening straightening(mesh, midsides.first_inner, context);
  straightening.run(left);
  list(straightening, meshed, numbering, midsides, mesh);
  return find_folded(mesh, context);
}

}  // namespace quadrille
