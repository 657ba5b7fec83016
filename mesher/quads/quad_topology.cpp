/// Quads with their neighbors: implicit half-edges, four per quad.

#include "mesher/quads/quad_topology.hpp"

#include <algorithm>
#include <cstddef>

#include "mesher/mesh/sides.hpp"

namespace quadrille {
namespace {

constexpr int boundary = -1;

bool has_node(std::span<const QuadTopology::Quad> quads, int node) {
  return std::any_of(quads.begin(), quads.end(), [&](const QuadTopology::Quad& quad) {
    return std::find(quad.begin(), quad.end(), node) != quad.end();
  });
}

bool contains(std::span<const int> quads, int quad) {
  return std::find(quads.begin(), quads.end(), quad) != quads.end();
}

}  // namespace

QuadTopology::QuadTopology(std::vector<Quad> quads, int node_count, const ExecutionContext& context)
    : quads_(std::move(quads)), sides_(node_count, -1) {
  context.check();
  SparseCheck check(context);
  twins_.assign(4 * quads_.size(), boundary);
  const auto join = [&](int, int, std::span<const int> same) {
    if (same.size() != 2 || origin(same[0]) == origin(same[1])) return;
    twins_[same[0]] = same[1];
    twins_[same[1]] = same[0];
  };
  for_each_shared_side(sides_.size(), check, join, quads_);
  uses_.assign(sides_.size(), 0);
  openings_.assign(sides_.size(), 0);
  for (int side = 0; side < 4 * size(); ++side) {
    check();
    sides_[origin(side)] = side;
    ++uses_[origin(side)];
    if (twins_[side] < 0) ++openings_[origin(side)];
  }
}

int QuadTopology::side_at(int quad, int node) const {
  for (int k = 0; k < 4; ++k)
    if (quads_[quad][k] == node) return 4 * quad + k;
  return -1;
}

QuadTopology::Fan QuadTopology::fan(int side) const {
  Fan result{.first = side};
  while (twins_[result.first] >= 0) {
    result.first = next(twins_[result.first]);
    if (result.first == side) break;
  }
  int at = result.first;
  do {
    ++result.quads;
    at = rotate(at);
  } while (at >= 0 && at != result.first);
  return result;
}

int QuadTopology::add_node() {
  sides_.push_back(-1);
  uses_.push_back(0);
  openings_.push_back(0);
  return static_cast<int>(sides_.size()) - 1;
}

bool QuadTopology::joined_outside(int from, int to, std::span<const int> patch) const {
  for (const int quad : patch) {
    const int start = side_at(quad, from);
    if (start < 0) continue;
    return !all_around(start, [&](int at) {
      return contains(patch, at >> 2) || (end(at) != to && origin(previous(at)) != to);
    });
  }
  return false;
}

bool QuadTopology::only_in(int node, std::span<const int> patch) const {
  return uses_[node] ==
         std::count_if(patch.begin(), patch.end(), [&](int quad) { return side_at(quad, node) >= 0; });
}

bool QuadTopology::find_outer_sides(std::span<const int> old_quads, std::span<PendingSide> sides) const {
  for (const int quad : old_quads)
    for (int k = 0; k < 4; ++k) {
      const int side = 4 * quad + k, beyond = twins_[side];
      if (beyond >= 0 && contains(old_quads, beyond >> 2)) continue;
      PendingSide* found = nullptr;
      for (PendingSide& pending : sides)
        if (pending.from == origin(side) && pending.to == end(side)) {
          if (found || pending.outer) return false;
          found = &pending;
        }
      if (!found) return false;
      found->outer = true;
      found->outside = beyond;
    }
  return true;
}

bool QuadTopology::join_inside(std::span<const int> old_quads, std::span<PendingSide> sides) const {
  const int count = static_cast<int>(sides.size());
  for (int i = 0; i < count; ++i) {
    PendingSide& side = sides[i];
    if (side.outer) continue;
    for (int j = 0; j < count; ++j) {
      if (j != i && sides[j].from == side.from && sides[j].to == side.to) return false;
      if (sides[j].from != side.to || sides[j].to != side.from) continue;
      if (sides[j].outer || side.twin >= 0) return false;
      side.twin = j;
    }
    if (side.twin < 0) return false;
    if (i < side.twin && joined_outside(side.from, side.to, old_quads)) return false;
  }
  return true;
}

void QuadTopology::take_out(std::span<const int> quads) {
  for (const int quad : quads) {
    for (const int node : quads_[quad]) --uses_[node];
    for (const int node : quads_[quad])
      if (sides_[node] >= 0 && contains(quads, sides_[node] >> 2)) sides_[node] = -1;
    quads_[quad] = {-1, -1, -1, -1};
  }
}

int QuadTopology::free_slot() {
  if (!dead_.empty()) {
    const int slot = dead_.back();
    dead_.pop_back();
    return slot;
  }
  quads_.push_back({});
  twins_.resize(twins_.size() + 4, boundary);
  return size() - 1;
}

bool QuadTopology::replace(std::span<const int> old_quads, std::span<const Quad> new_quads) {
  if (old_quads.size() > max_patch || new_quads.size() > max_patch || new_quads.empty()) return false;
  std::array<PendingSide, 4 * max_patch> pending;
  const int count = 4 * static_cast<int>(new_quads.size());
  for (int i = 0; i < count; ++i) {
    const Quad& quad = new_quads[i >> 2];
    pending[i] = {quad[i & 3], quad[(i + 1) & 3], -1, boundary, false};
    for (int k = 0; k < (i & 3); ++k)
      if (quad[k] == quad[i & 3]) return false;
  }
  const std::span<PendingSide> sides(pending.data(), count);
  if (!find_outer_sides(old_quads, sides) || !join_inside(old_quads, sides)) return false;
  for (const int quad : old_quads) {
    for (const int node : quads_[quad])
      if (!has_node(new_quads, node) && !only_in(node, old_quads)) return false;
  }

  // Nothing can fail from here on.
  take_out(old_quads);
  std::array<int, max_patch> slots;
  for (std::size_t i = 0; i < new_quads.size(); ++i) {
    slots[i] = i < old_quads.size() ? old_quads[i] : free_slot();
    quads_[slots[i]] = new_quads[i];
  }
  for (std::size_t i = new_quads.size(); i < old_quads.size(); ++i) dead_.push_back(old_quads[i]);
  for (int i = 0; i < count; ++i) {
    const int side = 4 * slots[i >> 2] + (i & 3);
    sides_[pending[i].from] = side;
    ++uses_[pending[i].from];
    if (pending[i].twin >= 0) {
      twins_[side] = 4 * slots[pending[i].twin >> 2] + (pending[i].twin & 3);
    } else {
      twins_[side] = pending[i].outside;
      if (pending[i].outside >= 0) twins_[pending[i].outside] = side;
    }
  }
  return true;
}

}  // namespace quadrille
