/// Grows a patch to the nearest irregular nodes, refills its outline, and keeps the result if it is not
/// worse.

#include "mesher/quads/improve.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <unordered_set>

#include "geometry/base/whole_number.hpp"
#include "mesher/mesh/sides.hpp"
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

/// The polygon around a patch.
struct Cavity : Outline {    // NOLINT(bugprone-exception-escape): as Outline
  std::vector<int> corners;  ///< indices into the ring
  int cost = 0;              ///< valence cost of the patch as it is
};

/// Grows patches from irregular nodes until they can be filled, and replaces them by the first filling that
/// is not worse.
class Cavities : private EditedMesh {
 public:
  Cavities(SurfaceMesh& mesh, const MeshSurface& surface, const ExecutionContext& context)
      : EditedMesh(mesh, context), surface_(surface) {}

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
      if (fits && fill()) return true;
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
        const int beyond = topology_.beyond(side);
        if (beyond < 0 || reached_[beyond] == search_) continue;
        reached_[beyond] = search_;
        queue.push_back(beyond);
        from.push_back(static_cast<int>(i));
      }
    }
    return false;
  }

  /// Finds the outline, its corners and the valence cost. False if the patch is not a disc, has nodes inside
  /// that must stay, or would have a reflex corner.
  bool trace() {
    cavity_ = {};
    if (!EditedMesh::trace(std::span<const int>(patch_.quads()), cavity_)) return false;
    for (int i = 0; i < cavity_.length(); ++i) {
      const int node = cavity_.ring[i];
      int quads = cavity_.uses[i];
      if (!inner(node) && !on_triangle_[node] && topology_.openings(node) == 1 && quads == valence(node)) {
        cavity_.cost += cost(node);
        quads = wanted(node);
      }
      if (quads > 2) return false;
      if (quads == 1) cavity_.corners.push_back(i);
    }
    for (const int node : cavity_.inside) cavity_.cost += cost(node);
    return true;
  }

  /// Replaces a patch by a filling with fewer irregular nodes, if there is one. \return whether it did.
  bool fill() {
    if (cavity_.cost < 2 || !is_flat() || !seen_.insert(patch_.fingerprint()).second) return false;
    std::vector<Vector3> outline;
    for (const int node : cavity_.ring) outline.push_back(point(node));
    const auto share = [&](double of) { return round_to_int(of * static_cast<double>(patch_.size())); };
    // Quads gained or lost already may be given back, however many they are.
    const int drift = std::max({std::abs(drift_), few_quads, static_cast<int>(most_drift * first_count_)});
    const int count = static_cast<int>(patch_.size()) - drift_;
    const FillingLimits limits{.most_irregular = cavity_.cost - 1,
                               .least_quads = std::max(share(least_share), count - drift),
                               .most_quads = std::min({share(most_share), count + drift, max_quads})};
    return fill_polygon(outline, cavity_.corners, limits,
                        [&](const PolygonFilling& filling) { return put(filling); });
  }

  /// Whether the patch is flat enough for places interpolated between its nodes to make sense.
  bool is_flat() const {
    constexpr double least_cosine = 0.7;
    Vector3 mean = Vector3::Zero();
    for (const int node : cavity_.ring) mean += normal(node);
    mean.normalize();
    const auto turned = [&](int node) { return !(normal(node).dot(mean) > least_cosine); };
    return std::none_of(cavity_.ring.begin(), cavity_.ring.end(), turned) &&
           std::none_of(cavity_.inside.begin(), cavity_.inside.end(), turned);
  }

  /// The mean distance of the quads from the industry criteria; no quad counts for more than `max_each`.
  double mean_objective(const std::vector<Quad>& quads) const {
    constexpr double max_each = 20;
    double sum = 0;
    for (const Quad& quad : quads) sum += std::min(max_each, measure_objective(points(), quad).value);
    return sum / static_cast<double>(quads.size());
  }

  /// Replaces the patch by a filling unless its quads are worse.
  bool put(const PolygonFilling& filling) {
    const std::vector<Quad> before = corners_of(patch_.quads());
    std::vector<int> nodes(cavity_.ring.begin(), cavity_.ring.end());
    for (std::size_t i = cavity_.ring.size(); i < filling.places.size(); ++i)
      nodes.push_back(place(filling.places[i]));
    std::vector<Quad> quads = filling.quads;
    for (Quad& quad : quads) quad = with_numbers(quad, nodes);
    const auto count = static_cast<double>(quads.size());
    const bool done = !too_long(before, quads) && worst(quads) > std::min(worst(before), mendable_filling) &&
                      mean_objective(quads) <
                          mean_objective(before) + rise_per_cost * (cavity_.cost - filling.irregular) / count;
    const std::vector<int> old = patch_.quads();
    patch_.clear();
    if (done && topology_.replace(old, quads)) {
      spare_.clear();
      drift_ += static_cast<int>(quads.size()) - static_cast<int>(old.size());
      return true;
    }
    patch_.restore(old);
    // Keep the new nodes for the next filling.
    spare_.assign(nodes.begin() + static_cast<long>(cavity_.ring.size()), nodes.end());
    return false;
  }

  /// A free node at the point of the surface nearest to the target.
  int place(const Vector3& target) {
    const auto nearest = [&](const Outline::List& nodes, int best) {
      for (const int node : nodes)
        if (best < 0 || (point(node) - target).squaredNorm() < (point(best) - target).squaredNorm())
          best = node;
      return best;
    };
    const int donor = nearest(cavity_.inside, nearest(cavity_.ring, -1));
    int node = -1;
    if (spare_.empty()) {
      node = add_node_like(donor);
    } else {
      node = spare_.back();
      spare_.pop_back();
      mesh_.parameters[node] = mesh_.parameters[donor];
    }
    mesh_.put(node, mesh_.moved(surface_, node, target));
    return node;
  }

  GrowingPatch patch_{topology_};
  Cavity cavity_;             ///< of the patch, once traced
  bool chooses_ = false;      ///< whether patches grow only to nodes that suit their corners
  int last_corners_ = 4;      ///< corners of the patch when it was last a polygon
  std::vector<int> tried_;    ///< irregular nodes to which the patch has grown
  std::vector<int> reached_;  ///< by quad: number of the search that met it last
  int search_ = 0;
  const MeshSurface& surface_;
  const int first_count_ = topology_.size();
  int drift_ = 0;                           ///< quads gained since the start
  std::vector<int> spare_;                  ///< nodes that no quad uses
  std::unordered_set<std::uint64_t> seen_;  ///< fingerprints of patches tried before
};

}  // namespace

int remesh_cavities(SurfaceMesh& mesh, const MeshSurface& surface, const ExecutionContext& context) {
  return Cavities(mesh, surface, context).run();
}

}  // namespace quadrille
