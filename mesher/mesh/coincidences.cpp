/// Finds the nodes at one place by a tolerance, then sorts segments and quads by those places.

#include "mesher/mesh/coincidences.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <numeric>
#include <set>
#include <unordered_map>
#include <unordered_set>

#include "geometry/base/side_key.hpp"
#include "geometry/surfaces/contacts.hpp"
#include "mesher/mesh/sides.hpp"
#include "mesher/mesh/surface_cut.hpp"

namespace quadrille {

namespace {

double tolerance_of(const ShellMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vector3& p : mesh.points) box.extend(p);
  double tolerance = 1e-7 * box.diagonal().norm();
  std::vector<double> lengths;
  for (const ShellMesh::Segment& segment : mesh.segments)
    lengths.push_back((mesh.points[segment.nodes[1]] - mesh.points[segment.nodes[0]]).norm());
  if (lengths.empty()) return tolerance;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return std::max(tolerance, 1e-4 * *middle);
}

/// Whether any two nodes on CAD edges coincide.
bool edges_touch(const ShellMesh& mesh, double tolerance) {
  std::vector<int> nodes;
  for (const ShellMesh::Segment& segment : mesh.segments)
    nodes.insert(nodes.end(), segment.nodes.begin(), segment.nodes.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  std::vector<Vector3> points;
  points.reserve(nodes.size());
  for (const int node : nodes) points.push_back(mesh.points[node]);
  const std::vector<int> first = coincident_points(points, tolerance);
  for (std::size_t i = 0; i < first.size(); ++i)
    if (first[i] != static_cast<int>(i)) return true;
  return false;
}

/// Counts what coincides, given the first node at the place of each.
class Count {
 public:
  Count(const ShellMesh& mesh, std::vector<int> first) : mesh_(mesh), first_(std::move(first)) {}

  Coincidences run() {
    forgive_collapsed_sides();
    met_.assign(first_.size(), 0);
    for (int node = 0; node < static_cast<int>(first_.size()); ++node) {
      if (first_[node] == node) continue;
      met_[node] = met_[first_[node]] = 1;
      ++result_.nodes;
    }
    count_quads();
    if (result_.nodes == 0) return std::move(result_);
    find_faces();
    count_segments();
    return std::move(result_);
  }

 private:
  /// Two nodes of one quad at one place are a defect of that quad, which its quality shows.
  void forgive_collapsed_sides() {
    for (const auto& quad : mesh_.quads)
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < i; ++j)
          if (first_[quad[i]] == first_[quad[j]])
            first_[std::max(quad[i], quad[j])] = std::max(quad[i], quad[j]);
  }

  /// Finds quads on quads also where they share their nodes.
  void count_quads() {
    std::vector<std::array<int, 4>> places = mesh_.quads;
    for (std::array<int, 4>& place : places) {
      place = with_numbers(place, first_);
      std::sort(place.begin(), place.end());
    }
    std::sort(places.begin(), places.end());
    for (std::size_t i = 1; i < places.size(); ++i) result_.quads += places[i] == places[i - 1];
  }

  void find_faces() {
    std::set<int> faces;
    for (std::size_t i = 0; i < mesh_.quad_faces.size(); ++i) {
      const std::array<int, 4>& quad = mesh_.quads[i];
      if (std::any_of(quad.begin(), quad.end(), [&](int node) { return met_[node] != 0; }))
        faces.insert(mesh_.quad_faces[i]);
    }
    result_.faces.assign(faces.begin(), faces.end());
  }

  void count_segments() {
    std::unordered_map<std::uint64_t, int> uses;
    for (const auto& quad : mesh_.quads)
      for (int k = 0; k < 4; ++k) {
        const int a = quad[k], b = quad[(k + 1) & 3];
        if (met_[a] && met_[b]) ++uses[side_key(a, b)];
      }
    std::map<std::uint64_t, std::vector<const ShellMesh::Segment*>> by_place;
    std::unordered_set<int> along;  // nodes of free sides on free sides
    for (const ShellMesh::Segment& segment : mesh_.segments) {
      const auto [a, b] = segment.nodes;
      if (met_[a] && met_[b]) by_place[side_key(first_[a], first_[b])].push_back(&segment);
    }
    std::set<int> free;
    for (const auto& [place, segments] : by_place) {
      if (segments.size() < 2) continue;
      const auto open = [&](const ShellMesh::Segment* segment) {
        return uses[side_key(segment->nodes[0], segment->nodes[1])] == 1;
      };
      const bool all_open = std::all_of(segments.begin(), segments.end(), open);
      for (const ShellMesh::Segment* segment : segments) {
        if (open(segment)) free.insert(segment->edge);
        if (all_open) along.insert({segment->nodes[0], segment->nodes[1], segment->middle});
      }
    }
    result_.free_edges.assign(free.begin(), free.end());
    result_.sewing_suffices = result_.quads == 0;
    for (int node = 0; node < static_cast<int>(met_.size()); ++node)
      if (met_[node] && along.count(node) == 0) result_.sewing_suffices = false;
  }

  const ShellMesh& mesh_;
  std::vector<int> first_;
  std::vector<char> met_;
  Coincidences result_;
};

/// "Face3, Face7, ...": at most eight names.
std::string names(const char* kind, const std::vector<int>& numbers) {
  constexpr std::size_t names_shown = 8;
  std::vector<std::string> shown;
  for (std::size_t i = 0; i < std::min(names_shown, numbers.size()); ++i)
    shown.push_back(fmt::format("{}{}", kind, numbers[i]));
  return fmt::format("{}{}", fmt::join(shown, ", "), numbers.size() > names_shown ? ", ..." : "");
}

}  // namespace

std::string_view Coincidences::remedy() const {
  if (nodes == 0) return quads > 0 ? "keep_features" : "";
  return sewing_suffices ? "sew" : "imprint";
}

std::string Coincidences::sentence(const std::set<std::string_view>& tried) const {
  std::vector<std::string> found;
  if (nodes > 0) found.push_back(fmt::format("{} nodes lie on others without being joined to them", nodes));
  if (nodes > 0 && !faces.empty()) found.back() += fmt::format(", on {}", names("Face", faces));
  if (!free_edges.empty())
    found.push_back(
        fmt::format("{} free edges lie on other edges ({})", free_edges.size(), names("Edge", free_edges)));
  if (quads > 0) found.push_back(fmt::format("{} quads lie on other quads", quads));
  if (found.empty()) return "";
  return fmt::format("{}: {}", fmt::join(found, "; "), advice(remedy(), tried));
}

Coincidences coincidences(const ShellMesh& mesh) {
  if (mesh.points.empty()) return {};
  const double tolerance = tolerance_of(mesh);
  // Meshes from files of other programs may have no segments.
  const bool touches = mesh.segments.empty() || edges_touch(mesh, tolerance);
  std::vector<int> first(mesh.points.size());
  std::iota(first.begin(), first.end(), 0);
  return Count(mesh, touches ? coincident_points(mesh.points, tolerance) : std::move(first)).run();
}

}  // namespace quadrille
