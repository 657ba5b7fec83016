/// For every cause of failure: remedies come to an end, each changes something, and only what is of the face.

#include "mesher/shell/remedies.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "mesher/quadrille.hpp"
#include "tests/support/ids.hpp"
#include "tests/support/sample_models.hpp"

namespace quadrille {
namespace {

constexpr int causes = static_cast<int>(Cause::out_of_time) + 1;

auto text_of(const FaceRecipe& r) {
  return std::tuple(r.chart, r.mapped, r.clean_up, r.fineness, r.pair, r.refusal, r.leaves_surface);
}

auto text_of(const SamplingPlan& p) {
  const auto list = [](const auto& values) { return std::vector<int>(values.begin(), values.end()); };
  return std::tuple(list(p.factor), list(p.ignore_curvature), list(p.subdivided), p.finer.size());
}

class Remedies : public testing::Test {
 protected:
  FaceProblem problem(Cause cause, bool with_places) const {
    FaceProblem result(cause, face, "it failed");
    if (!with_places) return result;
    const EdgeId edge = shape.faces[face].wires[0].coedges[0].edge;
    result.stretches.push_back({edge, shape.edges[edge].first, shape.edges[edge].last, 7});
    result.edges.push_back(edge);
    return result;
  }

  std::set<EdgeId> own_edges() const {
    std::set<EdgeId> edges;
    for (const CadWire& wire : shape.faces[face].wires)
      for (const Coedge& coedge : wire.coedges) edges.insert(coedge.edge);
    return edges;
  }

  /// The names of the remedies that are applied until there is none left.
  std::vector<std::string> all(Cause cause, bool with_places) {
    FaceRecord record;
    SamplingPlan plan(shape);
    std::vector<std::string> names;
    const FaceProblem failed = problem(cause, with_places);
    for (int round = 0; round < 100; ++round) {
      const auto recipe = text_of(record.recipe);
      const auto before = text_of(plan);
      const bool applied = apply_remedy(shape, failed, record, plan);
      EXPECT_EQ(applied, text_of(record.recipe) != recipe || text_of(plan) != before)
          << static_cast<int>(cause) << " after " << names.size();
      if (!applied) return names;
      EXPECT_EQ(record.history.size(), names.size() + 1);
      names.push_back(record.history.back());
    }
    ADD_FAILURE() << "no end of remedies for cause " << static_cast<int>(cause);
    return names;
  }

  const CadModel model = CadModel::read(sample_model("box").path());
  const CadShape& shape = model.shape();
  const FaceId face = face_id(2);
};

TEST_F(Remedies, ComeToAnEndAndEachChangesSomething) {
  for (int cause = 0; cause < causes; ++cause)
    for (const bool with_places : {false, true}) all(static_cast<Cause>(cause), with_places);
}

TEST_F(Remedies, AreNoneWhereNothingHelps) {
  for (const Cause cause : {Cause::no_area, Cause::out_of_work, Cause::out_of_time})
    EXPECT_TRUE(all(cause, true).empty());
}

TEST_F(Remedies, ComeInTheOrderOfTheTable) {
  const std::string finer = "it failed: finer segments there";
  EXPECT_EQ(all(Cause::coarse_segments, true), (std::vector<std::string>{finer, finer, finer, finer}));
  EXPECT_EQ(
      all(Cause::unusable_boundary, true),
      (std::vector<std::string>{"it failed: parametric curves recreated by projection",
                                "it failed: seen from above", "it failed: the whole face twice as fine"}));
}

TEST_F(Remedies, DoubleTheFinenessEachTime) {
  FaceRecord record;
  SamplingPlan plan(shape);
  const FaceProblem failed = problem(Cause::inverted, true);
  int wanted = 1;
  while (apply_remedy(shape, failed, record, plan)) {
    if (record.history.back() != "it failed: the whole face twice as fine") continue;
    wanted *= 2;
    EXPECT_EQ(record.recipe.fineness, wanted);
    for (const EdgeId edge : shape.edges.ids())
      EXPECT_EQ(plan.factor[edge], own_edges().contains(edge) ? wanted : 1);
  }
  EXPECT_EQ(wanted, 8);
}

TEST_F(Remedies, StopAfterTheMostAttempts) {
  FaceRecord record;
  record.attempts = FaceRecord::most_attempts;
  SamplingPlan plan(shape);
  EXPECT_FALSE(apply_remedy(shape, problem(Cause::no_mesh, true), record, plan));
  EXPECT_TRUE(record.history.empty());
}

TEST_F(Remedies, KnowTheLongestEdge) {
  double longest = 0;
  for (const EdgeId edge : own_edges()) longest = std::max(longest, shape.edges[edge].length);
  EXPECT_DOUBLE_EQ(longest_edge(shape, face), longest);
  EXPECT_GT(longest, 0);
}

}  // namespace
}  // namespace quadrille
