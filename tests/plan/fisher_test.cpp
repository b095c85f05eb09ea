// SPDX-License-Identifier: GPL-3.0-or-later
/// The standard errors and correlations of plans against the information matrix from differences of motions in 113 bits, whose steps and
/// readings are written here: a mount that leans, a clock that is late, and a top that is spun both ways.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numbers>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/frames/earth.hpp"
#include "plan/plans.hpp"

namespace earthtop::testing {
namespace {

constexpr double kSigma = 1e-3, kEvery_s = 0x1p-5, kUntil_s = 1;  // rad; a dyadic time, so that shifted times are exact
constexpr double kDegree = std::numbers::pi / 180;

/// An instrument and a motion.
struct Seen {
  Overrides set;
  double turn_east_deg = 0, turn_north_deg = 0, late_s = 0;
};

std::vector<Vec3<float128>> axes_of(const Seen& seen) {
  const Scene scene = parse_scene(shipped("toy-top"), seen.set);
  DriftProblem<float128> problem = scene.problem<float128>();
  problem.times_s.clear();
  std::vector<std::size_t> places;
  for (double t_s = 0; t_s <= kUntil_s; t_s += kEvery_s) {
    const double of_motion_s = std::max(t_s - seen.late_s, 0.0);  // before the release, the top is held
    if (problem.times_s.empty() || of_motion_s > problem.times_s.back()) problem.times_s.push_back(of_motion_s);
    places.push_back(problem.times_s.size() - 1);
  }
  IntegrationOptions options;
  options.method = Method::taylor;
  options.relative_tolerance = 1e-26;
  const auto motion = integrate_motion(problem, options, MotionSought::symmetry_axis);
  std::vector<Vec3<float128>> axes;
  for (const std::size_t place : places) axes.push_back(rotation_matrix(motion.samples.at(place).q_LB).col(2));
  return axes;
}

/// Derivatives of the azimuths and tilts that are read, one row each, from the axis and its derivative.
Eigen::VectorXd read(const Seen& seen, const std::vector<Vec3<double>>& axes, const std::vector<Vec3<double>>& by) {
  const Eigen::Vector3d turn(seen.turn_east_deg * kDegree, seen.turn_north_deg * kDegree, 0);
  const Eigen::AngleAxisd mount(turn.norm(), turn.norm() > 0 ? Eigen::Vector3d(turn.normalized()) : Eigen::Vector3d::UnitZ());
  Eigen::VectorXd rows(2 * static_cast<Eigen::Index>(axes.size()));
  for (std::size_t k = 0; k < axes.size(); ++k) {
    const Eigen::Vector3d n = mount * axes[k], d = mount * by[k];
    const double across = n[0] * n[0] + n[1] * n[1];
    rows[2 * static_cast<Eigen::Index>(k)] = (n[1] * d[0] - n[0] * d[1]) / across;
    rows[2 * static_cast<Eigen::Index>(k) + 1] = -d[2] / std::sqrt(across);
  }
  return rows / kSigma;
}

/// The column of a number: the axis at a changed number, above and below, over the distance.
Eigen::VectorXd column(const Seen& at, double distance, const Seen& above, const Seen& below) {
  const auto here = axes_of(at), high = axes_of(above), low = axes_of(below);
  std::vector<Vec3<double>> axes, by;
  for (std::size_t k = 0; k < here.size(); ++k) {
    Vec3<double> n, d;
    for (int i = 0; i < 3; ++i) {
      n[i] = static_cast<double>(here[k][i]);
      d[i] = static_cast<double>((high[k][i] - low[k][i]) / float128(distance));
    }
    axes.push_back(n);
    by.push_back(d);
  }
  return read(at, axes, by);
}

Seen with(Seen seen, const std::string& pointer, double value) {
  seen.set.emplace_back(pointer, fmt::format("{}", value));
  return seen;
}
Eigen::VectorXd column_of(const Seen& at, const std::string& pointer, double value) {
  const double step = std::abs(value) * 0x1p-30;
  return column(at, 2 * step, with(at, pointer, value + step), with(at, pointer, value - step));
}
/// The column of an angle of the mount, in degrees, which changes no motion.
Eigen::VectorXd column_of_turn(const Seen& at, double Seen::*angle) {
  constexpr double kStep_deg = 1e-3;
  const auto angles = [&](double by) {
    Seen turned = at;
    turned.*angle += by;
    const Eigen::Vector3d turn(turned.turn_east_deg * kDegree, turned.turn_north_deg * kDegree, 0);
    const Eigen::AngleAxisd mount(turn.norm(), turn.normalized());
    std::vector<Vec3<double>> axes;
    for (const Vec3<float128>& n : axes_of(at))
      axes.push_back(mount * Eigen::Vector3d(static_cast<double>(n[0]), static_cast<double>(n[1]), static_cast<double>(n[2])));
    return axes;
  };
  const auto here = angles(0), high = angles(kStep_deg), low = angles(-kStep_deg);
  std::vector<Vec3<double>> by;
  for (std::size_t k = 0; k < here.size(); ++k) by.push_back((high[k] - low[k]) / (2 * kStep_deg));
  return read({}, here, by);  // turned already
}

/// Expects the plan's standard errors and correlations to be those of the information J^T J.
void expect_planned(const PlanReport& planned, const Eigen::MatrixXd& J) {
  ASSERT_EQ(planned.outcome, PlanOutcome::determined) << planned.reason;
  ASSERT_EQ(planned.estimates.size(), static_cast<std::size_t>(J.cols()));
  const Eigen::MatrixXd covariance = (J.transpose() * J).inverse();
  for (Eigen::Index j = 0; j < J.cols(); ++j) {
    const PlannedEstimate& estimate = planned.estimates[static_cast<std::size_t>(j)];
    const double error = std::sqrt(covariance(j, j));
    EXPECT_NEAR(*estimate.standard_error, error, 1e-6 * error) << estimate.name;  // the errors of differences in double
    for (Eigen::Index k = 0; k < j; ++k)
      EXPECT_NEAR(planned.correlation[static_cast<std::size_t>(j)][static_cast<std::size_t>(k)],
                  covariance(j, k) / std::sqrt(covariance(j, j) * covariance(k, k)), 1e-6)  // likewise
          << estimate.name;
  }
}

MeasurementPlan plan_of(std::vector<std::string> estimates) {
  return plan_for({{"azimuth_rad", kSigma}, {"tilt_rad", kSigma}}, kEvery_s, kUntil_s, std::move(estimates));
}

TEST(PlanFisher, TiltedMount) {
  const Seen seen{{}, -0.3, 0.4, 0};
  Eigen::MatrixXd J(66, 3);
  J << column_of_turn(seen, &Seen::turn_east_deg), column_of_turn(seen, &Seen::turn_north_deg),
      column_of(seen, "/release/spin_rad_s", 200);
  const PlanReport planned =
      plan_measurement(shipped("toy-top"), {{"/instrument", "{\"turn_east_deg\": -0.3, \"turn_north_deg\": 0.4}"}},
                       plan_of({"/instrument/turn_east_deg", "/instrument/turn_north_deg", "spin_rad_s"}));
  expect_planned(planned, J);
}

TEST(PlanFisher, ClockOffset) {
  constexpr double kLate_s = 0x1p-8, kStep_s = 0x1p-30;
  const Seen seen{{}, 0, 0, kLate_s};
  Eigen::MatrixXd J(66, 3);
  J << column(seen, 2 * kStep_s, {{}, 0, 0, kLate_s + kStep_s}, {{}, 0, 0, kLate_s - kStep_s}),
      column_of(seen, "/release/spin_rad_s", 200), column_of(seen, "/release/tilt_deg", 20);
  const PlanReport planned = plan_measurement(shipped("toy-top"), {{"/instrument/time_offset_s", fmt::format("{}", kLate_s)}},
                                              plan_of({"/instrument/time_offset_s", "spin_rad_s", "tilt_deg"}));
  expect_planned(planned, J);
}

TEST(PlanFisher, TwoReleases) {
  // The vertical component of the Earth's rate, with the northward one held.
  const Site site = parse_scene(shipped("toy-top")).scenario().site;
  const double latitude = site.latitude_deg * kDegree, up = kEarthRateWgs84 * std::sin(latitude),
               north = kEarthRateWgs84 * std::cos(latitude), step = 0x1p-10 * kEarthRateWgs84;
  const auto turned = [&](const Seen& seen, double vertical) {
    return with(with(seen, "/earth/rotation_rate_rad_s", std::hypot(vertical, north)), "/site/latitude_deg",
                std::atan2(vertical, north) / kDegree);
  };
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(132, 4);  // rate and gravity of both, spins of each
  const Overrides sets[] = {{}, {{"/release/spin_rad_s", "-200"}}};
  for (Eigen::Index r = 0; r < 2; ++r) {
    const Seen seen{sets[r], 0, 0, 0};
    J.block(66 * r, 0, 66, 1) = column(seen, 2 * step, turned(seen, up + step), turned(seen, up - step));
    J.block(66 * r, 1, 66, 1) = column_of(seen, "/site/gravity_m_s2", 9.80665);
    J.block(66 * r, 2 + r, 66, 1) = column_of(seen, "/release/spin_rad_s", r == 0 ? 200 : -200);
  }
  MeasurementPlan plan = plan_of({"omega_sin_latitude_rad_s"});
  plan.nuisances = {"gravity_m_s2", "spin_rad_s"};
  plan.shared = {"omega_sin_latitude_rad_s", "gravity_m_s2"};
  expect_planned(plan_releases({{shipped("toy-top"), sets[0]}, {shipped("toy-top"), sets[1]}}, plan), J);
}

}  // namespace
}  // namespace earthtop::testing
