/// Entries of settings are read, written and read again.

#include "mesher/size_entries.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <utility>
#include <vector>

#include "mesher/mesh/entity_name.hpp"

namespace quadrille {
namespace {

using Set = void (*)(SizingOptions&, const Entries&);
using Get = Entries (*)(const SizingOptions&);

TEST(SizeEntries, ComeBackAsTheyWere) {
  const std::vector<std::tuple<Set, Get, Entries>> kinds = {
      {set_regions,
       regions_of,
       {"box:0,0,0,10,10,5=0.5", "sphere:1,2,3,4=0.25,7", "cylinder:0,0,0,0,0,9,2=1",
        "halfspace:0,0,1,0,0,-1=2"}},
      {set_kept, kept_of, {"Face7", "Edge3"}},
      {set_spacings<&EdgeSpacing::segments>, spacings_of<&EdgeSpacing::segments>, {"Edge4=20", "Edge9=1"}},
      {set_spacings<&EdgeSpacing::bias>, spacings_of<&EdgeSpacing::bias>, {"Edge4=1.2"}},
      {set_spacings<&EdgeSpacing::bias_both>, spacings_of<&EdgeSpacing::bias_both>, {"Edge4=0.8"}},
      {set_nodes, nodes_of, {"Tip=1,-2.5,3"}}};
  for (const auto& [set, get, entries] : kinds) {
    SizingOptions first, second;
    set(first, entries);
    const Entries written = get(first);
    EXPECT_EQ(written.size(), entries.size()) << entries[0];
    set(second, written);
    EXPECT_EQ(get(second), written) << entries[0];
    SizingOptions none;
    EXPECT_TRUE(get(none).empty());
  }
}

TEST(SizeEntries, AreUnderstood) {
  SizingOptions sizing;
  set_regions(sizing, {"cylinder:1,2,3,4,5,6,2=0.5,3"});
  ASSERT_EQ(sizing.regions.size(), 1u);
  EXPECT_EQ(sizing.regions[0].shape, SizeRegion::Shape::cylinder);
  EXPECT_EQ(sizing.regions[0].b, Vector3(4, 5, 6));
  EXPECT_EQ(sizing.regions[0].radius, 2);
  EXPECT_EQ(sizing.regions[0].size, 0.5);
  EXPECT_EQ(sizing.regions[0].transition, 3);
  set_spacings<&EdgeSpacing::segments>(sizing, {"Edge4=20,Edge5=3"});
  EXPECT_EQ(sizing.spacings.at(4).segments, 20);
  EXPECT_EQ(sizing.spacings.at(5).segments, 3);
  set_spacings<&EdgeSpacing::bias>(sizing, {"Edge4=1.2"});
  EXPECT_EQ(sizing.spacings.at(4).segments, 20) << "the number stays";
  EXPECT_EQ(sizing.spacings.at(4).bias, 1.2);
  set_chord_error(sizing, "2%");
  EXPECT_DOUBLE_EQ(sizing.chord_error.share, 0.02);
  EXPECT_EQ(chord_error_of(sizing), "2%");
  set_chord_error(sizing, "0.05");
  EXPECT_EQ(sizing.chord_error.length, 0.05);
  EXPECT_EQ(entity_of("Face3").dimension, 2);
  EXPECT_EQ(entity_of("Face3").number, 3);
  EXPECT_EQ(entity_of("Edge3").dimension, 1);
  EXPECT_EQ(entity_of("Face0").dimension, -1);
}

TEST(SizeEntries, AreRefusedWithTheEntry) {
  const std::vector<std::pair<Set, const char*>> wrong = {{set_regions, "ball:0,0,0,1=1"},
                                                          {set_regions, "box:0,0,0,1=1"},
                                                          {set_regions, "sphere:0,0,0,1"},
                                                          {set_spacings<&EdgeSpacing::segments>, "Face4=20"},
                                                          {set_spacings<&EdgeSpacing::segments>, "Edge4"},
                                                          {set_spacings<&EdgeSpacing::segments>, "Edge4=1.5"},
                                                          {set_spacings<&EdgeSpacing::bias>, "Edge4=x"},
                                                          {set_nodes, "1,2"},
                                                          {set_kept, "Solid1"}};
  for (const auto& [set, entry] : wrong) {
    SizingOptions sizing;
    try {
      set(sizing, {entry});
      ADD_FAILURE() << entry << " was taken";
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(entry), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace quadrille
