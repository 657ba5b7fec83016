/// Halves curves by chord and projects the middles of other sides to their surface, each side once.

#include "mesher/shell/midsides.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "geometry/base/side_key.hpp"
#include "geometry/cad/parallel_ids.hpp"
#include "geometry/surfaces/edge_curve.hpp"
#include "mesher/mesh/sides.hpp"

namespace quadrille {

namespace {

Vector3 surface_middle(const MeshSurface& surface, const FaceMesh& face, int a, int b, Vector2& uv) {
  const Vector3 target = 0.5 * (face.points[a] + face.points[b]);
  const std::array ends{face.pole[a] ? face.uv[b] : face.uv[a], face.pole[b] ? face.uv[a] : face.uv[b]};
  uv = surface.between(ends);
  Vector3 middle = surface.nearest(uv, target);
  // If the parametrization is uneven, the search may not get there from the middle parameter.
  constexpr double near_share = 0.25;
  if ((middle - target).norm() <= near_share * (face.points[b] - face.points[a]).norm()) return middle;
  for (Vector2 other : ends) {
    const Vector3 nearer = surface.nearest(other, target);
    if ((nearer - target).norm() >= (middle - target).norm()) continue;
    middle = nearer;
    uv = other;
  }
  return middle;
}

/// Midside nodes by the side_key() of sides between boundary nodes.
using Middles = std::unordered_map<std::uint64_t, int>;

/// The midside nodes of one face that are not on CAD edges.
struct FaceMidsides {
  std::vector<std::array<int, 4>> of_quads;  ///< for each side: index into points, or -1 - node on a CAD edge
  std::vector<Vector3> points;
  std::vector<Vector2> parameters;
  std::vector<std::pair<int, double>> off;  ///< points off the surface, and how far
  /// (points) keys of sides between boundary nodes, which other faces may have too; 0 = another side
  std::vector<std::uint64_t> chords;
};

FaceMidsides place_inside(FaceId id, const MeshedFaces& meshed, const ShellNumbering& numbering,
                          const Middles& middles, const ExecutionContext& context) {
  const FaceMesh& face = *meshed.faces[id];
  const auto surface = meshed.surface(id);
  SparseCheck check(context, 256);
  std::vector<Side> first(4 * face.quads.size());  // for each side: the first one between the same nodes
  const auto note_first = [&](int, int, std::span<const Side> sides) {
    for (const Side side : sides) first[side] = sides.front();
  };
  for_each_shared_side(face.points.size(), no_check, note_first, face.quads);
  FaceMidsides result;
  result.of_quads.reserve(face.quads.size());
  result.points.reserve(2 * face.quads.size());
  result.parameters.reserve(2 * face.quads.size());
  const int fixed = static_cast<int>(face.nodes.size());
  const auto place = [&](int a, int b, std::uint64_t chord) {
    const int index = static_cast<int>(result.points.size());
    Vector2& uv = result.parameters.emplace_back();
    Vector3 middle = surface_middle(*surface, face, a, b, uv);
    if (std::max(a, b) < fixed && !meshed.nodes.middles.empty()) {
      const auto crossing = meshed.nodes.middles.find(side_key(face.nodes[a], face.nodes[b]));
      if (crossing != meshed.nodes.middles.end()) middle = crossing->second;
    }
    const bool is_off = !face.off.empty() && std::max(face.off[a], face.off[b]) > 0;
    const Vector3 straight = 0.5 * (face.points[a] + face.points[b]);
    result.points.push_back(is_off ? straight : middle);
    result.chords.push_back(chord);
    if (is_off) result.off.emplace_back(index, (straight - middle).norm());
    return index;
  };
  for (const auto& quad : face.quads) {
    check();
    std::array<int, 4>& of_quad = result.of_quads.emplace_back();
    for (int k = 0; k < 4; ++k) {
      const int a = quad[k], b = quad[(k + 1) % 4];
      if (std::max(a, b) < fixed) {
        const std::uint64_t key = side_key(numbering.nodes[face.nodes[a]], numbering.nodes[face.nodes[b]]);
        const auto on_edge = middles.find(key);
        of_quad[k] = on_edge != middles.end() ? -1 - on_edge->second : place(a, b, key);
        continue;
      }
      const Side side = make_side(static_cast<int>(result.of_quads.size()) - 1, k);
      of_quad[k] = first[side] == side ? place(a, b, 0)
                                       : result.of_quads[element_of(first[side])][index_of(first[side])];
    }
  }
  return result;
}

/// Adds the midside nodes of a face to the mesh, but for those that another face has already.
void number(const FaceMidsides& face, ShellMesh& mesh, std::vector<Vector2>& parameters, Middles& middles,
            SparseCheck& check) {
  std::vector<int> numbers;
  numbers.reserve(face.points.size());
  for (std::size_t i = 0; i < face.points.size(); ++i) {
    check();
    const int next = static_cast<int>(mesh.points.size());
    numbers.push_back(face.chords[i] == 0 ? next : middles.emplace(face.chords[i], next).first->second);
    if (numbers.back() != next) continue;
    mesh.points.push_back(face.points[i]);
    parameters.push_back(face.parameters[i]);
  }
  for (const auto& [point, distance] : face.off) mesh.off_geometry.push_back({numbers[point], distance});
  for (const auto& of_quad : face.of_quads) {
    check();
    auto& midsides = mesh.midsides.emplace_back();
    for (int k = 0; k < 4; ++k) midsides[k] = of_quad[k] < 0 ? -1 - of_quad[k] : numbers[of_quad[k]];
  }
}

}  // namespace

Vector3 CadGeometry::middle(EdgeId edge, double from, double to, const Vector3& first,
                            const Vector3& last) const {
  const EdgeCurve curve(shape_.edges[edge]);
  constexpr int bisections = 30;
  for (int i = 0; i < bisections; ++i) {
    const double t = 0.5 * (from + to);
    Vector3 p = curve.point(t);
    const double difference = (p - first).norm() - (p - last).norm();
    if (std::abs(difference) < 1e-9 * (last - first).norm()) return p;
    (difference < 0 ? from : to) = t;
  }
  return curve.point(0.5 * (from + to));
}

Midsides add_midsides(const MeshedFaces& meshed, const ShellNumbering& numbering, ShellMesh& mesh,
                      const ExecutionContext& context) {
  SparseCheck check(context);
  Middles middles;
  mesh.order = 2;
  for (std::size_t s = 0; s < mesh.segments.size(); ++s) {
    check();
    auto& segment = mesh.segments[s];
    const auto [edge, k] = numbering.segments[s];
    const auto& t = meshed.nodes.edges[edge].parameters;
    segment.middle = static_cast<int>(mesh.points.size());
    const auto& nodes = meshed.nodes.edges[edge].nodes;
    const auto& points = meshed.nodes.points;
    mesh.points.push_back(
        meshed.geometry.middle(edge, t[k], t[k + 1], points[nodes[k]], points[nodes[k + 1]]));
    middles.emplace(side_key(segment.nodes[0], segment.nodes[1]), segment.middle);
  }
  Midsides result;
  result.first_inner = mesh.points.size();
  IdVector<FaceId, FaceMidsides> of_faces(meshed.faces.size());
  for_each_id(of_faces, [&](FaceId face) {
    if (meshed.faces[face]) of_faces[face] = place_inside(face, meshed, numbering, middles, context);
  });
  for (FaceMidsides& face : of_faces) {
    number(face, mesh, result.parameters, middles, check);
    face = {};
  }
  return result;
}

}  // namespace quadrille
