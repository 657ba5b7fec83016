/// Tries every filling of the small patches around a poor quad, with nodes relaxed, and takes the best.

#include "mesher/quads/mending.hpp"

#include <boost/container/static_vector.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "mesher/mesh/sides.hpp"
#include "mesher/quads/criteria_patch.hpp"
#include "mesher/quads/edited_mesh.hpp"

namespace quadrille {
namespace {

using Quad = QuadTopology::Quad;

constexpr double fine_objective = 0.1;  ///< a node stays if all its quads have a lower objective
/// A quad counts for no more than this, so that one that the CAD forces out of shape does not outweigh its
/// neighbors. Folded quads count this much while nodes move.
constexpr double largest_objective = 20;
constexpr double least_gain = 0.3;
/// How much of the objective one unit of valence cost is worth.
constexpr double per_cost = 0.2;
/// Fillings are tried if their valences cost at most this much more than those before.
constexpr double slack = 8;
/// No corner's sine may fall below this, or below the least one before if that is smaller.
constexpr double floor_sine = 0.3;

constexpr int max_attempts = 40;  ///< attempts for one quad
constexpr int sweeps = 3;
constexpr int passes = 2;  ///< passes over all quads

/// The quads of a filling and those next to them, apart from the mesh. Nodes move in the patch's plane; each
/// quad is judged in its own plane.
class Trial {
 public:
  static constexpr int max_points = 64, max_quads = 48;
  template <class T, int n>
  using List = boost::container::static_vector<T, n>;

  List<Vector3, max_points> points;
  List<int, max_points> nodes;     ///< (points) nodes of the mesh; -1 = new
  List<char, max_points> movable;  ///< (points) 1 = may move
  List<Quad, max_quads> quads;     ///< indices into points; those of the filling first
  double floor = floor_sine;       ///< least sine allowed at a corner

  void set_up(const Vector3& normal) {
    up_ = normal.normalized();
    u_ = up_.unitOrthogonal();
    v_ = up_.cross(u_);
  }

  void add_point(int node, const Vector3& place, bool may_move) {
    nodes.push_back(node);
    points.push_back(place);
    movable.push_back(may_move ? 1 : 0);
  }

  /// Judges the quads by their points in space.
  void measure() {
    values_.resize(quads.size());
    for (std::size_t i = 0; i < quads.size(); ++i) {
      const QuadObjective of = measure_objective({points.data(), points.size()}, quads[i]);
      values_[i] = judge(of, of.normal.dot(up_) > 0);
    }
  }

  /// Adds a quad of the mesh that is not replaced.
  void add_old(const Quad& quad, const QuadObjective& of) {
    quads.push_back(quad);
    values_.push_back({std::min(largest_objective, of.value), true});
    floor = std::min(floor, of.least_sine);
  }

  double sum() const {
    double result = 0;
    for (const auto& value : values_) result += value.value;
    return result;
  }

  bool sound() const {
    return std::all_of(values_.begin(), values_.end(), [](const auto& value) { return value.sound; });
  }

  /// Must be called before relax(), once all quads are there.
  void flatten() {
    uses_.resize(points.size());
    for (int i = 0; i < static_cast<int>(quads.size()); ++i) {
      const Quad& q = quads[i];
      flat_.emplace_back(points[q[0]], points[q[1]], points[q[2]], points[q[3]], up_, u_, v_);
      for (int k = 0; k < 4; ++k) {
        if (uses_[q[k]].size() == uses_[q[k]].capacity())
          movable[q[k]] = 0;
        else if (movable[q[k]])
          uses_[q[k]].emplace_back(i, k);
      }
    }
  }

  /// Moves each node once.
  void relax() {
    for (int i = 0; i < static_cast<int>(points.size()); ++i)
      if (movable[i]) relax(i);
  }

 private:
  struct Value {
    double value;
    bool sound;
  };

  Value judge(const QuadObjective& of, bool upright) const {
    const bool sound = upright && of.least_sine > 0 && of.least_sine >= floor;
    return {sound ? std::min(largest_objective, of.value) : largest_objective, sound};
  }

  void relax(int node) {
    double worst = 0;
    for (const auto& [quad, k] : uses_[node]) worst = std::max(worst, values_[quad].value);
    if (worst < fine_objective) return;
    CriteriaPatch patch(u_, v_);
    double shortest = std::numeric_limits<double>::max(), sum = 0;
    for (const auto& [quad, k] : uses_[node]) {
      patch.add(flat_[quad], k);
      for (const double side : flat_[quad].sides_at(k)) {
        shortest = std::min(shortest, side);
        sum += side;
      }
    }
    if (!(shortest > 0)) return;
    const auto [x, y] = patch.lowest(shortest, sum / (4.0 * static_cast<double>(uses_[node].size())));
    points[node] += x * u_ + y * v_;
    for (const auto& [quad, k] : uses_[node]) {
      flat_[quad].move(k, x, y);
      values_[quad] = judge(flat_[quad].measure(), true);
    }
  }

  Vector3 up_, u_, v_;  ///< the patch's normal, and two directions in its plane
  List<FlatQuad, max_quads> flat_;
  List<List<std::pair<int, int>, CriteriaPatch::max_quads>, max_points> uses_;  ///< (points) quad, corner
  List<Value, max_quads> values_;
};

// ---- patches that hold a quad ----

/// Patches, each of them once.
struct Patches {
  std::vector<SmallPatch> list;
  std::set<std::vector<int>> met;

  bool add(const SmallPatch& patch) {
    std::vector<int> key(patch.quads.begin(), patch.quads.end());
    std::sort(key.begin(), key.end());
    if (!met.insert(key).second) return false;
    list.push_back(patch);
    return true;
  }
};

/// Adds the patch, and all patches up to a size that grow from it by one neighbor after the other.
void grow(const QuadTopology& topology, const SmallPatch& patch, std::size_t size, Patches& patches) {
  if (!patches.add(patch) || patch.quads.size() == size) return;
  for (const int quad : patch.quads)
    for (int side = 4 * quad; side < 4 * quad + 4; ++side) {
      SmallPatch more = patch;
      const int beyond = topology.beyond(side);
      if (!patch.contains(beyond) && more.add(beyond)) grow(topology, more, size, patches);
    }
}

/// Patches that hold the quad: up to three quads, the quads around one of its corners, or around two.
std::vector<SmallPatch> patches_of(const QuadTopology& topology, int quad) {
  Patches patches;
  SmallPatch one;
  one.add(quad);
  grow(topology, one, 3, patches);
  for (int side = 4 * quad; side < 4 * quad + 4; ++side) {
    SmallPatch ring = one;
    if (!topology.add_fan(side, ring)) continue;
    patches.add(ring);
    for (const int other : {QuadTopology::next(side), QuadTopology::opposite(side)}) {
      SmallPatch both = ring;
      if (topology.add_fan(other, both)) patches.add(both);
    }
  }
  return std::move(patches.list);
}

// ---- their fillings ----

/// One way to fill one patch.
struct Candidate {  // NOLINT(bugprone-exception-escape): as Outline
  SmallPatch patch;
  Outline outline;
  const PatchTemplate* filling;
  double cost;    ///< increase of the valence cost
  double before;  ///< the objective of the patch as it is
  double quick;   ///< objective of the filling before its nodes move, minus `before`
};

struct Attempt {
  const Candidate* candidate;
  Trial trial;
  double before = 0, gain = 0;

  void weigh() { gain = before - trial.sum() - per_cost * std::max(0.0, candidate->cost); }
};

/// Whether a filling has the same uses, and as many nodes inside, as the patch has already.
bool is_there(const Outline& outline, const PatchTemplate& filling) {
  return filling.interior == outline.inside_count() &&
         std::equal(outline.uses.begin(), outline.uses.end(), filling.uses.begin());
}

// ---- the best of them ----

class Mending : private EditedMesh {
 public:
  Mending(SurfaceMesh& mesh, const MeshSurface& surface, double poor, double least_turn_cosine,
          const ExecutionContext& context)
      : EditedMesh(mesh, context),
        surface_(surface),
        poor_(poor),
        least_turn_cosine_(least_turn_cosine),
        changed_(mesh.mesh.points.size(), 0) {}

  /// \param changed see mend_quads() \return the number of refilled patches
  int run(std::vector<char>& changed) {
    int count = 0;
    for (int pass = 0; pass < passes; ++pass) {
      int done = 0;
      for (const auto& [value, quad] : worst_first(pass > 0)) {
        context_.check();
        if (topology_.alive(quad) && objective(quad).value > poor_) done += mend(quad);
      }
      count += done;
      if (done == 0) break;
    }
    changed.clear();
    for (const int node : write_back()) changed.push_back(changed_[node]);
    return count;
  }

 private:
  const QuadObjective& objective(int quad) {
    if (objectives_.size() < static_cast<std::size_t>(topology_.size())) objectives_.resize(topology_.size());
    std::optional<QuadObjective>& known = objectives_[quad];
    if (!known) known = measure_objective(points(), topology_.quad(quad));
    return *known;
  }

  /// To be called when a quad or a node of it has changed.
  void forget(int quad) {
    if (quad < static_cast<int>(objectives_.size())) objectives_[quad].reset();
  }

  /// \param again only the quads with a node marked in changed_
  std::vector<std::pair<double, int>> worst_first(bool again) {
    std::vector<std::pair<double, int>> bad;
    for (int quad = 0; quad < topology_.size(); ++quad) {
      if (!topology_.alive(quad)) continue;
      const Quad& q = topology_.quad(quad);
      if (again && std::none_of(q.begin(), q.end(), [this](int node) { return changed_[node]; })) continue;
      const double value = objective(quad).value;
      if (value > poor_) bad.emplace_back(-value, quad);
    }
    std::sort(bad.begin(), bad.end());
    return bad;
  }

  /// Adds the fillings of a patch that are worth an attempt.
  void find_fillings(const SmallPatch& patch, std::vector<Candidate>& candidates) {
    Candidate candidate{patch, {}, nullptr, 0, 0, 0};
    Outline& outline = candidate.outline;
    if (!trace(patch, outline)) return;
    FillingCosts costs;
    const double cost = find_costs(outline, costs);
    for (const int quad : patch.quads) candidate.before += std::min(largest_objective, objective(quad).value);
    costs.resize.fill(0);
    costs.drift.fill(0);
    costs.limit = cost + slack;
    for (const PatchTemplate* filling : cheapest_fillings(outline.length(), costs)) {
      candidate.filling = filling;
      if (is_there(outline, *filling)) continue;
      candidate.cost = filling->interior_cost - cost;
      for (int k = 0; k < outline.length(); ++k) candidate.cost += costs.uses[k][filling->uses[k]];
      Trial trial;
      lay(candidate, trial);
      candidate.quick = trial.sum() - candidate.before;
      // Before its nodes move, it is worse than the patch by as much as a quad counts at most.
      if (candidate.quick + per_cost * candidate.cost > largest_objective) continue;
      candidates.push_back(candidate);
    }
  }

  /// Moves the nodes of a filling. \return whether it gains more than the best one so far.
  bool attempt(Attempt& now, double best) {
    const Candidate& candidate = *now.candidate;
    Trial& trial = now.trial;
    lay(candidate, trial);
    for (const int quad : candidate.patch.quads)
      trial.floor = std::min(trial.floor, objective(quad).least_sine);
    now.before = candidate.before - trial.sum();
    if (!surround(candidate.patch, candidate.outline, trial)) return false;
    now.before += trial.sum();
    now.weigh();
    trial.flatten();
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      const double last = now.gain;
      trial.relax();
      now.weigh();
      // The gain of this sweep once more would not make it the best.
      if (now.gain + (now.gain - last) <= best) return false;
    }
    return now.gain > best && trial.sound();
  }

  /// Puts the filling into a trial, with its inner nodes at the mean of their neighbors.
  void lay(const Candidate& candidate, Trial& trial) const {
    const Filling filled = laid(candidate.outline, *candidate.filling);
    trial.set_up(filled.normal);
    const int length = candidate.outline.length();
    for (int i = 0; i < length + filled.filling.interior; ++i)
      trial.add_point(filled.nodes[i], filled.x[i], i >= length || inner(filled.nodes[i]));
    for (int k = 0; k < filled.filling.quads; ++k) {
      const auto& c = filled.filling.corners[k];
      trial.quads.push_back({c[0], c[1], c[2], c[3]});
    }
    trial.measure();
  }

  /// Adds the quads next to the patch; false if there are too many.
  bool surround(const SmallPatch& patch, const Outline& outline, Trial& trial) {
    boost::container::static_vector<int, Trial::max_quads> met;
    const auto add = [&](int side) {
      const int quad = side >> 2;
      if (patch.contains(quad) || std::find(met.begin(), met.end(), quad) != met.end()) return true;
      if (trial.quads.size() == Trial::max_quads || trial.points.size() + 4 > Trial::max_points) return false;
      met.push_back(quad);
      Quad local;
      for (int j = 0; j < 4; ++j) {
        const int node = topology_.quad(quad)[j];
        const auto at = std::find(trial.nodes.begin(), trial.nodes.end(), node);
        local[j] = static_cast<int>(at - trial.nodes.begin());
        if (at == trial.nodes.end()) trial.add_point(node, point(node), false);
      }
      trial.add_old(local, objective(quad));
      return true;
    };
    return std::all_of(outline.ring.begin(), outline.ring.end(),
                       [&](int node) { return topology_.all_around(topology_.side_of(node), add); });
  }

  bool mend(int quad) {
    std::vector<Candidate> candidates;
    for (const SmallPatch& patch : patches_of(topology_, quad)) find_fillings(patch, candidates);
    std::stable_sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
      return a.quick + per_cost * a.cost < b.quick + per_cost * b.cost;
    });
    if (candidates.size() > max_attempts)
      candidates.erase(candidates.begin() + max_attempts, candidates.end());
    std::vector<Attempt> attempts;
    double best = least_gain;
    for (const Candidate& candidate : candidates) {
      Attempt now{&candidate, {}};
      if (!attempt(now, best)) continue;
      best = now.gain;
      attempts.push_back(std::move(now));
    }
    // The last attempt is the best.
    for (auto now = attempts.rbegin(); now != attempts.rend(); ++now)
      if (put(*now)) return true;
    return false;
  }

  /// Carries out an attempt with its nodes on the surface, unless it loses its gain there.
  bool put(Attempt& now) {
    const Candidate& candidate = *now.candidate;
    Trial& trial = now.trial;
    int donor = trial.nodes[0];
    for (int i = 0; i < candidate.outline.length(); ++i)
      if (inner(trial.nodes[i])) donor = trial.nodes[i];
    std::vector<SurfacePlace> places;  // (points)
    for (std::size_t i = 0; i < trial.nodes.size(); ++i) {
      const int from = trial.nodes[i] < 0 ? donor : trial.nodes[i];
      places.push_back(trial.movable[i] ? mesh_.moved(surface_, from, trial.points[i])
                                        : mesh_.place_of(from));
      if (trial.movable[i]) trial.points[i] = places.back().point;
    }
    trial.measure();
    now.weigh();
    if (!(now.gain > least_gain) || !trial.sound()) return false;
    if (least_turn_cosine_ > -1 && turns_too_much(candidate, trial, places)) return false;
    if (!replace(candidate, trial, donor)) return false;
    for (std::size_t i = 0; i < trial.nodes.size(); ++i) {
      const int node = trial.nodes[i];
      changed_[node] = 1;
      if (!trial.movable[i]) continue;
      mesh_.put(node, places[i]);
      topology_.all_around(topology_.side_of(node), [&](int side) {
        forget(side >> 2);
        return true;
      });
    }
    for (const int quad : candidate.patch.quads) forget(quad);
    return true;
  }

  /// Whether a quad turns by more than allowed. \param places (points)
  bool turns_too_much(const Candidate& candidate, const Trial& trial,
                      const std::vector<SurfacePlace>& places) const {
    double least = least_turn_cosine_;
    for (const int quad : candidate.patch.quads)
      least = std::min(least, turn_cosine(topology_.quad(quad), mesh_.normals));
    std::vector<Vector3> normals;
    normals.reserve(places.size());
    for (const SurfacePlace& place : places) normals.push_back(place.normal);
    return std::any_of(trial.quads.begin(), trial.quads.begin() + candidate.filling->quads,
                       [&](const Quad& quad) { return turn_cosine(quad, normals) < least; });
  }

  bool replace(const Candidate& candidate, Trial& trial, int donor) {
    for (int& node : trial.nodes) {
      if (node >= 0) continue;
      node = add_node_like(donor);
      changed_.push_back(0);
    }
    std::vector<Quad> quads(trial.quads.begin(), trial.quads.begin() + candidate.filling->quads);
    for (Quad& quad : quads) quad = with_numbers(quad, trial.nodes);
    return topology_.replace(candidate.patch.span(), quads);
  }

  const MeshSurface& surface_;
  double poor_, least_turn_cosine_;
  std::vector<char> changed_;                             ///< (nodes) 1 = of a trial that was carried out
  std::vector<std::optional<QuadObjective>> objectives_;  ///< (quads) measured on demand
};

}  // namespace

double turn_cosine(const std::array<int, 4>& quad, const std::vector<Vector3>& normals) {
  double least = 1;
  for (int i = 0; i < 4; ++i)
    for (int k = i + 1; k < 4; ++k) least = std::min(least, normals[quad[i]].dot(normals[quad[k]]));
  return least;
}

int mend_quads(SurfaceMesh& mesh, const MeshSurface& surface, double poor, double least_turn_cosine,
               std::vector<char>& changed, const ExecutionContext& context) {
  return Mending(mesh, surface, poor, least_turn_cosine, context).run(changed);
}

}  // namespace quadrille
