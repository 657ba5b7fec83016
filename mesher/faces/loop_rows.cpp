/// Sends rays out of the nodes of the path, and joins neighboring rays by rows of quads.

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
  RowPlacer(const RowPath& path, const std::vector<double>& heights, double side, const FaceSurface& surface,
            const TrimmedDomain& domain)
      : path_(path),
        first_(path.heads[0]),
        count_(static_cast<int>(path.nodes.size()) - path.heads[0] - path.heads[1]),
        side_(side),
        surface_(surface),
        domain_(domain) {
    for (const double height : heights) reach_.push_back((reach_.empty() ? 0 : reach_.back()) + height);
    hole_.points = path.nodes;
  }

  std::optional<HoleRings::Hole> run() {
    for (int k = 0; k < count_; ++k) corners_.push_back(corner_at(k));
    for (int k = 0; k < count_; ++k) {
      if (corners_[k].turn < too_sharp) return std::nullopt;
      spread_lean(k, 1);
      spread_lean(k, -1);
    }
    for (int k = 0; k < count_; ++k) add_rays(k);
    for (int k = 0; k + (path_.closed ? 0 : 1) < count_; ++k)
      join(rays_[k].second, rays_[(k + 1) % count_].first);
    if (!is_valid()) return std::nullopt;
    return std::move(hole_);
  }

 private:
  using Ray = std::vector<int>;  // points from the path outward

  /// How rays leave a node of the path.
  struct Corner {
    Vector3 along, outward;  // unit vectors: along the segment before, and normal to it
    double turn = 0;         // of the path, away from the face: positive
    int blocks = 0;
    /// The tangent of the angle by which the ray leans forward, from the normal of the segment before and of
    /// the one after.
    std::array<double, 2> lean{0, 0};
    double lean_beside = 0;  // by its neighbors'
  };

  int number(int k) const { return first_ + (k + count_) % count_; }
  const HoleRings::Node& node(int k) const { return path_.nodes[number(k)]; }
  bool is_end(int k, int step) const { return !path_.closed && k == (step < 0 ? 0 : count_ - 1); }
  /// Whether the ray of an end runs along an edge.
  bool is_held(int k) const {
    return (is_end(k, -1) && path_.heads[0] > 0) || (is_end(k, 1) && path_.heads[1] > 0);
  }

  Corner corner_at(int k) const {
    Corner corner;
    const Vector3 normal = surface_.normal(node(k).uv);
    const auto in_plane = [&](const Vector3& v) -> Vector3 {
      return (v - v.dot(normal) * normal).normalized();
    };
    const Vector3 after = is_end(k, 1) ? Vector3::Zero() : in_plane(node(k + 1).point - node(k).point);
    corner.along = is_end(k, -1) ? after : in_plane(node(k).point - node(k - 1).point);
    corner.outward = side_ * normal.cross(corner.along);
    if (is_held(k)) {
      const Vector3 ray = path_.nodes[k == 0 ? 0 : path_.nodes.size() - 1].point - node(k).point;
      corner.lean[0] = corner.lean[1] = ray.dot(corner.along) / ray.dot(corner.outward);
    } else if (!is_end(k, 1) && !is_end(k, -1)) {
      corner.turn = std::atan2(-after.dot(corner.outward), after.dot(corner.along));
      corner.blocks = corner.turn < one_block ? 0 : corner.turn < two_blocks ? 1 : 2;
      if (corner.blocks == 0) corner.lean = {std::tan(0.5 * corner.turn), -std::tan(0.5 * corner.turn)};
    }
    return corner;
  }

  /// Makes the rays beside a node lean like its own, less and less, so that they do not cross.
  void spread_lean(int k, int step) {
    constexpr double gently = 3;
    const double lean = corners_[k].lean[step > 0 ? 1 : 0], reach = gently * reach_.back() * std::abs(lean);
    double distance = 0;
    for (int i = k; i - k < count_ && k - i < count_ && !is_end((i + count_) % count_, step); i += step) {
      distance += (node(i + step).point - node(i).point).norm();
      Corner& beside = corners_[(i + step + count_) % count_];
      if (!(distance < reach) || beside.blocks > 0) return;
      beside.lean_beside += lean * (1 - distance / reach);
    }
  }

  /// Adds the rays of a node, and the blocks between them.
  void add_rays(int k) {
    const Corner& corner = corners_[k];
    if (is_held(k)) {
      Ray ray;
      for (int i = 0; i <= static_cast<int>(reach_.size()); ++i) ray.push_back(number(k) + (k == 0 ? -i : i));
      rays_.emplace_back(ray, ray);
      return end_line(ray);
    }
    if (corner.blocks == 0) return add_ray(k);
    Ray last = ray(number(k), corner.outward, 1);
    const Ray first = last;
    end_line(first);
    for (int i = 1; i <= corner.blocks; ++i) {
      Ray next = ray(number(k), turned(corner.outward, corner.along, corner.turn * i / corner.blocks), 1);
      add_block(number(k), last, next);
      end_line(next);
      last = std::move(next);
    }
    rays_.emplace_back(first, last);
  }

  /// Adds the one ray of a node. At a free end of the path it bounds the rows.
  void add_ray(int k) {
    const Corner& corner = corners_[k];
    const double half = 0.5 * corner.turn, beside = std::atan(corner.lean_beside);
    const Ray own = ray(number(k), turned(corner.outward, corner.along, half + beside),
                        1 / (std::cos(half) * std::cos(beside)));
    rays_.emplace_back(own, own);
    if (is_end(k, -1)) hole_.outer.insert(hole_.outer.end(), own.begin(), own.end() - 1);
    end_line(own);
    if (is_end(k, 1)) hole_.outer.insert(hole_.outer.end(), own.rbegin() + 1, own.rend());
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
    for (std::size_t i = path_.nodes.size(); i < p.size(); ++i)
      if (!p[i].point.allFinite() || !domain_.inside(p[i].uv)) return false;
    return std::all_of(hole_.quads.begin(), hole_.quads.end(), [&](const std::array<int, 4>& q) {
      const Vector3 normal = side_ * surface_.normal(p[q[0]].uv);
      return folded_scaled_jacobian(p[q[0]].point, p[q[1]].point, p[q[2]].point, p[q[3]].point, normal) >
             poorest_jacobian;
    });
  }

  const RowPath& path_;
  int first_, count_;  // the path's own nodes
  double side_;
  const FaceSurface& surface_;
  const TrimmedDomain& domain_;
  std::vector<double> reach_;  // of each row from the loop
  std::vector<Corner> corners_;
  std::vector<std::pair<Ray, Ray>>
      rays_;  // of each node: beside the segment before, and beside the one after
  HoleRings::Hole hole_;
};

}  // namespace

std::optional<HoleRings::Hole> place_rows(const RowPath& path, const std::vector<double>& heights,
                                          double side, const FaceSurface& surface,
                                          const TrimmedDomain& domain) {
  return RowPlacer(path, heights, side, surface, domain).run();
}

}  // namespace quadrille
