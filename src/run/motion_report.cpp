// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/motion_report.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "earthtop/closed_form/swing.hpp"
#include "earthtop/frames/earth.hpp"
#include "earthtop/frames/rotation.hpp"
#include "run/largest.hpp"
#include "run/looks.hpp"
#include "run/row_vectors.hpp"
#include "scene/pendulum.hpp"

namespace earthtop {
namespace {

/// One of the two motions in a row.
struct Motion {
  std::array<double, 4> DriftRow::*q_LB;
  std::array<double, 3> DriftRow::*w_LB_B;
  std::array<double, 3> DriftRow::*axis_L;
};
constexpr Motion kRotating{&DriftRow::q_LB, &DriftRow::w_LB_B, &DriftRow::axis_L},
    kReference{&DriftRow::ref_q_LB, &DriftRow::ref_w_LB_B, &DriftRow::ref_axis_L};

double spin_of(const DriftRow& row, const Motion& motion) { return (row.*motion.w_LB_B)[2]; }
double tilt_of(const DriftRow& row, const Motion& motion) {
  const auto& n_L = row.*motion.axis_L;
  return real::atan2(real::hypot(n_L[0], n_L[1]), n_L[2]);
}

/// A number of a motion that comes to a value.
using NumberOf = double (*)(const DriftRow&, const Motion&);

/// The motion at even times that resolve it, and whether they do.
struct EvenLooks {
  std::vector<double> times_s;
  std::vector<DriftRow> rows;
  bool resolved = true;
};

EvenLooks even_looks(const LookSource& source, const RunResult& result) {
  constexpr double kMost = 400'000, kFewest = 24;
  EvenLooks looks;
  // A run that looks only where its bounds are judged has no step of its own.
  const Scene& scene = result.modelled;
  const double step_s = source.step_s > 0 ? source.step_s : plan_looks(scene, scene.choice().options).picture.step_s;
  const double wanted = std::max(kFewest, std::ceil(result.reached_s / step_s)), count = std::min(kMost, wanted);
  looks.resolved = wanted <= kMost;
  for (double k = 0; k <= count; ++k) looks.times_s.push_back(k == count ? result.reached_s : result.reached_s * (k / count));
  if (result.looks_a_window == 0 && result.looks.size() == looks.times_s.size())
    looks.rows = result.looks;
  else
    looks.rows = source.look(looks.times_s);
  looks.times_s.resize(looks.rows.size());
  return looks;
}

struct ReachedTime {
  std::optional<double> t_s, bound_s;
  bool is_sure = true;
};

/// The first time at which a number of a motion comes to a level: found among the looks, then by Newton's method in the motion itself.
/// @param bound  on the number's error
ReachedTime first_reached(const LookSource& source, const EvenLooks& looks, const Motion& motion, NumberOf number, double level,
                          double bound) {
  constexpr double kShare = 64, kCurved = 1.5;  // of a look for the slope; of a bound by the slope, for the curve
  constexpr double kEnough = 0.05;              // of the bound
  constexpr int kMost = 6;
  if (looks.rows.size() < 2) return {};
  const double at_release = number(looks.rows.front(), motion), sign = at_release <= level ? 1 : -1;
  if (std::abs(at_release - level) <= bound) return {0.0, 0.0};
  std::vector<double> values;
  for (const DriftRow& row : looks.rows) values.push_back(sign * number(row, motion));
  const std::optional<double> found = first_passing(looks.times_s, values, sign * level);
  const auto early = first_passing(looks.times_s, values, sign * level - bound),
             late = first_passing(looks.times_s, values, sign * level + bound);
  if (!found) return {std::nullopt, std::nullopt, !early && looks.resolved};
  const auto at = [&](std::vector<double> times_s) {
    std::vector<double> there;
    const std::vector<ExtendedDriftRow> rows = source.exact(times_s);
    for (std::size_t i = rows.size() - std::min(rows.size(), times_s.size()); i < rows.size(); ++i)
      there.push_back(sign * (number(row_cast<double>(rows[i]), motion) - level));
    return there;
  };
  const double step_s = looks.times_s[1] - looks.times_s[0], apart_s = std::min(step_s / kShare, *found / 2);
  const std::vector<double> around = at({*found - apart_s, *found});
  if (around.size() < 2) return {*found, std::nullopt, false};
  const double slope = (around[1] - around[0]) / apart_s;
  ReachedTime reached{*found, std::nullopt, false};
  if (!(slope > 0)) return reached;
  double left_s = around[1] / slope;
  *reached.t_s -= left_s;
  for (int k = 0; k < kMost && std::abs(left_s) > kEnough * bound / slope; ++k) {
    const std::vector<double> there = at({*reached.t_s});
    if (there.empty()) return reached;
    left_s = there[0] / slope;
    *reached.t_s -= left_s;
  }
  // The error may move the time: by the slope; or farther, where an earlier swing nearly comes to the level, or the later part hardly does.
  if (!looks.resolved || !early || !late) return reached;
  double error_s = kCurved * bound / slope + std::abs(left_s);
  if (*reached.t_s - *early > step_s) error_s = std::max(error_s, *reached.t_s - *early);
  if (*late - *reached.t_s > step_s) error_s = std::max(error_s, *late - *reached.t_s);
  return {*reached.t_s, error_s + 4 * real::epsilon<double>() * *reached.t_s};
}

MotionReport::Reached reached_by_both(const LookSource& source, const EvenLooks& looks, NumberOf number, double level,
                                      double bound) {
  const ReachedTime rotating = first_reached(source, looks, kRotating, number, level, bound),
                    reference = first_reached(source, looks, kReference, number, level, bound);
  return {rotating.t_s, reference.t_s, rotating.bound_s, reference.bound_s, rotating.is_sure, reference.is_sure};
}

/// The state that a swing is told from.
struct SwingState {
  std::array<double, 7> numbers;  // axis, its rate, spin
  Vec3<double> axis_L() const { return {numbers[0], numbers[1], numbers[2]}; }
  Vec3<double> rate_L() const { return {numbers[3], numbers[4], numbers[5]}; }
};

SwingState swing_state(const DriftRow& row, const Motion& motion) {
  const auto& w = row.*motion.w_LB_B;
  const auto& n = row.*motion.axis_L;
  const Vec3<double> rate_L = rotation_matrix(quaternion_of(row.*motion.q_LB)) * Vec3<double>(w[1], -w[0], 0);
  return {{n[0], n[1], n[2], rate_L[0], rate_L[1], rate_L[2], w[2]}};
}

/// Tells swings of one pendulum.
class SwingTeller {
 public:
  SwingTeller(const SymmetricTop<double>& pendulum, double up_rad_s, const MotionBounds& bounds)
      : pendulum_(pendulum), up_rad_s_(up_rad_s), bounds_(bounds) {}

  std::optional<Swing<double>> at(const SwingState& state) const {
    return swing_of(pendulum_, state.axis_L(), state.rate_L(), state.numbers[6], up_rad_s_);
  }
  /// The rate at which the plane turns in the laboratory as long as nothing disturbs the swing (rad/s).
  double rate_of(const Swing<double>& swing) const { return swing.apsidal_rate_rad_s + up_rad_s_; }

  /// Errors of semi-axes and azimuth that the errors of a state cause.
  /// @param is_release  which has no error but its rounding
  std::array<double, 3> errors(const SwingState& state, const Swing<double>& swing, bool is_release) const {
    constexpr double kStep = 0x1p-20, kRounding = 8 * 0x1p-53, kOfFunctions = 1e-14;  // parts of the amplitude
    const double size = std::max(swing.major_rad, 1e-12), rate = real::sqrt(2 * std::abs(pendulum_.mgl) / pendulum_.I1) * size;
    std::array<double, 3> sum{kOfFunctions * size, kOfFunctions * size, 0};
    for (std::size_t i = 0; i < state.numbers.size(); ++i) {
      const bool is_axis = i < 3, is_spin = i == 6;
      const double step = kStep * (is_axis ? size : is_spin ? std::max(rate, std::abs(state.numbers[6])) : rate);
      SwingState above = state, below = state;
      above.numbers[i] += step, below.numbers[i] -= step;
      const auto high = at(above), low = at(below);
      const double none = HUGE_VAL;
      const double error = kRounding * std::abs(state.numbers[i]) + (is_release ? 0
                                                                     : is_axis  ? bounds_.attitude_rad
                                                                     : is_spin  ? bounds_.spin_rad_s
                                                                                : rate_error(state));
      if (!high || !low) return {none, none, none};
      sum[0] += error * std::abs(high->major_rad - low->major_rad) / (2 * step);
      sum[1] += error * std::abs(high->minor_rad - low->minor_rad) / (2 * step);
      if (high->azimuth_rad && low->azimuth_rad)
        sum[2] += error * std::abs(std::remainder(*high->azimuth_rad - *low->azimuth_rad, std::numbers::pi)) / (2 * step);
      else
        sum[2] = none;
    }
    return sum;
  }

 private:
  /// The error of the axis's rate in the laboratory: the error of the rate across the axis, and the turn of the body's axes.
  double rate_error(const SwingState& state) const {
    return bounds_.rate_rad_s + bounds_.attitude_rad * real::hypot(state.numbers[3], state.numbers[4], state.numbers[5]);
  }
  SymmetricTop<double> pendulum_;
  double up_rad_s_;
  MotionBounds bounds_;
};

/// The swing that one motion tells of.
struct ToldSwing {
  BoundedNumber major_start, minor_start, major_end, minor_end, plane_rate;
};

std::optional<ToldSwing> swing_of_motion(const SwingTeller& teller, const Motion& motion, const RunResult& result) {
  const DriftRow &first = result.rows.front(), &last = result.rows.back();
  const SwingState start = swing_state(first, motion), end = swing_state(last, motion);
  const auto at_start = teller.at(start), at_end = teller.at(end);
  if (!at_start || !at_end || !at_start->azimuth_rad || !at_end->azimuth_rad || !(last.t_s > first.t_s)) return std::nullopt;
  // Between two looks the plane turns by what an undisturbed swing would make it turn, roughly: so half turns are counted.
  double turned = 0, t_s = first.t_s;
  Swing<double> before = *at_start;
  const auto go_on = [&](double to_s, const Swing<double>& swing) {
    if (!swing.azimuth_rad || !(to_s > t_s)) return;
    const double expected = (to_s - t_s) * (teller.rate_of(before) + teller.rate_of(swing)) / 2;
    turned += expected + std::remainder(*swing.azimuth_rad - *before.azimuth_rad - expected, std::numbers::pi);
    before = swing, t_s = to_s;
  };
  constexpr std::size_t kCounted = 256;  // looks; of an undisturbed swing the two ends would do
  const std::size_t stride = 1 + result.looks.size() / kCounted;
  for (std::size_t i = 0; i < result.looks.size() && result.looks[i].t_s < last.t_s; i += stride)
    if (const auto swing = teller.at(swing_state(result.looks[i], motion))) go_on(result.looks[i].t_s, *swing);
  go_on(last.t_s, *at_end);
  const auto start_errors = teller.errors(start, *at_start, true), end_errors = teller.errors(end, *at_end, false);
  const double duration_s = last.t_s - first.t_s;
  return ToldSwing{{at_start->major_rad, start_errors[0]},
                   {at_start->minor_rad, start_errors[1]},
                   {at_end->major_rad, end_errors[0]},
                   {at_end->minor_rad, end_errors[1]},
                   {turned / duration_s, (start_errors[2] + end_errors[2]) / duration_s}};
}

/// Whether a swing is that of a pendulum, and not of a top whose spin holds it: the spin turns the plane by less than a quarter turn a swing.
bool is_slow(const SymmetricTop<double>& pendulum, double spin_rad_s) {
  const double axial = pendulum.I3 / pendulum.I1 * spin_rad_s;
  return axial * axial < std::abs(pendulum.mgl) / pendulum.I1;
}

std::optional<MotionReport::OfSwing> swing_report(const MotionBounds& bounds, const RunResult& result) {
  const Scene& scene = result.modelled;
  const std::optional<SymmetricTop<double>> pendulum = pendulum_of(scene);
  if (!pendulum || !is_slow(*pendulum, result.rows.front().w_LB_B[2])) return std::nullopt;
  const double up_rad_s = scene.rotation_rate_rad_s() * celestial_axis_L<double>(scene.site())[2];
  const auto rotating = swing_of_motion({*pendulum, up_rad_s, bounds}, kRotating, result),
             reference = swing_of_motion({*pendulum, 0, bounds}, kReference, result);
  if (!rotating || !reference) return std::nullopt;
  return MotionReport::OfSwing{{rotating->major_start, reference->major_start},
                               {rotating->minor_start, reference->minor_start},
                               {rotating->major_end, reference->major_end},
                               {rotating->minor_end, reference->minor_end},
                               {rotating->plane_rate, reference->plane_rate}};
}

}  // namespace

MotionReport motion_report(const LookSource& source, const MotionBounds& bounds, const RunResult& result) {
  MotionReport report;
  const DriftRow& last = result.rows.back();
  report.spin_end_rad_s = {{spin_of(last, kRotating), bounds.spin_rad_s}, {spin_of(last, kReference), bounds.spin_rad_s}};
  const Scenario& scenario = result.scene.scenario();
  if (scenario.reported_spin_rad_s || scenario.reported_tilt_deg) {
    const EvenLooks looks = even_looks(source, result);
    if (scenario.reported_spin_rad_s)
      report.spin = reached_by_both(source, looks, spin_of, *scenario.reported_spin_rad_s, bounds.spin_rad_s);
    if (scenario.reported_tilt_deg)
      report.tilt =
          reached_by_both(source, looks, tilt_of, *scenario.reported_tilt_deg * std::numbers::pi / 180, bounds.attitude_rad);
  }
  report.swing = swing_report(bounds, result);
  return report;
}

}  // namespace earthtop
