// SPDX-License-Identifier: GPL-3.0-or-later
// Why tops on a table drift where no friction blurs it: a ball that spins about the vertical, and a sleeping top, both rolling.
#include <algorithm>
#include <cmath>
#include <optional>

#include "earthtop/model/body.hpp"
#include "earthtop/model/release.hpp"
#include "run/why_told.hpp"

namespace earthtop::why {
namespace {

/// Whether the tip rolls on a level table that takes nothing from the spin, from rest but for a spin about the vertical.
bool rolls_and_spins_upright(const Told& told) {
  const ContactSpec& contact = *told.scene.scenario().contact;
  const Release<double>& release = told.scene.release<double>();
  const bool starts_at_rest = contact.start != ContactStart::tip_velocity || contact.tip_velocity_m_s == std::array{0.0, 0.0};
  const DriftRow& first = told.result.looks.front();
  return contact.law == ContactLaw::rolling && contact.spinning_friction_m == 0 && contact.rolling_resistance_m == 0 &&
         contact.table_tilt_deg == 0 && contact.tip_radius_m > 0 && starts_at_rest && first.contact &&
         release.X == RatesRelativeTo::laboratory && release.w_XB_B[0] == 0 && release.w_XB_B[1] == 0 &&
         first.ref_axis_L[0] == 0 && first.ref_axis_L[1] == 0 && !told.scene.scenario().effects.applied.any();
}

/// The slope and the spread of a line through a value of the rows over time.
struct Line {
  double slope, largest_residual;
};
template <class Value>
Line line_through(const std::vector<DriftRow>& rows, const Value& value) {
  double t = 0, v = 0, tt = 0, tv = 0;
  const double n = static_cast<double>(rows.size());
  for (const DriftRow& row : rows) t += row.t_s / n, v += value(row) / n;
  for (const DriftRow& row : rows) tt += (row.t_s - t) * (row.t_s - t), tv += (row.t_s - t) * (value(row) - v);
  Line line{tv / tt, 0};
  for (const DriftRow& row : rows)
    line.largest_residual = std::max(line.largest_residual, std::abs(value(row) - v - line.slope * (row.t_s - t)));
  return line;
}

std::string length_text(double metre, int digits) {
  const ReadableUnit unit = length_unit(metre);
  return fmt::format("{:.{}g}{}", metre * unit.per_si, digits, unit.symbol);
}

void tell_coriolis_torque(Told& told, double spin) {
  const double torque = std::abs(told.I3 * spin * told.W_L[1]);
  told.add("coriolis_torque",
           fmt::format("The laboratory turns about North at {}, {:.5g} rad/s, and turns the spin with it: to an "
                       "observer in it, a Coriolis torque of {:.3g} N m acts on the body that spins upright.",
                       told.northward_rate(), std::abs(told.W_L[1]), torque),
           {{"laboratory_rate_north_rad_s", told.W_L[1]}, {"coriolis_torque_N_m", torque}});
}

/// A ball of equal moments: to first order in the Earth's rate its centre has the acceleration
/// I r w W_north/(I + m r^2) to the North, with the turn of its velocity about the vertical left out.
void tell_ball(Told& told, double spin, double radius) {
  const double mass = told.scene.body<double>().mass, share = told.I3 / (told.I3 + mass * radius * radius);
  const double acceleration = share * radius * spin * told.W_L[1], t = told.reached_s();
  const double predicted = acceleration * t * t / 2, left_out = 2 * told.Omega() * t * std::abs(predicted);
  const double seen = told.result.looks.back().contact->drift_tip_xy_m[1];
  constexpr double kMostLeftOut = 0.1;
  if (!(left_out <= kMostLeftOut * std::abs(predicted)) || !(std::abs(seen - predicted) <= left_out)) return;
  tell_earth_turns(told);
  tell_coriolis_torque(told, spin);
  told.add(
      "ball_rolls",
      fmt::format("The table holds the point of contact, so that this torque makes the ball roll to the {}, with the "
                  "acceleration I/(I + m r²) r {} = {:.4g} m/s², where I/(I + m r²) = {:.4g}.",
                  predicted > 0 ? "North" : "South", size_of("ω " + northward_rate(told.scene.site(), "Ω"), spin * told.W_L[1]),
                  std::abs(acceleration), share),
      {{"acceleration_north_m_s2", acceleration}, {"share", share}});
  const ReadableUnit unit = length_unit(predicted);
  const KnownNumber known = known_number(std::abs(predicted) * unit.per_si, left_out * unit.per_si);
  told.add("what_is_left",
           fmt::format("In {:.6g} s it rolls by {} ± {}{} in theory and by {} in this run.", t, known.value, known.error,
                       unit.symbol, length_text(std::abs(seen), 6)),
           {{"predicted_north_m", predicted}, {"predicted_error_m", left_out}, {"computed_north_m", seen}});
}

/// A sleeping top rests where gravity balances the Coriolis torque, and rolls there like a wheel.
void tell_walker(Told& told, double spin, double radius) {
  const double lean = told.I3 * spin * told.W_L[1] / told.mgl, west = radius * spin * lean;
  const Line walked = line_through(told.result.looks, [](const DriftRow& row) { return -row.contact->drift_tip_xy_m[0]; });
  double south = 0;
  for (const DriftRow& row : told.result.looks) south -= row.axis_L[1] / static_cast<double>(told.result.looks.size());
  constexpr double kAgree = 0.02;
  if (!(std::abs(walked.slope - west) <= kAgree * std::abs(west)) || !(std::abs(south - lean) <= kAgree * std::abs(lean)))
    return;
  const std::string_view to = west > 0 ? "West" : "East";
  tell_earth_turns(told);
  tell_coriolis_torque(told, spin);
  told.add("rest_leans",
           fmt::format("Gravity balances this torque where the axis leans by {} to the {}: the top circles about that "
                       "direction, and in this run it leans there by {} on average.",
                       angle_text(std::abs(lean), 3), lean > 0 ? "South" : "North", angle_text(std::abs(south), 3)),
           {{"lean_south_rad", lean}, {"mean_lean_south_rad", south}});
  told.add("walks_west",
           fmt::format("A top that leans rolls on its tip like a wheel, at r {} times its lean, {}/s to the {} in theory, and "
                       "at {}/s in this run. A top that spins the other way leans the other way, and walks to the {}, too.",
                       size_of("ω", spin), length_text(std::abs(west), 3), to, length_text(std::abs(walked.slope), 3), to),
           {{"predicted_west_m_s", west}, {"computed_west_m_s", walked.slope}});
  const double off = walked.largest_residual;
  told.add("what_is_left",
           fmt::format("In {:.6g} s that is {}; about this path the point of contact moves to and fro by {} at most.",
                       told.reached_s(), length_text(std::abs(walked.slope) * told.reached_s(), 3), length_text(off, 2)),
           {{"walked_west_m", walked.slope * told.reached_s()}, {"off_m", off}});
}

}  // namespace

void tell_on_table(Told& told) {
  const double spin = told.scene.release<double>().w_XB_B[2], radius = told.scene.scenario().contact->tip_radius_m;
  constexpr double kEqual = 1e-9;
  if (told.scene.symmetry_axis() == 2 && rolls_and_spins_upright(told) && spin != 0 &&
      std::abs(told.W_L[1]) > kNone * told.Omega()) {
    if (told.mgl == 0 && std::abs(told.I1 - told.I3) <= kEqual * told.I3)
      tell_ball(told, spin, radius);
    else if (told.mgl > 0)
      tell_walker(told, spin, radius);
  }
  if (told.sentences.empty()) tell_sliding(told);
}

}  // namespace earthtop::why
