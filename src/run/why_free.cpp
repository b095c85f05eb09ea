// SPDX-License-Identifier: GPL-3.0-or-later
// Why a body drifts on which no torque acts: it turns with the stars, it is released with the Earth's rate besides, and where it spins about
// the axis of its middle moment it turns over at another time.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "earthtop/closed_form/free_body.hpp"
#include "earthtop/closed_form/special_cases.hpp"
#include "earthtop/elementary.hpp"
#include "earthtop/model/body.hpp"
#include "earthtop/model/release.hpp"
#include "earthtop/scenario/support.hpp"
#include "run/turn_over.hpp"
#include "run/why_told.hpp"

namespace earthtop::why {
namespace {

bool is_free(const Told& told) {
  const Scene& scene = told.scene;
  return scene.is_plain() && (scene.site().gravity_m_s2 == 0 || scene.body<double>().p_PBcm_B == Vec3<double>::Zero());
}

Quaternion<double> quaternion(const std::array<double, 4>& q) { return {q[0], {q[1], q[2], q[3]}}; }

/// The Earth's rate in body axes at the release (rad/s).
Vec3<double> earth_rate_B(const Told& told) {
  return transposed_times(rotation_matrix(told.scene.release<double>().q_LB), told.W_L);
}

/// A body without a torque that has the Earth's rate besides, in space, moves there otherwise, too: as Euler and Poinsot's closed form says.
void tell_other_release(Told& told) {
  const Release<double>& release = told.scene.release<double>();
  const Mat3<double>& inertia = told.scene.body<double>().I_BP_B;
  const Vec3<double> w_B = release.w_XB_B, added_B = earth_rate_B(told);
  const Vec3<double> momentum = times(inertia, w_B), added = times(inertia, added_B);
  const double t = told.reached_s(), energy = momentum.dot(w_B);
  if (!(norm(w_B) > 0)) return;
  const auto attitude = [&](const Vec3<double>& w0_B) { return FreeBody<double>(inertia, release.q_LB, w0_B).at(t).q_NB; };
  const Vec3<double> turned = -0.5 * t * told.W_L;
  const double half = norm(turned);
  const Quaternion<double> laboratory{real::cos(half), Vec3<double>(real::sin(half) / half * turned)};
  const Quaternion<double> drift = attitude(w_B).conjugate() * (laboratory * attitude(Vec3<double>(w_B + added_B)));
  const double predicted = 2 * real::atan2(norm(drift.v), std::abs(drift.w));
  const double computed = told.result.rows.back().drift_attitude_rad, bound = told.result.rows.back().drift_attitude_bound_rad;
  constexpr double kRounding = 1e-14, kMostLeftOut = 0.01;
  const double error = kRounding * (1 + norm(w_B) * t);
  if (!(error <= kMostLeftOut * predicted) || std::abs(computed - predicted) > bound + error + kRounding * predicted) return;
  const double turn = real::atan2(norm(Vec3<double>(momentum.cross(added))), momentum.dot(Vec3<double>(momentum + added)));
  const double share = (added.dot(w_B) * 2 + added.dot(added_B)) / energy;
  tell_earth_turns(told);
  told.add(
      "released_with_laboratory",
      fmt::format("No torque acts on the body. Released with its rates in the laboratory, it has the Earth's rate besides in "
                  "space: this turns its angular momentum by {} and makes its energy {} by {:.3g} of itself, so that it is "
                  "another motion in space, too.",
                  angle_text(turn), share < 0 ? "less" : "more", std::abs(share)),
      {{"momentum_turned_rad", turn}, {"energy_change", share}});
  told.add(
      "what_is_left",
      fmt::format("Seen from the laboratory, which turns besides, the attitude has drifted by {} by the closed form of a free "
                  "body, and by {} in this run.",
                  angle_text(predicted, 7), angle_text(computed, 7)),
      {{"predicted_rad", predicted}, {"predicted_error_rad", error}, {"computed_rad", computed}});
}

/// When the component of the rate in space along the axis first changes its sign (s): at the root of the cubic through two looks that has
/// the slopes of Euler's equations.
std::optional<double> seen_turn_over(const Told& told, const Moments& moments, bool rotating) {
  const auto rate_at = [&](const DriftRow& look) {
    if (!rotating) return vector(look.ref_w_LB_B);
    return Vec3<double>(vector(look.w_LB_B) + transposed_times(rotation_matrix(quaternion(look.q_LB)), told.W_L));
  };
  const auto slope = [&](const Vec3<double>& w) {
    return (moments.C - moments.A) * w[moments.a] * w[moments.c] / moments.B * moments.handed();
  };
  const std::vector<DriftRow>& looks = told.result.looks;
  for (std::size_t i = 1; i < looks.size(); ++i) {
    const Vec3<double> before = rate_at(looks[i - 1]), after = rate_at(looks[i]);
    const double from = before[moments.b], to = after[moments.b], h = looks[i].t_s - looks[i - 1].t_s;
    if (from * to > 0 || from == to) continue;
    const double d0 = h * slope(before), d1 = h * slope(after);
    const auto cubic = [&](double x) {
      return from + x * (d0 + x * (3 * (to - from) - 2 * d0 - d1 + x * (d0 + d1 - 2 * (to - from))));
    };
    double low = 0, high = 1;
    constexpr int kHalvings = 50;
    for (int k = 0; k < kHalvings; ++k) {
      const double x = (low + high) / 2;
      (cubic(x) * from > 0 ? low : high) = x;
    }
    return looks[i - 1].t_s + h * low;
  }
  return std::nullopt;
}

/// The looks have to be no farther apart than this part of the time in which a disturbance grows by a factor of e.
bool looks_are_close(const Told& told, double growth_1_s) {
  constexpr double kClose = 0.3;
  const std::vector<DriftRow>& looks = told.result.looks;
  return told.result.looks_a_window == 0 && (looks[1].t_s - looks[0].t_s) * growth_1_s <= kClose;
}

std::string later(double by_s) { return by_s > 0 ? "later" : "earlier"; }

}  // namespace

/// Without a torque, or with gravity along the axis of the laboratory's turn, and with the same rates in space, both predictions are one motion among the
/// stars.
void tell_turns_with_the_stars(Told& told) {
  const Scenario& scenario = told.scene.scenario();
  const bool is_balanced = told.scene.site().gravity_m_s2 == 0 ||
                           (!masses_move(scenario) && told.scene.body<double>().p_PBcm_B == Vec3<double>::Zero());
  const bool is_at_pole = real::hypot(told.W_L[0], told.W_L[1]) <= real::epsilon<double>() * told.Omega();
  const DriftRow& last = told.result.rows.back();
  const double turned = told.Omega() * last.t_s;
  constexpr double kHalfTurn = std::numbers::pi, kRounding = 1e-13;
  if (!(is_balanced || is_at_pole) || scenario.release.rates_relative_to != RatesRelativeTo::inertial ||
      scenario.effects.applied.any() || !(turned < kHalfTurn) ||
      std::abs(last.drift_attitude_rad - turned) > last.drift_attitude_bound_rad + kRounding * turned)
    return;
  const bool has_parts = masses_move(scenario) || scenario.rotor;
  const char* const parts = masses_move(scenario) ? "the body and what moves in it" : has_parts ? "body and rotor" : "the body";
  told.add(
      "turns_with_the_stars",
      fmt::format("{}, and both predictions start with the same rates in space: there they are the same motion{}. Seen from "
                  "the laboratory the attitude turns with the stars, by |Ω| t = {}, and by {} in this run.",
                  is_balanced ? fmt::format("Nothing outside acts on {}", parts)
                              : "Gravity acts along the axis about which the laboratory turns",
                  has_parts ? fmt::format(", whatever happens between {}", parts) : "", angle_text(turned, 10),
                  angle_text(last.drift_attitude_rad, 10)),
      {{"predicted_rad", turned}, {"computed_rad", last.drift_attitude_rad}});
  if (has_parts) return;
  const Vec3<double> axis_L = vector(last.ref_axis_L);
  const double away = real::atan2(norm(Vec3<double>(axis_L.cross(told.W_L))), std::abs(axis_L.dot(told.W_L)));
  const double moved = balanced_gyroscope_drift(real::sin(away), told.Omega(), last.t_s);
  if (std::abs(last.drift_axis_rad - moved) > last.drift_axis_bound_rad + kRounding * turned) return;
  told.add(
      "axis_turns",
      fmt::format("The axis, at the end {:.5g}° away from the celestial axis, is moved by {} of that, and by {} in this run.",
                  away * 180 / std::numbers::pi, angle_text(moved, 7), angle_text(last.drift_axis_rad, 7)),
      {{"angle_from_celestial_axis_rad", away}, {"predicted_rad", moved}, {"computed_rad", last.drift_axis_rad}});
}

void tell_without_torque(Told& told) {
  if (!told.sentences.empty()) return;
  tell_turns_with_the_stars(told);
  if (!told.sentences.empty() || !is_free(told) || told.scene.release<double>().X != RatesRelativeTo::laboratory) return;
  tell_turn_over(told);
  if (told.sentences.empty() && told.result.verdict.verdict == Verdict::reliable) tell_other_release(told);
}

void tell_turn_over(Told& told) {
  const Release<double>& release = told.scene.release<double>();
  const std::optional<Moments> moments = three_moments(told.scene.body<double>().I_BP_B);
  if (!is_free(told) || release.X != RatesRelativeTo::laboratory || !moments) return;
  const Vec3<double> w_B = release.w_XB_B, added_B = earth_rate_B(told);
  const std::optional<TurnOver> plain = turn_over(*moments, w_B), turning = turn_over(*moments, Vec3<double>(w_B + added_B));
  if (!plain || !turning || !turning->first_s || !looks_are_close(told, turning->growth_1_s)) return;
  const std::optional<double> seen = seen_turn_over(told, *moments, true), seen_plain = seen_turn_over(told, *moments, false);
  constexpr double kSeen = 1e-4;  // of the time of growth
  const double error = turning->left_out_s + kSeen / turning->growth_1_s, end = told.reached_s();
  if (!seen || *seen >= told.result.verdict.reliable_until_s || std::abs(*seen - *turning->first_s) > error) return;
  const bool plain_turns = plain->first_s && *plain->first_s < end;
  if (plain_turns != seen_plain.has_value()) return;
  const double across = real::hypot(added_B[moments->a], added_B[moments->c]), spin = std::abs(w_B[moments->b]);
  std::vector<std::pair<std::string_view, double>> numbers = {
      {"predicted_s", *turning->first_s}, {"predicted_error_s", error}, {"computed_s", *seen}};
  std::string again;
  if (turning->again_s) {
    again = fmt::format(", and then every {:.4g} s", *turning->again_s);
    numbers.emplace_back("again_s", *turning->again_s);
  }
  std::string other;
  if (plain_turns) {
    const double predicted = *turning->first_s - *plain->first_s, computed = *seen - *seen_plain;
    const double left_out = (turning->smallness + plain->smallness) * std::abs(predicted) + kSeen * std::abs(predicted);
    if (*seen_plain >= told.result.verdict.reliable_until_s || predicted == 0 || std::abs(computed - predicted) > left_out)
      return;
    other = fmt::format(
        "The non-rotating prediction was released off the axis, too, and turns over at {:.5g} s: the Earth's rate "
        "makes it turn over {} by {:.3g} s in theory and by {:.3g} s in this run, and until both have turned "
        "their axes are apart.",
        *seen_plain, later(predicted), std::abs(predicted), std::abs(computed));
    numbers.emplace_back("predicted_later_s", predicted);
    numbers.emplace_back("predicted_later_error_s", left_out);
    numbers.emplace_back("computed_later_s", computed);
  } else {
    constexpr double kTenfold = 10;
    const double forward = real::log(kTenfold) / turning->growth_1_s;
    other = fmt::format("The non-rotating prediction does not turn over in this run, and so the drift comes to {}.",
                        angle_text(told.result.drift.axis_max_rad));
    if (!plain->first_s) {
      other += fmt::format(" An Earth that turned ten times as fast would bring this forward by only {:.3g} s.", forward);
      numbers.emplace_back("tenfold_earlier_s", forward);
    }
  }
  tell_earth_turns(told);
  told.add(
      "middle_axis",
      fmt::format("The body spins about the axis of its middle moment, and no such spin is stable: a motion across it grows by "
                  "a factor of e in {:.4g} s.",
                  1 / turning->growth_1_s),
      {{"growth_1_s", turning->growth_1_s}});
  told.add("earth_disturbs",
           fmt::format(
               "Released with its rates in the laboratory, the body has the Earth's rate besides in space, {:.3g} rad/s of it "
               "across the axis: {:.2g} of the spin.",
               across, across / spin),
           {{"across_rad_s", across}, {"share_of_spin", across / spin}});
  told.add("turns_over",
           fmt::format("When that has grown to the spin itself, the body turns over: at {} s in theory and at {:.5g} s in this "
                       "run{}. {}",
                       with_error(*turning->first_s, error), *seen, again, other),
           std::move(numbers));
}

}  // namespace earthtop::why
