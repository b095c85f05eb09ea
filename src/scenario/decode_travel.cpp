// SPDX-License-Identifier: GPL-3.0-or-later
// Decodes the journey of the laboratory, and checks that the other sections allow one.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "earthtop/frames/angle_spline.hpp"
#include "earthtop/real.hpp"
#include "scenario/decode.hpp"
#include "scenario/filed_table.hpp"
#include "scenario/reading.hpp"
#include "scenario/rules.hpp"
#include "scenario/travel_keys.hpp"
#include "text/number_words.hpp"

namespace earthtop::scenario {
namespace {

constexpr std::size_t kMostLegs = 10'000;
constexpr double kFastest = 1e5;    ///< m/s
constexpr double kPeak = 15.0 / 8;  ///< of the rate of x^3 (10 - 15 x + 6 x^2), over its mean
constexpr double kStandardGravity = 9.80665;

/// Checks that the path has the keys it needs and no other. @returns whether that is so
bool check_keys_of_path(const Section& travel, const TravelRule& rule) {
  bool good = true;
  for (const std::string_view key : split_words(kTravelKeys)) {
    if (lists(rule.required, key)) good = travel.require(key) && good;
    if (lists(rule.allowed, key) || !travel.has(key)) continue;
    travel.refuse_key(key, fmt::format("does not belong to the path \"{}\"; allowed with it: {}", rule.word,
                                       fmt::join(split_words(rule.allowed), ", ")));
    good = false;
  }
  if (rule.value == TravelPath::table || travel.has("speed_m_s") || travel.has("speed_kn")) return good;
  if (!travel.expects("speed_kn"))
    travel.missing("speed_m_s",
                   "neither speed_m_s nor speed_kn is given; give exactly one: 0 where the journey begins at rest");
  return false;
}

/// Checks that a journey or a leg has at most one speed. @returns whether that is so
bool check_speed(const Section& moving) {
  if (!moving.has("speed_m_s") || !moving.has("speed_kn")) return true;
  moving.refuse_key("speed_kn", "speed_m_s and speed_kn are both given; give exactly one");
  return false;
}

/// @returns whether all legs are complete
bool decode_legs(const Section& travel, TravelSpec& spec) {
  const std::size_t count = travel.size("legs");
  if (count > kMostLegs) {
    travel.refuse("legs", fmt::format("has {} legs; at most {} are allowed: a long record is a table", count, kMostLegs));
    return false;
  }
  bool good = true;
  for (std::size_t i = 0; i < count; ++i) {
    const Section leg = travel.element("legs", i);
    Reading codec(leg);
    leg_keys(codec, spec.legs.emplace_back());
    good = check_speed(leg) && codec.complete() && good;
  }
  return good;
}

/// Warns of legs that are faster than vehicles.
void warn_of_legs(const Section& travel, const TravelSpec& spec) {
  constexpr double kFastTurn = 10;  // deg/s
  double speed = spec.speed_m_s;
  for (std::size_t i = 0; i < spec.legs.size(); ++i) {
    const TravelLeg& leg = spec.legs[i];
    const double before = std::exchange(speed, leg.speed_m_s.value_or(speed));
    const double turn = kPeak * std::abs(leg.turn_deg) / leg.duration_s;
    const double acceleration = kPeak * std::abs(speed - before) / leg.duration_s;
    const Section section = travel.element("legs", i);
    if (turn > kFastTurn)
      section.warn("turn_deg",
                   fmt::format("the course turns at up to {} deg/s, as no ship or aircraft does; is the duration in "
                               "seconds?",
                               told_apart(turn, kFastTurn, 3).first));
    if (acceleration > kStandardGravity)
      section.warn(
          section.has("speed_kn") ? "speed_kn" : "speed_m_s",
          fmt::format("from {:.4g} to {:.4g} m/s the laboratory accelerates at up to {} m/s^2, more than a free fall; is "
                      "the duration in seconds?",
                      before, speed, told_apart(acceleration, kStandardGravity, 3).first));
  }
}

/// The largest acceleration of the spline through a table's places, without what the Earth's curvature makes (m/s^2). Each component is
/// linear between rows, so that it is largest at one of them.
double largest_acceleration(const TravelSpec& spec) {
  const std::array<double, 3> metres = metres_a_unit(spec);
  const std::array splines{AngleSpline<double>(*spec.table[0].rows), AngleSpline<double>(*spec.table[1].rows),
                           AngleSpline<double>(*spec.table[2].rows)};
  double largest = 0;
  for (const double t : spec.table[0].rows->t_s)
    largest = std::max(largest, real::hypot(metres[0] * splines[0].angle_acceleration(t),
                                            metres[1] * splines[1].angle_acceleration(t), splines[2].angle_acceleration(t)));
  return largest;
}

/// Warns of a table that accelerates as no vehicle does, and of one whose digits are too few for the accelerations that its spline makes
/// of them.
void warn_of_table(const Section& travel, const TravelSpec& spec) {
  if (spec.path != TravelPath::table) return;
  if (const double acceleration = largest_acceleration(spec); acceleration > kStandardGravity)
    travel.warn("file",
                fmt::format("between its places the laboratory accelerates at up to {} m/s^2, more than a free fall; are the "
                            "times in seconds, and the places in degrees and metres?",
                            told_apart(acceleration, kStandardGravity, 3).first));
  constexpr double kNoisy = 1e-3;  // m/s^2
  const double noise = noise_of_table_m_s2(spec);
  if (!(noise > kNoisy)) return;
  travel.warn("file",
              fmt::format("an error of one unit in the last digit of its places is an acceleration of about {} m/s^2 between "
                          "rows that are as near as these; give more digits, or rows that are farther apart",
                          told_apart(noise, kNoisy, 2).first));
}

/// Checks the places of a table and the way from one to the next. @returns whether they can be travelled
bool check_places(const Section& travel, const TravelSpec& spec) {
  constexpr std::size_t kLongestShownPath = 200;
  constexpr double kDegree = std::numbers::pi / 180, kLowest = -12000, kHighest = 1e6, kTurn = 360;
  const auto refuse = [&](std::size_t row, const std::string& why) {
    travel.refuse("file", fmt::format("{}:{}: {}", excerpt(spec.table[0].file, kLongestShownPath), row + 2, why));
    return false;
  };
  const std::vector<double>&t = spec.table[0].rows->t_s, &latitude = spec.table[0].rows->value,
        &longitude = spec.table[1].rows->value, &height = spec.table[2].rows->value;
  if (std::abs(longitude[0]) > kTurn)
    return refuse(0, fmt::format("longitude_deg is {}; must be from -360 to 360", longitude[0]));
  const double radius = spec.figure == TravelFigure::sphere ? spec.radius_m : kEquatorialRadiusWgs84;
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (std::abs(latitude[i]) > kLargestLatitudeDeg)
      return refuse(i,
                    fmt::format("latitude_deg is {}; East and North lose their meaning near a pole: must be from -89.9 to 89.9",
                                latitude[i]));
    if (height[i] < kLowest || height[i] > kHighest)
      return refuse(i, fmt::format("height_m is {}; must be from -12000 to 1e6", height[i]));
    if (i == 0) continue;
    const double north = (latitude[i] - latitude[i - 1]) * kDegree * radius;
    const double east = (longitude[i] - longitude[i - 1]) * kDegree * radius * real::cos(latitude[i] * kDegree);
    const double speed = real::hypot(north, east, height[i] - height[i - 1]) / (t[i] - t[i - 1]);
    if (speed > kFastest)
      return refuse(i, fmt::format("is reached at about {} m/s from the row before; at most {:g} are allowed: are the times in "
                                   "seconds, and the places in degrees and metres?",
                                   told_apart(speed, kFastest, 3).first, kFastest));
  }
  return true;
}

/// @returns whether the journey ever leads away from the site
bool leads_away(const TravelSpec& spec) {
  for (const FiledTable& column : spec.table)
    if (column.rows && std::ranges::any_of(column.rows->value, [&](double x) { return x != column.rows->value.front(); }))
      return true;
  return spec.speed_m_s != 0 || std::ranges::any_of(spec.legs, [](const TravelLeg& leg) {
           return leg.speed_m_s.value_or(0) != 0 || leg.climb_m != 0;
         });
}

}  // namespace

double m_s_from_knots(double knots) { return static_cast<double>(float128(knots) * float128(1852) / float128(3600)); }

std::optional<TravelSpec> decode_travel(const Section& root, const ScenarioSource& source, double duration_s) {
  if (!root.is_object("travel")) return std::nullopt;
  const Section travel = root.section("travel");
  TravelSpec spec;
  Reading codec(travel);
  travel_keys(codec, spec);
  bool good = codec.complete() && travel.word("path").has_value();
  good = check_speed(travel) && good;
  good = decode_legs(travel, spec) && good;
  if (travel.word("path")) good = check_keys_of_path(travel, row_of(kTravelPaths, spec.path)) && good;
  if (travel.has("radius_m") && travel.word("figure") && spec.figure != TravelFigure::sphere) {
    travel.refuse_key("radius_m", "belongs to the figure \"sphere\", and the figure is \"wgs84\"; leave one of the two out");
    good = false;
  }
  if (spec.reference == TravelReference::at_rest && spec.eotvos == TravelEotvos::both) {
    travel.refuse(
        "eotvos",
        "is \"both\", and the reference \"at_rest\" stays where it is and has no Eotvos term; must be \"rotating\" or "
        "\"off\", or take the reference \"same_path\"");
    good = false;
  }
  if (spec.path == TravelPath::table && travel.word("path")) {
    decode_table(travel, source, duration_s, kTableOfJourney, spec.table);
    good = spec.table[0].rows && check_places(travel, spec) && good;
  }
  if (!good) return std::nullopt;
  warn_of_legs(travel, spec);
  warn_of_table(travel, spec);
  if (spec.reference == TravelReference::at_rest && !leads_away(spec))
    travel.warn(
        "reference",
        "is \"at_rest\", and the journey leads nowhere: both motions are the same; give a speed, or take \"same_path\"");
  return spec;
}

bool place_at_start(const Section& site, const TravelSpec& travel, Site& place) {
  bool good = true;
  const auto short_way = [](double turn_deg) { return turn_deg - 360 * std::round(turn_deg / 360); };
  const auto put = [&](std::string_view key, const FiledTable& column, double& value, double slack, bool is_circular) {
    const double start = AngleSpline<double>(*column.rows).angle(0);
    if (!site.has(key)) {
      value = is_circular && std::abs(start) > 360 ? short_way(start) : start;
      return;
    }
    const bool is_known = site.number(key).has_value();
    const bool same = std::abs(is_circular ? short_way(value - start) : value - start) <= slack;
    good = good && is_known && same;
    if (is_known && !same)
      site.refuse(key,
                  fmt::format("is {}, and the table of /travel begins at {} at t = 0; must be the same to {:g}, or leave it "
                              "out",
                              value, start, slack));
  };
  constexpr double kSameAngle = 1e-9, kSameHeight = 1e-6;
  put("latitude_deg", travel.table[0], place.latitude_deg, kSameAngle, false);
  put("longitude_deg", travel.table[1], place.longitude_deg, kSameAngle, true);
  put("height_m", travel.table[2], place.height_m, kSameHeight, false);
  return good;
}

namespace {

/// Checks that a vehicle that turns with its course has one, and turns about Up.
void check_vehicle(const Section& platform, const PlatformSpec& spec, const std::optional<TravelSpec>& travel) {
  if (!travel || travel->path == TravelPath::table)
    platform.refuse("motion",
                    fmt::format("is \"course\", and {}",
                                travel ? "a journey by a table has no course where it stands; give the angle as a table, "
                                         "or the journey by its course"
                                       : "there is no journey whose course the platform could turn with; give /travel, or "
                                         "another motion"));
  if (spec.axis[0] != 0 || spec.axis[1] != 0 || !(spec.axis[2] > 0))
    platform.refuse("axis", "is not upright, and a vehicle turns with its course about Up; leave it out");
}

}  // namespace

void check_beside_travel(const Section& root, const Scenario& scenario) {
  if (scenario.platform && scenario.platform->motion == PlatformMotion::course && (scenario.travel || !root.has("travel")))
    check_vehicle(root.section("platform"), *scenario.platform, scenario.travel);
  if (!root.has("travel")) return;
  const Section site = root.section("site"), effects = root.section("effects");
  const auto latitude = site.number("latitude_deg");
  if (latitude && std::abs(*latitude) > kLargestLatitudeDeg)
    site.refuse(
        "latitude_deg",
        fmt::format("is {}, and near a pole East and North turn too fast to travel by them; must be from -89.9 to 89.9 with "
                    "/travel",
                    *latitude));
  const EffectsSpec& given = scenario.effects;
  const auto refuse = [&](std::string_view key, bool acts, std::string_view why) {
    if (acts) effects.refuse_key(key, fmt::format("is not available with /travel: {}; leave one of the two out", why));
  };
  constexpr std::string_view kOnePlace = "it belongs to one place, and is not carried along";
  refuse("tide", given.tide.has_value(), kOnePlace);
  refuse("polar_motion", !(scenario.site.pole == PolarMotion{}), kOnePlace);
  refuse("deflection_of_vertical", !(scenario.site.deflection == VerticalDeflection{}), kOnePlace);
  refuse("excess_length_of_day_ms", scenario.excess_length_of_day_ms != 0,
         "a journey takes the rate as it is given; give the changed rate as /earth/rotation_rate_rad_s");
  const auto& gradient = given.applied.gravity_gradient;
  refuse("gravity_gradient", gradient && gradient->field == GradientField::normal,
         "the tensor of the normal field belongs to one place; take true, the radial term");
  for (const auto& [key, acts] : {std::pair("coriolis", given.coriolis), std::pair("centrifugal", given.centrifugal),
                                  std::pair("transverse", given.transverse)})
    refuse(key, !acts, "the rate of a laboratory that travels has a share in all three torques");
  refuse("gimbal", given.applied.gimbal.has_value(),
         "it holds the axis level in a laboratory at rest; take /gimbals, with the inner one locked");
  refuse("coulomb_torque_N_m", given.applied.coulomb_N_m != 0,
         "dry friction that brings a motion to rest is not modelled aboard; take viscous_torque_N_m_s");
  if (given.automatic) {
    constexpr const char* kAtRest =
        "\"auto\" sizes effects for a laboratory at rest, and /travel is given; name the effects instead";
    root.is_word("effects") ? root.refuse("effects", kAtRest) : effects.refuse("select", kAtRest);
  }
  if (root.has("contact"))
    root.refuse_key(
        "contact",
        "is not available with /travel: the table on which a top stands does not travel yet; leave one of the two out");
}

}  // namespace earthtop::scenario
