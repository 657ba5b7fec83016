/// Narrow gaps between plates are filled so that all becomes one; wide ones, and those that are none, are
/// not.

#include "geometry/midsurface/gaps.hpp"

#include <gtest/gtest.h>

#include <BRepGProp.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <GProp_GProps.hxx>

#include "geometry/midsurface/solids.hpp"
#include "tests/models/trouble_models.hpp"

namespace quadrille {
namespace {

/// Two plates of thickness 2 in a T: the second one stands this far above the first.
TopoDS_Shape tee(double gap) {
  return compound({BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), gp_Pnt(40, 30, 2)).Shape(),
                   BRepPrimAPI_MakeBox(gp_Pnt(19, 0, 2 + gap), gp_Pnt(21, 30, 30)).Shape()});
}

double volume(const TopoDS_Shape& shape) {
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shape, properties);
  return properties.Mass();
}

TEST(Gaps, AreFilledWhereTheyAreNarrowerThanTheWall) {
  const ExecutionContext context(1);
  for (const double gap : {0.2, 1.0, 1.8}) {
    const NumberedSolids fillers = fill_gaps(skins_of(tee(gap), false, context), context);
    ASSERT_FALSE(fillers.solids.empty()) << gap;
    for (const TopoDS_Shape& solid : fillers.solids) EXPECT_GE(volume(solid), 2 * 30 * gap - 1e-6);
    const std::deque<Skin> joined = skins_of(tee(gap), true, context);
    ASSERT_EQ(joined.size(), 1U);
    EXPECT_NEAR(volume(joined[0].solid()), 40 * 30 * 2 + 2 * 30 * 28, 1e-6);
  }
}

TEST(Gaps, AreLeftWhereTheyAreWideOrNone) {
  const ExecutionContext context(1);
  for (const double gap : {0.0, 2.5, 8.0})
    EXPECT_TRUE(fill_gaps(skins_of(tee(gap), false, context), context).solids.empty()) << gap;
  EXPECT_EQ(skins_of(tee(2.5), true, context).size(), 2U);
}

}  // namespace
}  // namespace quadrille
