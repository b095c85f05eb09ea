// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/trend.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "earthtop/closed_form/mean_precession.hpp"
#include "earthtop/scenario/support.hpp"
#include "run/assessment.hpp"
#include "scene/parts.hpp"

namespace earthtop {
namespace {

constexpr double kWholeTurn = 2 * std::numbers::pi;
constexpr double kMostAzimuths = 1e5;
constexpr double kFewestAzimuths = 100;

constexpr const char* kTooLittle = "too little of the run is reliable";
constexpr const char* kThroughVertical = "an axis passes through the vertical";
constexpr const char* kMovedAsFar = "the Earth moves the axis about as far as the axis is from the vertical";

/// Names what acts on the top besides gravity and the Earth's rotation; empty if nothing does.
std::string other_action(const Scene& scene) {
  const Scenario& s = scene.scenario();
  if (const std::string_view reason = scene.support().no_trend; !reason.empty()) return std::string(reason);
  if (s.platform && s.platform->pivot_offset_m != std::array<double, 3>{}) return "the pivot rides on a platform";
  if (s.effects.applied.friction()) return "friction acts";
  if (s.effects.applied.gimbal) return "a gimbal holds the axis";
  if (s.effects.applied.unequal_support) return "the support is not equally stiff";
  if (s.effects.applied.given_torque) return "a given torque acts";
  if (s.effects.tide) return "the tide changes with time";
  if (!s.effects.all_on()) return "a non-inertial torque is left out";
  return "";
}

/// Whether the non-rotating prediction rests in its gimbal. The axis on the rotating Earth then swings, or rests too.
bool rests_in_gimbal(const Scene& scene) {
  const AppliedTorquesSpec& applied = scene.scenario().effects.applied;
  if (!applied.gimbal || applied.gravity_gradient || scene.scenario().platform || scene.scenario().effects.tide) return false;
  const Release<double>& release = scene.release<double>();
  const Vec3<double> up_B = rotation_matrix(release.q_LB).row(2).transpose();
  return up_B[0] * release.w_XB_B[0] + up_B[1] * release.w_XB_B[1] == 0;  // the axis is level, so that the spin turns nothing
}

/// The time within which the trend is looked for. After some hundred turns the weights of a fit have taken out each swing down to its
/// rounding, while that of the integration makes the rate worse the longer it lasts. So later turns count only where a sum of a few
/// precessions and multiples of the nutation is slow.
double window_that_suffices(const TrendFrequencies& frequencies, double duration) {
  constexpr double kCycles = 10;
  constexpr int kSums = 4;
  const double window = kTrendTurns * kWholeTurn / std::abs(frequencies.precession_rad_s);
  if (!frequencies.exact || !(window < duration)) return duration;
  for (int k = 1; k <= kSums; ++k) {
    const double turns = k * frequencies.precession_rad_s / frequencies.nutation_rad_s, slow = turns - std::round(turns);
    if (std::abs(slow) * frequencies.nutation_rad_s * window < kCycles * kWholeTurn) return duration;
  }
  return window;
}

/// How often the slowest swing that the looks show instead of a fast one goes round within a window, counted the more leniently the
/// smaller the swing is. The swings are those at multiples of the nutation, alone and with up to twice the precession added or taken
/// away.
double cycles_of_slowest_alias(double step, double window, const TrendFrequencies& frequencies) {
  constexpr int kMultiples = 12, kSums = 2;
  double slowest = HUGE_VAL;
  for (int j = 1; j <= kMultiples; ++j)
    for (int k = -kSums; k <= kSums; ++k) {
      const double cycles_a_step =
          std::abs(j * frequencies.nutation_rad_s + k * frequencies.precession_rad_s) * step / kWholeTurn;
      // The higher the multiple, the smaller is the swing; with twice the precession it is of second order in the Earth's rate.
      const double smaller = j * (std::abs(k) == kSums ? 4 : 1);
      if (cycles_a_step > 0.5) slowest = std::min(slowest, smaller * std::abs(cycles_a_step - std::round(cycles_a_step)));
    }
  return slowest * window / step;
}

/// The longest step between looks, about that of the least count of them or shorter, at which every fast swing still looks fast.
double step_between_looks(double duration, double least_count, const TrendFrequencies& frequencies) {
  constexpr double kFirst = 1.1, kNext = 0.98, kFast = 100;
  constexpr int kTried = 80;  // down to a fifth
  double tried = kFirst * duration / std::clamp(least_count, kFewestTrendLooks, kMostAzimuths), best = tried, best_cycles = 0;
  const double window = window_that_suffices(frequencies, duration);
  for (int i = 0; i < kTried && best_cycles < kFast; ++i, tried *= kNext)
    if (const double cycles = cycles_of_slowest_alias(tried, window, frequencies); cycles > best_cycles)
      best = tried, best_cycles = cycles;
  return best;
}

std::vector<double> times_in_steps(double duration, double step) {
  std::vector<double> times;
  for (std::size_t k = 0; step * static_cast<double>(k) < duration; ++k) times.push_back(step * static_cast<double>(k));
  return times;
}

/// The mean rate of the reference's azimuth (rad/s, counterclockwise), with weights that fall to zero at both ends.
double mean_precession(std::span<const AzimuthSample> azimuths, double step) {
  double sum = 0, weights = 0, before = 0;
  const auto count = static_cast<double>(azimuths.size() - 1);
  for (std::size_t i = 0; i < azimuths.size(); ++i) {
    const double angle = real::atan2(azimuths[i].ref_north, azimuths[i].ref_east);
    if (i > 0) {
      const double turned = angle - before, x = (static_cast<double>(i) - 0.5) / count;
      const double weight = real::exp(-1 / (x * (1 - x)));
      sum += weight * (turned - kWholeTurn * std::round(turned / kWholeTurn));
      weights += weight * step;
    }
    before = angle;
  }
  return sum / weights;
}

/// The Earth must not move the axis as far as it stands from the vertical: the azimuths would tell nothing of each other.
bool azimuths_tell(std::span<const AzimuthSample> azimuths) {
  double widest = 0, ref_widest = 0;
  for (const AzimuthSample& look : azimuths) {
    widest = std::max(widest, look.horizontal);
    ref_widest = std::max(ref_widest, real::hypot(look.ref_east, look.ref_north));
  }
  return widest < 2 * ref_widest && ref_widest < 2 * widest;
}

/// The bound on the azimuth drift over the time that it had to grow, from the first look at the end of a window or later, and none later
/// than the last that is reliable.
double azimuth_bound_a_second(const RunResult& result, double window_end, double reliable_until) {
  double bound = 0;
  for (const DriftRow& row : result.looks) {
    if (row.t_s > reliable_until) break;
    if (row.drift_azimuth_rad && horizontal(row) > 0 && row.t_s > 0)
      bound = row.drift_axis_bound_rad / horizontal(row) / row.t_s;
    if (row.t_s >= window_end) break;
  }
  return bound;
}

/// A swing slower than the run adds this to the bound of the rate. A window shifted by a part of such a swing's period sees another
/// slope by about that part of the swing's rate, so that the fit's own bound, which windows have told, over the part of a period that
/// the run sees bounds the swing where its expected size is pessimistic or not known.
double bound_of_slow_swing(const SlowSwing& swing, double duration, double bound_of_fit) {
  if (!(swing.rate_rad_s > 0)) return 0;
  const double seen = swing.frequency_rad_s * duration / kWholeTurn;
  return std::min(swing.rate_rad_s, swing.unseen * bound_of_fit / seen);
}

/// The mean of a motion on which more than gravity and the Earth's rotation acts, over the looks until the drift is no longer reliable.
void take_mean(const RunResult& result, SecularDrift& trend) {
  const auto last = std::find_if(result.looks.rbegin(), result.looks.rend(),
                                 [&](const DriftRow& look) { return look.t_s <= result.verdict.reliable_until_s; });
  if (last == result.looks.rend() || !(last->t_s > 0)) {
    trend.reason = kTooLittle;
    return;
  }
  if (!last->drift_azimuth_rad || !result.looks.front().drift_azimuth_rad) {
    trend.reason = kThroughVertical;
    return;
  }
  trend.window_s = {0, last->t_s};
  trend.azimuth_rate_rad_s = *last->drift_azimuth_rad / last->t_s;
  trend.azimuth_rate_bound_95_rad_s = azimuth_bound_a_second(result, last->t_s, last->t_s);
  trend.of_window = true;
}

/// Whether the run is made of Fourier sums, which tell the secular rate wherever there is one.
bool is_of_sums(const Scene& scene) { return scene.choice().options.method == Method::fourier; }

}  // namespace

TrendPlan plan_trend(const Scene& scene) {
  TrendPlan plan;
  if (rests_in_gimbal(scene)) {
    plan.no_precession =
        "the axis is released at rest in its gimbal: it swings to and fro, and its azimuth has no secular rate";
    return plan;
  }
  plan.mean_only = other_action(scene);
  if (!plan.mean_only.empty()) return plan;
  if (scene.gravity_torque_N_m() == 0) {
    plan.no_precession = "no torque of gravity acts, so that the axis does not precess";
    return plan;
  }
  const double duration = scene.scenario().duration_s;
  if (scene.symmetry_axis() == 2) {
    const std::optional<MeanRates> rates = mean_rates(top_constants_of(scene));
    if (!rates || rates->jumps() || rates->precession_rad_s == 0) {
      plan.no_precession = "the azimuth of the non-rotating prediction does not advance at a mean rate";
      return plan;
    }
    plan.frequencies = TrendFrequencies{rates->precession_rad_s, rates->nutation_rad_s};
    const double turns = std::abs(rates->precession_rad_s) * duration / kWholeTurn;
    if (is_of_sums(scene)) {
      if (!scene.fourier_outlook().has_azimuth_rate) plan.no_precession = kMovedAsFar;
      return plan;
    }
    if (turns < 1) return plan;
    // A tilt that is not a simple sine has many multiples of its frequency, all of which must be seen.
    constexpr int kSimple = 32;
    const double period = kWholeTurn / rates->nutation_rad_s;
    const double of_nutation = rates->parts > kSimple ? 0.5 * rates->parts * duration / period : 0;
    const double least_count = std::max(turns * kTrendLooksATurn, of_nutation);
    // Where these are too many, the rest of the run is not looked at.
    const double looked_at = least_count > kMostAzimuths ? window_that_suffices(*plan.frequencies, duration) : duration;
    plan.times_s =
        times_in_steps(looked_at, step_between_looks(looked_at, least_count * looked_at / duration, *plan.frequencies));
    return plan;
  }
  constexpr double kAzimuthsATurn = 3.3;
  const double looks =
      std::clamp(duration * scene.fastest_rate_rad_s() / kWholeTurn * kAzimuthsATurn, kFewestTrendLooks, kMostAzimuths);
  plan.times_s = times_in_steps(duration, duration / std::ceil(looks));
  return plan;
}

std::optional<SecularDrift> assess_trend(const RunResult& result, const TrendPlan& plan, std::span<const AzimuthSample> seen) {
  if (std::ranges::count_if(result.looks, [](const DriftRow& look) { return look.drift_azimuth_rad.has_value(); }) < 3)
    return std::nullopt;
  SecularDrift trend;
  trend.reason = plan.no_precession;
  if (!trend.reason.empty()) return trend;
  if (!plan.mean_only.empty()) {
    trend.reason = plan.mean_only;
    take_mean(result, trend);
    return trend;
  }
  const double until = std::min(result.reached_s, result.verdict.reliable_until_s);
  const auto under_one_turn = [&](double turns) {
    trend.turns_seen = turns;
    constexpr double kMost = 0.99;  // of less than one turn, two digits are not to show one
    trend.reason = fmt::format("{} covers {:.2g} turns of precession, and a trend needs at least one",
                               until < result.reached_s ? "what is reliable of the run" : "the run", std::min(turns, kMost));
    return trend;
  };
  trend.window_s = {0, until};
  if (const Scene& scene = result.modelled; plan.frequencies && is_of_sums(scene)) {
    trend.reason = kTooLittle;
    if (!(until > 0)) return trend;
    trend.reason.clear();
    trend.turns_seen = std::abs(plan.frequencies->precession_rad_s) * until / kWholeTurn;
    trend.azimuth_rate_rad_s = scene.fourier_outlook().azimuth_rate_rad_s;
    trend.azimuth_rate_bound_95_rad_s = scene.fourier_outlook().azimuth_rate_bound_rad_s;
    return trend;
  }
  if (plan.frequencies)
    if (const double turns = std::abs(plan.frequencies->precession_rad_s) * until / kWholeTurn; turns < 1)
      return under_one_turn(turns);

  std::size_t count = 0;
  while (count < seen.size() && plan.times_s[count] <= until) ++count;
  const std::span<const AzimuthSample> azimuths = seen.first(count);
  trend.reason = kTooLittle;
  if (static_cast<double>(count) < kFewestAzimuths) return trend;
  trend.reason = kThroughVertical;
  if (!std::ranges::all_of(azimuths, &AzimuthSample::defined)) return trend;
  trend.reason = kMovedAsFar;
  if (!azimuths_tell(azimuths)) return trend;

  const double step = plan.times_s[1];
  TrendFrequencies frequencies;
  if (plan.frequencies) {
    frequencies = *plan.frequencies;
  } else {
    frequencies.exact = false;
    frequencies.precession_rad_s = mean_precession(azimuths, step);
    const Body<double>& body = result.modelled.body<double>();
    frequencies.nutation_rad_s = std::abs(body.I_BP_B(2, 2) * result.modelled.release<double>().w_XB_B[2]) /
                                 (0.5 * (body.I_BP_B(0, 0) + body.I_BP_B(1, 1)));
  }
  const auto sufficient = static_cast<std::size_t>(window_that_suffices(frequencies, plan.times_s[count - 1]) / step) + 1;
  const std::span<const AzimuthSample> fitted = azimuths.first(std::min(count, sufficient));
  trend.window_s = {0, plan.times_s[fitted.size() - 1]};
  const double turns = std::abs(frequencies.precession_rad_s) * trend.window_s[1] / kWholeTurn;
  constexpr double kAlmostOne = 0.99;  // the looks of a run of just one turn may end a little earlier
  if (turns < kAlmostOne) return under_one_turn(turns);
  trend.turns_seen = turns;
  std::vector<double> drift;
  drift.reserve(fitted.size());
  for (const AzimuthSample& look : fitted) drift.push_back(look.drift_rad);
  const TrendEstimate estimate = estimate_trend(drift, step, frequencies);
  trend.reason = "the swings cannot be told apart from a trend";
  if (!std::isfinite(estimate.bound_rad_s)) return trend;
  trend.reason.clear();
  trend.azimuth_rate_rad_s = estimate.rate_rad_s;
  // The drift's own error, at either end, adds to that of the fit.
  trend.azimuth_rate_bound_95_rad_s =
      estimate.bound_rad_s +
      bound_of_slow_swing(unseen_swing(result.modelled, trend.window_s[1]), trend.window_s[1], estimate.bound_rad_s) +
      2 * azimuth_bound_a_second(result, trend.window_s[1], until);
  return trend;
}

}  // namespace earthtop
