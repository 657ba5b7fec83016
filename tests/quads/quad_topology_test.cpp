/// Which quads meet where, and what replaces a patch of them.

#include "mesher/quads/quad_topology.hpp"

#include <gtest/gtest.h>

#include <array>

#include "tests/support/quad_grid.hpp"

namespace quadrille {
namespace {

using namespace testing;

TEST(QuadTopology, FollowsFansRoundNodes) {
  const SurfaceMesh mesh = grid(3, 3);
  const QuadTopology topology(mesh.mesh.quads, 16);
  const QuadTopology::Fan inner = topology.fan(topology.side_of(5));
  EXPECT_TRUE(topology.closed(5));
  EXPECT_EQ(inner.quads, 4);
  const QuadTopology::Fan rim = topology.fan(topology.side_of(1));
  EXPECT_FALSE(topology.closed(1));
  EXPECT_EQ(rim.quads, 2);
  EXPECT_EQ(topology.twin(rim.first), -1);
  EXPECT_EQ(topology.valence(topology.side_of(0)), 1);
}

TEST(QuadTopology, RefusesWhatWouldNotFit) {
  const SurfaceMesh mesh = grid(3, 3);
  QuadTopology topology(mesh.mesh.quads, 16);
  const std::array<int, 2> patch{0, 1};
  using Quad = QuadTopology::Quad;
  // Another outline; the same side twice; the wrong way round.
  EXPECT_FALSE(topology.replace(patch, std::array<Quad, 1>{Quad{0, 1, 2, 6}}));
  EXPECT_FALSE(topology.replace(patch, std::array<Quad, 2>{Quad{0, 1, 5, 4}, Quad{0, 1, 5, 4}}));
  EXPECT_FALSE(topology.replace(patch, std::array<Quad, 2>{Quad{4, 5, 1, 0}, Quad{5, 6, 2, 1}}));
  EXPECT_EQ(topology.quad(0), (Quad{0, 1, 5, 4}));
  EXPECT_EQ(topology.quad(1), (Quad{1, 2, 6, 5}));
  // The side between them turned.
  EXPECT_TRUE(topology.replace(patch, std::array<Quad, 2>{Quad{0, 1, 2, 4}, Quad{4, 2, 6, 5}}));
  EXPECT_EQ(topology.valence(topology.side_of(1)), 1);
  EXPECT_EQ(topology.valence(topology.side_of(2)), 3);
  EXPECT_EQ(topology.valence(topology.side_of(5)), 3);
}

}  // namespace
}  // namespace quadrille
