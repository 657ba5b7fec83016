#pragma once
/// How wide a face is between opposite parts of its boundary. Internal.

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
  double angle = 0;  ///< between the two parts of the boundary, radians
  double width() const { return (to - from).norm(); }
};

/// The width of a face along its boundary: the straight distance across the face to a part of the boundary
/// that faces back. Corners are not gaps: only parts that face each other within 40 degrees count. A wedge
/// with a smaller angle counts too.
class FaceGaps {
 public:
  /// \param widest wider gaps are ignored. \param narrowest narrower gaps are all alike.
  FaceGaps(const CadShape& shape, FaceId face, double widest, double narrowest);

  /// The gaps at places along the boundary. Neighboring places on a curve are no farther apart than half the
  /// gap width. Time: the number of places times that of the boundary pieces near each.
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
