/// Divides each side's length by the size at its middle.

#include "mesher/shell/size_fidelity.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <unordered_map>
#include <vector>

#include "geometry/base/side_key.hpp"
#include "geometry/surfaces/face_surface.hpp"

namespace quadrille {

namespace {

SizeFidelity summary(std::vector<double> ratios) {
  SizeFidelity result;
  result.sides = static_cast<int>(ratios.size());
  if (ratios.empty()) return result;
  int below = 0, above = 0;
  for (const double ratio : ratios) {
    below += ratio < SizeFidelity::low;
    above += ratio > SizeFidelity::high;
  }
  result.below_percent = 100.0 * below / result.sides;
  result.above_percent = 100.0 * above / result.sides;
  result.within_percent = 100 - result.below_percent - result.above_percent;
  const auto middle = ratios.begin() + result.sides / 2;
  std::nth_element(ratios.begin(), middle, ratios.end());
  result.median = *middle;
  return result;
}

/// What the sizes request for the sides of the quads of one face.
class WantedSides {
 public:
  WantedSides(const SizingField& field, const CadFace& face, FaceId id)
      : size_at_(field, id),
        surface_(face),
        uv_(0.5 * Vector2(face.u_min + face.u_max, face.v_min + face.v_max)) {}

  /// \param corners of a quad. \return for each side. Where sizes have directions, rows run across the bend:
  /// the shorter sides follow its curvature.
  std::array<double, 4> operator()(const std::array<Vector3, 4>& corners) {
    std::array<double, 4> sizes;
    for (int k = 0; k < 4; ++k) sizes[k] = size_at_(0.5 * (corners[k] + corners[(k + 1) % 4]));
    if (!size_at_.is_directed() || surface_.planar()) return sizes;
    const Vector3 middle = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
    surface_.project(uv_, middle);
    const double across = size_at_.across(size_at_(middle), surface_, uv_);
    const auto length = [&](int k) {
      return (corners[k + 1] - corners[k]).norm() + (corners[(k + 3) % 4] - corners[k + 2]).norm();
    };
    const int first = length(0) < length(1) ? 0 : 1;
    for (const int k : {first, first + 2}) sizes[k] = std::min(sizes[k], across);
    return sizes;
  }

 private:
  SizingField::Sampler size_at_;
  FaceSurface surface_;
  Vector2 uv_;
};

}  // namespace

nlohmann::ordered_json SizeFidelity::json() const {
  return {{"sides", sides},
          {"median", median},
          {"within_percent", within_percent},
          {"below_percent", below_percent},
          {"above_percent", above_percent},
          {"low", low},
          {"high", high}};
}

SizeFidelity size_fidelity(const ShellMesh& mesh, const SizingField& field, const CadShape& shape) {
  // The two quads of a face on a side run along it in opposite directions: the one with a < b counts it. On
  // segments, where faces meet, the first quad counts it.
  std::vector<char> on_rim(mesh.points.size(), 0);
  std::unordered_map<std::uint64_t, std::size_t> first;  // segment -> first quad
  for (const ShellMesh::Segment& segment : mesh.segments) {
    for (const int node : segment.nodes) on_rim[node] = 1;
    first.emplace(side_key(segment.nodes[0], segment.nodes[1]), mesh.quads.size());
  }
  const auto rim_side = [&](int a, int b) {
    return on_rim[a] && on_rim[b] ? first.find(side_key(a, b)) : first.end();
  };
  for (std::size_t quad = mesh.quads.size(); quad-- > 0;)
    for (int k = 0; k < 4; ++k)
      if (const auto side = rim_side(mesh.quads[quad][k], mesh.quads[quad][(k + 1) % 4]); side != first.end())
        side->second = quad;
  std::vector<std::array<double, 4>> by_quad(mesh.quads.size());
  const oneapi::tbb::blocked_range<std::size_t> all(0, mesh.quads.size());
  oneapi::tbb::parallel_for(all, [&](const auto& range) {
    std::optional<WantedSides> wanted;
    for (std::size_t quad = range.begin(); quad < range.end(); ++quad) {
      const int face = mesh.quad_faces[quad];
      if (quad == range.begin() || face != mesh.quad_faces[quad - 1])
        wanted.emplace(field, shape.faces[FaceId::from_number(face)], FaceId::from_number(face));
      std::array<Vector3, 4> corners;
      for (int k = 0; k < 4; ++k) corners[k] = mesh.points[mesh.quads[quad][k]];
      const std::array<double, 4> sizes = (*wanted)(corners);
      for (int k = 0; k < 4; ++k) {
        const int a = mesh.quads[quad][k], b = mesh.quads[quad][(k + 1) % 4];
        const auto rim = rim_side(a, b);
        const bool counts = rim == first.end() ? a < b : rim->second == quad;
        by_quad[quad][k] = counts ? (corners[(k + 1) % 4] - corners[k]).norm() / sizes[k] : -1;
      }
    }
  });
  std::vector<double> ratios;
  ratios.reserve(2 * by_quad.size());
  for (const auto& quad : by_quad)
    std::copy_if(quad.begin(), quad.end(), std::back_inserter(ratios),
                 [](double ratio) { return ratio >= 0; });
  return summary(std::move(ratios));
}

std::vector<int> finer_quads(const ShellMesh& mesh, const SizingField& field) {
  std::vector<int> result;
  std::optional<SizingField::Sampler> size_at;
  int face = 0;
  for (std::size_t quad = 0; quad < mesh.quads.size(); ++quad) {
    double shortest = std::numeric_limits<double>::infinity();
    Vector3 middle;
    for (int k = 0; k < 4; ++k) {
      const Vector3 &p = mesh.points[mesh.quads[quad][k]], &q = mesh.points[mesh.quads[quad][(k + 1) % 4]];
      if (!((q - p).norm() < shortest)) continue;
      shortest = (q - p).norm();
      middle = 0.5 * (p + q);
    }
    if (!(shortest < 0.5 * mesh.size_min)) continue;
    if (!size_at || face != mesh.quad_faces[quad])
      size_at.emplace(field, FaceId::from_number(face = mesh.quad_faces[quad]));
    if ((*size_at)(middle) < mesh.size_min) result.push_back(static_cast<int>(quad));
  }
  return result;
}

}  // namespace quadrille
