/// Topological clean-up of quad meshes.
/// Based on: Kinney, CleanUp: improving quadrilateral finite element meshes (1997); Bunin, Non-local
/// topological clean-up (2006), for the idea of remeshing small patches inside their boundary. Collapsing a
/// node with two quads, as Giuliani & Krivodonova (2018) do, is one of these refills.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "mesher/quads/edited_mesh.hpp"
#include "mesher/quads/improve.hpp"
#include "mesher/quads/patch_templates.hpp"

namespace quadrille {
namespace {

using Quad = QuadTopology::Quad;
/// Scaled Jacobian above which a better connected patch may start: smoothing repairs it.
constexpr double mendable_patch = 0.05;
constexpr double min_gain = 0.5;  ///< a patch is refilled if it gains this much; nodes that cost less stay
constexpr double worth_trying = 1.5;  ///< a patch whose nodes cost less in all cannot gain
constexpr double resize_cost = 0.2;   ///< cost of each node more or fewer: keeps the density
constexpr double drift_cost = 50;     ///< cost of each added node, times the share of quads already gained

class CleanUp : private EditedMesh {
 public:
  /// \param doubtful (nodes) in: 1 = start here, empty = all; out, by write_back(): the same for next time.
  CleanUp(SurfaceMesh& surface_mesh, const MeshSurface& surface, std::vector<char>& doubtful,
          const ExecutionContext& context)
      : EditedMesh(surface_mesh, context), doubtful_(doubtful), surface_(surface) {
    if (doubtful_.empty()) doubtful_.assign(mesh_.mesh.points.size(), 1);
    tried_.assign(tried_slots, 0);
  }

  /// Refills small patches around irregular nodes where that improves the valences.
  bool improve_valences() {
    queued_.assign(mesh_.mesh.points.size(), 0);
    bool any = false;
    SparseCheck check(context_);
    for (int node = 0; node < node_count(); ++node) {
      check();
      if (doubtful_[node] && cost_at(node) > min_gain) push(node);
    }
    std::fill(doubtful_.begin(), doubtful_.end(), 0);
    // Each move lowers the cost by at least min_gain, so the queue empties; the bound is for safety only.
    const std::size_t bound = 40 * queue_.size() + 1000;
    SparseCheck check_often(context_, 16);
    for (std::size_t head = 0; head < queue_.size() && head < bound; ++head) {
      check_often();
      const int node = queue_[head];
      queued_[node] = 0;
      if (topology_.side_of(node) < 0 || cost_at(node) <= min_gain) continue;
      blocked_ = false;
      if (improve_round(node))
        any = true;
      else if (blocked_)
        doubtful_[node] = 1;
    }
    return any;
  }

  void write_back() {
    std::vector<char> doubtful;
    for (const int node : EditedMesh::write_back()) doubtful.push_back(doubtful_[node]);
    doubtful_ = std::move(doubtful);
  }

 private:
  /// What a quad adds to each patch that holds it: constant while the patches around one node are tried.
  struct QuadState {
    int round = 0;
    double cost = 0;          ///< sum of its nodes' costs
    std::uint64_t print = 0;  ///< changes with its nodes and their valences
  };

  double cost_at(int node) const {
    const int side = topology_.side_of(node);
    if (side < 0) return 0;
    return node_cost(node, topology_.valence(side));
  }

  void push(int node) {
    if (queued_.size() < mesh_.mesh.points.size()) queued_.resize(mesh_.mesh.points.size(), 0);
    if (queued_[node]) return;
    queued_[node] = 1;
    queue_.push_back(node);
  }

  /// Tries the patches around a node until one gains.
  bool improve_round(int node) {
    ++round_;
    const QuadTopology::Fan fan = topology_.fan(topology_.side_of(node));
    if (fan.quads > 12) return false;
    std::array<int, 12> sides, quads;
    for (int i = 0, at = fan.first; i < fan.quads; ++i, at = topology_.rotate(at)) {
      sides[i] = at;
      quads[i] = at >> 2;
    }

    // The node's own ring.
    SmallPatch ring;
    const bool whole = topology_.add_fan(fan.first, ring);
    if (whole && ring.quads.size() > 1 && try_patch(ring)) return true;
    // Pairs of quads, then chains of three.
    for (int i = 0; i < fan.quads; ++i)
      for (int k = 0; k < 4; ++k) {
        SmallPatch pair;
        pair.add(quads[i]);
        const int beyond = topology_.beyond(4 * quads[i] + k);
        if (beyond == quads[(i + 1) % fan.quads]) continue;  // that pair is tried from there
        if (pair.add(beyond) && try_patch(pair)) return true;
      }
    for (int i = 0; i < fan.quads; ++i)
      for (int k = 0; k < 4; ++k) {
        SmallPatch pair;
        pair.add(quads[i]);
        if (!pair.add(topology_.beyond(4 * quads[i] + k))) continue;
        for (const int member : pair.quads)
          for (int j = 0; j < 4; ++j) {
            SmallPatch triple = pair;
            if (triple.add(topology_.beyond(4 * member + j)) && triple.quads.size() == 3 && try_patch(triple))
              return true;
          }
      }
    // The node's ring with the ring of each other node of its quads.
    for (int i = 0; i < fan.quads && whole; ++i)
      for (const int other : {QuadTopology::next(sides[i]), QuadTopology::opposite(sides[i])}) {
        if (!topology_.closed(topology_.origin(other))) continue;
        SmallPatch both = ring;
        if (topology_.add_fan(other, both) && try_patch(both)) return true;
      }
    return false;
  }

  const QuadState& state_of(int quad) {
    const auto mix = [](std::uint64_t value) {
      value = (value ^ (value >> 31)) * 0x9E3779B97F4A7C15u;
      return value ^ (value >> 29);
    };
    if (states_.size() <= static_cast<std::size_t>(quad)) states_.resize(topology_.size());
    QuadState& state = states_[quad];
    if (state.round == round_) return state;
    state = {round_, 0, 0};
    for (int side = 4 * quad; side < 4 * quad + 4; ++side) {
      const int node = topology_.origin(side), valence = topology_.valence(side);
      state.cost += node_cost(node, valence);
      state.print += mix(static_cast<std::uint64_t>(side) << 32 ^ static_cast<std::uint64_t>(node) << 6 ^
                         static_cast<std::uint64_t>(valence));
    }
    return state;
  }

  /// Refills the patch by the cheapest template whose shapes are acceptable, if that gains.
  bool try_patch(const SmallPatch& patch) {
    // No gain unless two nodes are irregular. The sum counts a node once per quad, so it is an upper bound.
    double most = 0;
    std::uint64_t fingerprint = 0;  // equal for the same quads in any order, as long as they keep their nodes
    for (const int quad : patch.quads) {
      const QuadState& state = state_of(quad);
      most += state.cost;
      fingerprint += state.print;
    }
    if (most < worth_trying) return false;
    std::uint64_t& slot = tried_[fingerprint % tried_slots];
    if (slot == fingerprint) return false;
    slot = fingerprint;
    Outline outline;
    if (!trace(patch, outline)) return false;
    FillingCosts costs;
    const double cost = find_costs(outline, costs);
    if (cost < worth_trying) return false;

    // Of two fillings with the same gain, prefer the one that brings back the first number of quads.
    const double drift = std::clamp(drift_cost * drift_ / topology_.size(), -resize_cost, resize_cost);
    for (int interior = 0; interior <= PatchTemplate::max_interior; ++interior) {
      const int added = interior - outline.inside_count();
      costs.resize[interior] = resize_cost * std::abs(added);
      costs.drift[interior] = drift * added;
    }
    costs.limit = cost - min_gain;
    const CheapestFillings cheapest = cheapest_fillings(outline.length(), costs);
    for (const PatchTemplate* filling : cheapest)
      if (fill(patch, outline, *filling)) return true;
    if (!cheapest.empty()) {
      // If the patch is met again from another node, it must count as blocked there too.
      blocked_ = true;
      slot = 0;
    }
    return false;
  }

  bool fill(const SmallPatch& patch, const Outline& outline, const PatchTemplate& filling) {
    const std::vector<Quad> before = corners_of(patch.span());
    const double floor = std::min(worst(before), mendable_patch);
    Filling filled = laid(outline, filling);
    if (!(filled.worst() > floor)) return false;

    // Move the nodes to the surface only now.
    std::array<SurfacePlace, PatchTemplate::max_interior> saved;
    const int n = outline.length();
    int donor = filled.nodes[0];
    for (int i = 0; i < n; ++i)
      if (!mesh_.fixed[filled.nodes[i]]) donor = filled.nodes[i];
    for (int i = 0; i < filling.interior; ++i) {
      int& node = filled.nodes[n + i];
      if (node < 0) node = add_node_like(donor);
      saved[i] = mesh_.place_of(node);
      mesh_.put(node, mesh_.moved(surface_, node, filled.x[n + i]));
      filled.x[n + i] = point(node);
    }
    doubtful_.resize(mesh_.mesh.points.size(), 0);
    std::vector<Quad> after;
    for (int k = 0; k < filling.quads; ++k) {
      const auto& [a, b, c, d] = filling.corners[k];
      after.push_back({filled.nodes[a], filled.nodes[b], filled.nodes[c], filled.nodes[d]});
    }
    if (filled.worst() > floor && !too_long(before, after) && topology_.replace(patch.span(), after)) {
      drift_ += static_cast<int>(after.size()) - static_cast<int>(before.size());
      for (int i = 0; i < n + filling.interior; ++i) push(filled.nodes[i]);
      return true;
    }
    for (int i = 0; i < filling.interior; ++i) mesh_.put(filled.nodes[n + i], saved[i]);
    return false;
  }

  static constexpr std::size_t tried_slots = 1 << 13;

  std::vector<char>& doubtful_;       ///< nodes where something may still be gained
  int drift_ = 0;                     ///< quads gained since the start
  bool blocked_ = false;              ///< a gain was refused because of the shapes it would give
  int round_ = 0;                     ///< counts the nodes that are tried
  std::vector<QuadState> states_;     ///< by quad; each is valid in the round that it names
  std::vector<std::uint64_t> tried_;  ///< fingerprints of patches without gain, indexed by their low bits

  const MeshSurface& surface_;
  std::vector<int> queue_;  ///< nodes whose surroundings will be tried
  std::vector<char> queued_;
};

}  // namespace

void clean_up(SurfaceMesh& surface_mesh, const MeshSurface& surface, const ImproveOptions& options,
              ExecutionContext& context) {
  if (!options.clean_up) return;
  ImproveOptions relaxing = options;
  relaxing.smoothing_sweeps = 2;
  std::vector<char> doubtful;
  for (int round = 0; round < 2; ++round) {
    context.check();
    CleanUp work(surface_mesh, surface, doubtful, context);
    const bool any = work.improve_valences();
    work.write_back();
    if (!any) break;
    smooth(surface_mesh, surface, relaxing, context);
  }
  if (remesh_cavities(surface_mesh, surface, context) > 0) smooth(surface_mesh, surface, relaxing, context);
}

}  // namespace quadrille
