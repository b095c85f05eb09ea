// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/journey_section.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "earthtop/elementary.hpp"
#include "earthtop/frames/earth.hpp"
#include "earthtop/frames/journey.hpp"
#include "earthtop/model/model.hpp"
#include "report/path_picture.hpp"
#include "report/track_map.hpp"
#include "text/number_words.hpp"

namespace earthtop::report {
namespace {

/// Times of a journey that follow each turn of it: as many between two of its joints as tell a curve of a few radians.
std::vector<double> times_along(const Journey<double>& journey, double duration_s) {
  constexpr std::size_t kMost = 200'000, kMostBetween = 64;
  std::vector<double> joints = journey.joints(), times{0};
  joints.push_back(duration_s);
  const std::size_t between = std::clamp<std::size_t>(kMost / joints.size(), 1, kMostBetween);
  for (const double joint : joints) {
    const double from = times.back();
    for (std::size_t k = 1; k <= between; ++k)
      times.push_back(from + (joint - from) * static_cast<double>(k) / static_cast<double>(between));
  }
  return times;
}

/// A way, and some places on it for the table.
struct Way {
  Track track;
  struct Place {
    double t_s, latitude_deg, longitude_deg, height_m, course_deg, speed_m_s;
  };
  std::vector<Place> listed;
};

Way way_of(const Scene& scene) {
  const Journey<double>& journey = scene.model<double>().journey;
  const double duration_s = scene.scenario().duration_s;
  Way way;
  way.track.start_latitude_deg = scene.site().latitude_deg, way.track.start_longitude_deg = scene.site().longitude_deg;
  constexpr double kPerRadian = 180 / std::numbers::pi;
  // From the differences, which keep the digits of a way of millimetres.
  for (const double t : times_along(journey, duration_s)) {
    const Vec3<double> moved = journey.at(JourneyPart::place, t);
    way.track.north_deg.push_back(moved[0] * kPerRadian), way.track.east_deg.push_back(moved[1] * kPerRadian);
  }
  constexpr int kListed = 20;  // stretches of equal time
  for (int i = 0; i <= kListed; ++i) {
    const double t = duration_s * i / kListed;
    const JourneyPlace<double> at = journey.place(t);
    way.listed.push_back({t, at.latitude_deg, at.longitude_deg, at.height_m, at.course_deg, at.speed_m_s});
  }
  return way;
}

/// The same of results whose scenario names a file with its journey, which a page does not open: their rows.
Way way_of_rows(const Motion& motion) {
  Way way;
  const std::size_t latitude = column("latitude_deg"), longitude = column("longitude_deg"), height = column("height_m"),
                    course = column("course_deg"), speed = column("speed_m_s");
  constexpr double kFarthest_deg = 1e9;  // of longitudes that are counted on
  for (const compare::Row& row : motion.rows) {
    const Way::Place at{row.t_s,          value(row, latitude), value(row, longitude), value(row, height), value(row, course),
                        value(row, speed)};
    if (!(std::abs(at.latitude_deg) <= 90 && std::abs(at.longitude_deg) <= kFarthest_deg)) continue;
    way.listed.push_back(at);
    way.track.north_deg.push_back(at.latitude_deg - way.listed.front().latitude_deg);
    way.track.east_deg.push_back(at.longitude_deg - way.listed.front().longitude_deg);
  }
  if (way.listed.empty()) return way;
  way.track.start_latitude_deg = way.listed.front().latitude_deg,
  way.track.start_longitude_deg = way.listed.front().longitude_deg;
  return way;
}

/// The radius of the parallel at a latitude, over its cosine (m).
double parallel_radius(const Run& run, double latitude_deg, double height_m) {
  if (run.word("/scenario/travel/figure") == "sphere")
    return run.number("/scenario/travel/radius_m").value_or(TravelSpec{}.radius_m) + height_m;
  const SinCos<double> phi = sin_cos_degrees(latitude_deg);
  const Vec3<double> place_L = geocentric_position_L(latitude_deg, height_m);
  return (phi.cos * place_L[2] - phi.sin * place_L[1]) / phi.cos;
}

/// A length with four digits, and without a power of ten where it goes round the Earth.
std::string length_words(double m) {
  const double unit = real::power_of_ten(static_cast<int>(std::floor(real::log10(m))) - 3);
  return length_text(unit * std::floor(m / unit + 0.5), 9);
}

std::string_view path_words(const Run& run) {
  const std::string path = run.word("/scenario/travel/path");
  if (path == "table") return "as its table says";
  for (std::size_t i = 0; run.number(fmt::format("/scenario/travel/legs/{}/duration_s", i)); ++i)
    if (run.number(fmt::format("/scenario/travel/legs/{}/turn_deg", i)).value_or(0) != 0) return "with turns";
  return path == "rhumb" ? "on a constant course" : "on the straightest line";
}

}  // namespace

void add_journey(const Run& run, Page& page) {
  const auto length_m = run.number("/travel/length_m");
  constexpr double kLeast_m = 1e-9;
  if (!length_m || !(*length_m > kLeast_m)) return;
  const bool is_of_journey = run.scene && run.scene->scenario().travel;
  Way way = is_of_journey ? way_of(*run.scene) : way_of_rows(run.listed);
  if (way.listed.empty()) return;
  Track& track = way.track;
  const Way::Place &start = way.listed.front(), &end = way.listed.back();
  const double middle_deg = middle_latitude_deg(track);
  track.radius_m = parallel_radius(run, middle_deg, std::isfinite(start.height_m) ? start.height_m : 0);
  if (!has_map(track)) return;
  track.title = "The way of the laboratory";
  track.subtitle = fmt::format("{} from {} to {}, {}", length_words(*length_m), place_text(track, 0, 0),
                               place_text(track, track.north_deg.back(), track.east_deg.back()), path_words(run));
  if (end.height_m != start.height_m)
    track.subtitle += fmt::format(", from {:.4g} m to {:.4g} m of height", start.height_m, end.height_m);

  std::vector<std::vector<std::string>> rows;
  for (const Way::Place& at : way.listed) {
    rows.push_back({fmt::format("{:.7g}", at.t_s * run.time.per_s)});
    for (const double number : {at.latitude_deg, at.longitude_deg, at.height_m, at.course_deg, at.speed_m_s})
      rows.back().push_back(fmt::format("{:.10g}", number));
  }
  std::string caption = fmt::format("Courses are angles of this map, and its bar is true from West to East, at latitude {}.",
                                    latitude_text(middle_deg, 1));
  if (!is_of_journey) caption += " Drawn through the output rows.";
  page.section("journey", "The journey",
               page.picture("journey", track_svg(track), caption,
                            table_html({fmt::format("Time ({})", run.time.name), "Latitude (degrees)", "Longitude (degrees)",
                                        "Height (m)", "Course (degrees)", "Speed (m/s)"},
                                       rows)));
}

}  // namespace earthtop::report
