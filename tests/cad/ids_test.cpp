/// Ids as indices and numbers, and the range of all ids of a vector.

#include "geometry/cad/ids.hpp"

#include <algorithm>
#include <iterator>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

namespace quadrille {
namespace {

static_assert(std::forward_iterator<IdRange<FaceId>::Iterator>);
static_assert(!std::is_constructible_v<FaceId, EdgeId> && !std::is_constructible_v<FaceId, int>);

TEST(Ids, NumbersCountFromOneAndNoneIsZero) {
  EXPECT_EQ(FaceId::from_number(3), FaceId::from_index(2));
  EXPECT_EQ(FaceId::from_index(2).number(), 3);
  EXPECT_FALSE(FaceId().exists());
  EXPECT_EQ(FaceId::from_number(0), FaceId());
  EXPECT_LT(FaceId(), FaceId::from_index(0));
}

TEST(Ids, RangeHasEachIdOnceInOrder) {
  const IdVector<EdgeId, double> values(4, 0.5);
  std::vector<int> indices;
  for (const EdgeId id : values.ids()) indices.push_back(id.index());
  EXPECT_EQ(indices, (std::vector<int>{0, 1, 2, 3}));
  const IdVector<EdgeId, double> none;
  EXPECT_EQ(none.ids().begin(), none.ids().end());
}

TEST(Ids, RangeCanBeSearchedAndReadAgain) {
  IdVector<VertexId, char> marked(5);
  const auto ids = marked.ids();
  marked[VertexId::from_index(3)] = 1;
  const auto found = std::find_if(ids.begin(), ids.end(), [&](VertexId id) { return marked[id] != 0; });
  ASSERT_NE(found, ids.end());
  EXPECT_EQ((*found).index(), 3);
  auto next = found;
  EXPECT_EQ(*next++, *found);
  EXPECT_EQ((*next).index(), 4);
  EXPECT_EQ(++next, ids.end());
}

TEST(Ids, PushBackTellsTheNewId) {
  IdVector<FaceId, int> values;
  EXPECT_EQ(values.push_back(7).number(), 1);
  EXPECT_EQ(values.push_back(8).number(), 2);
  EXPECT_EQ(values[FaceId::from_number(2)], 8);
}

}  // namespace
}  // namespace quadrille
