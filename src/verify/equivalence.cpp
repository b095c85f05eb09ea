// SPDX-License-Identifier: GPL-3.0-or-later
// Criteria that compare two runs, or the two motions of one run, where a symmetry gives one from the other.
#include <cmath>
#include <limits>

#include "verify/differences.hpp"
#include "verify/formulas.hpp"
#include "verify/judge.hpp"

namespace earthtop::verify_detail {
namespace {

double difference(double a, double b) { return std::abs(a - b); }
double difference(const std::optional<double>& a, const std::optional<double>& b) {
  if (a.has_value() != b.has_value()) return std::numeric_limits<double>::infinity();
  return a ? std::abs(*a - *b) : 0;
}
template <std::size_t N>
double difference(const std::array<double, N>& a, const std::array<double, N>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < N; ++i) largest = worse(largest, std::abs(a[i] - b[i]));
  return largest;
}
std::optional<double> negative(const std::optional<double>& a) { return a ? std::optional(-*a) : std::nullopt; }

/// The absolute difference of the drifts of two runs. For a mirrored run, azimuth and spin drift are compared with opposite
/// sign.
double drift_difference(const DriftRow& a, const DriftRow& b, bool mirrored) {
  double error = worse(difference(a.drift_axis_rad, b.drift_axis_rad), difference(a.drift_tilt_rad, b.drift_tilt_rad));
  error = worse(error, difference(a.drift_attitude_rad, b.drift_attitude_rad));
  error = worse(error, difference(a.drift_azimuth_rad, mirrored ? negative(b.drift_azimuth_rad) : b.drift_azimuth_rad));
  return worse(error, difference(a.drift_spin_rad, mirrored ? -b.drift_spin_rad : b.drift_spin_rad));
}
double axis_difference(const DriftRow& a, const DriftRow& b) {
  return worse(difference(a.axis_L, b.axis_L), difference(a.ref_axis_L, b.ref_axis_L));
}
std::array<double, 3> mirrored(const std::array<double, 3>& axis) { return {axis[0], -axis[1], axis[2]}; }

struct Pair {
  const RunResult& a;
  const RunResult& b;
};

/// The largest error over the rows of both runs.
template <class Error>
double over_rows(const Pair& pair, double until_s, Error error_of) {
  if (pair.a.rows.size() != pair.b.rows.size()) throw NotJudged("the two runs do not have the same rows");
  double error = 0;
  for (std::size_t i = 0; i < pair.a.rows.size() && pair.a.rows[i].t_s <= until_s; ++i)
    error = worse(error, error_of(pair.a.rows[i], pair.b.rows[i]));
  return error;
}

/// Attitudes, axes and drifts of the two runs are the same (rad).
double same(const Pair& pair, double until_s) {
  return over_rows(pair, until_s, [](const DriftRow& a, const DriftRow& b) {
    const double attitudes = worse(difference(a.q_LB, b.q_LB), difference(a.ref_q_LB, b.ref_q_LB));
    return worse(attitudes, worse(axis_difference(a, b), drift_difference(a, b, false)));
  });
}
/// The axes are the same, however the body turns about them (rad).
double same_axis(const Pair& pair, double until_s) { return over_rows(pair, until_s, axis_difference); }

/// The drifts of axis, azimuth and tilt are the same; relative to the largest axis drift.
double same_drift(const Pair& pair, double until_s) {
  const double error = over_rows(pair, until_s, [](const DriftRow& a, const DriftRow& b) {
    return worse(worse(difference(a.drift_axis_rad, b.drift_axis_rad), difference(a.drift_tilt_rad, b.drift_tilt_rad)),
                 difference(a.drift_azimuth_rad, b.drift_azimuth_rad));
  });
  return error / pair.a.drift.axis_max_rad;
}

double mirrored_north_south(const Pair& pair, double until_s) {
  return over_rows(pair, until_s, [](const DriftRow& a, const DriftRow& b) {
    const double axes = worse(difference(a.axis_L, mirrored(b.axis_L)), difference(a.ref_axis_L, mirrored(b.ref_axis_L)));
    return worse(axes, drift_difference(a, b, true));
  });
}

/// The drifts of axis and attitude are proportional to the Earth's rate; relative to the largest axis drift.
double proportional(const Pair& pair, double until_s) {
  const double A = std::abs(pair.a.scene.rotation_rate_rad_s()), B = std::abs(pair.b.scene.rotation_rate_rad_s());
  double largest = 0;
  const double error = over_rows(pair, until_s, [&](const DriftRow& a, const DriftRow& b) {
    largest = std::max(largest, a.drift_axis_rad / A);
    return worse(std::abs(a.drift_axis_rad / A - b.drift_axis_rad / B),
                 std::abs(a.drift_attitude_rad / A - b.drift_attitude_rad / B));
  });
  return error / largest;
}

/// If at the end all rates are reversed, also the Earth's, the top returns to its release (rad; rates relative to their size).
double reversed_in_time(const RunResult& forth, const Watch& watch) {
  Scenario back = forth.scene.scenario();
  const DriftRow &start = forth.rows.front(), &end = forth.rows.back();
  back.rotation_rate_rad_s = -forth.scene.rotation_rate_rad_s();
  back.release.quaternion_LB = end.q_LB;
  back.release.angular_velocity_body_rad_s = {-end.w_LB_B[0], -end.w_LB_B[1], -end.w_LB_B[2]};
  back.release.rates_relative_to = RatesRelativeTo::laboratory;
  const RunResult result = completed_run(resolve(std::move(back)), watch);
  return return_error(result.rows.back(), start);
}

}  // namespace

double equivalence_error(const CriterionSpec& criterion, Runs& runs) {
  const double until_s = criterion.until_s.value_or(std::numeric_limits<double>::infinity());
  if (criterion.quantity == "reference_turned") return reference_turned_error(runs.run(criterion.set), until_s);
  if (criterion.quantity == "reversed_in_time") return reversed_in_time(runs.run(criterion.set), runs.next_watch());
  const Pair pair{runs.run(), runs.run(criterion.set)};
  if (criterion.quantity == "same") return same(pair, until_s);
  if (criterion.quantity == "same_axis") return same_axis(pair, until_s);
  if (criterion.quantity == "same_drift") return same_drift(pair, until_s);
  if (criterion.quantity == "mirrored_north_south") return mirrored_north_south(pair, until_s);
  if (criterion.quantity == "proportional_to_earth_rate") return proportional(pair, until_s);
  throw std::logic_error("no such equivalence: " + criterion.quantity);
}

}  // namespace earthtop::verify_detail
