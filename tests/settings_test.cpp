/// The table of settings: each has a place of its own, takes what it says and refuses what lies outside.

#include <gtest/gtest.h>
#include <cmath>
#include <nlohmann/json.hpp>

#include "geometry/base/error.hpp"
#include "mesher/settings.hpp"

namespace quadrille {
namespace {

/// A text that the setting takes and that is not what it has by default.
std::vector<std::string> other_text(const Setting& setting) {
  static const std::map<std::string_view, std::string> by_name = {
      {"chord_error", "2%"},
      {"size_in", "sphere:0,0,0,1=0.5"},
      {"segments", "Edge4=20"},
      {"bias", "Edge4=1.2"},
      {"bias_both", "Edge4=1.2"},
      {"keep", "Edge7"},
      {"nodes_at", "Tip=1,-2.5,3"},
      {"order", "1"},
      {"nodes", "9"},
      {"rings", "2"},
  };
  if (const auto found = by_name.find(setting.name); found != by_name.end()) return {found->second};
  const std::string_view kind = setting.kind();
  if (kind == "number" || kind == "count") return {"7"};
  if (kind == "flag") return {"true"};
  if (kind == "choice") return {std::string(setting.choices().back())};
  if (kind == "file") return {"sizes.vdb"};
  if (kind == "names") return {"Face7"};
  if (kind == "sizes") return {"Face3=0.5"};
  return {std::string(setting.choices().front())};  // words
}

TEST(Settings, EachHasAPlaceOfItsOwn) {
  const Settings before;
  for (const Setting& setting : all_settings()) {
    SCOPED_TRACE(setting.name);
    Settings after;
    const SettingValue wanted = parse(setting, other_text(setting));
    assign(after, setting, wanted);
    EXPECT_EQ(setting.value(after), wanted);
    for (const Setting& other : all_settings()) {
      if (&other == &setting) continue;
      const SettingValue was = other.value(before), is = other.value(after);
      const bool both_nan = std::holds_alternative<double>(was) && std::isnan(std::get<double>(was)) &&
                            std::isnan(std::get<double>(is));
      EXPECT_TRUE(both_nan || was == is) << other.name << " changed with it";
    }
  }
}

TEST(Settings, NumbersOutsideTheLimitsAreRefused) {
  int limits = 0;
  for (const Setting& setting : all_settings()) {
    if (setting.kind() != "number" && setting.kind() != "count") continue;
    SCOPED_TRACE(setting.name);
    Settings settings;
    const auto refuses = [&](double value) {
      try {
        assign(settings, setting, value);
        return false;
      } catch (const Error& error) {
        return error.subject() == setting.name;
      }
    };
    ++limits;
    EXPECT_TRUE(refuses(std::nextafter(setting.range.low, -INFINITY)));
    EXPECT_EQ(refuses(setting.range.low), setting.range.above_low);
    EXPECT_TRUE(refuses(std::numeric_limits<double>::quiet_NaN()));
    if (std::isfinite(setting.range.high)) {
      EXPECT_FALSE(refuses(setting.range.high));
      EXPECT_TRUE(refuses(setting.range.high + 1));
    }
  }
  EXPECT_GT(limits, 10);
}

}  // namespace
}  // namespace quadrille
