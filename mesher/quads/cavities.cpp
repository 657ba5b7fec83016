/// Grows a patch to the nearest irregular nodes, refills its outline, and keeps the result if it is not
/// worse.

#include "mesher/quads/cavities.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <unordered_set>

#include "geometry/base/whole_number.hpp"
#include "mesher/quads/criteria_patch.hpp"
#include "mesher/quads/edited_mesh.hpp"
#include "mesher/quads/polygon_filling.hpp"

namespace quadrille {
namespace {

using Quad = QuadTopology::Quad;

constexpr int max_quads = 150;   ///< quads in a patch, before and after
constexpr int max_growths = 8;   ///< how often a patch may grow
constexpr int max_search = 600;  ///< quads looked at for the nearest irregular node
/// The same two limits for patches that choose the nodes to which they grow.
constexpr int few_growths = 4, near_search = 100;
/// To preserve sizes: least and most quads of a filling as a share of the patch's, and the share of the
/// face's quads that may be gained or lost in all.
constexpr double least_share = 0.7, most_share = 1.35, most_drift = 0.08;
constexpr int few_quads = 8;  ///< this many quads may be gained or lost in any face
/// Scaled Jacobian above which quads may start: smoothing repairs them.
constexpr double mendable_filling = 0.2;
/// How much the sum of the quads' objectives may rise for each unit of valence cost saved. The nodes of the
/// patch have been smoothed, those of a filling not yet.
constexpr double rise_per_cost = 0.3;

/// Quads that are replaced together, and how many of them each node has.
class GrowingPatch {
 public:
  explicit GrowingPatch(const QuadTopology& topology) : topology_(topology) {}

  const std::vector<int>& quads() const { return quads_; }
  std::size_t size() const { return quads_.size(); }
  bool contains(int quad) const { return is_in_[quad] != 0; }
  int uses(int node) const { return uses_[node]; }

  /// Must be called after quads or nodes were added to the mesh.
  void make_room(int nodes) {
    is_in_.resize(topology_.size(), 0);
    uses_.resize(nodes, 0);
  }

  void clear() {
    for (const int quad : quads_) {
      is_in_[quad] = 0;
      for (const int node : topology_.quad(quad)) uses_[node] = 0;
    }
    quads_.clear();
  }

  /// False if the patch is full.
  bool add(int quad) {
    if (contains(quad)) return true;
    if (quads_.size() == max_quads) return false;
    is_in_[quad] = 1;
    for (const int node : topology_.quad(quad)) ++uses_[node];
    quads_.push_back(quad);
    return true;
  }

  void restore(const std::vector<int>& quads) {
    clear();
    for (const int quad : quads) add(quad);
  }

  /// Equal for the same quads in any order, as long as they keep their nodes.
  std::uint64_t fingerprint() const {
    std::uint64_t sum = 0;
    for (const int quad : quads_) {
      std::uint64_t print = static_cast<std::uint64_t>(quad);
      for (const int node : topology_.quad(quad))
        print = (print ^ (print >> 29) ^ static_cast<std::uint64_t>(node)) * 0x9E3779B97F4A7C15u;
      sum += print ^ (print >> 32);
    }
    return sum;
  }

 private:
  const QuadTopology& topology_;
  std::vector<int> quads_;
  std::vector<char> is_in_;  ///< by quad
  std::vector<int> uses_;    ///< by node: quads of the patch
};

/// A patch as a polygon with nodes inside.
struct Cavity {
  std::vector<int> ring, inside;  ///< nodes
  std::vector<int> corners;       ///< indices into the ring
  int cost = 0;                   ///< valence cost of the patch as it is
};

/// Replaces patches by the first filling that is not worse.
class CavityFiller {
 public:
  CavityFiller(EditedMesh& mesh, const MeshSurface& surface) : mesh_(mesh), surface_(surface) {}

  /// Replaces a patch by a filling with fewer irregular nodes, if there is one. \return whether it did.
  bool fill(GrowingPatch& patch, const Cavity& cavity) {
    if (cavity.cost < 2 || !is_flat(cavity) || !seen_.insert(patch.fingerprint()).second) return false;
    std::vector<Vector3> outline;
    for (const int node : cavity.ring) outline.push_back(mesh_.point(node));
    const auto share = [&](double of) { return round_to_int(of * static_cast<double>(patch.size())); };
    // Quads gained or lost already may be given back, however many they are.
    const int drift = std::max({std::abs(drift_), few_quads, static_cast<int>(most_drift * first_count_)});
    const int count = static_cast<int>(patch.size()) - drift_;
    const FillingLimits limits{.most_irregular = cavity.cost - 1,
                               .least_quads = std::max(share(least_share), count - drift),
                               .most_quads = std::min({share(most_share), count + drift, max_quads})};
    return fill_polygon(outline, cavity.corners, limits,
                        [&](const PolygonFilling& filling) { return put(filling, patch, cavity); });
  }

 private:
  /// Whether the patch is flat enough for places interpolated between its nodes to make sense.
  bool is_flat(const Cavity& cavity) const {
    constexpr double least_cosine = 0.7;
    Vector3 mean = Vector3::Zero();
    for (const int node : cavity.ring) mean += mesh_.normal(node);
    mean.normalize();
    const auto turned = [&](int node) { return !(mesh_.normal(node).dot(mean) > least_cosine); };
    return std::none_of(cavity.ring.begin(), cavity.ring.end(), turned) &&
           std::none_of(cavity.inside.begin(), cavity.inside.end(), turned);
  }

  /// The mean distance of the quads from the industry criteria; no quad counts for more than `max_each`.
  double mean_objective(const std::vector<Quad>& quads) const {
    constexpr double max_each = 20;
    double sum = 0;
    for (const Quad& quad : quads) sum += std::min(max_each, measure_objective(mesh_.points(), quad).value);
    return sum / static_cast<double>(quads.size());
  }

  /// Replaces the patch by a filling unless its quads are worse.
  bool put(const PolygonFilling& filling, GrowingPatch& patch, const Cavity& cavity) {
    std::vector<Quad> before;
    for (const int quad : patch.quads()) before.push_back(mesh_.topology().quad(quad));
    std::vector<int> nodes = cavity.ring;
    for (std::size_t i = cavity.ring.size(); i < filling.places.size(); ++i)
      nodes.push_back(place(filling.places[i], cavity));
    std::vector<Quad> quads = filling.quads;
    for (Quad& quad : quads)
      for (int& node : quad) node = nodes[node];
    const auto count = static_cast<double>(quads.size());
    const bool done = !mesh_.too_long(before, quads) &&
                      mesh_.worst(quads) > std::min(mesh_.worst(before), mendable_filling) &&
                      mean_objective(quads) <
                          mean_objective(before) + rise_per_cost * (cavity.cost - filling.irregular) / count;
    const std::vector<int> old = patch.quads();
    patch.clear();
    if (done && mesh_.topology().replace(old, quads)) {
      spare_.clear();
      drift_ += static_cast<int>(quads.size()) - static_cast<int>(old.size());
      return true;
    }
    patch.restore(old);
    // Keep the new nodes for the next filling.
    spare_.assign(nodes.begin() + static_cast<long>(cavity.ring.size()), nodes.end());
    return false;
  }

  /// A free node at the point of the surface nearest to the target.
  int place(const Vector3& target, const Cavity& cavity) {
    const auto nearest = [&](const std::vector<int>& nodes, int best) {
      for (const int node : nodes)
        if (best < 0 ||
            (mesh_.point(node) - target).squaredNorm() < (mesh_.point(best) - target).squaredNorm())
          best = node;
      return best;
    };
    const int donor = nearest(cavity.inside, nearest(cavity.ring, -1));
    int node = -1;
    if (spare_.empty()) {
      node = mesh_.add_node_like(donor);
    } else {
      node = spare_.back();
      spare_.pop_back();
      mesh_.mesh().parameters[node] = mesh_.mesh().parameters[donor];
    }
    mesh_.mesh().put(node, mesh_.mesh().moved(surface_, node, target));
    return node;
  }

  EditedMesh& mesh_;
  const MeshSurface& surface_;
  const int first_count_ = mesh_.topology().size();
  int drift_ = 0;                           ///< quads gained since the start
  std::vector<int> spare_;                  ///< nodes that no quad uses
  std::unordered_set<std::uint64_t> seen_;  ///< fingerprints of patches tried before
};

/// Grows patches from irregular nodes until they can be filled.
class Cavities : private EditedMesh {
 public:
  Cavities(SurfaceMesh& mesh, const MeshSurface& surface, const ExecutionContext& context)
      : EditedMesh(mesh, context), filler_(*this, surface) {}

  int run() {
    const int first_node_count = node_count();
    int filled = 0;
    SparseCheck check(context_, 8);
    for (int node = 0; node < node_count(); ++node) {
      check();
      if (topology_.side_of(node) >= 0 && topology_.openings(node) < 2 && cost(node) > 0 && mend(node))
        ++filled;
    }
    if (filled > 0 || node_count() > first_node_count) write_back();
    return filled;
  }

 private:
  int valence(int node) const { return topology_.valence(topology_.side_of(node)); }

  /// The number of quads that the angle at a boundary node asks for.
  int wanted(int node) const { return std::max(1, round_to_int(angles_[node] / (std::numbers::pi / 2))); }

  int excess(int node) const { return valence(node) - (inner(node) ? 4 : wanted(node)); }
  int cost(int node) const { return excess(node) * excess(node); }

  bool add_fan(int node) { return topology_.add_fan(topology_.side_of(node), patch_); }

  /// Tries a patch that grows to the nearest irregular nodes. If that fails, tries another one that leaves
  /// out the first of these and grows only to nodes that bring it nearer to four corners.
  bool mend(int node) {
    patch_.make_room(node_count());
    reached_.resize(topology_.size(), 0);
    met_.resize(node_count(), 0);
    tried_.clear();
    for (const bool chooses : {false, true}) {
      chooses_ = chooses;
      if (chooses && tried_.empty()) return false;
      if (chooses) tried_.resize(1);
      if (add_fan(node) && grow_until_filled()) return true;
      patch_.clear();
    }
    return false;
  }

  bool grow_until_filled() {
    std::vector<int> last;  // the last patch that was a polygon
    last_corners_ = 4;
    for (int growth = 0; growth < (chooses_ ? few_growths : max_growths); ++growth) {
      const bool fits = make_convex() && trace();
      if (fits && filler_.fill(patch_, cavity_)) return true;
      if (fits) {
        last = patch_.quads();
        last_corners_ = static_cast<int>(cavity_.corners.size());
      } else if (last.empty())
        return false;
      else
        patch_.restore(last);
      if (!grow() && !widen()) return false;
    }
    return false;
  }

  /// Adds the quads around the outline, for more room.
  bool widen() {
    const std::size_t count = patch_.size();
    for (std::size_t i = 0; i < count; ++i)
      for (const int node : topology_.quad(patch_.quads()[i]))
        if (inner(node) && !add_fan(node)) return false;
    return patch_.size() > count;
  }

  /// Adds quads until no node of the outline has more than two of them inside.
  bool make_convex() {
    for (std::size_t i = 0; i < patch_.size(); ++i) {
      for (const int node : topology_.quad(patch_.quads()[i])) {
        if (patch_.uses(node) < 3 || topology_.openings(node) > 1 || patch_.uses(node) == valence(node))
          continue;
        if (!inner(node) || !add_fan(node)) return false;
      }
    }
    return true;
  }

  /// Whether the patch should grow to a node. A node with too many quads adds a corner once it is inside.
  bool suits(int node) const {
    return !chooses_ || last_corners_ == 4 || (excess(node) > 0) == (last_corners_ < 4);
  }

  /// Adds the quads of the nearest irregular node that suits and was not tried, and the quads on the way.
  bool grow() {
    ++search_;
    std::vector<int> queue = patch_.quads(), from(patch_.size(), -1);
    for (const int quad : patch_.quads()) reached_[quad] = search_;
    const std::size_t most = chooses_ ? near_search : max_search;
    for (std::size_t i = 0; i < queue.size() && queue.size() < most; ++i) {
      for (const int node : topology_.quad(queue[i])) {
        if (topology_.openings(node) > 1 || cost(node) == 0 || patch_.uses(node) == valence(node)) continue;
        if (!inner(node) && wanted(node) > 2) continue;
        if (!suits(node)) continue;
        if (std::find(tried_.begin(), tried_.end(), node) != tried_.end()) continue;
        tried_.push_back(node);
        for (int at = static_cast<int>(i); at >= 0; at = from[at])
          if (!patch_.add(queue[at])) return false;
        return add_fan(node);
      }
      for (int side = 4 * queue[i]; side < 4 * queue[i] + 4; ++side) {
        const int beyond = topology_.twin(side) < 0 ? -1 : topology_.twin(side) >> 2;
        if (beyond < 0 || reached_[beyond] == search_) continue;
        reached_[beyond] = search_;
        queue.push_back(beyond);
        from.push_back(static_cast<int>(i));
      }
    }
    return false;
  }

  bool is_outer(int side) const {
    const int twin = topology_.twin(side);
    return twin < 0 || !patch_.contains(twin >> 2);
  }

  /// Finds the outline, its corners, the nodes inside and the valence cost. False if the patch is not a disc,
  /// has nodes inside that must stay, or would have a reflex corner.
  bool trace() {
    cavity_.ring.clear();
    cavity_.corners.clear();
    cavity_.inside.clear();
    cavity_.cost = 0;
    ++search_;
    int start = -1, outer = 0;
    for (const int quad : patch_.quads())
      for (int side = 4 * quad; side < 4 * quad + 4; ++side)
        if (is_outer(side)) {
          start = side;
          ++outer;
        }
    if (start < 0) return false;
    int side = start;
    do {
      const int node = topology_.origin(side);
      if (met_[node] == search_) return false;
      met_[node] = search_;
      // The node's quads in the patch lie side by side; otherwise the outline would meet itself here.
      int quads = patch_.uses(node);
      if (!inner(node) && !on_triangle_[node] && topology_.openings(node) == 1 && quads == valence(node)) {
        cavity_.cost += cost(node);
        quads = wanted(node);
      }
      if (quads > 2) return false;
      if (quads == 1) cavity_.corners.push_back(static_cast<int>(cavity_.ring.size()));
      cavity_.ring.push_back(node);
      for (side = QuadTopology::next(side); !is_outer(side);) side = QuadTopology::next(topology_.twin(side));
    } while (side != start);
    if (static_cast<int>(cavity_.ring.size()) != outer) return false;
    for (const int quad : patch_.quads())
      for (const int node : topology_.quad(quad)) {
        if (met_[node] == search_) continue;
        met_[node] = search_;
        if (!inner(node)) return false;
        cavity_.inside.push_back(node);
        cavity_.cost += cost(node);
      }
    return static_cast<int>(patch_.size()) == outer / 2 - 1 + static_cast<int>(cavity_.inside.size());
  }

  GrowingPatch patch_{topology_};
  Cavity cavity_;  ///< of the patch, once traced
  CavityFiller filler_;
  bool chooses_ = false;      ///< whether patches grow only to nodes that suit their corners
  int last_corners_ = 4;      ///< corners of the patch when it was last a polygon
  std::vector<int> tried_;    ///< irregular nodes to which the patch has grown
  std::vector<int> met_;      ///< by node: number of the trace that met it last
  std::vector<int> reached_;  ///< by quad: number of the search that met it last
  int search_ = 0;
};

}  // namespace

int remesh_cavities(SurfaceMesh& mesh, const MeshSurface& surface, const ExecutionContext& context) {
  return Cavities(mesh, surface, context).run();
}

}  // namespace quadrille
