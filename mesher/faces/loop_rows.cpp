/// Sends rays out of the nodes of the loop, and joins neighboring rays by rows of quads.

#include "mesher/faces/loop_rows.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesher/mesh/quad_geometry.hpp"

namespace quadrille {

namespace {

/// Turns (radians) beyond which a corner gets one block, or two, and to the other side beyond which it is too
/// sharp.
constexpr double one_block = 0.4 * M_PI, two_blocks = 0.75 * M_PI, too_sharp = -0.75 * M_PI;
constexpr double poorest_jacobian = 0.15;

class RowPlacer {
 public:
  RowPlacer(const std::vector<HoleRings::Node>& loop, const std::vector<double>& heights, double side,
            const FaceSurface& surface, const TrimmedDomain& domain)
      : loop_(loop), side_(side), surface_(surface), domain_(domain) {
    for (const double height : heights) reach_.push_back((reach_.empty() ? 0 : reach_.back()) + height);
    hole_.points = loop;
  }

  std::optional<HoleRings::Hole> run() {
    for (std::size_t k = 0; k < loop_.size(); ++k) {
      if (!add_rays(k)) return std::nullopt;
    }
    for (std::size_t k = 0; k < loop_.size(); ++k) {
      const std::size_t next = (k + 1) % loop_.size();
      join(rays_[k].second, rays_[next].first);
    }
    if (!is_valid()) return std::nullopt;
    return std::move(hole_);
  }

 private:
  using Ray = std::vector<int>;  // points from the loop outward

  /// Adds the rays of a node, and the blocks between them. \return false if the loop turns too sharply.
  bool add_rays(std::size_t k) {
    const std::size_t n = loop_.size();
    const HoleRings::Node& here = loop_[k];
    const Vector3 normal = surface_.normal(here.uv);
    const auto in_plane = [&](const Vector3& v) -> Vector3 {
      return (v - v.dot(normal) * normal).normalized();
    };
    const Vector3 before = in_plane(here.point - loop_[(k + n - 1) % n].point),
                  after = in_plane(loop_[(k + 1) % n].point - here.point);
    const Vector3 from = side_ * normal.cross(before);
    const double turn = std::atan2(-after.dot(from), after.dot(before));  // away from the face: positive
    if (turn < too_sharp) return false;
    const int blocks = turn < one_block ? 0 : turn < two_blocks ? 1 : 2;
    if (blocks == 0) {
      const double half = 0.5 * turn;
      rays_.emplace_back();
      rays_.back().first = rays_.back().second =
          ray(static_cast<int>(k), turned(from, before, half), 1 / std::cos(half));
      end_line(rays_.back().first);
      return true;
    }
    Ray last = ray(static_cast<int>(k), from, 1);
    const Ray first = last;
    end_line(first);
    for (int i = 1; i <= blocks; ++i) {
      Ray next = ray(static_cast<int>(k), turned(from, before, turn * i / blocks), 1);
      add_block(static_cast<int>(k), last, next);
      end_line(next);
      last = std::move(next);
    }
    rays_.emplace_back(first, last);
    return true;
  }

  /// A direction turned from `from` towards `along` by an angle.
  static Vector3 turned(const Vector3& from, const Vector3& along, double angle) {
    return std::cos(angle) * from + std::sin(angle) * along;
  }

  /// Adds a point that lies beside another one. \return its index
  int add(int beside, const Vector3& target) {
    HoleRings::Node node{hole_.points[beside].uv, {}};
    node.point = surface_.move(node.uv, target).point;
    hole_.points.push_back(node);
    return static_cast<int>(hole_.points.size()) - 1;
  }

  Ray ray(int start, const Vector3& direction, double stretch) {
    Ray result{start};
    double before = 0;
    for (const double reach : reach_) {
      const Vector3 at = hole_.points[result.back()].point;
      result.push_back(add(result.back(), at + stretch * (reach - before) * direction));
      before = reach;
    }
    return result;
  }

  void end_line(const Ray& ray) { hole_.outer.push_back(ray.back()); }

  /// Fills the corner between two rays of a node, and adds the block's two far sides to the outer line.
  void add_block(int corner, const Ray& first, const Ray& second) {
    const int rows = static_cast<int>(reach_.size());
    const Vector3 origin = hole_.points[corner].point;
    std::vector<Ray> grid{second};  // grid[i][j]: i along the first ray, j along the second
    for (int i = 1; i <= rows; ++i) {
      Ray line{first[i]};
      const Vector3 along = hole_.points[first[i]].point - origin;
      for (int j = 1; j <= rows; ++j) line.push_back(add(line.back(), hole_.points[second[j]].point + along));
      grid.push_back(std::move(line));
    }
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < rows; ++j)
        hole_.quads.push_back({grid[i][j], grid[i][j + 1], grid[i + 1][j + 1], grid[i + 1][j]});
    for (int j = 1; j <= rows; ++j) hole_.outer.push_back(grid[rows][j]);
    for (int i = rows - 1; i > 0; --i) hole_.outer.push_back(grid[i][rows]);
  }

  void join(const Ray& ray, const Ray& next) {
    for (std::size_t i = 0; i + 1 < ray.size(); ++i)
      hole_.quads.push_back({ray[i], next[i], next[i + 1], ray[i + 1]});
  }

  bool is_valid() const {
    const auto& p = hole_.points;
    for (std::size_t i = loop_.size(); i < p.size(); ++i)
      if (!p[i].point.allFinite() || !domain_.inside(p[i].uv)) return false;
    return std::all_of(hole_.quads.begin(), hole_.quads.end(), [&](const std::array<int, 4>& q) {
      const Vector3 normal = side_ * surface_.normal(p[q[0]].uv);
      return folded_scaled_jacobian(p[q[0]].point, p[q[1]].point, p[q[2]].point, p[q[3]].point, normal) >
             poorest_jacobian;
    });
  }

  const std::vector<HoleRings::Node>& loop_;
  double side_;
  const FaceSurface& surface_;
  const TrimmedDomain& domain_;
  std::vector<double> reach_;  // of each row from the loop
  std::vector<std::pair<Ray, Ray>>
      rays_;  // of each node: beside the segment before, and beside the one after
  HoleRings::Hole hole_;
};

}  // namespace

std::optional<HoleRings::Hole> place_rows(const std::vector<HoleRings::Node>& loop,
                                          const std::vector<double>& heights, double side,
                                          const FaceSurface& surface, const TrimmedDomain& domain) {
  return RowPlacer(loop, heights, side, surface, domain).run();
}

}  // namespace quadrille
