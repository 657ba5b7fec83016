/// Runs the steps: orientation, features, remeshed triangles, quads on each patch, numbers of nodes.

#include "mesher/remesh/remesh.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <unordered_map>

#include "geometry/base/error.hpp"
#include "geometry/base/place_text.hpp"
#include "geometry/base/process_usage.hpp"
#include "geometry/base/side_key.hpp"
#include "geometry/base/threads.hpp"
#include "geometry/cad/parallel_ids.hpp"
#include "geometry/sizing/element_count.hpp"
#include "geometry/sizing/sizing_options.hpp"
#include "mesher/mesh/quad_geometry.hpp"
#include "mesher/mesh/side_twins.hpp"
#include "mesher/mesh/sides.hpp"
#include "mesher/mesh/surface_cut.hpp"
#include "mesher/quads/face_quads.hpp"
#include "mesher/quads/improve.hpp"
#include "mesher/quads/triangulated_surface.hpp"
#include "mesher/remesh/fidelity.hpp"
#include "mesher/remesh/patch_surface.hpp"
#include "mesher/remesh/triangle_remesher.hpp"
#include "mesher/shell/assembly.hpp"
#include "mesher/shell/triangle_input.hpp"

namespace quadrille {

namespace {

/// Sides of quads shorter than this times the surface's diagonal count as having no length.
constexpr double same_place = 1e-9;
/// Nodes at most this share of the size apart are one: the rims of needles would ask for sides as short.
constexpr double one_point = 1e-6;

void check(const RemeshOptions& options) {
  if (!(options.size > 0) || !std::isfinite(options.size))
    throw usage_error("size", fmt::format("`size` must be a positive number, not {:g}", options.size));
  if (options.order != 1 && options.order != 2)
    throw usage_error("order", fmt::format("`order` must be 1 or 2, not {}", options.order));
  if (!(options.feature_angle >= 0 && options.feature_angle <= 180))
    throw usage_error(
        "feature_angle",
        fmt::format("the feature angle must be from 0 to 180 degrees, not {:g}", options.feature_angle));
}

/// Throws Error (failure) if more than two triangles share a side, or if no two triangles share one.
void check_manifold(const TriangleMesh& mesh) {
  bool any_shared = false;
  const auto look = [&](int a, int b, std::span<const Side> sides) {
    any_shared |= sides.size() > 1;
    if (sides.size() > 2)
      throw failure("", fmt::format("{} triangles meet at the side from {} to {}, where a surface has two at "
                                    "most: split the surface there",
                                    sides.size(), place_text(mesh.points[a]), place_text(mesh.points[b])));
  };
  for_each_shared_side(mesh.points.size(), no_check, look, mesh.triangles);
  if (mesh.triangles.size() > 2 && !any_shared)
    throw failure("", fmt::format("none of the {} triangles shares a side with another: `merge` merges nodes "
                                  "that lie close together",
                                  mesh.triangles.size()));
}

/// The surface to be meshed, in one or more pieces.
struct Surface {
  TriangleMesh mesh;          ///< tags are the input's faces
  std::vector<int> original;  ///< point -> the point that it is a copy of, or itself
  std::vector<char> touches;  ///< (points) 1 = the surface touches itself there; the point has copies
  std::vector<int> pieces;    ///< (triangles) connected piece of each, from 0
  int piece_count = 0;        ///< number of connected pieces
};

Surface oriented_surface(TriangleMesh mesh, std::vector<std::string>& notes) {
  const std::vector<int> faces = std::move(mesh.tags);
  mesh.tags.clear();
  check_manifold(mesh);
  if (const int turned = orient_alike(mesh); turned > 0)
    notes.push_back(fmt::format("{} triangles were reversed to match those of neighboring faces", turned));
  CutSurface cut = cut_surface(mesh, 0);
  Surface surface{std::move(cut.mesh), std::move(cut.original), {}, {}, cut.pieces};
  surface.pieces = std::move(surface.mesh.tags);
  surface.mesh.tags = faces;
  surface.touches.assign(surface.original.size(), 0);
  for (std::size_t v = mesh.points.size(); v < surface.original.size(); ++v)
    surface.touches[v] = surface.touches[surface.original[v]] = 1;
  return surface;
}

std::vector<Eigen::AlignedBox3d> boxes_of_pieces(const Surface& surface) {
  std::vector<Eigen::AlignedBox3d> boxes(surface.piece_count);
  for (std::size_t t = 0; t < surface.pieces.size(); ++t)
    for (const int v : surface.mesh.triangles[t]) boxes[surface.pieces[t]].extend(surface.mesh.points[v]);
  return boxes;
}

/// Throws Error (usage) if the size exceeds the surface's diagonal. \return that diagonal.
double check_size(const Surface& surface, const RemeshOptions& options) {
  Eigen::AlignedBox3d box;
  for (const auto& piece : boxes_of_pieces(surface)) box.extend(piece);
  const double diagonal = box.diagonal().norm();
  if (options.size > diagonal)
    throw usage_error("size", fmt::format("`size` is {:g}, larger than the surface, whose diagonal is {:.6g}",
                                          options.size, diagonal));
  return diagonal;
}

/// The numbers of faces or edges in the result. The first one with a given input number keeps it; the others
/// get new numbers. \param inputs numbers in the input, 0 = none.
std::vector<int> numbers_of(const std::vector<int>& inputs) {
  std::set<int> taken;
  int last = 0;
  for (const int number : inputs) last = std::max(last, number);
  std::vector<int> result;
  result.reserve(inputs.size());
  for (const int number : inputs)
    result.push_back(number > 0 && taken.insert(number).second ? number : ++last);
  return result;
}

/// The first nodes of the sides that two quads run along in the same direction. Such sides occur where a tube
/// has too few triangles around it and collapses onto itself.
std::vector<int> doubled_sides(const std::vector<std::array<int, 4>>& quads) {
  std::vector<std::pair<int, int>> sides;
  sides.reserve(4 * quads.size());
  for (const auto& quad : quads)
    for (int k = 0; k < 4; ++k) sides.emplace_back(quad[k], quad[(k + 1) & 3]);
  std::ranges::sort(sides);
  std::vector<int> nodes;
  for (std::size_t i = 1; i < sides.size(); ++i)
    if (sides[i] == sides[i - 1]) nodes.push_back(sides[i].first);
  return nodes;
}

/// The surface, cut into faces.
struct Model {
  SurfaceLocator locator;
  TriangulatedSurface reference;  // cut along the curves; points move on it
  Surface surface;
  double least_side = 0;  // shortest side that a quad may have
  FeatureNetwork network;
  std::vector<int> input_faces, face_numbers;  // by patch
  std::vector<int> input_edges, edge_numbers;  // by curve
};

/// The sides of the surface that are segments of the input. \param node point of each of its nodes
std::map<std::pair<int, int>, int> given_sides(const ShellMesh& input, const Surface& surface,
                                               const std::vector<int>& node) {
  std::map<std::pair<int, int>, int> wanted, result;
  for (const ShellMesh::Segment& segment : input.segments) {
    const int a = node[segment.nodes[0]], b = node[segment.nodes[1]];
    if (a >= 0 && b >= 0 && a != b) wanted[std::minmax(a, b)] = segment.edge;
  }
  if (wanted.empty()) return result;
  for (const auto& t : surface.mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      const int a = t[i], b = t[next_index(i)];
      const auto found = wanted.find(std::minmax(surface.original[a], surface.original[b]));
      if (found != wanted.end()) result[std::minmax(a, b)] = found->second;
    }
  }
  return result;
}

/// The surface cut along its curves. Points move on it.
TriangulatedSurface cut_reference(const Surface& surface, const FeatureNetwork& network) {
  TriangleMesh mesh = surface.mesh;
  mesh.tags = network.patches;
  std::vector<std::array<int, 2>> sides;
  for (const FeatureCurve& curve : network.curves)
    for (std::size_t k = 0; k + 1 < curve.points.size(); ++k)
      sides.push_back({curve.points[k], curve.points[k + 1]});
  return TriangulatedSurface(cut_surface(mesh, 0, std::move(sides)).mesh);
}

Model find_faces(const ShellMesh& input, const RemeshOptions& options, std::vector<std::string>& notes,
                 ExecutionContext& context) {
  const StageTimer timer(context, Stage::sample);
  context.report(Stage::sample, 0);
  TriangleInput triangles = triangle_input(input, options.merge, one_point * options.size, notes, context);
  if (input.order == 2)
    notes.push_back("the mesh is of second order: the surface is taken to be flat between its corner nodes");
  Surface surface = oriented_surface(std::move(triangles.mesh), notes);
  const double least_side = same_place * check_size(surface, options);
  context.check();
  const FeatureRules rules{.angle = options.feature_angle,
                           .size = options.size,
                           .sides = given_sides(input, surface, triangles.node),
                           .fixed = surface.touches};
  FeatureNetwork network = find_features(surface.mesh, rules);
  context.check();
  std::vector<int> face_of_patch(network.patch_count), edge_of_curve;
  for (std::size_t t = 0; t < network.patches.size(); ++t)
    face_of_patch[network.patches[t]] = surface.mesh.tags[t];
  for (const FeatureCurve& curve : network.curves) edge_of_curve.push_back(curve.edge);
  std::vector<int> face_numbers = numbers_of(face_of_patch), edge_numbers = numbers_of(edge_of_curve);
  return {SurfaceLocator(surface.mesh, network.patches, network.patch_count),
          cut_reference(surface, network),
          std::move(surface),
          least_side,
          std::move(network),
          std::move(face_of_patch),
          std::move(face_numbers),
          std::move(edge_of_curve),
          std::move(edge_numbers)};
}

/// The longest sides of triangles with which each piece keeps its shape. Every piece gets at least four
/// sides across its diagonal. Pieces without curves, such as rings and spheres, get about five around their
/// mean thickness, unless their walls are thin. The mean thickness is twice the volume over the area.
std::vector<double> longest_sides(const Model& model, double size) {
  constexpr double least_across = 4, of_thickness = 1.2, least_of_size = 0.5;
  std::vector<double> most;
  for (const auto& box : boxes_of_pieces(model.surface)) most.push_back(box.diagonal().norm() / least_across);
  std::vector<char> has_curve(most.size(), 0), on_curve(model.surface.mesh.points.size(), 0);
  for (const FeatureCurve& curve : model.network.curves)
    for (const int v : curve.points) on_curve[v] = 1;
  std::vector<double> area(most.size(), 0), volume(most.size(), 0);
  const auto& p = model.surface.mesh.points;
  for (std::size_t t = 0; t < model.surface.pieces.size(); ++t) {
    const int piece = model.surface.pieces[t];
    const auto& [a, b, c] = model.surface.mesh.triangles[t];
    const Vector3 twice = (p[b] - p[a]).cross(p[c] - p[a]);
    area[piece] += 0.5 * twice.norm();
    volume[piece] += twice.dot(p[a] - p[0]) / 6;
    has_curve[piece] |= on_curve[a] | on_curve[b] | on_curve[c];
  }
  for (std::size_t piece = 0; piece < most.size(); ++piece)
    if (!has_curve[piece])
      most[piece] = std::min(most[piece], std::max(least_of_size * size,
                                                   of_thickness * 2 * std::abs(volume[piece]) / area[piece]));
  return most;
}

/// (points) wanted lengths of the sides of triangles.
std::vector<double> find_targets(const Model& model, double size) {
  std::vector<double> targets(model.surface.mesh.points.size(), 2 * size);
  const std::vector<double> longest_of_piece = longest_sides(model, size);
  for (std::size_t t = 0; t < model.surface.pieces.size(); ++t)
    for (const int v : model.surface.mesh.triangles[t])
      targets[v] = std::min(targets[v], longest_of_piece[model.surface.pieces[t]]);
  return targets;
}

void hold_budget(const TriangleMesh& surface, const std::vector<double>& targets, int order) {
  Budget budget;
  // As measured on a sphere of 164 000 quads. Half of it is for measuring the distances.
  budget.bytes_an_element = order == 2 ? 3300 : 1800;
  double count = 0;
  for (const auto& [a, b, c] : surface.triangles) {
    const auto& p = surface.points;
    const double side = std::min({targets[a], targets[b], targets[c]});
    count += 0.5 * (p[b] - p[a]).cross(p[c] - p[a]).norm() / (0.25 * side * side);
  }
  hold_elements(count, budget, free_memory());
}

RemeshedTriangles make_triangles(const Model& model, const std::vector<double>& targets,
                                 ExecutionContext& context) {
  const StageTimer timer(context, Stage::triangulate);
  std::vector<double> by_curve;
  for (const FeatureCurve& curve : model.network.curves)
    by_curve.push_back(targets[std::ranges::min(curve.points, {}, [&](int v) { return targets[v]; })]);
  return remesh_triangles(model.surface.mesh, model.network, place_on_curves(model.network, by_curve),
                          model.locator, targets, context);
}

/// Whether a quad is inverted, or has a side of no length. Unfolding looks only at shape, not at size.
bool is_spoiled(const std::vector<Vector3>& p, const std::array<int, 4>& quad, double least_side) {
  for (int k = 0; k < 4; ++k)
    if ((p[quad[(k + 1) % 4]] - p[quad[k]]).norm() < least_side) return true;
  return quad_scaled_jacobian(p, quad) <= 0;
}

/// A node of each quad that is spoiled or lies on another quad.
std::vector<Vector3> inverted_places(const FaceMeshes& quads, double least_side) {
  std::vector<Vector3> places;
  for (const auto& piece : quads) {
    for (const auto& quad : piece->quads)
      if (is_spoiled(piece->points, quad, least_side)) places.push_back(piece->points[quad[0]]);
    for (const int node : doubled_sides(piece->quads)) places.push_back(piece->points[node]);
  }
  return places;
}

/// Makes the targets near some places smaller.
void refine_near(const std::vector<Vector3>& places, const std::vector<Vector3>& points, double size,
                 std::vector<double>& targets, const ExecutionContext& context) {
  constexpr double smaller = 0.6, reach = 3;
  constexpr std::size_t most_places = 1000;
  const std::size_t step = 1 + places.size() / most_places;
  std::vector<char> near(targets.size(), 0);
  for (std::size_t k = 0; k < places.size(); k += step) {
    int nearest = -1;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t v = 0; v < near.size(); ++v) {
      const double distance = (points[v] - places[k]).norm();
      if (distance < reach * size) near[v] = 1;
      if (distance >= least) continue;
      least = distance;
      nearest = static_cast<int>(v);
    }
    near[nearest] = 1;
    context.check();
  }
  for (std::size_t v = 0; v < near.size(); ++v)
    if (near[v]) targets[v] *= smaller;
}

void tell_off_surface(const FaceMeshes& quads, std::vector<std::string>& notes) {
  std::ptrdiff_t off = 0;
  for (const auto& piece : quads) off += std::ranges::count_if(piece->off, [](double d) { return d > 0; });
  if (off == 0) return;
  notes.push_back(fmt::format(
      "{} nodes lie off the surface, where it bends too tightly for the size and quads would be inverted",
      off));
}

/// Connected pieces of the patches, without sides on which they would meet themselves.
struct Pieces {
  std::vector<FaceTriangulation> triangulations;  ///< without parameters and normals of their points
  IdVector<FaceId, int> patches;                  ///< (pieces) the patch of each
  BoundaryNodes nodes;                            ///< corners, then along the curves
};

/// Cuts triangles along the curves, and numbers the nodes on the boundaries; the middles of sides are on the
/// curves, or on the patches.
class PieceCutter {
 public:
  PieceCutter(const Model& model, RemeshedTriangles triangles)
      : model_(model), triangles_(std::move(triangles)) {}

  Pieces run() && {
    std::vector<std::array<int, 2>> sides;
    for (const auto& side : triangles_.sides) sides.push_back(side.points);
    split(cut_surface(triangles_.mesh, 0, std::move(sides)));
    number_boundary();
    return std::move(result_);
  }

 private:
  /// The triangles and the boundary of each piece. Its points are renumbered, those on the boundary first.
  /// `nodes` and `middle_node` are points of the triangles and middle_node() of sides.
  void split(const CutSurface& cut) {
    std::unordered_map<std::uint64_t, int> side_of;
    for (std::size_t s = 0; s < triangles_.sides.size(); ++s)
      side_of[side_key(triangles_.sides[s].points[0], triangles_.sides[s].points[1])] = static_cast<int>(s);
    std::vector<std::array<char, 3>> inner(cut.mesh.triangles.size(), {0, 0, 0});
    join_twins(cut.mesh, [&](Side a, Side b) {
      inner[triangle_of(a)][index_of(a)] = inner[triangle_of(b)][index_of(b)] = 1;
    });
    std::vector<std::vector<int>> members(cut.pieces);
    for (std::size_t t = 0; t < inner.size(); ++t) members[cut.mesh.tags[t]].push_back(static_cast<int>(t));
    const AngleSums angles = sum_angles();
    std::vector<int> local(cut.mesh.points.size(), -1);
    std::vector<FaceTriangulation>& pieces = result_.triangulations;
    pieces.resize(cut.pieces);
    result_.patches.assign(cut.pieces, 0);
    for (const FaceId p : result_.patches.ids()) {
      FaceTriangulation& piece = pieces[p.index()];
      const std::vector<int>& triangles = members[p.index()];
      const int patch = result_.patches[p] = triangles_.mesh.tags[triangles.front()];
      // Returns whether the point had no number.
      const auto number = [&](int v) {
        if (local[v] >= 0) return false;
        local[v] = static_cast<int>(piece.mesh.points.size());
        piece.mesh.points.push_back(cut.mesh.points[v]);
        return true;
      };
      std::vector<int> boundary;
      for (const int t : triangles) {
        for (int i = 0; i < 3; ++i) {
          if (inner[t][i]) continue;
          const int a = cut.mesh.triangles[t][i], b = cut.mesh.triangles[t][next_index(i)];
          for (const int v : {a, b})
            if (number(v)) boundary.push_back(v);
          const int side = side_index(side_of, cut.original[a], cut.original[b], patch);
          FaceBoundary::Segment& segment = piece.segments.emplace_back();
          segment.a = local[a];
          segment.b = local[b];
          segment.middle_node = middle_node(side);
          segment.middle_point = middle_places_[side];
        }
      }
      add_boundary_nodes(cut, boundary, patch, angles, piece);
      for (const int t : triangles) {
        auto triangle = cut.mesh.triangles[t];
        for (int& v : triangle) {
          number(v);
          v = local[v];
        }
        piece.mesh.triangles.push_back(triangle);
      }
      for (const int t : triangles)
        for (const int v : cut.mesh.triangles[t]) local[v] = -1;
    }
  }

  using AngleSums = std::map<std::pair<int, int>, double>;  // (patch, corner of the surface) -> angle

  /// \param boundary points of `cut` on the boundary of the piece
  void add_boundary_nodes(const CutSurface& cut, const std::vector<int>& boundary, int patch,
                          const AngleSums& angles, FaceTriangulation& piece) const {
    piece.boundary_count = static_cast<int>(boundary.size());
    std::map<int, int> copies;
    for (const int v : boundary) ++copies[cut.original[v]];
    for (const int v : boundary) {
      piece.nodes.push_back(cut.original[v]);
      const auto sum = angles.find({patch, triangles_.surface_corner[cut.original[v]]});
      piece.angles.push_back(sum == angles.end() ? std::numbers::pi : sum->second / copies[cut.original[v]]);
    }
  }

  AngleSums sum_angles() const {
    AngleSums sums;
    for (std::size_t t = 0; t < model_.surface.mesh.triangles.size(); ++t) {
      const auto& triangle = model_.surface.mesh.triangles[t];
      for (int i = 0; i < 3; ++i) {
        const int v = triangle[i];
        if (!model_.network.corner[v]) continue;
        const auto& p = model_.surface.mesh.points;
        sums[{model_.network.patches[t], v}] +=
            angle_between(p[triangle[next_index(i)]] - p[v], p[triangle[previous_index(i)]] - p[v]);
      }
    }
    return sums;
  }

  /// The index of the side between two points. A new side is added where a cut went on beyond the curves.
  int side_index(std::unordered_map<std::uint64_t, int>& side_of, int a, int b, int patch) {
    const auto [found, is_new] =
        side_of.try_emplace(side_key(a, b), static_cast<int>(triangles_.sides.size()));
    if (is_new) triangles_.sides.push_back({{a, b}, -1, 0, 0});
    while (middle_places_.size() < triangles_.sides.size()) {
      const auto& side = triangles_.sides[middle_places_.size()];
      const auto& points = triangles_.mesh.points;
      middle_places_.push_back(
          side.curve >= 0
              ? model_.network.curves[side.curve].at(0.5 * (side.from + side.to))
              : model_.locator.nearest(patch, 0.5 * (points[side.points[0]] + points[side.points[1]])).point);
    }
    return found->second;
  }

  int middle_node(int side) const { return static_cast<int>(triangles_.mesh.points.size()) + side; }

  /// Numbers the nodes on the boundaries: corners, then along the curves.
  void number_boundary() {
    std::vector<int> node(triangles_.mesh.points.size() + triangles_.sides.size(), -1);
    std::vector<int> joined(model_.surface.original.size(), -1);  // corners where the surface touches itself
    const auto add = [&](int point, const Vector3& place, int corner) {
      if (node[point] >= 0) return;
      int& same = corner >= 0 ? joined[model_.surface.original[corner]] : node[point];
      if (same < 0) {
        same = static_cast<int>(result_.nodes.points.size());
        result_.nodes.points.push_back(place);
        // The start of a closed curve without corners is not a corner.
        if (corner >= 0 && model_.network.corner[corner]) result_.nodes.vertex_nodes.push_back(same);
      }
      node[point] = same;
    };
    const auto& points = triangles_.mesh.points;
    for (std::size_t v = 0; v < points.size(); ++v)
      if (const int corner = triangles_.surface_corner[v]; corner >= 0)
        add(static_cast<int>(v), points[v], corner);
    result_.nodes.edges.resize(model_.network.curves.size());
    for (std::size_t s = 0; s < triangles_.sides.size(); ++s) {
      const auto& side = triangles_.sides[s];
      const int middle = middle_node(static_cast<int>(s));
      add(side.points[0], points[side.points[0]], -1);
      add(middle, middle_places_[s], -1);
      add(side.points[1], points[side.points[1]], -1);
      if (side.curve < 0) continue;
      BoundaryNodes::Edge& edge = result_.nodes.edges[EdgeId::from_index(side.curve)];
      if (edge.nodes.empty()) {
        edge.nodes.push_back(node[side.points[0]]);
        edge.parameters.push_back(side.from);
      }
      edge.nodes.insert(edge.nodes.end(), {node[middle], node[side.points[1]]});
      edge.parameters.insert(edge.parameters.end(), {0.5 * (side.from + side.to), side.to});
    }
    for (FaceTriangulation& piece : result_.triangulations) {
      for (int& point : piece.nodes) point = node[point];
      for (FaceBoundary::Segment& segment : piece.segments) segment.middle_node = node[segment.middle_node];
    }
  }

  const Model& model_;
  RemeshedTriangles triangles_;
  std::vector<Vector3> middle_places_;  // by side
  Pieces result_;
};

FaceMesh quads_of(FaceTriangulation triangulation, const PatchSurface& surface, const RemeshOptions& given,
                  ExecutionContext& context) {
  std::vector<Vector3>& points = triangulation.mesh.points;
  for (std::size_t v = 0; v < points.size(); ++v) {
    const Vector3 there =
        surface.find(points[v], triangulation.uv.emplace_back(), triangulation.normals.emplace_back());
    if (static_cast<int>(v) >= triangulation.boundary_count) points[v] = there;
  }
  for (FaceBoundary::Segment& segment : triangulation.segments) {
    Vector3 normal;
    surface.find(segment.middle_point, segment.middle_uv, normal);
  }
  triangulation.pole.assign(points.size(), 0);
  const FaceQuadsOptions options{.recombine = given.recombine, .improve = given.improve};
  FaceQuads quads = make_quads(std::move(triangulation), surface, options, context);
  QuadMesh& mesh = quads.surface_mesh.mesh;
  const std::vector<char> moved = unfold_in_space(mesh.quads, mesh.points, quads.surface_mesh.fixed,
                                                  std::numeric_limits<double>::infinity(), context);
  FaceMesh result;
  result.points = std::move(mesh.points);
  result.uv = std::move(quads.surface_mesh.parameters);
  result.quads = std::move(mesh.quads);
  result.pole = std::move(quads.pole);
  result.nodes = std::move(quads.nodes);
  if (std::ranges::count(moved, 1) == 0) return result;
  result.off.assign(moved.size(), 0);
  for (std::size_t v = 0; v < moved.size(); ++v)
    if (moved[v]) result.off[v] = (surface.nearest(result.uv[v], result.points[v]) - result.points[v]).norm();
  return result;
}

FaceMeshes quads_of_pieces(const Model& model, Pieces& pieces, const RemeshOptions& options,
                           ExecutionContext& context) {
  FaceMeshes quads(pieces.triangulations.size());
  std::atomic<int> done{0};
  for_each_id(quads, [&](FaceId piece) {
    quads[piece] =
        quads_of(std::move(pieces.triangulations[piece.index()]),
                 PatchSurface(model.reference, model.locator, pieces.patches[piece]), options, context);
    context.report(Stage::mesh, static_cast<double>(++done) / static_cast<double>(quads.size()));
  });
  return quads;
}

class ScanGeometry : public ShellGeometry {
 public:
  ScanGeometry(const Model& model, const IdVector<FaceId, int>& patches) : model_(model), patches_(patches) {}

  std::shared_ptr<const MeshSurface> surface(FaceId piece, const FaceMesh&) const override {
    return std::make_shared<const PatchSurface>(model_.reference, model_.locator, patches_[piece]);
  }
  Vector3 middle(EdgeId curve, double from, double to, const Vector3&, const Vector3&) const override {
    return model_.network.curves[curve.index()].at(0.5 * (from + to));
  }
  int number(FaceId piece) const override { return model_.face_numbers[patches_[piece]]; }
  int number(EdgeId curve) const override { return model_.edge_numbers[curve.index()]; }

 private:
  const Model& model_;
  const IdVector<FaceId, int>& patches_;  // (pieces)
};

void check_doubled(const FaceMeshes& quads, const ShellGeometry& geometry) {
  for (const FaceId piece : quads.ids()) {
    const std::vector<int> doubled = doubled_sides(quads[piece]->quads);
    if (doubled.empty()) continue;
    throw failure(fmt::format("Face{}", geometry.number(piece)),
                  fmt::format("quads of Face{} lie on one another at this size, the first at {}: try a "
                              "smaller `size`, or another feature angle",
                              geometry.number(piece), place_text(quads[piece]->points[doubled.front()])));
  }
}

void check_inverted(const ShellMesh& mesh, double least_side) {
  std::vector<std::size_t> spoiled;
  for (std::size_t q = 0; q < mesh.quads.size(); ++q)
    if (is_spoiled(mesh.points, mesh.quads[q], least_side)) spoiled.push_back(q);
  if (spoiled.empty()) return;
  const int face = mesh.quad_faces[spoiled.front()];
  throw failure(fmt::format("Face{}", face),
                fmt::format("{} quads stay inverted or without area at this size, the first on Face{} at "
                            "{}: try a smaller `size`, or another feature angle",
                            spoiled.size(), face, place_text(mesh.points[mesh.quads[spoiled.front()][0]])));
}

void tell_straight_sides(const ShellMesh& mesh, std::vector<std::string>& notes) {
  int first = static_cast<int>(mesh.points.size()), count = 0;
  for (const auto& midsides : mesh.midsides) first = std::min(first, *std::ranges::min_element(midsides));
  double largest = 0;
  for (const ShellMesh::OffGeometry& off : mesh.off_geometry) {
    if (off.node < first) continue;
    ++count;
    largest = std::max(largest, off.distance);
  }
  if (count > 0)
    notes.push_back(fmt::format("{} midside nodes lie up to {} off the surface, so that no element folds",
                                count, number_text(largest)));
}

void tell_faces(ShellMesh& mesh, const std::vector<int>& face_numbers) {
  std::map<int, ShellMesh::Face> faces;
  for (const int number : face_numbers) {
    faces[number].face = number;
    faces[number].status = FaceStatus::meshed;
    faces[number].q_min = 1;
  }
  for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
    ShellMesh::Face& face = faces[mesh.quad_faces[q]];
    ++face.quads;
    face.q_min = std::min(face.q_min, quad_q(mesh.points, mesh.quads[q]));
  }
  for (auto& [number, face] : faces) mesh.faces.push_back(face);
}

/// Groups of faces and segments keep their extent. If any are left, each face, edge and vertex gets a group
/// of its own besides.
void keep_groups(const ShellMesh& input, const Model& model, std::vector<std::string>& notes,
                 ShellMesh& mesh) {
  std::vector<std::string> lost;
  for (const ShellMesh::Group& group : input.groups) {
    ShellMesh::Group kept{group.name, group.dimension, group.number, {}};
    const auto take = [&](const std::vector<int>& inputs, const std::vector<int>& numbers) {
      for (std::size_t i = 0; i < numbers.size(); ++i)
        if (std::ranges::binary_search(group.entities, inputs[i])) kept.entities.push_back(numbers[i]);
    };
    if (group.dimension == 2) take(model.input_faces, model.face_numbers);
    if (group.dimension == 1) take(model.input_edges, model.edge_numbers);
    std::ranges::sort(kept.entities);
    if (kept.entities.empty())
      lost.push_back(group.name.empty() ? fmt::format("{}", group.number) : group.name);
    else
      mesh.groups.push_back(std::move(kept));
  }
  if (!lost.empty())
    notes.push_back(
        fmt::format("groups of nodes, and groups without elements of the surface, are left out: {}",
                    fmt::join(lost, ", ")));
  if (mesh.groups.empty()) return;
  std::set<std::string> names;
  for (const ShellMesh::Group& group : mesh.groups) names.insert(group.name);
  const auto add = [&](const char* kind, int dimension, int number) {
    const std::string name = fmt::format("{}{}", kind, number);
    if (names.insert(name).second) mesh.groups.push_back({name, dimension, 0, {number}});
  };
  for (const int number : model.face_numbers) add("Face", 2, number);
  for (const int number : model.edge_numbers) add("Edge", 1, number);
  for (const ShellMesh::Corner& corner : mesh.corners) add("Vertex", 0, corner.vertex);
}

ShellMesh remesh_oriented(const ShellMesh& input, const RemeshOptions& options, RemeshFidelity* fidelity,
                          std::vector<std::string>& notes, ExecutionContext& context) {
  const Model model = find_faces(input, options, notes, context);
  const TriangleMesh& surface = model.surface.mesh;
  std::vector<double> targets = find_targets(model, options.size);
  if (!options.force) hold_budget(surface, targets, options.order);
  Pieces pieces;
  FaceMeshes quads;
  // Where quads stay inverted the surface needs smaller ones.
  constexpr int most_attempts = 4;
  for (int attempt = 1;; ++attempt) {
    RemeshedTriangles triangles = make_triangles(model, targets, context);
    const StageTimer timer(context, Stage::mesh);
    pieces = PieceCutter(model, std::move(triangles)).run();
    quads = quads_of_pieces(model, pieces, options, context);
    const std::vector<Vector3> inverted = inverted_places(quads, model.least_side);
    if (inverted.empty() || attempt == most_attempts) break;
    refine_near(inverted, surface.points, options.size, targets, context);
  }
  const ScanGeometry geometry(model, pieces.patches);
  tell_off_surface(quads, notes);
  check_doubled(quads, geometry);
  ShellMesh mesh = assemble(geometry, pieces.nodes, quads, options.order, context);
  const StageTimer timer(context, Stage::assemble);
  check_inverted(mesh, model.least_side);
  if (rim_of(surface.points, surface.triangles).sides == 0)
    if (const int open = rim_of(mesh.points, mesh.quads).sides; open > 0)
      throw failure(
          "",
          fmt::format("the surface is closed, but {} sides of the mesh are open: use another size", open));
  tell_straight_sides(mesh, notes);
  if (fidelity != nullptr)
    *fidelity = measure_fidelity(surface, model.network.patches, model.locator, mesh, model.face_numbers);
  tell_faces(mesh, model.face_numbers);
  keep_groups(input, model, notes, mesh);
  return mesh;
}

}  // namespace

ShellMesh remesh(const ShellMesh& input, const RemeshOptions& options, RemeshFidelity* fidelity,
                 std::vector<std::string>& notes, ExecutionContext& context) {
  check(options);
  return on_threads(context.threads(),
                    [&] { return remesh_oriented(input, options, fidelity, notes, context); });
}

}  // namespace quadrille
