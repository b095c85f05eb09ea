// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/results/top_lines.hpp"

#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "earthtop/run.hpp"
#include "results/figures.hpp"
#include "text/json.hpp"

namespace earthtop {
namespace {

std::string listed(const std::array<double, 3>& numbers) {
  return fmt::format("{:.6g}, {:.6g}, {:.6g}", numbers[0], numbers[1], numbers[2]);
}
std::string in_rpm(double rad_s) { return fmt::format("{:.6g} rad/s ({:.6g} rpm)", rad_s, rad_s * 30 / std::numbers::pi); }
std::string with_period(double rad_s, std::string_view name) {
  const auto period = period_of(rad_s);
  return period ? fmt::format("{:.6g} rad/s, {} {:.6g} s", rad_s, name, *period) : fmt::format("{:.6g} rad/s", rad_s);
}
/// A rate of precession by its size and sense, so that no sign has to be explained.
std::string precession(double rad_s) {
  if (rad_s == 0) return "0 rad/s";
  return with_period(std::abs(rad_s), rad_s > 0 ? "counterclockwise from above, a turn in" : "clockwise from above, a turn in");
}

using Lines = std::vector<std::pair<std::string, std::string>>;

void add_gimbals(const TopFigures::OfGimbals& gimbals, Lines& lines) {
  lines.emplace_back(
      "gimbals", fmt::format("{:.6g} kg m² about the outer axis, {:.6g} kg m² about the inner one, without the rotor's spin",
                             gimbals.outer_moment_kg_m2, gimbals.inner_moment_kg_m2));
  constexpr double kDegrees = 180 / std::numbers::pi;
  if (gimbals.outer_rest_rad && gimbals.inner_rest_rad) {
    const auto degrees = [](double rad) { return std::round(rad * kDegrees * 1e6) / 1e6 + 0.0; };
    std::string swings = fmt::format("outer angle {:.6g} deg, inner angle {:.6g} deg", degrees(*gimbals.outer_rest_rad),
                                     degrees(*gimbals.inner_rest_rad));
    if (gimbals.slow_period_s) swings += fmt::format("; small undamped swings about it take {:.6g} s", *gimbals.slow_period_s);
    if (gimbals.slow_period_s && gimbals.fast_period_s) swings += fmt::format(" and {:.6g} s", *gimbals.fast_period_s);
    lines.emplace_back("place of rest", swings);
  }
  if (!gimbals.earth_torque_N_m) return;
  std::string imitates = fmt::format("a torque of {:.4g} N m", *gimbals.earth_torque_N_m);
  if (gimbals.earth_offset_m) imitates += fmt::format(", a centre of mass that is off by {:.4g} m", *gimbals.earth_offset_m);
  if (gimbals.earth_nutation_rad) imitates += fmt::format(", a nutation of {:.4g} deg", *gimbals.earth_nutation_rad * kDegrees);
  lines.emplace_back("like the Earth", imitates);
}

/// An angle from North, by its size and side.
std::string beside_north(double rad) {
  const double degrees = rad * 180 / std::numbers::pi;
  return degrees == 0 ? std::string("North")
                      : fmt::format("{:.4g} deg {} of North", std::abs(degrees), degrees > 0 ? "East" : "West");
}

/// A longitude from -180 to 180 deg.
double short_way(double longitude_deg) { return std::remainder(longitude_deg, 360.0); }

void add_journey(const JourneyFigures& journey, Lines& lines) {
  constexpr double kDegrees = 180 / std::numbers::pi, kHour = 3600;
  lines.emplace_back("journey", fmt::format("{:.6g} km, to latitude {:.6f} deg, longitude {:.6f} deg, height {:.6g} m",
                                            journey.length_m / 1000, journey.end_latitude_deg,
                                            short_way(journey.end_longitude_deg), journey.end_height_m));
  std::string rate = fmt::format("East, North and Up turn over the Earth at up to {:.4g} rad/s", journey.transport_rate_rad_s);
  if (journey.transport_over_earth) rate += fmt::format(", {:.3g} times the Earth's rate", *journey.transport_over_earth);
  lines.emplace_back("transport rate", rate);
  lines.emplace_back("plumb line", fmt::format("leans aboard by up to {:.4g} deg", journey.plumb_lean_rad * kDegrees));
  if (journey.false_north_start_rad && journey.false_north_end_rad) {
    const std::string start = beside_north(*journey.false_north_start_rad), end = beside_north(*journey.false_north_end_rad);
    lines.emplace_back("false North", "a damped level compass points to " +
                                          (start == end ? start : fmt::format("{} at the start, {} at the end", start, end)));
  }
  lines.emplace_back("wander",
                     fmt::format("a level free axis turns in azimuth by {:.4g} deg/h at the start, {:.4g} deg/h of it by the "
                                 "journey",
                                 journey.wander_rad_s * kDegrees * kHour, journey.transport_wander_rad_s * kDegrees * kHour));
  if (journey.table_noise_m_s2)
    lines.emplace_back("table", fmt::format("one unit in the last digit of its places is an acceleration of {:.2g} m/s^2",
                                            *journey.table_noise_m_s2));
  if (journey.schuler_kappa)
    lines.emplace_back("Schuler",
                       fmt::format("kappa = {:.4g}, 1 for a compass that no change of speed deflects; undamped period "
                                   "{:.4g} min",
                                   *journey.schuler_kappa, *journey.schuler_period_s / 60));
}

}  // namespace

std::vector<std::pair<std::string, std::string>> top_lines(const TopFigures& top) {
  std::vector<std::pair<std::string, std::string>> lines;
  lines.emplace_back("mass", fmt::format("{:.6g} kg", top.mass_kg));
  lines.emplace_back("centre of mass", fmt::format("({}) m from the pivot, body axes", listed(top.center_of_mass_m)));
  lines.emplace_back("I1, I2, I3", fmt::format("{} kg m² about the pivot", listed(top.moments_about_pivot_kg_m2)));
  lines.emplace_back("the same", fmt::format("{} kg m² about the centre of mass", listed(top.moments_about_center_kg_m2)));
  std::string spin = in_rpm(top.spin_rad_s) + " about axis 3";
  if (top.critical_spin_rad_s && top.spin_over_critical)
    spin += fmt::format(", {:.4g} times the critical spin of {}", *top.spin_over_critical, in_rpm(*top.critical_spin_rad_s));
  lines.emplace_back("spin", spin);
  if (top.rotor_spin_rad_s && top.rotor_momentum_kg_m2_s)
    lines.emplace_back("rotor", fmt::format("{} relative to the body, momentum {:.6g} kg m²/s", in_rpm(*top.rotor_spin_rad_s),
                                            *top.rotor_momentum_kg_m2_s));
  if (top.rim_speed_m_s) lines.emplace_back("rim speed", fmt::format("{:.4g} m/s", *top.rim_speed_m_s));
  if (top.mean_precession_rad_s)
    lines.emplace_back("precession", precession(*top.mean_precession_rad_s) + "; mean of this release");
  if (top.slow_precession_rad_s)
    lines.emplace_back("slow precession", precession(*top.slow_precession_rad_s) + "; steady at this tilt and spin");
  if (top.fast_precession_rad_s)
    lines.emplace_back("fast precession", precession(*top.fast_precession_rad_s) + "; steady, too");
  if (top.nutation_rad_s)
    lines.emplace_back("nutation", fmt::format("{}, {}", with_period(*top.nutation_rad_s, "period"),
                                               top.gimbals ? "of small amplitude"
                                               : top.nutation_kind == NutationKind::of_release
                                                   ? "at the amplitude of this release"
                                                   : "of small amplitude; this release does not nutate"));
  if (top.gimbals) add_gimbals(*top.gimbals, lines);
  if (top.journey) add_journey(*top.journey, lines);
  for (const std::string& note : top.notes) lines.emplace_back("note", note);
  for (const std::string& what : top.left_out) lines.emplace_back("left out", what);
  return lines;
}

std::string top_json(const Scene& scene) {
  RunResult result;
  result.scene = scene;
  return written(summary_part(result, "top"));
}

}  // namespace earthtop
