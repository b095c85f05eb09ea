// SPDX-License-Identifier: GPL-3.0-or-later
// Why the axes of tops that do not precess drift: free gyroscopes, sleeping tops, pendulums and gyrocompasses.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "closed_form/level_compass.hpp"
#include "earthtop/closed_form/special_cases.hpp"
#include "earthtop/elementary.hpp"
#include "earthtop/model/body.hpp"
#include "earthtop/model/release.hpp"
#include "run/why_told.hpp"

namespace earthtop::why {

void tell_free_gyroscope(Told& told) {
  const double Omega = told.scene.rotation_rate_rad_s();
  const Vec3<double> axis_L = vector(told.result.looks.front().axis_L);
  const double away = real::atan2(norm(Vec3<double>(axis_L.cross(told.W_L))), axis_L.dot(told.W_L) * (Omega > 0 ? 1 : -1));
  tell_earth_turns(told);
  told.add("no_torque",
           fmt::format("{}, and the axis was released at rest among the stars: no torque turns it, and it keeps its direction "
                       "among them.",
                       told.scene.site().gravity_m_s2 == 0 ? "No gravity acts" : "The centre of mass is at the pivot"),
           {});
  told.add(
      "turns_with_the_stars",
      fmt::format("Seen from the laboratory, it therefore turns as the stars do, about the celestial axis, {} seen from the "
                  "celestial North Pole, at {} = {:.7g} rad/s; it stands α = {:.5g}° from that pole.",
                  Omega > 0 ? "clockwise" : "counterclockwise", size_of("Ω", Omega), std::abs(Omega),
                  away * 180 / std::numbers::pi),
      {{"rate_rad_s", Omega}, {"angle_from_celestial_pole_rad", away}});
  const double error = std::max(told.theory->predicted_error, told.theory->computed_error.value_or(0));
  told.add(
      "what_is_left",
      fmt::format("In the time t of this run its direction has moved by 2 asin(sin(α) |sin(Ω t/2)|), which is {} in theory "
                  "and {} in this run.",
                  angle_with_error(told.theory->predicted, error), angle_with_error(*told.theory->computed, error)),
      {{"predicted_rad", told.theory->predicted}, {"computed_rad", *told.theory->computed}});
}

void tell_sleeping_top(Told& told) {
  const double lean = told.theory->predicted, seen = *told.theory->computed;
  if (std::abs(told.W_L[1]) <= kNone * told.Omega()) return;
  const double coriolis = norm(coriolis_torque_L(told, told.result.looks.front())), gravity = std::abs(told.mgl * lean);
  tell_earth_turns(told);
  told.add("coriolis_torque",
           fmt::format("The laboratory turns about North at {}, {:.5g} rad/s, and turns the spin with it: to an "
                       "observer in it, a Coriolis torque of {:.3g} N m acts on the upright top.",
                       told.northward_rate(), std::abs(told.W_L[1]), coriolis),
           {{"laboratory_rate_north_rad_s", told.W_L[1]}, {"coriolis_torque_N_m", coriolis}});
  told.add("rest_leans",
           fmt::format(
               "Gravity balances this torque where the axis leans by {} to the {}: the top could rest there, but not upright.",
               angle_text(std::abs(lean), 3), lean > 0 ? "South" : "North"),
           {{"lean_south_rad", lean}, {"gravity_torque_N_m", gravity}});
  told.add(
      "what_is_left",
      fmt::format(
          "Released upright, it circles about that direction, up to {} from the vertical; on average it leans to the {} by {} "
          "in theory and by {} in this run.",
          angle_text(told.result.drift.axis_max_rad, 3), seen > 0 ? "South" : "North",
          angle_with_error(std::abs(lean), told.theory->predicted_error),
          angle_with_error(std::abs(seen), told.theory->computed_error.value_or(0))),
      {{"axis_max_rad", told.result.drift.axis_max_rad},
       {"mean_lean_south_rad", seen},
       {"predicted_error_rad", told.theory->predicted_error}});
}

namespace {

/// Whether the release is at rest in the laboratory, apart from a spin about the axis.
bool axis_at_rest(const Scene& scene) {
  const Release<double>& release = scene.release<double>();
  return release.X == RatesRelativeTo::laboratory && release.w_XB_B[0] == 0 && release.w_XB_B[1] == 0;
}

/// The rate (rad/s, counterclockwise about Up) at which the plane turns in which an axis swings: (East + i North)^2 has, on average
/// over swings, twice the angle of the plane. Empty where the run is too short, or its rows too few, for windows of some swings.
std::optional<double> seen_plane_rate(const std::vector<DriftRow>& rows, double swing_s, double expected) {
  constexpr double kSwings = 4, kRows = 16, kMost = 64, kTurnedInWindow = std::numbers::pi / 8;
  const double duration = rows.back().t_s, count = static_cast<double>(rows.size());
  const double windows = std::floor(std::min({duration / (kSwings * swing_s), count / kRows, kMost}));
  if (windows < 2 || std::abs(expected) * duration / windows > kTurnedInWindow) return std::nullopt;
  double n = 0, t = 0, tt = 0, a = 0, ta = 0, before = 0;
  for (std::size_t row = 0; n < windows;) {
    double re = 0, im = 0, weight = 0, time = 0;
    for (const double end = duration * (n + 1) / windows; row < rows.size() && rows[row].t_s <= end; ++row) {
      const double x = rows[row].axis_L[0], y = rows[row].axis_L[1];
      re += x * x - y * y, im += 2 * x * y, weight += x * x + y * y, time += (x * x + y * y) * rows[row].t_s;
    }
    if (!(weight > 0)) return std::nullopt;
    double angle = real::atan2(im, re) / 2;
    if (n > 0) angle += std::numbers::pi * std::round((before - angle) / std::numbers::pi);
    before = angle, time /= weight, ++n;
    t += time, tt += time * time, a += angle, ta += angle * time;
  }
  return (n * ta - t * a) / (n * tt - t * t);
}

}  // namespace

void tell_pendulum(Told& told) {
  const Vec3<double> n_L = vector(told.result.looks.front().ref_axis_L);
  if (told.scene.scenario().effects.applied.any() || !axis_at_rest(told.scene) || told.scene.release<double>().w_XB_B[2] != 0 ||
      !(told.mgl * n_L[2] < 0))
    return;
  const double amplitude = real::atan2(real::hypot(n_L[0], n_L[1]), std::abs(n_L[2])), share = told.I3 / (2 * told.I1);
  constexpr double kLargest = 0.5, kMostLeftOut = 0.1, kRows = 0.01;
  if (!(amplitude > 0) || amplitude > kLargest || std::abs(told.W_L[2]) <= kNone * told.Omega()) return;
  const FirstOrder<double> rate = foucault_rate({told.I1, told.I3, -std::abs(told.mgl)}, amplitude, told.W_L);
  const double swing_s = 2 * std::numbers::pi * std::sqrt(told.I1 / std::abs(told.mgl));
  const std::optional<double> seen = seen_plane_rate(told.result.looks, swing_s, rate.value);
  if (!seen || rate.left_out > kMostLeftOut * std::abs(rate.value) ||
      std::abs(*seen - rate.value) > rate.left_out + kRows * std::abs(rate.value))
    return;
  const double up = told.W_L[2];
  tell_earth_turns(told);
  told.add("laboratory_turns",
           fmt::format("Gravity keeps the swing in its plane while the laboratory turns about its vertical at {}, {:.5g} "
                       "rad/s {} from above: seen from the laboratory, the plane turns {} by as much.",
                       told.vertical_rate(), std::abs(up), sense(up), sense(-up)),
           {{"laboratory_rate_rad_s", up}, {"swing_s", swing_s}});
  told.add("bob_has_spin",
           fmt::format("Released at rest in the laboratory, the bob turns with it and has a spin of its own in space, which "
                       "takes away the fraction I3/(2 I1) = {:.3g} of this rate.",
                       share),
           {{"part", share}});
  told.add(
      "what_is_left",
      fmt::format("In all, the plane turns {} by {} rad/s in theory and by {:.4g} rad/s in this run: by {} in its {:.6g} s.",
                  sense(rate.value), with_error(std::abs(rate.value), rate.left_out), std::abs(*seen),
                  angle_text(std::abs(*seen) * told.reached_s(), 4), told.reached_s()),
      {{"predicted_rad_s", rate.value}, {"predicted_error_rad_s", rate.left_out}, {"computed_rad_s", *seen}});
}

/// A pendulum whose support is not equally stiff: the swings along the direction e and across it get out of step faster than
/// the Earth turns the plane.
void tell_unequal_pendulum(Told& told) {
  const AppliedTorquesSpec& applied = told.scene.scenario().effects.applied;
  const Vec3<double> n_L = vector(told.result.looks.front().ref_axis_L);
  if (!applied.support_alone() || !axis_at_rest(told.scene) || told.scene.release<double>().w_XB_B[2] != 0 ||
      !(told.mgl * n_L[2] < 0) || std::abs(told.W_L[2]) <= kNone * told.Omega())
    return;
  const SupportStiffness<double>& K = told.scene.model<double>().applied.support;
  const double kappa = K.east + K.north, weight = std::abs(told.mgl), amplitude = real::hypot(n_L[0], n_L[1]);
  constexpr double kLargest = 0.1, kFaster = 3;
  if (amplitude > kLargest || !(weight + kappa > 0)) return;
  const double along = std::sqrt((weight + kappa) / told.I1), across = std::sqrt(weight / told.I1);
  const double apart = std::abs(along - across), turning = std::abs(told.W_L[2]) * (1 - told.I3 / (2 * told.I1));
  if (!(apart > kFaster * 2 * turning)) return;
  tell_earth_turns(told);
  told.add(
      "support_is_unequal",
      fmt::format("The support is {} along the azimuth of {:.4g}°: the swing along it has the rate {:.7g} rad/s, and that "
                  "across it {:.7g} rad/s. The two get out of step by one turn in {:.5g} s, in which the swing opens to an "
                  "ellipse and closes again.",
                  kappa > 0 ? "stiffer" : "softer", applied.unequal_support->azimuth_deg, along, across,
                  2 * std::numbers::pi / apart),
      {{"rate_along_rad_s", along}, {"rate_across_rad_s", across}, {"out_of_step_s", 2 * std::numbers::pi / apart}});
  told.add(
      "plane_is_held",
      fmt::format("On a support that is equally stiff the Earth would turn the plane of the swing by {:.4g} rad/s. Here the "
                  "swings part by {:.4g} rad/s, {:.3g} times as fast, so that its turn does not add up from swing to swing.",
                  turning, apart, apart / turning),
      {{"turning_rad_s", turning}, {"apart_rad_s", apart}});
}

void tell_gyrocompass(Told& told) {
  AppliedTorquesSpec applied = told.scene.scenario().effects.applied;
  if (!applied.gimbal || applied.gimbal->damping_N_m_s != 0 || !axis_at_rest(told.scene)) return;
  applied.gimbal.reset();
  const Vec3<double> n_L = vector(told.result.looks.front().ref_axis_L);
  // North is where the level part of the Earth's rate points.
  const double level = real::hypot(told.W_L[0], told.W_L[1]), Omega = told.scene.rotation_rate_rad_s() < 0 ? -1 : 1;
  const double spin = told.scene.release<double>().w_XB_B[2], in_space = spin + n_L.dot(told.W_L);
  if (applied.any() || level <= kNone * told.Omega() || spin * in_space <= 0) return;
  // The end of the axis that turns to North is that to which spin and Earth's rate point.
  const double end = spin * Omega > 0 ? 1 : -1;
  const auto from_north = [&](const std::array<double, 3>& axis) {
    const double along = Omega * (axis[0] * told.W_L[0] + axis[1] * told.W_L[1]);
    return real::atan2(end * Omega * (axis[0] * told.W_L[1] - axis[1] * told.W_L[0]), end * along);
  };
  const double first = from_north(told.result.looks.front().ref_axis_L);
  const double directing = std::abs(told.I3 * in_space * level) / told.I1;
  constexpr double kLargest = 0.5, kAgree = 1e-3;
  if (first == 0 || std::abs(first) > kLargest || !(directing > level * level)) return;
  const LevelCompass swing(directing, level, first);
  const double period = swing.period_s();
  for (const DriftRow& look : told.result.looks)
    if (std::abs(from_north(look.axis_L) - swing.angle(look.t_s)) > kAgree * std::abs(first)) return;
  const double small_period = 2 * std::numbers::pi * std::sqrt(told.I1 / std::abs(told.I3 * spin * level));
  const auto beside_cosine = [&](double t_s, double angle) {
    return std::abs(angle - first * real::cos(2 * std::numbers::pi * t_s / period));
  };
  double off = 0;
  for (const DriftRow& look : told.result.looks) off = std::max(off, beside_cosine(look.t_s, from_north(look.axis_L)));
  constexpr int kBetweenLooks = 240;  // times in a period at which the theory tells what the looks leave out
  for (int i = 1; i < kBetweenLooks && period * i / kBetweenLooks < told.reached_s(); ++i)
    off = std::max(off, beside_cosine(period * i / kBetweenLooks, swing.angle(period * i / kBetweenLooks)));
  const double torque = std::abs(coriolis_torque_L(told, told.result.looks.front())[2]);  // at its largest
  const std::string of_north = northward_rate(told.scene.site(), "Ω");
  tell_earth_turns(told);
  told.add("gimbal_holds",
           fmt::format("The gimbal holds the axis level, so that only the Earth's rotation about North matters, {} = {:.5g} "
                       "rad/s: the Coriolis torque about the vertical, {:.3g} N m at most, turns the axis, which cannot yield "
                       "upwards.",
                       size_of(of_north, Omega), level, torque),
           {{"laboratory_rate_north_rad_s", Omega * level}, {"coriolis_torque_N_m", torque}});
  told.add(
      "swings_about_north",
      fmt::format("It drives the axis to the {}: about that direction the axis swings by {} to either side. To first order "
                  "in the Earth's rate, small swings have the period 2π sqrt(I1/(I3 {})) = {:.5g} s; these swings have "
                  "the period {:.5g} s, by an elliptic integral.",
                  end > 0 ? (spin > 0 ? "North" : "North, and its spin to the South")
                          : (spin > 0 ? "South" : "South, and its spin to the North"),
                  angle_text(std::abs(first), 4), size_of("ω3 " + of_north, end), small_period, period),
      {{"drives_to_north", end},
       {"amplitude_rad", std::abs(first)},
       {"small_swing_period_s", small_period},
       {"period_s", period}});
  told.add("what_is_left",
           fmt::format("This run covers {:.3g} such swings, and departs from a cosine of their period by {} at most.",
                       told.reached_s() / period, angle_text(off, 2)),
           {{"swings", told.reached_s() / period}, {"off_rad", off}});
}

}  // namespace earthtop::why
