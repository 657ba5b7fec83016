/// Random sheets of four-sided faces: all sums hold afterwards, and little has changed.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "mesher/edges/count_balance.hpp"

namespace quadrille {
namespace {

using Rule = BalanceProblem::Rule;

int broken_rules(const BalanceProblem& problem) {
  const std::vector<int> sums = problem.sums();
  int broken = 0;
  for (std::size_t node = 0; node < sums.size(); ++node)
    broken += problem.rules[node] == Rule::zero ? sums[node] != 0 : sums[node] % 2 != 0;
  return broken;
}

/// A sheet of columns x rows four-sided faces: edges along x have (rows + 1) x columns, along y the rest.
BalanceProblem sheet(int columns, int rows, double edge_share_of_even, std::mt19937& random) {
  BalanceProblem problem;
  std::uniform_real_distribution<double> wanted(3, 6), unit(0, 1);
  const auto node_of = [&](int i, int j) { return 2 * (j * columns + i); };
  std::vector<char> even(columns * rows);
  for (int face = 0; face < columns * rows; ++face) {
    even[face] = unit(random) < edge_share_of_even;
    problem.rules.push_back(even[face] ? Rule::even : Rule::zero);
    problem.rules.push_back(even[face] ? Rule::even : Rule::zero);
  }
  const auto add = [&](int i, int j, int sign, bool along_y, auto& variable) {
    if (i < 0 || j < 0 || i >= columns || j >= rows) return;
    const int face = j * columns + i;
    variable.terms.push_back({node_of(i, j) + (along_y && !even[face]), sign});
  };
  const auto variable = [&] {
    BalanceProblem::Variable v;
    v.wanted = wanted(random);
    v.value = static_cast<int>(std::lround(v.wanted));
    return v;
  };
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      auto v = variable();
      add(i, j, 1, false, v);
      add(i, j - 1, -1, false, v);
      problem.variables.push_back(v);
    }
  }
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      auto v = variable();
      add(i, j, 1, true, v);
      add(i - 1, j, -1, true, v);
      problem.variables.push_back(v);
    }
  }
  return problem;
}

TEST(Balance, KeepsAllRulesOfSheets) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 100; ++trial) {
    BalanceProblem problem = sheet(1 + trial % 7, 1 + trial % 5, 0.3 * (trial % 4), random);
    const BalanceProblem before = problem;
    EXPECT_TRUE(balance(problem).empty());
    EXPECT_EQ(broken_rules(problem), 0);
    for (std::size_t i = 0; i < problem.variables.size(); ++i) {
      EXPECT_GE(problem.variables[i].value, problem.variables[i].least);
      EXPECT_LE(problem.variables[i].value, 2 * before.variables[i].wanted + 1);
    }
  }
}

TEST(Balance, ChangesLittleWhereLittleIsWrong) {
  // Three edges in a row of two faces; the middle one wants one more.
  BalanceProblem problem;
  problem.rules = {Rule::zero, Rule::zero};
  problem.variables = {
      {10, 1, 1, 10, {{0, 1}}}, {11, 1, 1, 11, {{0, -1}, {1, 1}}}, {10, 1, 1, 10, {{1, -1}}}};
  EXPECT_TRUE(balance(problem).empty());
  for (const auto& variable : problem.variables) EXPECT_EQ(variable.value, problem.variables[0].value);
  EXPECT_NEAR(problem.variables[0].value, 10.5, 0.6);
}

TEST(Balance, SumsOfSeveralEdgesBalanceOne) {
  BalanceProblem problem;
  problem.rules = {Rule::zero};
  problem.variables = {{7.4, 1, 1, 7, {{0, 1}}},
                       {3.4, 1, 1, 3, {{0, -1}}},
                       {3.6, 1, 1, 4, {{0, -1}}},
                       {2.6, 1, 1, 3, {{0, -1}}}};
  EXPECT_TRUE(balance(problem).empty());
  EXPECT_EQ(broken_rules(problem), 0);
}

TEST(Balance, NamesNodesThatItCannotMend) {
  // One edge alone must be zero, and may not.
  BalanceProblem problem;
  problem.rules = {Rule::zero, Rule::even};
  problem.variables = {{4, 1, 1, 4, {{0, 1}}}, {3, 1, 1, 3, {{1, 1}}}};
  EXPECT_EQ(balance(problem), std::vector<int>{0});
  EXPECT_EQ(problem.variables[1].value % 2, 0);
}

}  // namespace
}  // namespace quadrille
