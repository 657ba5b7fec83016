/// Limits from JSON and from HyperMesh's criteria, and the reasons of refusals.

#include "mesher/io/limits_reader.hpp"

#include <gtest/gtest.h>

#include "geometry/base/error.hpp"
#include "tests/support/process.hpp"

namespace quadrille {
namespace {

class LimitsReading : public testing::Test {
 protected:
  CriteriaLimits read(const std::string& text) {
    test::write_text(folder_ / "limits", text);
    return read_limits(folder_ / "limits");
  }

  std::string refusal(const std::string& text) {
    try {
      read(text);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  static double limit(const CriteriaLimits& limits, Criterion criterion) {
    return limits.values[static_cast<std::size_t>(criterion)];
  }

 private:
  test::TemporaryFolder folder_;
};

TEST_F(LimitsReading, JsonNamesWhatDiffers) {
  const CriteriaLimits limits = read(R"({"aspect": 3.5, "taper": null})");
  EXPECT_EQ(limit(limits, Criterion::aspect), 3.5);
  EXPECT_EQ(limit(limits, Criterion::skew), 40);
  EXPECT_FALSE(limits.fails(Criterion::taper, 0.99));
}

TEST_F(LimitsReading, HyperMeshLinesGiveTheirColumnFail) {
  const CriteriaLimits limits = read(
      " 0 penalty value              0.00    0.00    0.80    1.00   10.00\n"
      "  1 min length        1 1.0  10.000   9.000   4.000   2.000   1.000    1   59    0\n"
      "  3 aspect ratio      1 1.0   1.000   2.000   4.400   6.000  10.000    0   41    2\n"
      "  4 warpage           0 1.0   0.000   5.000  13.000  15.000  30.000    0   56    3\n"
      "  5 max angle quad    1 1.0  90.000 110.000 134.000 145.000 160.000    0   28    4\n"
      "  6 min angle quad    1 1.0  90.000  70.000  46.000  35.000  20.000    0   61    5\r\n"
      "  7 max angle tria    0 1.0  60.000  80.000 112.000 120.000 150.000    0   19    6\n"
      " 10 jacobian          1 1.0   1.000   0.900   0.700   0.500   0.300    0   57    9\n"
      " 13 % of trias        1 1.0   0.000   6.000  10.000  15.000  20.000    0    0   -1\n"
      "   Global_solver -1\n");
  EXPECT_EQ(limit(limits, Criterion::aspect), 6);
  EXPECT_EQ(limit(limits, Criterion::min_length), 2);
  EXPECT_EQ(limit(limits, Criterion::angle_max), 145);
  EXPECT_EQ(limit(limits, Criterion::angle_min), 35);
  EXPECT_EQ(limit(limits, Criterion::jacobian_ratio), 0.5);
  EXPECT_FALSE(limits.fails(Criterion::warp, 89));  // switched off
  EXPECT_FALSE(limits.fails(Criterion::skew, 89));  // not in the file
  EXPECT_EQ(limits.not_measured, (std::vector<std::string>{"% of trias"}));
}

TEST_F(LimitsReading, RefusalsNameTheReason) {
  const auto says = [&](const std::string& text, const std::string& part) {
    EXPECT_NE(refusal(text).find(part), std::string::npos) << refusal(text);
  };
  says("", "empty");
  says("nothing of the kind\n", "neither JSON");
  says("{\"aspect\": 5", "not valid JSON");
  says("{\"aspects\": 5}", "aspects is not one of the criteria aspect, warp");
  says("{\"aspect\": \"five\"}", "aspect must be a number");
  says("{\"aspect\": 0.5}", "aspect must be above 1");
  says("{\"min_length\": 0}", "min_length must be above 0");
  says("{\"angle_min\": 90}", "angle_min must be below 90");
  says("  3 aspect ratio      1 1.0   1.000   2.000\n", "line 1: aspect ratio needs the columns");
  says("\n 10 jacobian 1 1.0 1 0.9 0.7 1.5 0.3 0\n", "jacobian_ratio must be below 1");
}

}  // namespace
}  // namespace quadrille
