/// Tables of the wanted number of segments along an edge.

#include "mesher/edges/count_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/base/error.hpp"
#include "mesher/quadrille.hpp"
#include "tests/support/ids.hpp"
#include "tests/support/sample_models.hpp"

namespace quadrille {
namespace {

/// Sizes from 1 to 3 along a line of length 10, in `n` intervals: 5 ln 3 segments.
CountTable growing(int n) {
  CountTable table;
  for (int i = 0; i <= n; ++i) {
    const double s = 10.0 * i / n;
    table.parameters.push_back(2 * s);
    table.lengths.push_back(s);
    table.counts.push_back(5 * std::log(1 + s / 5));
  }
  return table;
}

TEST(CountTable, ItsFunctionsAreInversesOfEachOther) {
  const CountTable table = growing(200);
  EXPECT_NEAR(table.total(), 5 * std::log(3.0), 1e-12);
  EXPECT_EQ(table.length(), 10);
  for (double length = 0; length <= 10; length += 0.37) {
    const double count = table.count_at_length(length);
    EXPECT_NEAR(table.length_at(count), length, 1e-9);
    EXPECT_NEAR(table.parameter_at(count), 2 * length, 1e-9);
    EXPECT_NEAR(table.parameter_at_length(length), 2 * length, 1e-9);
    EXPECT_NEAR(count, 5 * std::log(1 + length / 5), 1e-3);
  }
}

TEST(CountTable, GetsFinerWhereAskedAndOnlyThere) {
  CountTable table = growing(200);
  const double before = table.count_at_length(4), after = table.total() - table.count_at_length(6);
  table.make_finer(8, 12, 5);  // parameters: lengths from 4 to 6
  EXPECT_NEAR(table.count_at_length(6) - table.count_at_length(4), 5, 1e-9);
  EXPECT_NEAR(table.count_at_length(4), before, 1e-9);
  EXPECT_NEAR(table.total() - table.count_at_length(6), after, 1e-9);
  const double total = table.total();
  table.make_finer(8, 12, 4);  // is as fine already
  EXPECT_NEAR(table.total(), total, 1e-12);
}

TEST(CountTable, IsRaisedToADensity) {
  CountTable table = growing(2000);
  table.raise_to(0.5);  // sizes of at most 2, which they have at 5
  EXPECT_NEAR(table.total(), 5 * std::log(2.0) + 2.5, 1e-2);
  EXPECT_NEAR(table.count_at_length(5), 5 * std::log(2.0), 1e-2);
}

TEST(CountTable, CountsTheSizesOfAField) {
  const CadModel model = CadModel::read(sample_model("box").path());
  SizingOptions sizing;
  sizing.size = 0.7;
  sizing.elements_per_circle = 0;
  sizing.short_edges = false;
  ExecutionContext context;
  const SizingField field = SizingField::build(model, sizing, context);
  for (const CadEdge& edge : model.shape().edges) {
    SizingField::Sampler size_at(field, edge);
    const CountTable table = tabulate(edge, true, size_at);
    EXPECT_NEAR(table.length(), edge.length, 1e-9);
    EXPECT_NEAR(table.total(), edge.length / 0.7, 1e-3 * table.total());
    EXPECT_NEAR(table.turning, 0, 1e-9);
  }
}

TEST(CountTable, TooManySegmentsAreRefused) {
  const CadModel model = CadModel::read(sample_model("box").path());
  Budget budget;
  EXPECT_NO_THROW(hold_segments(budget.segments, budget, model.shape().edges[edge_id(1)]));
  EXPECT_THROW(hold_segments(1.01 * budget.segments, budget, model.shape().edges[edge_id(1)]), Error);
}

}  // namespace
}  // namespace quadrille
