#pragma once
/// How wide a face is between its own loops and rims. Internal.

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/base/vector.hpp"
#include "geometry/cad/cad_shape.hpp"

namespace quadrille {

/// Two places of a face's boundary that face each other.
struct FaceGap {
  Vector3 from, to;
  double width() const { return (to - from).norm(); }
};

/// The width of a face along its boundary: the way straight across it to a part of the boundary that faces
/// it. Corners are no gaps: only what is within 40 degrees of facing counts, a wedge of less too.
class FaceGaps {
 public:
  /// \param face from 0 \param widest no gap wider than this is wanted \param narrowest gaps below this are
  /// all alike.
  FaceGaps(const CadShape& shape, int face, double widest, double narrowest);

  /// The gaps at places along the boundary, neighbors on a curve no farther apart than half their widths.
  /// Time: places times the pieces of the boundary that are near.
  std::vector<FaceGap> find(const ExecutionContext& context) const;

 private:
  /// A piece of the boundary; `inward` is a unit vector in the surface, into the face.
  struct Piece {
    Vector3 a, b, inward;
  };
  using Cell = std::array<std::int64_t, 3>;
  struct CellHash {
    std::size_t operator()(const Cell& cell) const {
      return static_cast<std::size_t>(73856093 * cell[0] ^ 19349663 * cell[1] ^ 83492791 * cell[2]);
    }
  };

  void add_coedge(const CadEdge& edge, const Coedge& coedge, const class FaceSurface& surface);
  Cell cell_of(const Vector3& point) const;
  std::optional<FaceGap> gap_at(const Vector3& point, const Vector3& inward) const;
  void find_between(const Piece& piece, std::vector<FaceGap>& gaps, SparseCheck& check) const;

  double widest_, narrowest_;
  std::vector<Piece> pieces_;
  std::unordered_map<Cell, std::vector<int>, CellHash> cells_;
};

}  // namespace quadrille
