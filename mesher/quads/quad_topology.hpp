#pragma once
/// Quads with their neighbors, replaced patch by patch; not part of the public interface.

#include <array>
#include <span>
#include <vector>

#include "geometry/base/execution_context.hpp"

namespace quadrille {

/// The quads of a mesh and which side meets which. Side k of quad q, from its node k to node k + 1, is number
/// 4 * q + k. A side's twin is the same side seen from the quad beyond it; -1 on the boundary and where the
/// mesh is not manifold.
class QuadTopology {
 public:
  using Quad = std::array<int, 4>;
  static constexpr int max_patch = 160;  ///< quads in a patch; larger ones are not replaced

  /// A connected run of sides that leave one node, counter-clockwise.
  struct Fan {
    int first = -1;  ///< first side; on the boundary if the fan is open
    int quads = 0;
  };

  QuadTopology(std::vector<Quad> quads, int node_count, const ExecutionContext& context = {});

  int size() const { return static_cast<int>(quads_.size()); }  ///< slots, dead ones included
  bool alive(int quad) const { return quads_[quad][0] >= 0; }
  const Quad& quad(int quad) const { return quads_[quad]; }

  int twin(int side) const { return twins_[side]; }
  /// The quad beyond a side; -1 = none.
  int beyond(int side) const { return twins_[side] >> 2; }
  int origin(int side) const { return quads_[side >> 2][side & 3]; }
  int end(int side) const { return quads_[side >> 2][(side + 1) & 3]; }
  static int next(int side) { return (side & ~3) | ((side + 1) & 3); }
  static int opposite(int side) { return side ^ 2; }
  static int previous(int side) { return (side & ~3) | ((side + 3) & 3); }
  /// The next side around the origin, counter-clockwise; -1 past the last quad of an open fan.
  int rotate(int side) const { return twins_[previous(side)]; }
  /// The fan around the origin of a side. Time: linear in its quads.
  Fan fan(int side) const;
  /// Calls visit(side) for the sides of the fan around the origin of a side, until it returns false.
  /// \return whether it never did.
  template <class Visit>
  bool all_around(int side, Visit&& visit) const {
    const Fan around = fan(side);
    side = around.first;
    for (int i = 0; i < around.quads; ++i, side = rotate(side))
      if (!visit(side)) return false;
    return true;
  }
  /// Adds the quads of the fan around the origin of a side to a patch. False if they do not fit.
  template <class Patch>
  bool add_fan(int side, Patch& patch) const {
    return all_around(side, [&](int at) { return patch.add(at >> 2); });
  }
  /// The number of quads in the fan around the origin of a side. Constant time if the node has only one fan.
  int valence(int side) const {
    const int node = origin(side);
    return openings_[node] < 2 ? uses_[node] : fan(side).quads;
  }
  /// Whether the quads close around the node.
  bool closed(int node) const { return openings_[node] == 0; }
  /// The number of open fans of the node.
  int openings(int node) const { return openings_[node]; }
  /// One side that leaves the node, or -1 when no quad uses it. A boundary node may have several fans.
  int side_of(int node) const { return sides_[node]; }
  /// The side of the quad that leaves the node, or -1.
  int side_at(int quad, int node) const;

  int add_node();

  /// Replaces the quads of a patch by others with the same outer sides; nodes inside may change.
  /// \return false, with nothing changed, if the outer sides differ or the result would not be manifold.
  bool replace(std::span<const int> old_quads, std::span<const Quad> new_quads);

 private:
  /// A side of a patch's new quads, whose twin is still to be found.
  struct PendingSide {
    int from, to;
    int twin;     ///< index of the new side opposite, or -1
    int outside;  ///< side of a quad outside the patch, or -1
    bool outer;   ///< whether an outer side of the old quads runs along it
  };

  /// Sets `outer` and `outside`. False unless each outer side of the patch is found once among the new sides.
  bool find_outer_sides(std::span<const int> old_quads, std::span<PendingSide> sides) const;
  /// Sets `twin` of all other sides. False unless they join each other in pairs.
  bool join_inside(std::span<const int> old_quads, std::span<PendingSide> sides) const;
  void take_out(std::span<const int> quads);
  /// Returns a slot for one more quad.
  int free_slot();
  bool joined_outside(int from, int to, std::span<const int> patch) const;
  /// Whether all quads of a node are in `patch`.
  bool only_in(int node, std::span<const int> patch) const;

  std::vector<Quad> quads_;
  std::vector<int> twins_;
  std::vector<int> sides_;
  std::vector<int> uses_;       ///< quads of each node
  std::vector<char> openings_;  ///< open fans of each node; replacing patches never changes them
  std::vector<int> dead_;       ///< slots to reuse
};

}  // namespace quadrille
