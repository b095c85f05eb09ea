// SPDX-License-Identifier: GPL-3.0-or-later
// The still of the top: what it draws is where it says, by a projection of the test's own.
#include "report/top_still.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <regex>
#include <string>
#include <vector>

namespace earthtop::report {
namespace {

std::array<double, 3> direction(double tilt_deg, double azimuth_deg) {
  const double tilt = tilt_deg * std::numbers::pi / 180, azimuth = azimuth_deg * std::numbers::pi / 180;
  return {std::sin(tilt) * std::sin(azimuth), std::sin(tilt) * std::cos(azimuth), std::cos(tilt)};
}

struct Segment {
  double x0, y0, x1, y1;
};

/// The straight lines of one colour and width.
std::vector<Segment> lines_in(const std::string& picture, const std::string& stroke) {
  const std::regex line("<path d=\"M([-0-9.]+) ([-0-9.]+)L([-0-9.]+) ([-0-9.]+)\" fill=\"none\" stroke=\"" + stroke + "\"");
  std::vector<Segment> found;
  for (std::sregex_iterator at(picture.begin(), picture.end(), line), end; at != end; ++at)
    found.push_back({std::stod((*at)[1]), std::stod((*at)[2]), std::stod((*at)[3]), std::stod((*at)[4])});
  return found;
}

TEST(TopStill, MagnifiesByARoundFactorThatIsSeen) {
  TopStill still;
  still.ref_axis_L = direction(20, 30);
  for (const auto& [apart_deg, factor] : {std::pair{0.06, 100.0}, {0.6, 10.0}, {1e-7, 1e8}, {30.0, 1.0}, {0.0, 1.0}}) {
    still.axis_L = direction(20 + apart_deg, 30);
    EXPECT_DOUBLE_EQ(magnification(still), factor) << apart_deg;
  }
}

// The eye looks from the South, turned by 0.6 rad to the East, and 0.35 rad above the ground: North is up and to the right of the pivot.
TEST(TopStill, DrawsBothAxesWhereTheyPoint) {
  TopStill still{"t", "s", direction(26, 90), direction(20, 90), {0, 1, 1}, true, false};  // 6 degrees: drawn as they are
  const std::string picture = top_still_svg(still).wide;
  ASSERT_EQ(magnification(still), 1);
  const auto own = lines_in(picture, "#d55e00"), twin = lines_in(picture, "#0072b2");
  ASSERT_EQ(own.size(), 2U) << "below the disc and above it";
  ASSERT_EQ(twin.size(), 1U);
  const double length = 1.15 * 0.46 * std::min(0.78 * 640, 420.0);
  const auto seen = [&](double tilt_deg) {
    const auto [east, north, up] = direction(tilt_deg, 90);
    return std::pair{length * (east * std::cos(0.6) + north * std::sin(0.6)),
                     length * (up * std::cos(0.35) + std::sin(0.35) * (north * std::cos(0.6) - east * std::sin(0.6)))};
  };
  constexpr double kPixel = 0.11;  // coordinates have one decimal
  EXPECT_NEAR(twin[0].x1 - twin[0].x0, seen(20).first, kPixel);
  EXPECT_NEAR(twin[0].y0 - twin[0].y1, seen(20).second, kPixel);
  EXPECT_NEAR(own[1].x1 - own[0].x0, seen(26).first, kPixel);
  EXPECT_NEAR(own[0].y0 - own[1].y1, seen(26).second, kPixel);
}

TEST(TopStill, LeavesOutWhatThereIsNot) {
  TopStill still{"t", "s", direction(20, 0), direction(20, 0), {0, 0, 0}, false, true};
  const std::string picture = top_still_svg(still).narrow;
  EXPECT_EQ(picture.find("Earth&#39;s axis"), picture.npos);
  EXPECT_EQ(picture.find("nan"), picture.npos);
  EXPECT_EQ(picture.find("dasharray=\"1 4\""), picture.npos) << "no cone";
}

}  // namespace
}  // namespace earthtop::report
