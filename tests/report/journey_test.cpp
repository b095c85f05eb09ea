// SPDX-License-Identifier: GPL-3.0-or-later
// The map of a journey on a run's page: read as a reader does, from its labelled lines. And the words of a run whose reference is the
// laboratory that stays.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <regex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "earthtop/report/report.hpp"
#include "earthtop/results/results.hpp"
#include "earthtop/run.hpp"
#include "report/track_map.hpp"
#include "support/page_data.hpp"
#include "support/temporary_directory.hpp"

namespace earthtop {
namespace {

using report::Track;
using testing::TemporaryDirectory;

constexpr double kDegree = std::numbers::pi / 180;

/// A line of the graticule: its number of degrees, and where it is (px).
struct Labelled {
  double deg, px;
};
struct Point {
  double x, y;
};

/// Numbers that can be read off a map.
struct SeenMap {
  std::vector<Labelled> parallels, meridians;
  std::vector<std::vector<Point>> way;
  Point start{}, end{};
  double left = 0, top = 0, width = 0, height = 0;  ///< of the frame
  double bar_px = 0, bar_m = 0;

  explicit SeenMap(const std::string& svg) {
    static const std::regex kLabel(
        "<text x=\"([-0-9.]+)\" y=\"([-0-9.]+)\" text-anchor=\"(end|middle)\">([0-9.]+)°(?: ([NSEW]))?</text>");
    for (std::sregex_iterator at(svg.begin(), svg.end(), kLabel), last; at != last; ++at) {
      const std::string side = (*at)[5];
      const double deg = std::stod((*at)[4]) * (side == "S" || side == "W" ? -1 : 1);
      if ((*at)[3] == "end")
        parallels.push_back({deg, std::stod((*at)[2]) - 4});  // the baseline is below the line's middle
      else
        meridians.push_back({deg, std::stod((*at)[1])});
    }
    for (std::size_t i = 1; i < meridians.size(); ++i)  // the date line
      meridians[i].deg += 360 * std::ceil((meridians[i - 1].deg - meridians[i].deg) / 360);
    const std::string path = testing::between(
        svg, "<path id=\"track" + std::string(svg.find("id=\"track-") != svg.npos ? "-narrow" : "") + "\" d=\"", "\"");
    std::string numbers = path;
    for (char& c : numbers)
      if (c == 'M' || c == 'L') c = ' ';
    std::istringstream read(numbers);
    for (const char c : path)
      if (Point p{}; c == 'M' || c == 'L') {
        read >> p.x >> p.y;
        if (c == 'M') way.emplace_back();
        way.back().push_back(p);
      }
    static const std::regex kCircle("<circle cx=\"([-0-9.]+)\" cy=\"([-0-9.]+)\" r=\"(7|4)\"");
    std::sregex_iterator circle(svg.begin(), svg.end(), kCircle);
    start = {std::stod((*circle)[1]), std::stod((*circle)[2])}, ++circle;
    end = {std::stod((*circle)[1]), std::stod((*circle)[2])};
    static const std::regex kFrame(
        "<rect class=\"et-frame\"[^>]* x=\"([0-9.]+)\" y=\"([0-9.]+)\" width=\"([0-9.]+)\" height=\"([0-9.]+)\"");
    std::smatch frame;
    EXPECT_TRUE(std::regex_search(svg, frame, kFrame));
    left = std::stod(frame[1]), top = std::stod(frame[2]), width = std::stod(frame[3]), height = std::stod(frame[4]);
    static const std::regex kBar("v8h([0-9.]+)v-8\"[^>]*/>\n<text[^>]*>([0-9.e+-]+) (km|m|mm)</text>");
    std::smatch bar;
    EXPECT_TRUE(std::regex_search(svg, bar, kBar));
    bar_px = std::stod(bar[1]), bar_m = std::stod(bar[2]) * (bar[3] == "km" ? 1e3 : bar[3] == "mm" ? 1e-3 : 1);
  }
  double per_north() const {
    return (parallels.front().px - parallels.back().px) / (parallels.back().deg - parallels.front().deg);
  }
  double per_east() const {
    return (meridians.back().px - meridians.front().px) / (meridians.back().deg - meridians.front().deg);
  }
  double latitude(Point p) const { return parallels.front().deg + (parallels.front().px - p.y) / per_north(); }
  double longitude(Point p) const { return meridians.front().deg + (p.x - meridians.front().px) / per_east(); }
};

/// A straight track through a few points, degrees beside its start.
Track track_through(double latitude_deg, double longitude_deg, const std::vector<std::array<double, 2>>& north_east) {
  Track track;
  track.title = "a track", track.start_latitude_deg = latitude_deg, track.start_longitude_deg = longitude_deg;
  for (std::size_t i = 1; i < north_east.size(); ++i)
    for (int k = i > 1 ? 1 : 0; k <= 100; ++k) {
      track.north_deg.push_back(north_east[i - 1][0] + (north_east[i][0] - north_east[i - 1][0]) * k / 100);
      track.east_deg.push_back(north_east[i - 1][1] + (north_east[i][1] - north_east[i - 1][1]) * k / 100);
    }
  track.radius_m = 6371e3;
  return track;
}

double turns_apart(double a, double b) { return std::remainder(a - b, 360.0); }

constexpr double kPixels = 0.2;  // places have a tenth of a pixel, scales two of them over a graticule

// Whatever the size and the place of a track: who reads start and end by the labelled lines finds the true ones, the way stays in its
// frame, the frame is a map and no line, and degrees of longitude are narrower by the cosine of the middle latitude.
TEST(TrackMap, TheLabelledLinesTellWhereATrackIs) {
  const std::vector<Track> tracks = {
      track_through(45, 8, {{0, 0}, {4.5e-4, 2e-4}}),           // 50 m
      track_through(45, 8, {{0, 0}, {0.45, 1.1}, {0.9, 0.2}}),  // 100 km
      track_through(-18, 178, {{0, 0}, {3.7, 10.5}}),           // across the date line, eastward
      track_through(-18, -178, {{0, 0}, {-3.7, -10.5}}),        // and westward
      track_through(0.3, -0.2, {{0, 0}, {-1, 0.7}}),            // across the equator and the meridian of Greenwich
      track_through(89.7, 20, {{0, 0}, {0.19, 60}}),            // near the pole
      track_through(-89.7, 20, {{0, 0}, {-0.19, 60}}),
      track_through(60, 20, {{0, 0}, {0, 5}}),      // along a parallel
      track_through(60, 20, {{0, 0}, {5, 0}}),      // along a meridian
      track_through(-80, 20, {{0, 0}, {160, 0}}),   // along nearly all of it
      track_through(10, 5, {{0, 0}, {20, 350}}),    // nearly round the world
      track_through(45, 8, {{0, 0}, {3e-8, 1e-8}})  // 3 mm
  };
  for (const Track& track : tracks) {
    ASSERT_TRUE(report::has_map(track));
    const report::Drawings drawings = report::track_svg(track);
    for (const std::string& svg : {drawings.wide, drawings.narrow}) {
      SCOPED_TRACE(svg.substr(0, 100) + std::to_string(track.start_latitude_deg) + " " +
                   std::to_string(track.north_deg.back()));
      const SeenMap map(svg);
      ASSERT_GE(map.parallels.size(), 2U);
      ASSERT_GE(map.meridians.size(), 2U);
      ASSERT_EQ(map.way.size(), 1U);
      for (const auto& [seen, i] : {std::pair{map.start, std::size_t{0}}, {map.end, track.north_deg.size() - 1}}) {
        EXPECT_NEAR((map.latitude(seen) - track.start_latitude_deg - track.north_deg[i]) * map.per_north(), 0, kPixels);
        EXPECT_NEAR(turns_apart(map.longitude(seen), track.start_longitude_deg + track.east_deg[i]) * map.per_east(), 0,
                    kPixels);
      }
      EXPECT_NEAR(map.way.front().front().x, map.start.x, kPixels);
      EXPECT_NEAR(map.way.front().back().y, map.end.y, kPixels);
      for (const Point& p : map.way.front()) {
        EXPECT_GE(std::min(p.x - map.left, p.y - map.top), 0);
        EXPECT_GE(std::min(map.left + map.width - p.x, map.top + map.height - p.y), 0);
      }
      EXPECT_GE(std::min(map.width, map.height), 160);
      const double middle = track.start_latitude_deg + track.north_deg.back() / 2,
                   across = (map.meridians.back().px - map.meridians.front().px);
      EXPECT_NEAR(map.per_east() / map.per_north() / std::cos(middle * kDegree), 1, 2 * kPixels / std::min(across, 40.0));
      EXPECT_NEAR(map.bar_px / (map.bar_m / (6371e3 * std::cos(middle * kDegree) * kDegree) * map.per_east()), 1,
                  2 * kPixels / std::min(across, 40.0));
      EXPECT_LE(map.left + map.bar_px, map.left + map.width);
      EXPECT_EQ(svg.find("nan"), svg.npos);
    }
  }
}

// A track that goes round more than once comes back from the other side.
TEST(TrackMap, RoundTheWorldIsOneTurnOfIt) {
  const Track track = track_through(30, 10, {{0, 0}, {0, 800}});
  const report::Drawings drawings = report::track_svg(track);
  const SeenMap map(drawings.wide);
  EXPECT_EQ(map.way.size(), 3U);  // 180 deg to the edge, a whole turn, the rest
  EXPECT_NEAR(map.per_east() * 360, map.width, kPixels);
  EXPECT_NEAR(map.end.x - map.start.x, 80 * map.per_east(), kPixels);
  for (const auto& piece : map.way)
    for (const Point& p : piece) EXPECT_TRUE(p.x >= map.left - kPixels && p.x <= map.left + map.width + kPixels) << p.x;
  EXPECT_NEAR(map.way[1].back().x - map.way[1].front().x, map.width, kPixels);
}

TEST(TrackMap, LabelsAreSidesOfTheEarth) {
  EXPECT_EQ(report::latitude_text(-12.5, 1), "12.5° S");
  EXPECT_EQ(report::latitude_text(-1e-12, 0), "0°");
  EXPECT_EQ(report::longitude_text(190, 0), "170° W");
  EXPECT_EQ(report::longitude_text(-190, 0), "170° E");
  EXPECT_EQ(report::longitude_text(-540, 0), "180°");
  EXPECT_EQ(report::longitude_text(360, 1), "0.0°");
}

std::string page_with(const std::string& travel, const std::string& more = "") {
  const TemporaryDirectory dir;
  const std::string text = R"({ "name": "aboard", "site": { "latitude_deg": 45, "longitude_deg": 179.9, "height_m": 100 },
    "body": { "mass_kg": 0.1, "center_of_mass_m": [0, 0, 0.03], "inertia": { "about": "pivot", "principal_kg_m2": [1.2e-4, 1.2e-4, 4e-5] } },
    "release": { "tilt_deg": 20, "azimuth_deg": 90, "spin_rad_s": 200 }, "travel": )" +
                           travel + R"(, "motion": { "duration_s": 4, "output_step_s": 2 } })";
  Overrides changes;
  if (!more.empty()) changes.emplace_back("/motion/output_step_s", more);
  write_results(run(parse_scenario({"aboard", text}, changes)), dir.path() / "run", false);
  const Report page = make_report(dir.path() / "run");
  for (const auto& [name, picture] : page.pictures)
    if (name == "journey") return page.html + picture;
  return page.html;
}

// The page's map is that of the scenario's journey: along a meridian from 45 degrees at 1,000 m/s, of which four seconds are 4 km. Of how many
// rows were asked for nothing is seen.
TEST(JourneySection, TheMapComesFromTheJourney) {
  const std::string page = page_with(R"({ "path": "rhumb", "course_deg": 0, "speed_m_s": 1000 })");
  ASSERT_NE(page.find("<section id=\"section-journey\""), page.npos);
  EXPECT_NE(page.find("<desc>4 km from 45.0000° N, 179.9000° E to 45.0360° N, 179.9000° E, on a constant course</desc>"),
            page.npos);
  EXPECT_LT(page.find("id=\"section-journey\""), page.find("id=\"section-protocol\""));
  const SeenMap map(page.substr(page.rfind("<svg")));
  constexpr double kMeridianRadius = 6367381.8156 + 100;  // of WGS 84 at 45 deg, a (1 - e^2)/(1 - e^2/2)^(3/2), and the height
  EXPECT_NEAR(map.latitude(map.end) - map.latitude(map.start), 4000 / kMeridianRadius / kDegree, kPixels / map.per_north());
  constexpr double kPrimeRadius = 6388838.2901 + 100;  // a/sqrt(1 - e^2/2)
  EXPECT_NEAR(map.bar_px / map.per_east() * kPrimeRadius * std::cos(45.018 * kDegree) * kDegree / map.bar_m, 1,
              2 * kPixels / map.bar_px);  // by the meridian's radius it would be 3.4e-3
  const auto picture = [](const std::string& whole) { return whole.substr(whole.rfind("<svg")); };
  EXPECT_EQ(picture(page), picture(page_with(R"({ "path": "rhumb", "course_deg": 0, "speed_m_s": 1000 })", "0.01")));
}

TEST(JourneySection, AJourneyThatLeadsNowhereHasNoMap) {
  for (const char* travel :
       {R"({ "path": "rhumb", "course_deg": 0, "speed_m_s": 0 })",
        R"({ "path": "geodesic", "course_deg": 0, "speed_m_s": 0, "legs": [ { "duration_s": 4, "climb_m": 20 } ] })"})
    EXPECT_EQ(page_with(travel).find("section-journey"), std::string::npos) << travel;
}

// Against the laboratory that stays, the page speaks of the journey wherever it speaks of the Earth's rotation otherwise.
TEST(JourneySection, TheWordsAreThoseOfTheReference) {
  const std::string journey = R"({ "path": "rhumb", "course_deg": 0, "speed_m_s": 100, "reference": ")";
  const std::string at_rest = page_with(journey + "at_rest\" }"), same_path = page_with(journey + "same_path\" }");
  const std::vector<std::array<std::string, 2>> pairs = {
      {"s the journey turns this top's axis ", "s the Earth turns this top's axis "},
      {"from where it would be if the laboratory had stayed", "from where it would be if the Earth did not turn"},
      {"from where the prediction for the laboratory that stays at the place of release puts it",
       "from where the non-rotating prediction puts it"},
      {"Travelling minus resting laboratory; same", "Rotating minus non-rotating Earth; same"},
      {"Travelling against resting laboratory; same", "Rotating against non-rotating Earth; same"},
      {"The top in motion, with the journey and without,", "The top in motion, with the Earth&#39;s rotation and without,"},
      {"\"cause\":\"the journey\"", "\"cause\":\"the Earth's rotation\""},
      {">without the journey<", ">without the Earth&#39;s rotation<"}};
  for (const auto& [of_journey, of_rotation] : pairs) {
    EXPECT_NE(at_rest.find(of_journey), at_rest.npos) << of_journey;
    EXPECT_NE(same_path.find(of_rotation), same_path.npos) << of_rotation;
    EXPECT_EQ(at_rest.find(of_rotation), at_rest.npos) << of_rotation;
    EXPECT_EQ(same_path.find(of_journey), same_path.npos) << of_journey;
  }
  EXPECT_EQ(at_rest.find("on-rotating"), at_rest.npos);
}

}  // namespace
}  // namespace earthtop
