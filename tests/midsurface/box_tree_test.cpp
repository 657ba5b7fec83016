/// Lines meet the same boxes in a tree as one by one.

#include "geometry/midsurface/box_tree.hpp"

#include <gtest/gtest.h>

#include <gp_Dir.hxx>
#include <gp_Pnt.hxx>

#include <random>
#include <vector>

namespace quadrille {
namespace {

constexpr double far = 1000;

TEST(BoxTree, MeetsBoxesBetweenTwoParameters) {
  std::vector<Bnd_Box> boxes;
  for (int i = 0; i < 20; ++i) boxes.emplace_back(gp_Pnt(3.0 * i, 0, 0), gp_Pnt(3.0 * i + 1, 1, 1));
  const BoxTree tree(boxes);
  const gp_Lin along(gp_Pnt(0, 0.5, 0.5), gp_Dir(1, 0, 0));
  EXPECT_EQ(tree.met(along, -far, far).size(), 20U);
  EXPECT_EQ(tree.met(along, 3.5, 9.5), (std::vector<std::size_t>{1, 2, 3}));
  EXPECT_EQ(tree.met(along, 4.5, 5.5), std::vector<std::size_t>{});
  EXPECT_EQ(tree.met(gp_Lin(gp_Pnt(0, 2, 0.5), gp_Dir(1, 0, 0)), -far, far), std::vector<std::size_t>{});
  EXPECT_EQ(tree.met(gp_Lin(gp_Pnt(6.5, 0, -9), gp_Dir(0, 0, 1)), -far, far), std::vector<std::size_t>{2});
}

TEST(BoxTree, MeetsTheSameBoxesAsOneByOne) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(0, 10), width(0, 2), turn(-1, 1);
  for (int round = 0; round < 50; ++round) {
    std::vector<Bnd_Box> boxes;
    for (int i = 0; i < 1 + 7 * round; ++i) {
      const gp_XYZ low(place(random), place(random), place(random));
      boxes.emplace_back(gp_Pnt(low), gp_Pnt(low + gp_XYZ(width(random), width(random), width(random))));
    }
    const BoxTree tree(boxes);
    const gp_Lin line(gp_Pnt(place(random), place(random), place(random)),
                      gp_Dir(turn(random), turn(random), turn(random)));
    std::vector<std::size_t> met;
    for (std::size_t i = 0; i < boxes.size(); ++i)
      if (!BoxTree(std::vector<Bnd_Box>{boxes[i]}).met(line, -5, 5).empty()) met.push_back(i);
    EXPECT_EQ(tree.met(line, -5, 5), met);
  }
  EXPECT_TRUE(BoxTree(std::vector<Bnd_Box>()).met(gp_Lin(), -1, 1).empty());
}

}  // namespace
}  // namespace quadrille
