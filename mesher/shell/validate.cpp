/// Checks of every invariant of a mesh.

#include "mesher/shell/validate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>

#include "geometry/base/place_text.hpp"
#include "geometry/base/side_key.hpp"
#include "mesher/mesh/joined_faces.hpp"
#include "mesher/mesh/quad_geometry.hpp"
#include "mesher/mesh/second_order.hpp"
#include "mesher/mesh/sides.hpp"
#include "mesher/mesh/surface_cut.hpp"

namespace quadrille {
namespace {

constexpr std::size_t max_sentences = 20;
constexpr double coincident = 1e-9;  ///< share of the diagonal

/// Collects sentences up to the limit. Further ones are dropped without being formatted.
class Findings {
 public:
  template <typename... Arguments>
  void add(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    if (sentences_.size() < max_sentences)
      sentences_.push_back(fmt::format(format, std::forward<Arguments>(arguments)...));
  }
  bool empty() const { return sentences_.empty(); }
  std::vector<std::string> take() { return std::move(sentences_); }

 private:
  std::vector<std::string> sentences_;
};

/// Quads and triangles under common numbers. Triangles come after the quads.
struct Elements {
  std::span<const Vector3> points;
  std::span<const std::array<int, 4>> quads;
  std::span<const std::array<int, 3>> triangles;

  int count() const { return static_cast<int>(quads.size() + triangles.size()); }
  std::span<const int> nodes(int element) const {
    const auto i = static_cast<std::size_t>(element);
    if (i < quads.size()) return quads[i];
    return triangles[i - quads.size()];
  }
  int start(Side side) const { return nodes(element_of(side))[index_of(side)]; }
  /// Calls `visit` as for_each_shared_side() does.
  template <typename Visit>
  void for_each_side(Visit&& visit) const {
    for_each_shared_side(points.size(), no_check, visit, quads, triangles);
  }
  std::string name(int element) const {
    const auto i = static_cast<std::size_t>(element);
    return i < quads.size() ? fmt::format("quad {}", i) : fmt::format("triangle {}", i - quads.size());
  }
};

bool check_indices(const Elements& elements, Findings& findings) {
  const int n = static_cast<int>(elements.points.size());
  bool in_range = true;
  for (int e = 0; e < elements.count(); ++e) {
    const auto nodes = elements.nodes(e);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (nodes[i] < 0 || nodes[i] >= n) {
        findings.add("{} refers to point {}, but there are {} points", elements.name(e), nodes[i], n);
        in_range = false;
      }
      for (std::size_t j = 0; j < i; ++j)
        if (nodes[i] == nodes[j]) findings.add("{} has point {} twice", elements.name(e), nodes[i]);
    }
  }
  for (int i = 0; i < n; ++i)
    if (!elements.points[i].allFinite()) findings.add("point {} has a coordinate that is not a number", i);
  return in_range;
}

void check_used(const std::vector<char>& used, Findings& findings) {
  for (std::size_t i = 0; i < used.size(); ++i)
    if (!used[i]) findings.add("point {} belongs to no element", i);
}

std::vector<char> used_points(const Elements& elements) {
  std::vector<char> used(elements.points.size(), 0);
  for (int e = 0; e < elements.count(); ++e)
    for (const int node : elements.nodes(e)) used[node] = 1;
  return used;
}

void check_manifold(const Elements& elements, Findings& findings) {
  elements.for_each_side([&](int low, int high, std::span<const Side> sides) {
    if (sides.size() > 2)
      findings.add("the side between points {} and {} has {} elements", low, high, sides.size());
    else if (sides.size() == 2 && elements.start(sides[0]) == elements.start(sides[1]))
      findings.add("{} and {} run the side between points {} and {} in the same direction",
                   elements.name(element_of(sides[0])), elements.name(element_of(sides[1])), low, high);
  });
}

void check_areas(const Elements& elements, Findings& findings) {
  for (std::size_t i = 0; i < elements.triangles.size(); ++i) {
    const auto& t = elements.triangles[i];
    const Vector3 &a = elements.points[t[0]], &b = elements.points[t[1]], &c = elements.points[t[2]];
    const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    if (!((b - a).cross(c - a).norm() > 1e-14 * longest)) findings.add("triangle {} has no area", i);
  }
}

void check_convex(const Elements& elements, Findings& findings) {
  for (std::size_t i = 0; i < elements.quads.size(); ++i) {
    const double sj = quad_scaled_jacobian(elements.points, elements.quads[i]);
    if (!(sj > 0)) findings.add("quad {} is not convex: its scaled Jacobian is {}", i, number_text(sj));
  }
}

void check_tags(std::size_t tags, std::size_t count, const char* what, Findings& findings) {
  if (tags != 0 && tags != count) findings.add("there are {} tags for {} {}", tags, count, what);
}

/// The checks that triangles and quads share; false if indices are out of range and nothing more can be said.
bool check_elements(const Elements& elements, Findings& findings) {
  if (!check_indices(elements, findings)) return false;
  check_used(used_points(elements), findings);
  check_manifold(elements, findings);
  check_areas(elements, findings);
  return true;
}

void check_coincident(const std::vector<Vector3>& points, Findings& findings) {
  Eigen::AlignedBox3d box;
  for (const Vector3& p : points) box.extend(p);
  const std::vector<int> first = coincident_points(points, coincident * box.diagonal().norm());
  for (int i = 0; i < static_cast<int>(first.size()); ++i)
    if (first[i] != i) findings.add("points {} and {} coincide", first[i], i);
}

using SegmentIndex = std::unordered_map<std::uint64_t, int>;

/// Maps sides to segments. Reports sides that are listed more than once.
SegmentIndex index_segments(const ShellMesh& mesh, Findings& findings) {
  SegmentIndex index;
  index.reserve(mesh.segments.size());
  const int n = static_cast<int>(mesh.points.size());
  for (std::size_t i = 0; i < mesh.segments.size(); ++i) {
    const auto& segment = mesh.segments[i];
    const auto [a, b] = segment.nodes;
    if (a < 0 || b < 0 || a >= n || b >= n || a == b) {
      findings.add("segment {} has the nodes {} and {}", i, a, b);
      continue;
    }
    if (segment.edge < 1) findings.add("segment {} has no CAD edge", i);
    const auto [entry, fresh] = index.try_emplace(side_key(a, b), static_cast<int>(i));
    if (!fresh) findings.add("segments {} and {} have the same nodes {} and {}", entry->second, i, a, b);
  }
  return index;
}

void check_shell_sides(const ShellMesh& mesh, const Elements& elements, bool closed, Findings& findings) {
  const SegmentIndex segments = index_segments(mesh, findings);
  const JoinedFaces joined(mesh);
  const auto face = [&](Side side) { return joined.first(mesh.quad_faces[element_of(side)]); };
  std::vector<char> met(mesh.segments.size(), 0);
  elements.for_each_side([&](int low, int high, std::span<const Side> sides) {
    const auto segment = segments.find(side_key(low, high));
    if (segment != segments.end()) met[segment->second] = 1;
    if (closed && sides.size() < 2)
      findings.add("the side between nodes {} and {} of quad {} is open", low, high, element_of(sides[0]));
    // Meshes from files of other programs may have no segments. Then it is unknown which sides lie on edges.
    if (segment == segments.end() && !mesh.segments.empty()) {
      if (sides.size() != 2)
        findings.add("the side between nodes {} and {} lies on no CAD edge and has {} elements", low, high,
                     sides.size());
      else if (face(sides[0]) != face(sides[1]))
        findings.add("the side between nodes {} and {} lies on no CAD edge, but parts faces {} and {}", low,
                     high, face(sides[0]), face(sides[1]));
    }
    if (sides.size() == 2 && face(sides[0]) == face(sides[1]) &&
        elements.start(sides[0]) == elements.start(sides[1]))
      findings.add("quads {} and {} of face {} run the side between nodes {} and {} in the same direction",
                   element_of(sides[0]), element_of(sides[1]), face(sides[0]), low, high);
  });
  for (std::size_t i = 0; i < met.size(); ++i)
    if (!met[i]) findings.add("segment {} is not a side of any quad", i);
}

void check_corners(const ShellMesh& mesh, Findings& findings) {
  std::unordered_map<int, int> nodes, vertices;
  for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
    const auto& corner = mesh.corners[i];
    if (corner.node < 0 || corner.node >= static_cast<int>(mesh.points.size()) || corner.vertex < 1) {
      findings.add("corner {} has node {} and vertex {}", i, corner.node, corner.vertex);
      continue;
    }
    if (!nodes.try_emplace(corner.node, i).second)
      findings.add("node {} is listed as a corner twice", corner.node);
    if (!vertices.try_emplace(corner.vertex, i).second)
      findings.add("vertex {} is listed twice", corner.vertex);
  }
}

/// Checks midside nodes: one per side, the same in all its elements, and used by no other side.
void check_midsides(const ShellMesh& mesh, Findings& findings) {
  if (mesh.order == 1) {
    if (!mesh.midsides.empty()) findings.add("a mesh of order 1 has {} midside rows", mesh.midsides.size());
    return;
  }
  if (mesh.midsides.size() != mesh.quads.size()) {
    findings.add("there are {} midside rows for {} quads", mesh.midsides.size(), mesh.quads.size());
    return;
  }
  const int n = static_cast<int>(mesh.points.size());
  std::unordered_map<std::uint64_t, int> middle_of;
  std::vector<std::uint64_t> side_of(mesh.points.size(), 0);
  const std::vector<char> corner = used_points({mesh.points, mesh.quads, {}});
  for (std::size_t i = 0; i < mesh.quads.size(); ++i)
    for (int k = 0; k < 4; ++k) {
      const int middle = mesh.midsides[i][k];
      if (middle < 0 || middle >= n || corner[middle]) {
        findings.add("quad {} has {} as a midside node", i, middle);
        continue;
      }
      const std::uint64_t key = side_key(mesh.quads[i][k], mesh.quads[i][(k + 1) & 3]);
      const auto [entry, fresh] = middle_of.try_emplace(key, middle);
      if (entry->second != middle)
        findings.add("side {} of quad {} has midside node {}, but {} from another quad", k, i, middle,
                     entry->second);
      if (fresh && side_of[middle] != 0) findings.add("midside node {} serves two sides", middle);
      side_of[middle] = key;
    }
  for (std::size_t i = 0; i < mesh.segments.size(); ++i) {
    const auto& segment = mesh.segments[i];
    const auto entry = middle_of.find(side_key(segment.nodes[0], segment.nodes[1]));
    if (entry != middle_of.end() && entry->second != segment.middle)
      findings.add("segment {} has midside node {}, but its quads {}", i, segment.middle, entry->second);
  }
}

/// Checks that second-order elements are valid everywhere, not only at their corners.
void check_curved(const ShellMesh& mesh, Findings& findings) {
  if (mesh.order != 2 || mesh.midsides.size() != mesh.quads.size()) return;
  for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
    const CurvedQuad element = curved_quad(mesh, i);
    if (!folds(element)) continue;
    const double bound = jacobian_bound(element);
    findings.add("quad {} folds between its nodes: its Jacobian falls to {}", i, number_text(bound));
  }
}

}  // namespace

std::vector<std::string> validate(const TriangleMesh& mesh) {
  Findings findings;
  check_tags(mesh.tags.size(), mesh.triangles.size(), "triangles", findings);
  check_elements({mesh.points, {}, mesh.triangles}, findings);
  return findings.take();
}

std::vector<std::string> validate(const QuadMesh& mesh, bool require_convex) {
  Findings findings;
  const Elements elements{mesh.points, mesh.quads, mesh.triangles};
  check_tags(mesh.quad_tags.size(), mesh.quads.size(), "quads", findings);
  check_tags(mesh.triangle_tags.size(), mesh.triangles.size(), "triangles", findings);
  if (check_elements(elements, findings) && require_convex) check_convex(elements, findings);
  return findings.take();
}

std::vector<std::string> validate(const ShellMesh& mesh, bool closed) {
  Findings findings;
  const Elements elements{mesh.points, mesh.quads, mesh.triangles};
  if (mesh.order != 1 && mesh.order != 2) findings.add("the order is {}", mesh.order);
  if (!mesh.triangles.empty()) findings.add("{} triangles remain", mesh.triangles.size());
  if (mesh.quad_faces.size() != mesh.quads.size())
    findings.add("there are {} face numbers for {} quads", mesh.quad_faces.size(), mesh.quads.size());
  // The checks below need valid indices, and one face number for each element, which triangles lack.
  if (!check_indices(elements, findings) || !findings.empty()) return findings.take();
  std::vector<char> used = used_points(elements);
  const int n = static_cast<int>(mesh.points.size());
  for (const auto& row : mesh.midsides)
    for (const int node : row)
      if (node >= 0 && node < n) used[node] = 1;
  check_used(used, findings);
  check_coincident(mesh.points, findings);
  check_convex(elements, findings);
  check_shell_sides(mesh, elements, closed, findings);
  check_corners(mesh, findings);
  check_midsides(mesh, findings);
  if (findings.empty()) check_curved(mesh, findings);
  return findings.take();
}

}  // namespace quadrille
