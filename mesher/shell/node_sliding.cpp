/// Slides nodes along edges and moves them inside faces, and refills patches where that is not enough.
/// Based on: Freitag, On combining Laplacian and optimization-based mesh smoothing techniques (1997), for
/// accepting moves one node at a time. The objective is that of CriteriaPatch.

#include "mesher/shell/node_sliding.hpp"

#include <Standard_Failure.hxx>

#include <algorithm>
#include <memory>

#include "geometry/cad/parallel_ids.hpp"
#include "geometry/surfaces/edge_curve.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/mesh/criteria.hpp"
#include "mesher/mesh/quad_geometry.hpp"
#include "mesher/mesh/sides.hpp"
#include "mesher/quads/criteria_patch.hpp"
#include "mesher/quads/mending.hpp"
#include "mesher/shell/boundary_sides.hpp"
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
constexpr double parallel_share = 0.1;
/// The cosine of the limit of skew and of corner angles, 40 degrees. Quads across smooth edges turn by no
/// more between two corners either, or than they did before, so that fillets keep their rows.
constexpr double limit_cosine = 0.766;
/// The weight of a quad alone in a corner of its face that is sharper than the limit: it stays outside
/// whatever its other nodes do. With its full weight, its neighbors would be drawn outside too.
constexpr double sharp_weight = 0.1;
/// After a move by more than this share of the mean side, the neighbors are visited again.
constexpr double still_share = 0.01;
/// Segments on edges stay between these shares of their original length in the curve's parameter. On curved
/// edges they grow less, so that circles stay round.
constexpr double shortest_interval = 0.5, longest_interval = 1.5, longest_curved_interval = 1.15;

/// The state of one face while nodes move.
struct FaceState {
  FaceMesh* mesh = nullptr;
  const CadFace* cad_face = nullptr;
  bool keeps_inside = false;                   // nodes inside stay
  std::shared_ptr<const MeshSurface> surface;  // made on first use
  Rows<Side> corners;                          // around each point
  std::vector<double> objective, least_sine;   // (quads) the objective is weighted
  std::vector<double> weight;                  // (quads) of the objective
  std::vector<char> active;                    // (points) 1 = to be visited
  std::vector<char> slid;                      // (boundary points) 1 = moved; uv must be updated
  bool mended = false;                         // quads were replaced
  int moves = 0;                               // nodes moved in the last sweep

  const MeshSurface& get_surface() {
    if (!surface) surface = mesh->surface ? mesh->surface : std::make_shared<const FaceSurface>(*cad_face);
    return *surface;
  }

  const Vector3& corner(int quad, int k) const { return mesh->points[mesh->quads[quad][k & 3]]; }

  /// Measures a quad with its corners at other places.
  QuadObjective measure(int quad, const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d,
                        double squareness) const {
    QuadObjective result = measure_objective(a, b, c, d, squareness);
    result.value *= weight[quad];
    return result;
  }

  /// Reverses the quads of a reversed face. While nodes move, all quads are oriented as the surface is, so
  /// that reversed faces get the same quads as others.
  void turn_as_surface() const {
    if (!cad_face->reversed) return;
    for (auto& quad : mesh->quads) std::swap(quad[1], quad[3]);
  }

  void prepare(const ExecutionContext& context) {
    corners = corners_by_node(mesh->points.size(), mesh->quads, SparseCheck(context, 2048));
    objective.resize(mesh->quads.size());
    least_sine.resize(mesh->quads.size());
    active.assign(mesh->points.size(), 1);
    slid.resize(mesh->nodes.size(), 0);
    // Find the quads in sharp corners. Nodes on the boundary come first.
    weight.assign(mesh->quads.size(), 1);
    for (std::size_t i = 0; i < mesh->nodes.size(); ++i) {
      if (corners[i].size() != 1) continue;
      const int quad = element_of(corners[i][0]), k = index_of(corners[i][0]);
      const Vector3& here = corner(quad, k);
      const Vector3 next = corner(quad, k + 1) - here, previous = corner(quad, k + 3) - here;
      if (next.dot(previous) > limit_cosine * next.norm() * previous.norm()) weight[quad] = sharp_weight;
    }
  }

  /// Measures all quads. Active nodes stay active only if one of their quads is poor.
  void measure_all(const Aim& aim, const ExecutionContext& context) {
    SparseCheck check(context);
    std::vector<char> poor(mesh->points.size(), 0);
    for (int quad = 0; quad < static_cast<int>(mesh->quads.size()); ++quad) {
      check();
      const QuadObjective measured =
          measure(quad, corner(quad, 0), corner(quad, 1), corner(quad, 2), corner(quad, 3), aim.squareness);
      objective[quad] = measured.value;
      least_sine[quad] = measured.least_sine;
      if (measured.value <= aim.poor) continue;
      for (const int node : mesh->quads[quad]) poor[node] = 1;
    }
    for (std::size_t i = 0; i < poor.size(); ++i) active[i] &= poor[i];
  }

  /// Updates uv after nodes moved.
  void finish() {
    turn_as_surface();
    for (std::size_t i = 0; i < slid.size(); ++i)
      if (slid[i]) get_surface().nearest(mesh->uv[i], mesh->points[i]);
  }
};

using FaceStates = IdVector<FaceId, FaceState>;

/// A quad around a node, which is its corner `corner`.
struct QuadUse {
  FaceState* face;
  int quad, corner;

  /// The k-th corner, counted from the node.
  const Vector3& at(int k) const { return face->corner(quad, corner + k); }
};

/// The quads around a node while a better place for it is sought. Reused from node to node.
class Round {
 public:
  explicit Round(const Aim& aim) : aim_(aim) {}

  const std::vector<QuadUse>& uses() const { return uses_; }
  double shortest() const { return shortest_; }  ///< length of the sides at the node
  double mean() const { return mean_; }          ///< length of the sides at the node

  void clear() {
    uses_.clear();
    objective_ = worst_objective_ = 0;
    least_sine_ = 1;
  }

  void gather(FaceState& face, int point) {
    for (const Side side : face.corners[point]) {
      const int quad = element_of(side);
      uses_.push_back({&face, quad, index_of(side)});
      objective_ += face.objective[quad];
      worst_objective_ = std::max(worst_objective_, face.objective[quad]);
      least_sine_ = std::min(least_sine_, face.least_sine[quad]);
    }
  }

  /// Measures the sides at the node. \return whether a quad is poor and the quads are not fine as they are.
  bool needs_move() {
    if (uses_.empty() || worst_objective_ <= aim_.poor) return false;
    shortest_ = std::numeric_limits<double>::max();
    double aspect = 1;        // largest ratio of the two sides of a quad at the node
    double off_parallel = 0;  // largest difference of opposite sides
    double sum = 0, short_sum = 0;
    for (const QuadUse& use : uses_) {
      const Vector3& here = use.at(0);
      const double next = (use.at(1) - here).norm(), previous = (use.at(3) - here).norm();
      const auto [shorter, longer] = std::minmax(next, previous);
      shortest_ = std::min(shortest_, shorter);
      aspect = std::max(aspect, longer / shorter);
      sum += next + previous;
      short_sum += shorter;
      const Vector3 off = use.face->corner(use.quad, 0) - use.face->corner(use.quad, 1) +
                          use.face->corner(use.quad, 2) - use.face->corner(use.quad, 3);
      off_parallel = std::max(off_parallel, off.norm());
    }
    mean_ = sum / (2.0 * static_cast<double>(uses_.size()));
    // Rows of which some are beyond the limit, but not their mean, become more even.
    constexpr double most = usual_limit(Criterion::aspect);
    const bool uneven = aspect > most && (sum - short_sum) / short_sum < most;
    return !(least_sine_ > limit_cosine && !uneven && off_parallel / mean_ < parallel_share);
  }

  /// \return whether the patch has all quads
  bool draw(CriteriaPatch& patch) const {
    return std::all_of(uses_.begin(), uses_.end(), [&](const QuadUse& use) {
      return patch.add(use.at(0), use.at(1), use.at(2), use.at(3), use.face->weight[use.quad]);
    });
  }

  /// Tries the whole of a move, then half of it. \param place_at its place, by the share of the move
  /// \param put puts the node there, unless it returns false
  template <class PlaceAt, class Put>
  bool move(const Vector3& here, PlaceAt&& place_at, Put&& put) {
    for (const double share : {1.0, 0.5}) {
      const Vector3 place = place_at(share);
      if (!improves(place)) continue;
      const double moved = (place - here).norm();
      if (!put(place)) continue;
      store(moved > still_share * mean_);
      return true;
    }
    return false;
  }

 private:
  /// Measures the quads with the node at a place. \return whether they improve and keep the floor.
  bool improves(const Vector3& place) {
    if (!place.allFinite()) return false;
    measured_.clear();
    double objective = 0;
    const double floor = std::min(floor_sine, least_sine_);
    const double enough = (1 - least_gain) * objective_;
    for (const QuadUse& use : uses_) {
      const Vector3 &here = use.at(0), &next = use.at(1), &opposite = use.at(2), &previous = use.at(3);
      const QuadObjective quad =
          use.face->measure(use.quad, place, next, opposite, previous, aim_.squareness);
      objective += quad.value;
      if (!(objective <= enough) || !(quad.least_sine >= floor) || !(quad.least_sine > 0)) return false;
      // The quad must not be inverted compared with before: surfaces bend less than that between quads.
      if (!(quad.normal.dot((opposite - here).cross(previous - next)) > 0)) return false;
      measured_.push_back(quad);
    }
    return true;
  }

  /// Stores what improves() measured.
  void store(bool wakes) const {
    for (std::size_t i = 0; i < uses_.size(); ++i) {
      const auto& [face, quad, corner] = uses_[i];
      face->objective[quad] = measured_[i].value;
      face->least_sine[quad] = measured_[i].least_sine;
      if (!wakes) continue;
      for (const int node : face->mesh->quads[quad]) face->active[node] = 1;
    }
  }

  Aim aim_;
  std::vector<QuadUse> uses_;
  double objective_ = 0, worst_objective_ = 0, least_sine_ = 1;
  double shortest_ = 0, mean_ = 0;
  std::vector<QuadObjective> measured_;  ///< (uses) at the place tried last
};

// ---- along CAD edges ----

/// (edges) the parameters of the nodes.
using EdgeParameters = IdVector<EdgeId, std::vector<double>>;

/// The slidable nodes: those inside a single edge, unless its spacing is prescribed.
std::vector<char> slidable_nodes(const BoundaryNodes& nodes) {
  std::vector<char> uses = nodes.edges_at_nodes();
  for (const auto& edge : nodes.edges) {
    if (!edge.kept) continue;
    for (const int node : edge.nodes) uses[node] = 2;
  }
  for (char& use : uses) use = use == 1;
  return uses;
}

/// Slides nodes along their edges, in all faces at once.
class EdgeSliding {
 public:
  /// \param sampled before any node moved
  EdgeSliding(const CadShape& shape, BoundaryNodes& nodes, const EdgeParameters& sampled, FaceStates& faces)
      : shape_(shape), nodes_(nodes), sampled_(sampled), slidable_(slidable_nodes(nodes)) {
    instances_ = Rows<Instance>(nodes_.points.size(), [&](auto&& add) {
      for (FaceState& face : faces) {
        if (face.mesh == nullptr) continue;
        const auto& of_face = face.mesh->nodes;
        for (std::size_t k = 0; k < of_face.size(); ++k)
          add(of_face[k], Instance{&face, static_cast<int>(k)});
      }
    });
  }

  /// Visits each active node once. \return how many moved.
  int sweep(const Aim& aim, const ExecutionContext& context) {
    int moves = 0;
    Round round(aim);
    SparseCheck check(context, 64);
    for (const EdgeId id : nodes_.edges.ids()) {
      const BoundaryNodes::Edge& edge = nodes_.edges[id];
      std::optional<EdgeCurve> curve;
      for (std::size_t k = 1; k + 1 < edge.nodes.size(); ++k) {
        const int node = edge.nodes[k];
        if (!slidable_[node] || !take_active(node)) continue;
        check();
        if (!curve) curve.emplace(shape_.edges[id]);
        moves += slide(*curve, id, k, aim, round);
      }
    }
    return moves;
  }

 private:
  /// A point of a face at a boundary node.
  struct Instance {
    FaceState* face = nullptr;
    int point = -1;
  };

  bool take_active(int node) {
    bool any = false;
    for (const auto& [face, point] : instances_[node]) {
      any |= face->active[point] != 0;
      face->active[point] = 0;
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

  bool slide(const EdgeCurve& curve, EdgeId id, std::size_t k, const Aim& aim, Round& round) {
    BoundaryNodes::Edge& edge = nodes_.edges[id];
    const int node = edge.nodes[k];
    round.clear();
    for (const auto& [face, point] : instances_[node]) round.gather(*face, point);
    if (!round.needs_move()) return false;
    const double t = edge.parameters[k];
    const auto [low, high] = range_of(id, k, curve.straight() ? longest_interval : longest_curved_interval);
    const Vector3 derivative = curve.derivative(t);
    const double speed = derivative.norm();
    CriteriaPatch patch(derivative / speed, Vector3::Zero(), aim.squareness);
    if (!(speed > 0) || !(low < high) || !round.draw(patch)) return false;
    CriteriaPatch::Lanes steps{-0.4, -0.2, -0.08, -0.02, 0.02, 0.08, 0.2, 0.4};
    for (double& step : steps) step *= round.mean();
    const auto lanes = patch.evaluate(steps, {});
    const double best = steps[std::min_element(lanes.begin(), lanes.end()) - lanes.begin()];
    double to = t;
    const auto place_at = [&, low = low, high = high](double share) {
      to = std::clamp(t + share * best / speed, low, high);
      return curve.point(to);
    };
    return round.move(nodes_.points[node], place_at, [&](const Vector3& place) {
      edge.parameters[k] = to;
      nodes_.points[node] = place;
      for (const auto& [face, point] : instances_[node]) {
        face->mesh->points[point] = place;
        face->slid[point] = 1;
      }
      return true;
    });
  }

  const CadShape& shape_;
  BoundaryNodes& nodes_;
  const EdgeParameters& sampled_;
  Rows<Instance> instances_;    ///< (boundary nodes)
  std::vector<char> slidable_;  ///< (boundary nodes) 1 = may slide along its edge
};

// ---- inside faces ----

/// Gives a node of faces that are taken as one its new normal, unless a quad would then turn by more than
/// allowed, and by more than the quads do now.
bool turn(FaceState& face, const Round& round, int node, Vector2 uv, const Vector3& point) {
  std::vector<Vector3>& normals = face.mesh->normals;
  const auto least = [&] {
    double result = 1;
    for (const QuadUse& use : round.uses())
      result = std::min(result, turn_cosine(face.mesh->quads[use.quad], normals));
    return result;
  };
  const double allowed = std::min(limit_cosine, least());
  const Vector3 before = normals[node];
  face.get_surface().move(uv, point, normals[node]);
  if (least() >= allowed) return true;
  normals[node] = before;
  return false;
}

bool relax(FaceState& face, int node, const Aim& aim, Round& round) {
  round.clear();
  round.gather(face, node);
  if (!round.needs_move()) return false;
  FaceMesh& mesh = *face.mesh;
  const Vector3& here = mesh.points[node];
  Vector3 normal = Vector3::Zero();
  for (const QuadUse& use : round.uses()) normal += quad_area_vector(mesh.points, mesh.quads[use.quad]);
  const Vector3 u = normal.unitOrthogonal(), v = normal.normalized().cross(u);
  CriteriaPatch patch(u, v, aim.squareness);
  if (!round.draw(patch)) return false;
  const auto [x, y] = patch.lowest(round.shortest(), 0.5 * round.mean());
  const Vector3 step = x * u + y * v;
  Vector2 uv;
  const auto place_at = [&](double share) {
    uv = mesh.uv[node];
    return face.get_surface().approach(uv, here + share * step);
  };
  return round.move(here, place_at, [&](const Vector3& place) {
    if (!mesh.normals.empty() && !turn(face, round, node, uv, place)) return false;
    mesh.points[node] = place;
    mesh.uv[node] = uv;
    return true;
  });
}

/// Visits each active node inside a face once, and counts those that move.
void relax_face(FaceState& face, const Aim& aim, const ExecutionContext& context) {
  face.moves = 0;
  if (face.keeps_inside) return;
  Round round(aim);
  SparseCheck check(context, 64);
  for (int node = static_cast<int>(face.mesh->nodes.size()); node < static_cast<int>(face.active.size());
       ++node) {
    if (!face.active[node]) continue;
    check();
    face.active[node] = 0;
    try {
      face.moves += relax(face, node, aim, round);
    } catch (const Standard_Failure&) {
      continue;  // the surface cannot be evaluated there: the node stays
    }
  }
}

// ---- replacing quads ----

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

SurfaceMesh surface_mesh(const FaceMesh& mesh) {
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

/// Refills patches around quads outside the limits, and activates only their nodes.
void mend(FaceState& face, const ExecutionContext& context) {
  const auto outside = [](double value) { return value > outside_objective; };
  if (face.mesh->grid || !face.mesh->off.empty() ||
      std::none_of(face.objective.begin(), face.objective.end(), outside))
    return;
  FaceMesh& mesh = *face.mesh;
  SurfaceMesh work = surface_mesh(mesh);
  std::vector<char> changed;
  try {
    const double turn = mesh.normals.empty() ? -1 : limit_cosine;
    if (mend_quads(work, MovedOnFace(face), outside_objective, turn, changed, context) == 0) return;
    if (crowded_side(mesh.nodes, work.mesh.quads)) return;
  } catch (const Standard_Failure&) {
    return;  // the surface cannot be evaluated somewhere: the face stays as it is
  }
  face.mended = true;
  mesh.points = std::move(work.mesh.points);
  mesh.quads = std::move(work.mesh.quads);
  mesh.uv = std::move(work.parameters);
  if (!mesh.normals.empty()) mesh.normals = std::move(work.normals);
  mesh.pole.resize(mesh.points.size(), 0);
  face.prepare(context);
  face.active = std::move(changed);
}

/// The faces of a shape while their nodes move.
class NodeSliding {
 public:
  /// \param sampled before any node moved
  NodeSliding(const CadShape& shape, BoundaryNodes& nodes, FaceMeshes& faces, const EdgeParameters& sampled,
              ExecutionContext& context)
      : context_(context), states_(faces.size()) {
    for (const FaceId face : faces.ids()) {
      if (!faces[face]) continue;
      largest_first_.push_back(face);
      FaceMesh& mesh = *faces[face];
      FaceState& state = states_[face];
      state.mesh = &mesh;
      state.cad_face = &shape.faces[face];
      // Grids beside an edge with prescribed spacing stay.
      state.keeps_inside = (mesh.grid && nodes.plans[face].keeps_rows()) || !mesh.off.empty();
      state.turn_as_surface();
    }
    std::stable_sort(largest_first_.begin(), largest_first_.end(),
                     [&](FaceId a, FaceId b) { return faces[a]->quads.size() > faces[b]->quads.size(); });
    for_each_face([&](FaceState& face) { face.prepare(context_); });
    edges_.emplace(shape, nodes, sampled, states_);
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
    for_each_face([&](FaceState& face) {
      face.measure_all(toward_limits, context_);
      quadrille::mend(face, context_);
    });
    return std::any_of(states_.begin(), states_.end(), [](const FaceState& face) { return face.mended; });
  }

  /// Updates uv after nodes moved.
  void finish() {
    for_each_face([](FaceState& face) { face.finish(); });
  }

 private:
  void slide(int sweeps, const Aim& aim) {
    for_each_face([&](FaceState& face) { face.measure_all(aim, context_); });
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      int moves = edges_->sweep(aim, context_);
      for_each_face([&](FaceState& face) { relax_face(face, aim, context_); });
      for (const FaceState& face : states_) moves += face.moves;
      if (moves == 0) break;
    }
  }

  template <class Work>
  void for_each_face(Work&& work) {
    for_each_in_order(largest_first_, [&](FaceId face) { work(states_[face]); });
  }

  ExecutionContext& context_;
  FaceStates states_;
  std::vector<FaceId> largest_first_;  ///< faces with a mesh
  std::optional<EdgeSliding> edges_;   ///< holds references to states_
};

}  // namespace

std::vector<EdgeId> slide_nodes(const CadShape& shape, BoundaryNodes& nodes, FaceMeshes& faces,
                                const EdgeFlags& kept, const ImproveOptions& options,
                                ExecutionContext& context) {
  if (options.sliding_sweeps <= 0) return {};
  const StageTimer timer(context, Stage::slide);
  context.report(Stage::slide, 0);
  EdgeParameters sampled;
  for (const auto& edge : nodes.edges) sampled.push_back(edge.parameters);
  {
    NodeSliding sliding(shape, nodes, faces, sampled, context);
    sliding.run(options.sliding_sweeps);
    sliding.finish();
  }
  if (!options.clean_up) return {};
  const std::vector<CompositeFace> composites = join_smooth_faces(shape, kept, nodes, faces, context);
  {
    NodeSliding sliding(shape, nodes, faces, sampled, context);
    sliding.wake_only(composites);
    const bool mended = sliding.mend();
    if (mended || !composites.empty()) sliding.run(options.sliding_sweeps);
    sliding.finish();
  }
  return split_faces(composites, nodes, faces, context);
}

}  // namespace quadrille
