// SPDX-License-Identifier: GPL-3.0-or-later
// Theory of a Cardan suspension: the drift by nutation after Magnus, a balanced gyroscope that keeps its direction, and slow swings about
// a place of rest, as of a gyrocompass.
#include <fmt/core.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "earthtop/closed_form/special_cases.hpp"
#include "earthtop/model/gimbal_equations.hpp"
#include "earthtop/scenario/support.hpp"
#include "run/assessment.hpp"
#include "scene/gimbal_rest.hpp"

namespace earthtop {
namespace {

/// Some of the looks, evenly and with the last: enough to fit a few harmonics.
std::vector<DriftRow> thinned(const std::vector<DriftRow>& looks) {
  constexpr std::size_t kMost = 2000;
  const std::size_t stride = (looks.size() + kMost - 1) / kMost;
  std::vector<DriftRow> some;
  for (std::size_t left = looks.size(); left > 0; left -= std::min(left, stride)) some.push_back(looks[left - 1]);
  std::ranges::reverse(some);
  return some;
}

/// A line with swings at a rate and its multiples, fitted to one angle of the looks.
struct FittedSwing {
  double middle, slope, amplitude;
  double rest;  ///< the largest distance of a look from the fit
};
/// @param value  takes a row to the angle
template <class Value>
std::optional<FittedSwing> fitted_swing(const std::vector<DriftRow>& looks, double rate, const Value& value) {
  constexpr Eigen::Index kHarmonics = 3, kColumns = 2 + 2 * kHarmonics;
  const auto count = static_cast<Eigen::Index>(looks.size());
  if (count < 2 * kColumns) return std::nullopt;
  Eigen::MatrixXd columns(count, kColumns);
  Eigen::VectorXd angles(count);
  const double end = looks.back().t_s;
  for (Eigen::Index i = 0; i < count; ++i) {
    const DriftRow& look = looks[static_cast<std::size_t>(i)];
    columns(i, 0) = 1, columns(i, 1) = look.t_s / end - 0.5;
    for (Eigen::Index k = 0; k < kHarmonics; ++k) {
      const double phase = static_cast<double>(k + 1) * rate * look.t_s;
      columns(i, 2 + 2 * k) = real::cos(phase), columns(i, 3 + 2 * k) = real::sin(phase);
    }
    angles(i) = value(look);
  }
  const Eigen::VectorXd found = columns.colPivHouseholderQr().solve(angles);
  return FittedSwing{found(0), found(1) / end, real::hypot(found(2), found(3)),
                     (columns * found - angles).cwiseAbs().maxCoeff()};
}

/// The rate at which an angle swings, near one that is expected: where the fit is best.
template <class Value>
std::optional<double> swinging_rate(const std::vector<DriftRow>& looks, double expected, double within, const Value& value) {
  double low = expected * (1 - within), high = expected * (1 + within);
  const auto rest = [&](double rate) {
    const auto fit = fitted_swing(looks, rate, value);
    return fit ? fit->rest : HUGE_VAL;
  };
  constexpr int kCoarse = 40, kFine = 50;
  double best = expected;
  for (int i = 0; i <= kCoarse; ++i)
    if (const double rate = low + (high - low) * i / kCoarse; rest(rate) < rest(best)) best = rate;
  low = best - (high - low) / kCoarse, high = best + 2 * (best - low) - (best - low);
  const double golden = (std::sqrt(5.0) - 1) / 2;
  for (int i = 0; i < kFine; ++i) {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    (rest(a) < rest(b) ? high : low) = rest(a) < rest(b) ? b : a;
  }
  const double rate = (low + high) / 2;
  return std::isfinite(rest(rate)) ? std::optional(rate) : std::nullopt;
}

double reference_outer(const DriftRow& row) { return row.gimbals->ref_outer_angle_rad; }
double reference_inner(const DriftRow& row) { return row.gimbals->ref_inner_angle_rad; }
double rotating_outer(const DriftRow& row) { return row.gimbals->outer_angle_rad; }

/// The moment about the outer axis at an inner angle, without skew and products.
double outer_moment(const Model<double>& model, double inner) {
  const double sine = real::sin(inner), cosine = real::cos(inner);
  return model.gimbals.ring.I(2, 2) + model.I_BP_B(0, 0) * sine * sine + model.I_BP_B(2, 2) * cosine * cosine;
}

/// The rate of nutation of a balanced suspension without the Earth, by quadrature between both turning points of the inner angle:
///   N beta'^2 = 2 E - (p_a - h cos(beta))^2 / M(beta)
std::optional<double> nutation_rate(const Scene& scene) {
  const Model<double>& model = scene.model<double>();
  const GimbalAngles<double>& at = model.gimbals.release;
  const double h = gimbal_rotor_momentum(scene);
  const auto moment = [&](double inner) { return outer_moment(model, inner); };
  const double N = model.I_BP_B(1, 1), p_ring = moment(at.inner) * at.outer_rate;
  const auto left = [&](double inner) {  // p_a - h cos(beta)
    return p_ring + 2 * h * real::sin((inner + at.inner) / 2) * real::sin((inner - at.inner) / 2);
  };
  const double energy = N * at.inner_rate * at.inner_rate + p_ring * at.outer_rate;
  const auto square = [&](double inner) { return energy - left(inner) * left(inner) / moment(inner); };
  double middle = at.inner;
  for (int i = 0; i < 20; ++i) middle -= left(middle) / (h * real::sin(middle));
  if (!(std::abs(middle - at.inner) < 1) || !(square(middle) > 0)) return std::nullopt;
  const auto turning = [&](double side) -> std::optional<double> {
    double step = std::sqrt(energy * moment(middle)) / std::abs(h * real::sin(middle)), inside = 0;
    while (square(middle + side * step) > 0 && step < 1) inside = step, step *= 1.5;
    if (!(step < 1)) return std::nullopt;
    for (int i = 0; i < 60; ++i) (square(middle + side * (inside + step) / 2) > 0 ? inside : step) = (inside + step) / 2;
    return middle + side * inside;
  };
  const auto least = turning(-1), most = turning(1);
  if (!least || !most) return std::nullopt;
  constexpr int kPoints = 64;
  double period_s = 0;
  for (int i = 0; i < kPoints; ++i) {
    const double phase = std::numbers::pi * ((i + 0.5) / kPoints - 0.5), reach = (*most - *least) / 2;
    const double f = square((*most + *least) / 2 + reach * real::sin(phase));
    if (!(f > 0)) return std::nullopt;
    period_s += 2 * std::numbers::pi / kPoints * reach * real::cos(phase) * std::sqrt(N / f);
  }
  return 2 * std::numbers::pi / period_s;
}

/// The drift of the outer angle that nutation makes, to second order in its amplitude X about b:
///   - h X^2 cos(b) (A3 + B3) / (2 M0^2)                              [K. Magnus, Kreisel (1971)]
std::optional<TheoryReport> magnus_drift(const Scene& scene, const std::vector<DriftRow>& looks) {
  constexpr double kFewest = 3;  // nutations
  if (!has_magnus_drift(scene)) return std::nullopt;
  const std::optional<double> rate = nutation_rate(scene);
  if (!rate || !(*rate * looks.back().t_s > 2 * std::numbers::pi * kFewest)) return std::nullopt;
  const auto inner = fitted_swing(looks, *rate, reference_inner), outer = fitted_swing(looks, *rate, reference_outer);
  const double X = inner->amplitude, b = inner->middle, h = gimbal_rotor_momentum(scene);
  constexpr double kSmallest = 1e-9;  // rad: less is rounding
  if (!(X > kSmallest) || !(inner->rest < 0.1 * X)) return std::nullopt;
  const Model<double>& model = scene.model<double>();
  const double sine = real::sin(b), cosine = real::cos(b);
  const double axial = model.gimbals.ring.I(2, 2) + model.I_BP_B(2, 2), M0 = outer_moment(model, b);
  TheoryReport report;
  report.name = "magnus_drift";
  report.statement =
      "mean rate of the outer angle in the non-rotating prediction, -h X^2 cos(b) (A3 + B3)/(2 M0^2), of a nutation X about b";
  report.unit = "rad/s";
  report.predicted = -h * X * X * cosine * axial / (2 * M0 * M0);
  // Terms of the next order were 0.65 X^2 at 60 degrees; near gimbal lock they grow as the square of X over the angle from it.
  const double relative = 4 * X * X * (1 + 1 / (sine * sine) + 1 / std::max(cosine * cosine, 1e-12) * X * X);
  report.predicted_error = relative * std::abs(report.predicted) + h * X * X * X * X * axial / (M0 * M0);
  report.applies = relative < 0.1;
  report.computed = outer->slope;
  report.computed_error = 8 * outer->rest / looks.back().t_s + 1e-6 * std::abs(outer->slope);
  return report;
}

/// A balanced suspension at rest keeps the rotor's axis in inertial space, but for the nutation that the release excites.
std::optional<TheoryReport> kept_direction(const Scene& scene, const std::vector<DriftRow>& looks, const DriftSummary& drift) {
  const GimbalReleaseSpec& release = *scene.scenario().release.gimbals;
  if (!has_magnus_drift(scene) || release.outer_rate_rad_s != 0 || release.inner_rate_rad_s != 0) return std::nullopt;
  const Model<double>& model = scene.model<double>();
  const Vec3<double> c_L = times(rotation_matrix(scene.release<double>().q_LB), model.rotor.axis_B);
  const double cross = norm(Vec3<double>(celestial_axis_L<double>(scene.site()).cross(c_L)));
  const double Omega = scene.rotation_rate_rad_s(), t = looks.back().t_s;
  const GimbalInertia inertia = gimbal_inertia(scene);
  const double sine = std::abs(real::sin(model.gimbals.release.inner)), h = std::abs(gimbal_rotor_momentum(scene));
  TheoryReport report;
  report.name = "free_gyro_axis_drift";
  report.statement = "the rotor's axis stays in inertial space: 2 asin(sin(angle from the celestial axis) |sin(Omega t/2)|)";
  report.unit = "rad";
  report.predicted = balanced_gyroscope_drift(cross <= 4 * real::epsilon<double>() ? 0 : cross, Omega, t);
  // The gimbals' inertia makes the Earth's rate nutate the axis by Omega (M + N) / (h sin b), and moves the centre of this by as much.
  report.predicted_error = 3 * std::abs(Omega) * (inertia.outer + inertia.inner) / (h * sine * sine);
  report.applies = report.predicted_error < 0.1 * report.predicted;
  report.computed = drift.rotor_axis_final_rad.value_or(0);
  report.computed_error = drift.rotor_axis_bound_rad;
  return report;
}

/// The slow swing of the outer angle about a place of rest, and this place.
std::vector<TheoryReport> slow_swing(const Scene& scene, const std::vector<DriftRow>& looks) {
  const Gimbals<double>& gimbals = scene.model<double>().gimbals;
  const auto is_braked = [](const Bearing<double>& b) { return b.viscous != 0 || b.coulomb != 0; };
  if (gimbals.outer.locked || is_braked(gimbals.outer) || is_braked(gimbals.inner)) return {};
  const std::optional<GimbalRest> rest = gimbal_rest(scene, Prediction::rotating);
  constexpr double kLeastTurn = 1.1, kSlow = 3600;
  if (!rest || !rest->slow_period_s || *rest->slow_period_s > kSlow * 4 ||
      !(looks.back().t_s > kLeastTurn * *rest->slow_period_s))
    return {};
  const double expected = 2 * std::numbers::pi / *rest->slow_period_s;
  const std::optional<double> rate = swinging_rate(looks, expected, 0.1, rotating_outer);
  if (!rate) return {};
  const auto fit = fitted_swing(looks, *rate, rotating_outer);
  // A swing of a finite size is slower by a sixteenth of its square, and its middle moves by less than that.
  const double square = fit->amplitude * fit->amplitude;
  if (!(fit->rest < 0.2 * fit->amplitude)) return {};
  TheoryReport period;
  period.name = gimbals.inner.locked ? "compass_period" : "slow_period";
  period.statement = "period of a small swing of the outer gimbal about its place of rest, with the inertia of both gimbals";
  period.unit = "s";
  period.predicted = *rest->slow_period_s;
  period.predicted_error = square / 4 * period.predicted;
  period.applies = square < 0.2;
  period.computed = 2 * std::numbers::pi / *rate;
  period.computed_error = *period.computed * (fit->rest / fit->amplitude + 1e-6);
  TheoryReport middle;
  middle.name = "middle_of_swing";
  middle.statement = "outer angle at which the torques of the Earth's rotation, gravity and springs balance";
  middle.unit = "rad";
  middle.predicted = rest->outer_rad;
  middle.predicted_error = square * fit->amplitude;
  middle.applies = square < 0.2;
  middle.computed = fit->middle;
  middle.computed_error = fit->rest + std::abs(fit->slope) * looks.back().t_s;
  return {period, middle};
}

/// The angle at which spring, weight and gyroscopic torque hold the gimbal that is free alone, once its damper has brought it to rest.
std::optional<TheoryReport> settled_angle(const Scene& scene, const std::vector<DriftRow>& looks) {
  const Gimbals<double>& gimbals = scene.model<double>().gimbals;
  if (gimbals.outer.locked == gimbals.inner.locked) return std::nullopt;
  const Bearing<double>& free = gimbals.outer.locked ? gimbals.inner : gimbals.outer;
  if (free.viscous == 0 || free.coulomb != 0) return std::nullopt;
  const std::optional<GimbalRest> rest = gimbal_rest(scene, Prediction::reference);
  if (!rest) return std::nullopt;
  const auto angle = [&](const DriftRow& row) { return gimbals.outer.locked ? reference_inner(row) : reference_outer(row); };
  const double last = angle(looks.back()), reach = std::abs(last - angle(looks.front()));
  double swing = 0;  // in the last fifth
  for (auto look = looks.end() - static_cast<std::ptrdiff_t>(looks.size() / 5); look != looks.end(); ++look)
    swing = std::max(swing, std::abs(angle(*look) - last));
  if (!(swing < 1e-3 * reach)) return std::nullopt;
  TheoryReport report;
  report.name = "settled_angle";
  report.statement =
      "angle of the free gimbal, in the non-rotating prediction, at which spring, weight and gyroscopic torque balance";
  report.unit = "rad";
  report.predicted = gimbals.outer.locked ? rest->inner_rad : rest->outer_rad;
  report.predicted_error = 1e-14;
  report.applies = true;
  report.computed = last;
  report.computed_error = 2 * swing + 1e-14;
  return report;
}

/// The angle by which masses turn a body that only turns about an upright axis: Omega sin(latitude) times the integral of I(0)/I - 1.
std::optional<TheoryReport> turn_by_masses(const Scene& scene, const std::vector<DriftRow>& looks, const DriftSummary& drift) {
  const Scenario& scenario = scene.scenario();
  const Model<double>& model = scene.model<double>();
  const Gimbals<double>& gimbals = model.gimbals;
  const Bearing<double>& outer = gimbals.outer;
  if (!masses_move(scenario) || gimbals.has_rotor || scenario.platform || !scenario.effects.plain() || !gimbals.inner.locked ||
      outer.viscous != 0 || outer.coulomb != 0 || outer.torsion != 0 || gimbals.R_P0(2, 2) != 1 ||
      scenario.release.rates_relative_to != RatesRelativeTo::laboratory)
    return std::nullopt;
  const GimbalPose<double, double> pose{gimbals, real::sin_cos(gimbals.release.outer), real::sin_cos(gimbals.release.inner)};
  const auto moment = [&](double t) {
    const CarriedParts<double> parts = carried_parts(model, t);
    const Vec3<double> a_B = pose.outer_axis_B();
    return parts.ring.I(2, 2) + a_B.dot(times(parts.body.I, a_B));
  };
  constexpr int kPoints = 10'000;
  const double end = looks.back().t_s, first = moment(0), step = end / kPoints;
  double angle = 0;
  for (int i = 0; i < kPoints; ++i) angle += step * (first / moment((i + 0.5) * step) - 1);
  const double upward = model.W_IL_L[2], turned = scene.rotation_rate_rad_s() * end;
  TheoryReport report;
  report.name = "turn_by_masses";
  report.statement = "angle of the outer gimbal that the Earth's rate about Up makes as the moment of inertia changes";
  report.unit = "rad";
  report.predicted = upward * angle;
  report.predicted_error = std::abs(report.predicted) * (turned * turned + 1e-6);  // the level rate, and the sum
  report.applies = turned * turned < 0.01;
  report.computed = drift.outer_angle->final_rad;
  report.computed_error = drift.outer_angle->bound_rad;
  return report;
}

}  // namespace

std::vector<TheoryReport> assess_theory_of_gimbals(const Scene& scene, const std::vector<DriftRow>& all_looks,
                                                   const DriftSummary& drift) {
  std::vector<TheoryReport> reports;
  if (all_looks.size() < 3 || !all_looks.front().gimbals) return reports;
  const std::vector<DriftRow> looks = thinned(all_looks);
  if (scene.rotation_rate_rad_s() != 0) {
    if (auto report = turn_by_masses(scene, looks, drift)) reports.push_back(*std::move(report));
    if (auto report = kept_direction(scene, looks, drift)) reports.push_back(*std::move(report));
    for (TheoryReport& report : slow_swing(scene, looks)) reports.push_back(std::move(report));
  }
  if (auto report = settled_angle(scene, looks)) reports.push_back(*std::move(report));
  if (auto report = magnus_drift(scene, looks)) reports.push_back(*std::move(report));
  return reports;
}

}  // namespace earthtop
