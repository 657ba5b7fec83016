/// Sorts pieces of the boundary into cells of a hash grid and looks for pieces that face each other.

#include "geometry/sizing/face_gaps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <unordered_map>

#include "geometry/surfaces/edge_curve.hpp"
#include "geometry/surfaces/face_surface.hpp"

namespace quadrille {

namespace {

/// Cosine of the largest angle at which parts of a boundary face each other.
const double facing = std::cos(40 * M_PI / 180);
/// Largest turning of the curve within a piece, radians.
constexpr double turn_of_piece = 0.26;
constexpr int most_pieces = 20000;

double turning(const EdgeCurve& curve, const CadEdge& edge) {
  if (curve.straight()) return 0;
  constexpr int samples = 32;
  double sum = 0;
  Vector3 before = curve.derivative(edge.first).normalized();
  for (int i = 1; i <= samples; ++i) {
    const Vector3 now = curve.derivative(edge.first + (edge.last - edge.first) * i / samples).normalized();
    sum += std::acos(std::clamp(before.dot(now), -1.0, 1.0));
    before = now;
  }
  return sum;
}

class FaceGapFinder {
 public:
  FaceGapFinder(const CadShape& shape, FaceId face, double widest, double narrowest)
      : widest_(widest), narrowest_(narrowest) {
    const CadFace& cad = shape.faces[face];
    const FaceSurface surface(cad);
    std::map<EdgeId, int> uses;  // seams are used twice and do not bound the face
    for (const EdgeId edge : cad.edges()) ++uses[edge];
    for (const CadWire& wire : cad.wires) {
      for (const Coedge& coedge : wire.coedges) {
        const CadEdge& edge = shape.edges[coedge.edge];
        if (uses[coedge.edge] == 1 && !coedge.internal && !edge.degenerate && edge.length > 0)
          add_coedge(edge, coedge, surface);
      }
    }
    for (std::size_t i = 0; i < pieces_.size(); ++i)
      cells_[cell_of(0.5 * (pieces_[i].a + pieces_[i].b))].push_back(static_cast<int>(i));
  }

  std::vector<FaceGap> find(const ExecutionContext& context) const {
    std::vector<FaceGap> gaps;
    SparseCheck check(context, 64);
    for (const Piece& piece : pieces_) {
      if (const auto gap = gap_at(piece.a, piece.inward)) gaps.push_back(*gap);
      if (const auto gap = gap_at(piece.b, piece.inward)) gaps.push_back(*gap);
      find_between(piece, gaps, check);
    }
    return gaps;
  }

 private:
  /// A piece of the boundary; `inward` is a unit vector in the surface, into the face.
  struct Piece {
    Vector3 a, b, inward;
  };
  using Cell = std::array<std::int64_t, 3>;
  struct CellHash {  // boost::hash takes a quarter longer for the whole search
    std::size_t operator()(const Cell& cell) const {
      return static_cast<std::size_t>(73856093 * cell[0] ^ 19349663 * cell[1] ^ 83492791 * cell[2]);
    }
  };

  void add_coedge(const CadEdge& edge, const Coedge& coedge, const FaceSurface& surface) {
    const EdgeCurve curve(edge);
    const double wanted = std::max({1.0, 2 * edge.length / widest_, turning(curve, edge) / turn_of_piece});
    const int n = static_cast<int>(std::min<double>(most_pieces, std::ceil(wanted)));
    Vector3 from = curve.point(edge.first);
    for (int i = 0; i < n; ++i) {
      const double step = (edge.last - edge.first) / n;
      const Vector3 to = curve.point(edge.first + (i + 1) * step);
      const Vector3 normal = surface.normal(parametric_point(coedge, edge.first + (i + 0.5) * step));
      // The face lies to the left of its wires.
      const Vector3 inward = (coedge.forward ? 1 : -1) * normal.cross(to - from);
      if (inward.norm() > 0) pieces_.push_back({from, to, inward.normalized()});
      from = to;
    }
  }

  Cell cell_of(const Vector3& point) const {
    // Pieces are at most half as long as the widest gap, so all near pieces lie in the neighboring cells.
    const Vector3 index = point / (1.5 * widest_);
    return {static_cast<std::int64_t>(std::floor(index.x())),
            static_cast<std::int64_t>(std::floor(index.y())),
            static_cast<std::int64_t>(std::floor(index.z()))};
  }

  std::optional<FaceGap> gap_at(const Vector3& point, const Vector3& inward) const {
    const Cell middle = cell_of(point);
    double width = widest_;
    std::optional<FaceGap> gap;
    for (int k = 0; k < 27; ++k) {
      const auto cell =
          cells_.find({middle[0] + k % 3 - 1, middle[1] + k / 3 % 3 - 1, middle[2] + k / 9 - 1});
      if (cell == cells_.end()) continue;
      for (const int i : cell->second) {
        const Piece& piece = pieces_[i];
        if (piece.inward.dot(inward) > -facing) continue;
        const Vector3 to = piece.a + nearest_share(piece.a, piece.b, point) * (piece.b - piece.a),
                      way = to - point;
        const double length = way.norm();
        if (!(length > 0) || length >= width) continue;
        if (way.dot(inward) < facing * length || -way.dot(piece.inward) < facing * length) continue;
        width = length;
        gap = FaceGap{point, to, std::acos(std::clamp(-piece.inward.dot(inward), -1.0, 1.0))};
      }
    }
    return gap;
  }

  void find_between(const Piece& piece, std::vector<FaceGap>& gaps, SparseCheck& check) const {
    check();
    const auto gap = gap_at(0.5 * (piece.a + piece.b), piece.inward);
    if (gap) gaps.push_back(*gap);
    // Points of a half may be nearer to another piece by up to the length of the half.
    const double length = (piece.b - piece.a).norm();
    const double width = std::max((gap ? gap->width() : widest_) - 0.5 * length, narrowest_);
    if (length <= 0.5 * width) return;
    const Vector3 middle = 0.5 * (piece.a + piece.b);
    if (middle == piece.a || middle == piece.b) return;  // no numbers lie between the ends
    find_between({piece.a, middle, piece.inward}, gaps, check);
    find_between({middle, piece.b, piece.inward}, gaps, check);
  }

  double widest_, narrowest_;
  std::vector<Piece> pieces_;
  std::unordered_map<Cell, std::vector<int>, CellHash> cells_;
};

}  // namespace

std::vector<FaceGap> face_gaps(const CadShape& shape, FaceId face, double widest, double narrowest,
                               const ExecutionContext& context) {
  return FaceGapFinder(shape, face, widest, narrowest).find(context);
}

}  // namespace quadrille
