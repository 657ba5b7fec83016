#include "mesher/faces/hole_rings.hpp"

#include <algorithm>
#include <cmath>

namespace quadrille {

namespace {

class RingPlacer {
 public:
  RingPlacer(const FaceBoundary& boundary, const FaceSurface& surface, const TrimmedDomain& domain)
      : surface_(surface), domain_(domain), result_{boundary, false, {}} {
    result_.between.resize(boundary.uv.size());
  }

  HoleRings run(int rings) {
    const std::vector<std::vector<int>> loops = find_loops();
    for (int ring = 0; ring < rings; ++ring) {
      for (const auto& loop : loops) {
        if (is_smooth(loop) && (ring == 0 || has_ring(loop))) add_ring(loop);
      }
    }
    return std::move(result_);
  }

 private:
  /// The holes: loops that run clockwise in the parameter plane.
  std::vector<std::vector<int>> find_loops() const {
    const FaceBoundary& boundary = result_.inside;
    std::vector<std::vector<int>> loops;
    std::vector<int> uses(boundary.uv.size(), 0);
    std::vector<int> loop;
    int end = -1;
    bool usual = true;
    const auto close = [&] {
      if (usual && !loop.empty() && loop.front() == end && area(loop) < 0) loops.push_back(loop);
      loop.clear();
      usual = true;
    };
    for (const auto& segment : boundary.segments) {
      if (segment.a != end) close();
      usual = usual && !segment.degenerate && !segment.internal;
      loop.push_back(segment.a);
      end = segment.b;
      if (!loop.empty() && loop.front() == end) {
        close();
        end = -1;
      }
      ++uses[segment.a];
    }
    std::erase_if(loops, [&](const auto& points) {
      return std::any_of(points.begin(), points.end(), [&](int i) { return uses[i] != 1; });
    });
    return loops;
  }

  double area(const std::vector<int>& loop) const {
    double sum = 0;
    const auto& uv = result_.inside.uv;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vector2 &p = uv[loop[i]], &q = uv[loop[(i + 1) % loop.size()]];
      sum += p.x() * q.y() - p.y() * q.x();
    }
    return sum;
  }

  bool is_smooth(const std::vector<int>& loop) const {
    constexpr double most = 0.6;  // radians
    return std::all_of(loop.begin(), loop.end(),
                       [&](int i) { return std::abs(result_.inside.angles[i] - M_PI) < most; });
  }

  bool has_ring(const std::vector<int>& loop) const { return result_.inside.nodes[loop.front()] < 0; }

  /// A ring as wide as the loop's segments are long, or narrower where there is less room; none where there is
  /// less than half of that, or where it would get segments far shorter or longer than the loop's.
  void add_ring(const std::vector<int>& loop) {
    for (const double width : {0.8, 0.55}) {
      std::vector<std::pair<Vector2, Vector3>> ring;
      if (!offset(loop, width, ring)) continue;
      FaceBoundary& inside = result_.inside;
      result_.any = true;
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const int point = loop[i];
        if (inside.nodes[point] < 0) result_.between[point].push_back({inside.uv[point], inside.points[point]});
        inside.uv[point] = ring[i].first;
        inside.points[point] = ring[i].second;
        inside.nodes[point] = -1 - point;
        inside.angles[point] = M_PI;
      }
      return;
    }
  }

  bool offset(const std::vector<int>& loop, double width, std::vector<std::pair<Vector2, Vector3>>& ring) const {
    const FaceBoundary& inside = result_.inside;
    const std::size_t n = loop.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Vector3 &before = inside.points[loop[(i + n - 1) % n]], &here = inside.points[loop[i]],
                    &after = inside.points[loop[(i + 1) % n]];
      Vector2 uv = inside.uv[loop[i]];
      const Vector3 across = surface_.normal(uv).cross(after - before).normalized();
      const double length = 0.5 * ((after - here).norm() + (here - before).norm());
      const SurfacePoint at = surface_.move(uv, here + width * length * across);
      if (!domain_.inside(uv) || is_crowded(loop, at.point, 2 * width * length)) return false;
      ring.push_back({uv, at.point});
    }
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t next = (i + 1) % n;
      const double ratio = (ring[next].second - ring[i].second).norm() /
                           (inside.points[loop[next]] - inside.points[loop[i]]).norm();
      if (!(ratio > 0.6) || !(ratio < 2.2)) return false;
    }
    return true;
  }

  /// Whether another boundary, or its ring, is nearer than that.
  bool is_crowded(const std::vector<int>& loop, const Vector3& p, double room) const {
    const FaceBoundary& inside = result_.inside;
    for (const auto& segment : inside.segments) {
      if (std::find(loop.begin(), loop.end(), segment.a) != loop.end()) continue;
      const Vector3 &a = inside.points[segment.a], &b = inside.points[segment.b];
      const Vector3 along = b - a;
      const double t = std::clamp((p - a).dot(along) / std::max(along.squaredNorm(), 1e-300), 0.0, 1.0);
      if ((a + t * along - p).squaredNorm() < room * room) return true;
    }
    return false;
  }

  const FaceSurface& surface_;
  const TrimmedDomain& domain_;
  HoleRings result_;
};

}  // namespace

HoleRings place_rings(const FaceBoundary& boundary, const FaceSurface& surface, const TrimmedDomain& domain,
                      int rings) {
  return RingPlacer(boundary, surface, domain).run(rings);
}

}  // namespace quadrille
