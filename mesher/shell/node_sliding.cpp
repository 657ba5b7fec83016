/// Based on: Freitag, On combining Laplacian and optimization-based mesh smoothing techniques (1997), for
/// accepting moves one node at a time. The objective is that of CriteriaPatch.

#include "mesher/shell/node_sliding.hpp"

#include <Standard_Failure.hxx>

#include <algorithm>
#include <cmath>
#include <memory>

#include "geometry/cad/parallel_ids.hpp"
#include "geometry/surfaces/edge_curve.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/mesh/quad_geometry.hpp"
#include "mesher/mesh/quality.hpp"
#include "mesher/mesh/sides.hpp"
#include "mesher/quads/criteria_patch.hpp"
#include "mesher/quads/mending.hpp"
#include "mesher/shell/crossed_edges.hpp"

namespace quadrille {
namespace {

/// The aim of a round of sliding.
struct Aim {
  double squareness;  ///< weight of right angles, see measure_objective()
  double poor;        ///< nodes of quads above this objective are moved
};
/// The first round aims at right angles everywhere, the second at quads that are still outside the limits.
constexpr Aim right_angles{3, 0.1}, toward_limits{0, outside_objective};
/// Moves must not reduce a corner's sine below this, or below the least sine around the node if that is less.
/// A floor at the limit of corner angles (sin 40 degrees) would block moves that many quads need.
constexpr double floor_sine = 0.5;
/// A move must lower the objective by this share.
constexpr double least_gain = 0.001;
/// Quads inside the limits that are this close to parallelograms (as a share of the mean side) stay. A skew
/// grid of them is as accurate in bending as a square one, but not after its nodes move.
constexpr double parallel_share = 0.1, inside_limits = 0.766;  // the sine of 50 degrees: skew 40
/// Limit of the aspect. Rows of which some are beyond it, but not their mean, become more even.
constexpr double inside_aspect = 5;
/// A quad alone in a corner of its face that is sharper than the limit of 40 degrees stays outside whatever
/// its other nodes do. With its full weight, its neighbors would be drawn outside too.
constexpr double sharp_cosine = 0.766, sharp_weight = 0.1;
/// Quads across smooth edges turn by no more than 40 degrees between two corners, or than quads did before,
/// so that fillets keep their rows.
constexpr double least_turn_cosine = 0.766;
/// After a move by more than this share of the mean side, the neighbors are visited again.
constexpr double still_share = 0.01;
/// Segments on edges stay between these shares of their original length in the curve's parameter. On curved
/// edges they grow less, so that circles stay round.
constexpr double shortest_interval = 0.5, longest_interval = 1.5, longest_curved_interval = 1.15;

/// A quad around a node, which is its corner `corner`.
struct QuadUse {
  FaceId face;
  int quad, corner;
};

/// The state of one face while nodes move.
struct FaceState {
  FaceMesh* mesh = nullptr;
  const CadFace* cad_face = nullptr;
  std::shared_ptr<const MeshSurface> surface;  // made on first use
  Rows<Side> corners;                          // around each point
  std::vector<double> objective, least_sine;   // (quads) the objective is weighted
  std::vector<double> weight;                  // (quads) of the objective
  std::vector<char> active;                    // (points) 1 = to be visited
  std::vector<char> slid;                      // (boundary points) 1 = moved; uv must be updated
  bool touched = false;                        // nodes or quads changed
  int moves = 0;                               // nodes moved in the last sweep

  const MeshSurface& get_surface() {
    if (!surface) surface = mesh->surface ? mesh->surface : std::make_shared<const FaceSurface>(*cad_face);
    return *surface;
  }

  const Vector3& corner(int quad, int k) const { return mesh->points[mesh->quads[quad][k & 3]]; }

  QuadObjective measure(int quad, double squareness = 0) const {
    return measure(quad, corner(quad, 0), corner(quad, 1), corner(quad, 2), corner(quad, 3), squareness);
  }

  /// Measures a quad with its corners at other places.
  QuadObjective measure(int quad, const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d,
                        double squareness) const {
    QuadObjective result = measure_objective(a, b, c, d, squareness);
    result.value *= weight[quad];
    return result;
  }
};

/// The surface on which nodes of a face move while patches are refilled.
class MovedOnFace : public MeshSurface {
 public:
  explicit MovedOnFace(FaceState& face)
      : surface_(face.get_surface()), is_composite_(!face.mesh->normals.empty()) {}
  Vector3 move(Vector2& uv, const Vector3& target, Vector3& normal) const override {
    return is_composite_ ? surface_.move(uv, target, normal) : surface_.approach(uv, target);
  }

 private:
  const MeshSurface& surface_;
  bool is_composite_;
};

/// (edges) the parameters of the nodes.
using EdgeParameters = IdVector<EdgeId, std::vector<double>>;

EdgeParameters parameters_of(const BoundaryNodes& nodes) {
  EdgeParameters result;
  for (const auto& edge : nodes.edges) result.push_back(edge.parameters);
  return result;
}

class NodeSliding {
 public:
  /// \param sampled before any node moved
  NodeSliding(const CadShape& shape, BoundaryNodes& nodes, FaceMeshes& faces, const EdgeParameters& sampled,
              ExecutionContext& context)
      : shape_(shape), nodes_(nodes), context_(context), states_(faces.size()), sampled_(sampled) {
    for (const FaceId face : faces.ids()) {
      if (!faces[face]) continue;
      largest_first_.push_back(face);
      states_[face].mesh = &*faces[face];
      states_[face].cad_face = &shape.faces[face];
      turn_as_surface(states_[face]);
    }
    std::stable_sort(largest_first_.begin(), largest_first_.end(),
                     [&](FaceId a, FaceId b) { return faces[a]->quads.size() > faces[b]->quads.size(); });
    for_each_face([&](FaceId face) { prepare(states_[face]); });
    link_boundary();
    find_slidable();
  }

  /// Moves active nodes toward right angles, then those of quads outside the limits.
  void run(int sweeps) {
    slide((sweeps + 2) / 3, right_angles);  // later sweeps gain little
    for (FaceState& face : states_) std::fill(face.active.begin(), face.active.end(), 1);
    slide(sweeps, toward_limits);
  }

  /// Deactivates all nodes except those of some faces.
  void wake_only(const std::vector<CompositeFace>& composites) {
    FaceFlags awake(states_.size(), 0);
    for (const CompositeFace& composite : composites) awake[composite.members.front()] = 1;
    for (const FaceId face : states_.ids())
      if (!awake[face]) std::fill(states_[face].active.begin(), states_[face].active.end(), 0);
  }

  /// Refills patches around quads outside the limits, and activates their nodes. \return whether any changed.
  bool mend() {
    aim_ = toward_limits;
    for_each_face([&](FaceId face) {
      measure(states_[face]);
      mend(states_[face]);
    });
    return std::any_of(states_.begin(), states_.end(), [](const FaceState& face) { return face.touched; });
  }

  /// Updates uv and q_min after nodes moved.
  void finish() {
    for_each_face([&](FaceId face) { finish(states_[face]); });
  }

 private:
  struct Instance {
    FaceId face;
    int point = -1;
  };

  void slide(int sweeps, const Aim& aim) {
    aim_ = aim;
    for_each_face([&](FaceId face) { measure(states_[face]); });
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      int moves = slide_edges();
      for_each_face([&](FaceId face) { relax_face(face); });
      for (const FaceState& face : states_) moves += face.moves;
      if (moves == 0) break;
    }
  }

  /// The quads around a node before a move.
  struct Round {
    std::vector<QuadUse> uses;
    double objective = 0, worst_objective = 0, least_sine = 1;
    double shortest = 0, mean = 0;  // shortest and mean length of the sides at the node
    double aspect = 1;              // largest ratio of the two sides of a quad at the node
    double mean_aspect = 1;         // the mean of the longer ones of these two over that of the shorter ones
    double off_parallel = 0;        // largest difference of opposite sides, over the mean length

    bool is_fine() const {
      const bool uneven = aspect > inside_aspect && mean_aspect < inside_aspect;
      return least_sine > inside_limits && !uneven && off_parallel < parallel_share;
    }

    void clear() {
      uses.clear();
      objective = worst_objective = 0;
      least_sine = 1;
    }
  };

  /// A new position of a node, and the measures of the quads with it.
  struct Trial {
    Vector3 point;
    std::vector<QuadObjective> quads;
    double objective = 0;
  };

  /// Buffers of one thread, reused for each node.
  struct Buffers {
    Round round;
    Trial trial;
  };

  template <class Work>
  void for_each_face(Work&& work) {
    for_each_in_order(largest_first_, work);
  }

  // ---- preparation ----

  void prepare(FaceState& face) {
    const FaceMesh& mesh = *face.mesh;
    face.corners = corners_by_node(mesh.points.size(), mesh.quads, SparseCheck(context_, 2048));
    face.objective.resize(mesh.quads.size());
    face.least_sine.resize(mesh.quads.size());
    face.active.assign(mesh.points.size(), 1);
    face.slid.resize(mesh.nodes.size(), 0);
    weigh(face);
  }

  /// Finds the quads in sharp corners. Nodes on the boundary come first.
  static void weigh(FaceState& face) {
    face.weight.assign(face.mesh->quads.size(), 1);
    for (std::size_t i = 0; i < face.mesh->nodes.size(); ++i) {
      if (face.corners[i].size() != 1) continue;
      const int quad = element_of(face.corners[i][0]), k = index_of(face.corners[i][0]);
      const Vector3& here = face.corner(quad, k);
      const Vector3 next = face.corner(quad, k + 1) - here, previous = face.corner(quad, k + 3) - here;
      if (next.dot(previous) > sharp_cosine * next.norm() * previous.norm()) face.weight[quad] = sharp_weight;
    }
  }

  /// Measures all quads. Active nodes stay active only if one of their quads is poor.
  void measure(FaceState& face) {
    const FaceMesh& mesh = *face.mesh;
    SparseCheck check(context_);
    std::vector<char> poor(mesh.points.size(), 0);
    for (int quad = 0; quad < static_cast<int>(mesh.quads.size()); ++quad) {
      check();
      const QuadObjective measured = face.measure(quad, aim_.squareness);
      face.objective[quad] = measured.value;
      face.least_sine[quad] = measured.least_sine;
      if (measured.value <= aim_.poor) continue;
      for (const int node : mesh.quads[quad]) poor[node] = 1;
    }
    for (std::size_t i = 0; i < poor.size(); ++i) face.active[i] &= poor[i];
  }

  /// Finds the points that each boundary node has in the faces.
  void link_boundary() {
    instances_ = Rows<Instance>(nodes_.points.size(), [&](auto&& add) {
      for (const FaceId face : states_.ids()) {
        if (states_[face].mesh == nullptr) continue;
        const auto& of_face = states_[face].mesh->nodes;
        for (std::size_t k = 0; k < of_face.size(); ++k) add(of_face[k], Instance{face, static_cast<int>(k)});
      }
    });
  }

  /// Finds the slidable nodes: those inside a single edge, unless its spacing is prescribed.
  void find_slidable() {
    std::vector<char> uses = nodes_.edges_at_nodes();
    for (const auto& edge : nodes_.edges) {
      if (!edge.kept && !edge.matched) continue;
      for (const int node : edge.nodes) uses[node] = 2;
    }
    for (const FaceId face : states_.ids()) {
      if (!states_[face].mesh || !states_[face].mesh->rows) continue;
      for (const int node : states_[face].mesh->nodes) uses[node] = 2;
    }
    slidable_.resize(uses.size());
    for (std::size_t i = 0; i < uses.size(); ++i) slidable_[i] = uses[i] == 1;
  }

  // ---- the quads around a node ----

  void gather(FaceId face, int point, Round& round) {
    const FaceState& state = states_[face];
    for (const Side side : state.corners[point]) {
      const int quad = element_of(side), corner = index_of(side);
      round.uses.push_back({face, quad, corner});
      round.objective += state.objective[quad];
      round.worst_objective = std::max(round.worst_objective, state.objective[quad]);
      round.least_sine = std::min(round.least_sine, state.least_sine[quad]);
    }
  }

  void measure_sides(Round& round) {
    round.shortest = std::numeric_limits<double>::max();
    round.aspect = 1;
    double sum = 0, short_sum = 0;
    for (const QuadUse& use : round.uses) {
      const FaceState& state = states_[use.face];
      const Vector3& here = state.corner(use.quad, use.corner);
      const double next = (state.corner(use.quad, use.corner + 1) - here).norm(),
                   previous = (state.corner(use.quad, use.corner + 3) - here).norm();
      const auto [shorter, longer] = std::minmax(next, previous);
      round.shortest = std::min(round.shortest, shorter);
      round.aspect = std::max(round.aspect, longer / shorter);
      sum += next + previous;
      short_sum += shorter;
    }
    round.mean = sum / (2.0 * static_cast<double>(round.uses.size()));
    round.mean_aspect = (sum - short_sum) / short_sum;
    round.off_parallel = 0;
    for (const QuadUse& use : round.uses) {
      const FaceState& state = states_[use.face];
      const Vector3 off = state.corner(use.quad, 0) - state.corner(use.quad, 1) + state.corner(use.quad, 2) -
                          state.corner(use.quad, 3);
      round.off_parallel = std::max(round.off_parallel, off.norm() / round.mean);
    }
  }

  bool draw(const Round& round, CriteriaPatch& patch) const {
    for (const QuadUse& use : round.uses) {
      const FaceState& state = states_[use.face];
      if (!patch.add(state.corner(use.quad, use.corner), state.corner(use.quad, use.corner + 1),
                     state.corner(use.quad, use.corner + 2), state.corner(use.quad, use.corner + 3),
                     state.weight[use.quad]))
        return false;
    }
    return true;
  }

  /// Measures the quads with the node at the trial's point. \return whether they improve and keep the floor.
  bool is_better(const Round& round, Trial& trial) const {
    if (!trial.point.allFinite()) return false;
    trial.quads.clear();
    trial.objective = 0;
    const double floor = std::min(floor_sine, round.least_sine);
    const double enough = (1 - least_gain) * round.objective;
    for (const QuadUse& use : round.uses) {
      const FaceState& state = states_[use.face];
      const Vector3 &here = state.corner(use.quad, use.corner),
                    &next = state.corner(use.quad, use.corner + 1),
                    &opposite = state.corner(use.quad, use.corner + 2),
                    &previous = state.corner(use.quad, use.corner + 3);
      const QuadObjective quad =
          state.measure(use.quad, trial.point, next, opposite, previous, aim_.squareness);
      trial.objective += quad.value;
      if (!(trial.objective <= enough) || !(quad.least_sine >= floor) || !(quad.least_sine > 0)) return false;
      // The quad must not be inverted compared with before: surfaces bend less than that between quads.
      if (!(quad.normal.dot((opposite - here).cross(previous - next)) > 0)) return false;
      trial.quads.push_back(quad);
    }
    return true;
  }

  void store(const Round& round, const Trial& trial, bool wakes) {
    for (std::size_t i = 0; i < round.uses.size(); ++i) {
      const QuadUse& use = round.uses[i];
      FaceState& state = states_[use.face];
      state.objective[use.quad] = trial.quads[i].value;
      state.least_sine[use.quad] = trial.quads[i].least_sine;
      state.touched = true;
      if (!wakes) continue;
      for (const int node : state.mesh->quads[use.quad]) state.active[node] = 1;
    }
  }

  // ---- along CAD edges ----

  int slide_edges() {
    int moves = 0;
    Buffers buffers;
    SparseCheck check(context_, 64);
    for (const EdgeId id : nodes_.edges.ids()) {
      const BoundaryNodes::Edge& edge = nodes_.edges[id];
      std::optional<EdgeCurve> curve;
      for (std::size_t k = 1; k + 1 < edge.nodes.size(); ++k) {
        const int node = edge.nodes[k];
        if (!slidable_[node] || !take_active(node)) continue;
        check();
        if (!curve) curve.emplace(shape_.edges[id]);
        moves += slide(*curve, id, k, buffers);
      }
    }
    return moves;
  }

  bool take_active(int node) {
    bool any = false;
    for (const Instance& instance : instances_[node]) {
      char& active = states_[instance.face].active[instance.point];
      any |= active != 0;
      active = 0;
    }
    return any;
  }

  /// The range of parameters for node k of an edge, such that its segments are at most `longest` times as
  /// long as at first.
  std::array<double, 2> range_of(EdgeId edge, std::size_t k, double longest) const {
    const auto &now = nodes_.edges[edge].parameters, &sampled = sampled_[edge];
    const double before = sampled[k] - sampled[k - 1], after = sampled[k + 1] - sampled[k];
    return {std::max(now[k - 1] + shortest_interval * before, now[k + 1] - longest * after),
            std::min(now[k + 1] - shortest_interval * after, now[k - 1] + longest * before)};
  }

  bool slide(const EdgeCurve& curve, EdgeId id, std::size_t k, Buffers& buffers) {
    BoundaryNodes::Edge& edge = nodes_.edges[id];
    const int node = edge.nodes[k];
    auto& [round, trial] = buffers;
    round.clear();
    for (const Instance& instance : instances_[node]) gather(instance.face, instance.point, round);
    if (round.uses.empty() || round.worst_objective <= aim_.poor) return false;
    measure_sides(round);
    if (round.is_fine()) return false;
    const double t = edge.parameters[k];
    const auto [low, high] = range_of(id, k, curve.straight() ? longest_interval : longest_curved_interval);
    const Vector3 derivative = curve.derivative(t);
    const double speed = derivative.norm();
    CriteriaPatch patch(derivative / speed, Vector3::Zero(), aim_.squareness);
    if (!(speed > 0) || !(low < high) || !draw(round, patch)) return false;
    CriteriaPatch::Lanes steps{-0.4, -0.2, -0.08, -0.02, 0.02, 0.08, 0.2, 0.4};
    for (double& step : steps) step *= round.mean;
    const auto lanes = patch.evaluate(steps, {});
    const auto best = std::min_element(lanes.begin(), lanes.end()) - lanes.begin();
    for (const double share : {1.0, 0.5}) {
      const double to = std::clamp(t + share * steps[best] / speed, low, high);
      trial.point = curve.point(to);
      if (!is_better(round, trial)) continue;
      const double moved = (trial.point - nodes_.points[node]).norm();
      edge.parameters[k] = to;
      nodes_.points[node] = trial.point;
      for (const Instance& instance : instances_[node]) {
        FaceState& state = states_[instance.face];
        state.mesh->points[instance.point] = trial.point;
        state.slid[instance.point] = 1;
      }
      store(round, trial, moved > still_share * round.mean);
      return true;
    }
    return false;
  }

  // ---- inside faces ----

  /// Whether a face has rows along a loop, or is a grid beside an edge with prescribed spacing.
  bool keeps_rows(FaceId face) const {
    return states_[face].mesh->rows || (states_[face].mesh->grid && nodes_.plans[face].keeps_rows);
  }

  void relax_face(FaceId id) {
    FaceState& face = states_[id];
    face.moves = 0;
    if (keeps_rows(id) || !face.mesh->off.empty()) return;
    Buffers buffers;
    SparseCheck check(context_, 64);
    for (int node = static_cast<int>(face.mesh->nodes.size()); node < static_cast<int>(face.active.size());
         ++node) {
      if (!face.active[node]) continue;
      check();
      face.active[node] = 0;
      try {
        face.moves += relax(face, id, node, buffers);
      } catch (const Standard_Failure&) {
        continue;  // the surface cannot be evaluated there: the node stays
      }
    }
  }

  bool relax(FaceState& face, FaceId id, int node, Buffers& buffers) {
    auto& [round, trial] = buffers;
    round.clear();
    gather(id, node, round);
    if (round.uses.empty() || round.worst_objective <= aim_.poor) return false;
    measure_sides(round);
    if (round.is_fine()) return false;
    const Vector3& here = face.mesh->points[node];
    Vector3 normal = Vector3::Zero();
    for (const QuadUse& use : round.uses)
      normal += (face.corner(use.quad, 2) - face.corner(use.quad, 0))
                    .cross(face.corner(use.quad, 3) - face.corner(use.quad, 1));
    const Vector3 u = normal.unitOrthogonal(), v = normal.normalized().cross(u);
    CriteriaPatch patch(u, v, aim_.squareness);
    if (!draw(round, patch)) return false;
    const auto [x, y] = patch.lowest(round.shortest, 0.5 * round.mean);
    for (const double share : {1.0, 0.5}) {
      Vector2 uv = face.mesh->uv[node];
      trial.point = face.get_surface().approach(uv, here + share * (x * u + y * v));
      if (!is_better(round, trial)) continue;
      if (!face.mesh->normals.empty() && !turn(face, round, node, uv, trial.point)) continue;
      const double moved = (trial.point - here).norm();
      face.mesh->points[node] = trial.point;
      face.mesh->uv[node] = uv;
      store(round, trial, moved > still_share * round.mean);
      return true;
    }
    return false;
  }

  /// Gives a node of faces that are taken as one its new normal, unless a quad would then turn by more than
  /// allowed, and by more than the quads do now.
  static bool turn(FaceState& face, const Round& round, int node, Vector2 uv, const Vector3& point) {
    std::vector<Vector3>& normals = face.mesh->normals;
    const auto least = [&] {
      double result = 1;
      for (const QuadUse& use : round.uses)
        result = std::min(result, turn_cosine(face.mesh->quads[use.quad], normals));
      return result;
    };
    const double allowed = std::min(least_turn_cosine, least());
    const Vector3 before = normals[node];
    face.get_surface().move(uv, point, normals[node]);
    if (least() >= allowed) return true;
    normals[node] = before;
    return false;
  }

  // ---- replacing quads ----

  void mend(FaceState& face) {
    const auto outside = [](double value) { return value > outside_objective; };
    if (face.mesh->grid || face.mesh->rows || !face.mesh->off.empty() ||
        std::none_of(face.objective.begin(), face.objective.end(), outside))
      return;
    FaceMesh& mesh = *face.mesh;
    SurfaceMesh work = surface_mesh(mesh);
    std::vector<char> changed;
    try {
      const double turn = mesh.normals.empty() ? -1 : least_turn_cosine;
      if (mend_quads(work, MovedOnFace(face), outside_objective, turn, changed, context_) == 0) return;
    } catch (const Standard_Failure&) {
      return;  // the surface cannot be evaluated somewhere: the face stays as it is
    }
    face.touched = true;
    mesh.points = std::move(work.mesh.points);
    mesh.quads = std::move(work.mesh.quads);
    mesh.uv = std::move(work.parameters);
    if (!mesh.normals.empty()) mesh.normals = std::move(work.normals);
    mesh.pole.resize(mesh.points.size(), 0);
    prepare(face);
    face.active = std::move(changed);
  }

  /// Reverses the quads of a reversed face. While nodes move, all quads are oriented as the surface is, so
  /// that reversed faces get the same quads as others.
  static void turn_as_surface(FaceState& face) {
    if (!face.cad_face->reversed) return;
    for (auto& quad : face.mesh->quads) std::swap(quad[1], quad[3]);
  }

  static SurfaceMesh surface_mesh(const FaceMesh& mesh) {
    SurfaceMesh result;
    result.mesh.points = mesh.points;
    result.mesh.quads = mesh.quads;
    result.parameters = mesh.uv;
    result.fixed.assign(mesh.points.size(), 0);
    std::fill_n(result.fixed.begin(), mesh.nodes.size(), 1);
    result.normals = mesh.normals;
    if (!result.normals.empty()) return result;
    result.normals.assign(mesh.points.size(), Vector3::Zero());
    for (const auto& quad : result.mesh.quads) {
      const Vector3 normal = quad_area_vector(mesh.points, quad).normalized();
      for (const int node : quad) result.normals[node] += normal;
    }
    for (Vector3& normal : result.normals) normal.normalize();
    return result;
  }

  // ---- conclusion ----

  void finish(FaceState& face) {
    turn_as_surface(face);
    if (!face.touched) return;
    FaceMesh& mesh = *face.mesh;
    for (std::size_t i = 0; i < face.slid.size(); ++i)
      if (face.slid[i]) face.get_surface().nearest(mesh.uv[i], mesh.points[i]);
    mesh.q_min = 1;
    SparseCheck check(context_);
    for (const auto& quad : mesh.quads) {
      check();
      mesh.q_min = std::min(mesh.q_min, quad_q(mesh.points, quad));
    }
  }

  const CadShape& shape_;
  BoundaryNodes& nodes_;
  ExecutionContext& context_;
  Aim aim_ = toward_limits;
  IdVector<FaceId, FaceState> states_;
  std::vector<FaceId> largest_first_;  // faces with a mesh
  const EdgeParameters& sampled_;      // before sliding
  Rows<Instance> instances_;
  std::vector<char> slidable_;  // (boundary nodes) 1 = may slide along its edge
};

}  // namespace

std::vector<EdgeId> slide_nodes(const CadShape& shape, BoundaryNodes& nodes, FaceMeshes& faces,
                                const EdgeFlags& kept, const ImproveOptions& options,
                                ExecutionContext& context) {
  if (options.sliding_sweeps <= 0) return {};
  const StageTimer timer(context, Stage::slide);
  context.report(Stage::slide, 0);
  const EdgeParameters sampled = parameters_of(nodes);
  {
    NodeSliding sliding(shape, nodes, faces, sampled, context);
    sliding.run(options.sliding_sweeps);
    sliding.finish();
  }
  if (!options.clean_up) return {};
  EdgeFlags uncrossed = kept;
  for (const FaceId face : faces.ids()) {
    if (!faces[face] || !faces[face]->rows) continue;
    for (const CadWire& wire : shape.faces[face].wires)
      for (const Coedge& coedge : wire.coedges) uncrossed[coedge.edge] = 1;
  }
  const std::vector<CompositeFace> composites = join_smooth_faces(shape, uncrossed, nodes, faces, context);
  {
    NodeSliding sliding(shape, nodes, faces, sampled, context);
    sliding.wake_only(composites);
    const bool mended = sliding.mend();
    if (mended || !composites.empty()) sliding.run(options.sliding_sweeps);
    sliding.finish();
  }
  return split_faces(shape, composites, nodes, faces, context);
}

}  // namespace quadrille
