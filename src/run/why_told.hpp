// SPDX-License-Identifier: GPL-3.0-or-later
/// Common parts of the sentences on all kinds of tops.
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "earthtop/model/gyrostat.hpp"
#include "earthtop/model/model.hpp"
#include "earthtop/run.hpp"
#include "earthtop/vectors.hpp"
#include "run/earth_symbols.hpp"
#include "run/largest.hpp"
#include "run/slow_precession.hpp"
#include "text/number_words.hpp"

namespace earthtop::why {

/// A component of the Earth's rate that is less than this part of it is rounding.
inline constexpr double kNone = 1e-9;

/// The run that sentences are about, and the sentences told so far.
struct Told {
  const RunResult& result;
  const Scene& scene;
  const TheoryReport* theory;  ///< null where the result has no theory on the scene
  Vec3<double> W_L;            ///< the Earth's rate (rad/s)
  double I1, I3, mgl;
  std::vector<WhySentence> sentences;

  double Omega() const { return norm(W_L); }
  double reached_s() const { return result.rows.back().t_s; }
  std::string vertical_rate() const { return size_of(earthtop::vertical_rate(scene.site(), "Ω"), W_L[2]); }
  std::string northward_rate() const { return size_of(earthtop::northward_rate(scene.site(), "Ω"), W_L[1]); }
  void add(std::string_view name, std::string text, std::vector<std::pair<std::string_view, double>> numbers) {
    sentences.push_back({name, std::move(text), std::move(numbers)});
  }
};

/// Whether a prediction applies and agrees with the run.
inline bool holds_in_run(const TheoryReport& theory) {
  return theory.applies && theory.computed &&
         std::abs(*theory.computed - theory.predicted) <= theory.predicted_error + theory.computed_error.value_or(0);
}

inline Vec3<double> vector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

/// The Coriolis torque (N m) that belongs to a velocity moment at a look.
inline Vec3<double> coriolis_torque_L(const Told& told, const DriftRow& look, const Mat3<double>& J_B) {
  const Mat3<double> R_LB = rotation_matrix(Quaternion<double>{look.q_LB[0], {look.q_LB[1], look.q_LB[2], look.q_LB[3]}});
  return times(R_LB, coriolis_torque<double>(transposed_times(R_LB, told.W_L), J_B));
}
/// That of the rotor's turn in the body, which has a rotor.
inline Vec3<double> coriolis_torque_on_rotor_L(const Told& told, const DriftRow& look) {
  const Rotor<double> rotor = make_rotor<double>(*told.scene.scenario().rotor);
  return coriolis_torque_L(told, look, spin_velocity_moment(rotor, look.rotor->rate_rad_s));
}
/// The whole Coriolis torque (N m) at a look, as the ledger of the laboratory observer counts it.
inline Vec3<double> coriolis_torque_L(const Told& told, const DriftRow& look) {
  const Model<double>& model = told.scene.model<double>();
  const ModelInTime<double> in_time(model);
  Mat3<double> J_B = velocity_moment<double>(in_time.at(look.t_s).S_BP_B, vector(look.w_LB_B));
  if (const MassSums<double>* masses = in_time.masses_at(look.t_s)) J_B += masses->velocity_moment;
  const Vec3<double> of_body = coriolis_torque_L(told, look, J_B);
  return look.rotor ? Vec3<double>(of_body + coriolis_torque_on_rotor_L(told, look)) : of_body;
}

/// The largest length that a vector has along the motion, between the looks, too.
/// @param vector_at  takes a look
template <class VectorAt>
double largest_length(const RunResult& result, const VectorAt& vector_at) {
  std::vector<double> times_s, squares;  // of the length, since the length itself may have a corner
  double scale = 0;
  std::vector<Vec3<double>> vectors;
  for (const DriftRow& look : result.looks) {
    times_s.push_back(look.t_s), vectors.push_back(vector_at(look));
    scale = std::max(scale, norm(vectors.back()));
  }
  if (!(scale > 0)) return 0;
  for (const Vec3<double>& v : vectors) squares.push_back((v / scale).dot(v / scale));
  const std::size_t count = result.looks_a_window > 0 ? result.looks_a_window : times_s.size();
  double largest = 1;
  for (std::size_t begin = 0; begin < times_s.size(); begin += count) {
    const std::size_t size = std::min(count, times_s.size() - begin);
    if (const auto top = largest_of(std::span(times_s).subspan(begin, size), std::span(squares).subspan(begin, size)))
      largest = std::max(largest, top->value);
  }
  return scale * std::sqrt(largest);
}

inline std::string with_error(double value, double error) {
  const KnownNumber known = known_number(value, error);
  return fmt::format("{} ± {}", known.value, known.error);
}

/// Both in the unit of the angle's size.
inline std::string angle_with_error(double rad, double error_rad) {
  const ReadableUnit unit = angle_unit(rad);
  const KnownNumber known = known_number(rad * unit.per_si, error_rad * unit.per_si);
  return fmt::format("{}{} ± {}{}", known.value, unit.symbol, known.error, unit.symbol);
}

inline void tell_earth_turns(Told& told) {
  const double angle = std::abs(told.scene.rotation_rate_rad_s()) * told.reached_s();
  told.add("earth_turns",
           fmt::format("In the {:.6g} s of this run the Earth turns by {}{}.", told.reached_s(), angle_text(angle),
                       told.scene.rotation_rate_rad_s() < 0 ? ", in this scenario in the opposite sense" : ""),
           {{"earth_angle_rad", angle}});
}

/// The sense of a rate about Up.
inline std::string_view sense(double rate) { return rate > 0 ? "counterclockwise" : "clockwise"; }

/// The azimuth's drift (rad, counterclockwise) at the end, averaged over a few nutations, with the time that belongs to it.
struct AveragedDrift {
  double t_s, azimuth_rad, bound_rad;
};
std::optional<AveragedDrift> averaged_drift(const RunResult& result, double period_s);

/// The top of a run, released as its non-rotating prediction was.
/// @param I1  the moment across the axis about the point round which the top precesses (kg m^2)
SlowTop slow_top(const Told& told, double I1, const AppliedTorques<double>& applied);

/// The spin (rad/s) to which friction and a given torque along the axis bring a top whose axis is at rest.
double spin_left(const Told& told, const AppliedTorques<double>& applied, double spin);
/// Whether that agrees with the run.
bool spin_agrees(const Told& told, double first, double last);
/// Tells it.   @param cause  at the beginning of a sentence   @param and_so  what follows from it, to the end of the sentence
void tell_spin_changes(Told& told, std::string_view name, const std::string& cause, double first, double last,
                       const std::string& and_so);

/// Tells the azimuth's drift in slow precession, where theory applies and agrees with the run.
/// @param slow  to the end of the run   @param tell_cause  tells what acts besides
template <class TellCause>
void tell_slow_drift(Told& told, const SlowTop& top, const SlowPrecession& slow, const TellCause& tell_cause) {
  constexpr double kMostLeftOut = 0.2;
  const std::optional<AveragedDrift> computed = averaged_drift(told.result, slow.period_s);
  const std::optional<SlowPrecession> then = computed ? slow_precession(top, computed->t_s) : std::nullopt;
  if (!then || !(then->left_out_rad <= kMostLeftOut * std::abs(then->drift_rad)) ||
      std::abs(computed->azimuth_rad - then->drift_rad) > then->left_out_rad + computed->bound_rad)
    return;
  const double up = told.W_L[2], turned = -up * computed->t_s;
  tell_earth_turns(told);
  tell_cause();
  told.add(
      "laboratory_turns",
      fmt::format("The laboratory turns about its vertical at {}, {:.5g} rad/s {} seen from above, at whatever pace the axis "
                  "precesses: seen from the laboratory its azimuth is therefore turned {} by {} in {:.5g} s.",
                  told.vertical_rate(), std::abs(up), sense(up), sense(turned), angle_text(std::abs(turned)), computed->t_s),
      {{"laboratory_rate_rad_s", up}, {"turned_rad", turned}, {"t_s", computed->t_s}});
  told.add("what_is_left",
           fmt::format(
               "With the lean of the cone and what the Earth adds to the release, and apart from the nutation, the azimuth has "
               "drifted {} by {} in theory and by {} in this run.",
               sense(then->drift_rad), angle_with_error(std::abs(then->drift_rad), then->left_out_rad),
               angle_text(std::abs(computed->azimuth_rad))),
           {{"predicted_rad", then->drift_rad},
            {"predicted_error_rad", then->left_out_rad},
            {"computed_rad", computed->azimuth_rad}});
}

/// The kinds of tops. Each adds its sentences, or none where its own theory does not apply.
void tell_free_gyroscope(Told& told);
void tell_sleeping_top(Told& told);
void tell_pendulum(Told& told);
void tell_unequal_pendulum(Told& told);
void tell_gyrocompass(Told& told);
void tell_rubbed(Told& told);
void tell_without_torque(Told& told);
void tell_turn_over(Told& told);
void tell_turns_with_the_stars(Told& told);
void tell_caged(Told& told);
void tell_with_rotor(Told& told);
void tell_with_gimbals(Told& told);
void tell_with_masses(Told& told);
void tell_on_pivot(Told& told);
void tell_on_table(Told& told);
void tell_on_journey(Told& told);
void tell_sliding(Told& told);

}  // namespace earthtop::why
