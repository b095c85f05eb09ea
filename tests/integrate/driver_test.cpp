// SPDX-License-Identifier: GPL-3.0-or-later
/// The loop around odeint's steppers: order of convergence, landing on output times, named outcomes instead of NaN or an
/// endless loop, exact time.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "integrate/odeint_driver.hpp"
#include "support/tolerances.hpp"

namespace earthtop {
namespace {

constexpr std::array kMethods{Method::dopri5, Method::rkf78,  Method::bulirsch_stoer, Method::extrapolation,
                              Method::abm8,   Method::dop853, Method::gauss};

/// x' = y, y' = -x, and z' = 1, whose solution is the time.
struct Oscillator {
  using Shape = Oscillator;
  static constexpr std::size_t kSize = 3;
  static constexpr std::array<ComponentGroup, 2> groups() { return {{{0, 2, 1.0}, {2, 1, 1.0}}}; }
  void operator()(const std::array<double, 3>& x, std::array<double, 3>& dxdt, double) const { dxdt = {x[1], -x[0], 1.0}; }
};

template <class System>
struct Recorder {
  std::vector<std::array<double, System::kSize>> rows;
  std::vector<double> step_times;
  StepCounters counters;

  RunStatus run(System system, std::array<double, System::kSize> x, const std::vector<double>& times,
                DriveOptions<double> options) {
    if (options.step_limit == 0) options.step_limit = 1'000'000;
    auto on_step = [&](double t, const auto&) { step_times.push_back(t); };
    auto on_row = [&](std::size_t row, const auto& state) {
      EXPECT_EQ(row, rows.size());
      rows.push_back(state);
    };
    Driver<double, System, decltype(on_step), decltype(on_row)> driver(system, options, on_step, on_row);
    const RunStatus status = driver.run(x, times);
    counters = driver.counters();
    return status;
  }
};

std::vector<double> equidistant(double step, int count) {
  std::vector<double> times;
  for (int k = 0; k <= count; ++k) times.push_back(k * step);
  return times;
}

TEST(Driver, EveryMethodLandsOnEveryOutputTime) {
  // Steps that do not divide one another, the last interval a short one.
  std::vector<double> times = equidistant(0.7, 30);
  times.push_back(21.1);
  for (const Method method : kMethods) {
    SCOPED_TRACE(to_string(method));
    Recorder<Oscillator> recorder;
    DriveOptions<double> options;
    options.method = method;
    options.relative_tolerance = 1e-12;
    options.fixed_step = 0.03;
    ASSERT_EQ(recorder.run({}, {1, 0, 0}, times, options), RunStatus::completed);
    ASSERT_EQ(recorder.rows.size(), times.size());
    for (std::size_t i = 0; i < times.size(); ++i) {
      EXPECT_NEAR(recorder.rows[i][0], std::cos(times[i]),
                  testing::truncation(options.relative_tolerance, static_cast<double>(recorder.counters.accepted)));
      // z' = 1 is exact for every method: only the rounding of z in every stage of every step is left.
      EXPECT_NEAR(recorder.rows[i][2], times[i], static_cast<double>(recorder.counters.evaluations) * 1.2e-16 * 22);
    }
    // Every step is seen, and where output times cut no step they too.
    const std::size_t rows_between = ends_steps_at_rows(method) ? 0 : times.size() - 2;
    EXPECT_EQ(recorder.step_times.size(), static_cast<std::size_t>(recorder.counters.accepted) + rows_between + 1);
    EXPECT_TRUE(std::is_sorted(recorder.step_times.begin(), recorder.step_times.end()));
  }
}

/// The oscillator together with z' = |t - 1.05|, whose slope has a jump.
struct Kinked : Oscillator {
  static constexpr double kKink = 1.05;
  void operator()(const std::array<double, 3>& x, std::array<double, 3>& dxdt, double t) const {
    dxdt = {x[1], -x[0], std::abs(t - kKink)};
  }
  static double z(double t) { return (kKink * kKink + (t - kKink) * std::abs(t - kKink)) / 2; }
};

TEST(Driver, StepsEndAtJoints) {
  const std::vector<double> times = equidistant(0.7, 10);
  for (const Method method : kMethods) {
    SCOPED_TRACE(to_string(method));
    const auto worst = [&](Recorder<Kinked>& recorder, std::vector<double> joints) {
      DriveOptions<double> options;
      options.method = method;
      options.relative_tolerance = 1e-12;
      options.fixed_step = 0.03;
      options.joints = std::move(joints);
      EXPECT_EQ(recorder.run({}, {1, 0, 0}, times, options), RunStatus::completed);
      EXPECT_EQ(recorder.rows.size(), times.size());  // a joint is no row
      double error = 0;
      for (std::size_t i = 0; i < recorder.rows.size(); ++i) {
        error = std::max(error, std::abs(recorder.rows[i][2] - Kinked::z(times[i])));
        EXPECT_NEAR(recorder.rows[i][0], std::cos(times[i]),
                    testing::truncation(options.relative_tolerance, static_cast<double>(recorder.counters.accepted)));
      }
      return error;
    };
    // One before the first row, one at a row, two that no step fits between, one after the end.
    Recorder<Kinked> with, without;
    const double error = worst(with, {-0.5, times[1], Kinked::kKink, 5, 5 + 1e-15, 9});
    // For a straight line every method's only error is rounding.
    EXPECT_LT(error, static_cast<double>(with.counters.evaluations) * 1.2e-16 * 22);
    EXPECT_TRUE(std::is_sorted(with.step_times.begin(), with.step_times.end()));
    for (const double joint : {Kinked::kKink, 5.0})
      EXPECT_TRUE(std::any_of(with.step_times.begin(), with.step_times.end(), [&](double t) {
        return std::abs(t - joint) < 4e-15;
      })) << joint;
    if (method == Method::dop853) {
      EXPECT_GT(worst(without, {}), 10 * error);  // the kink is felt
    }
  }
}

TEST(Driver, TimeIsKeptWithoutSumming) {
  // One interval, many steps: the clock lands on the end to one rounding of it.
  IntervalClock<double> clock(0, 60);
  const double h = 60.0 / 77777;
  for (int i = 0; i < 77776; ++i) clock.advance(h);
  EXPECT_NEAR(clock.remaining(), h, 2e-16 * 60);
  EXPECT_NEAR(clock.now(), 60 - h, 2 * 2e-16 * 60);
}

TEST(Driver, AdamsBashforthMoultonHasOrderEight) {
  // The error must stay below f h^(p+1), with f from the coarsest step, at every halving down to round-off: one wrong
  // coefficient fails.
  double coarsest = 0;
  for (int halving = 0; halving < 4; ++halving) {
    const double h = 0.2 / (1 << halving);
    Recorder<Oscillator> recorder;
    DriveOptions<double> options;
    options.method = Method::abm8;
    options.fixed_step = h;
    ASSERT_EQ(recorder.run({}, {1, 0, 0}, equidistant(1.0, 10), options), RunStatus::completed);
    EXPECT_EQ(recorder.counters.accepted, std::lround(10 / h));
    const double error = std::hypot(recorder.rows.back()[0] - std::cos(10.0), recorder.rows.back()[1] + std::sin(10.0));
    if (halving == 0)
      coarsest = error;
    else
      EXPECT_LT(error, 1.3 * coarsest / std::pow(2.0, 8 * halving) + 1e-14) << "h " << h;
  }
  EXPECT_GT(coarsest, 1e-9);  // there is an error to measure
}

TEST(Driver, OutputTimesCutNoStepOfADenseMethod) {
  DriveOptions<double> options;
  options.method = Method::dop853;
  options.relative_tolerance = 1e-10;
  Recorder<Oscillator> few, many;
  ASSERT_EQ(few.run({}, {1, 0, 0}, {0, 20}, options), RunStatus::completed);
  ASSERT_EQ(many.run({}, {1, 0, 0}, equidistant(0.01, 2000), options), RunStatus::completed);
  EXPECT_EQ(few.counters.accepted, many.counters.accepted);
  EXPECT_EQ(few.rows.back(), many.rows.back());
  // The interpolant is of order 7: between the steps the error is a little larger than at their ends.
  for (std::size_t i = 0; i < many.rows.size(); ++i)
    EXPECT_NEAR(many.rows[i][0], std::cos(0.01 * static_cast<double>(i)), 1e-9) << i;
  // States are seen at least every `largest_step`, although no step is cut for it.
  options.largest_step = 0.1;
  Recorder<Oscillator> seen;
  ASSERT_EQ(seen.run({}, {1, 0, 0}, {0, 20}, options), RunStatus::completed);
  EXPECT_EQ(seen.counters.accepted, few.counters.accepted);
  for (std::size_t i = 1; i < seen.step_times.size(); ++i) EXPECT_LE(seen.step_times[i] - seen.step_times[i - 1], 0.1 + 1e-12);
}

/// x = t^degree.
struct Powers {
  using Shape = Powers;
  static constexpr std::size_t kSize = 1;
  static constexpr std::array<ComponentGroup, 1> groups() { return {{{0, 1, 1.0}}}; }
  int degree;
  void operator()(const std::array<double, 1>&, std::array<double, 1>& dxdt, double t) const {
    dxdt[0] = degree * std::pow(t, degree - 1);
  }
};

TEST(Driver, DormandPrinceInterpolantIsExactOnPolynomials) {
  // The method itself is exact to degree 8, the interpolant to degree 7; that tests every condition on nodes and weights.
  for (int degree = 1; degree <= 8; ++degree) {
    const Powers system{degree};
    GroupScales<double, Powers> scales;
    Dop853Stepper<Powers> stepper(1e6, scales);
    stepper.initialize({0}, 0, 1);
    const auto counted = [&](const auto& x, auto& dxdt, double t) { system(x, dxdt, t); };
    ASSERT_TRUE(stepper.try_step(counted));
    EXPECT_NEAR(stepper.current_state()[0], 1, testing::rounding(6 * 40));  // weights of up to 6, stages of up to 40
    if (degree == 8) continue;
    stepper.prepare_interpolant(counted);
    for (const double t : {0.1, 0.37, 0.5, 0.9}) {
      std::array<double, 1> x;
      stepper.calc_state(t, x);
      EXPECT_NEAR(x[0], std::pow(t, degree), testing::rounding(500)) << "degree " << degree << ", t " << t;
    }
  }
}

TEST(Driver, GaussHasOrderTwelve) {
  // The error must stay below f h^(p+1), with f from the coarsest step, down to round-off; z' = 1 is exact.
  double coarsest = 0;
  for (int halving = 0; halving < 4; ++halving) {
    const double h = 1.25 / (1 << halving);
    Recorder<Oscillator> recorder;
    DriveOptions<double> options;
    options.method = Method::gauss;
    options.fixed_step = h;
    ASSERT_EQ(recorder.run({}, {1, 0, 0}, equidistant(5.0, 8), options), RunStatus::completed);
    const double error = std::hypot(recorder.rows.back()[0] - std::cos(40.0), recorder.rows.back()[1] + std::sin(40.0));
    if (halving == 0)
      coarsest = error;
    else
      EXPECT_LT(error, 1.3 * coarsest / std::pow(2.0, 12 * halving) + 1e-14) << "h " << h;
  }
  EXPECT_GT(coarsest, 3e-11);  // there is an error to measure
}

TEST(Driver, EmbeddedMethodsFollowTheirTolerance) {
  // The error falls with the tolerance, and the number of steps grows as its power 1/order.
  for (const auto& [method, order] :
       {std::pair(Method::dopri5, 5.0), std::pair(Method::rkf78, 8.0), std::pair(Method::dop853, 8.0)}) {
    std::int64_t steps[2];
    double errors[2];
    for (int i = 0; i < 2; ++i) {
      Recorder<Oscillator> recorder;
      DriveOptions<double> options;
      options.method = method;
      options.relative_tolerance = i == 0 ? 1e-7 : 1e-11;
      ASSERT_EQ(recorder.run({}, {1, 0, 0}, {0, 100}, options), RunStatus::completed);
      steps[i] = recorder.counters.accepted;
      errors[i] = std::abs(recorder.rows.back()[0] - std::cos(100.0));
    }
    EXPECT_LT(errors[1], 1e-3 * errors[0]);
    EXPECT_NEAR(std::log10(static_cast<double>(steps[1]) / static_cast<double>(steps[0])), 4 / order, 0.12 * 4);
  }
}

TEST(Driver, ExtrapolationReachesEveryTolerance) {
  // The order rises as the tolerance falls, until the round-off of the columns limits it: the work grows with the number of
  // digits, not exponentially with it, and the error keeps to the tolerance over the 100 rad.
  std::int64_t evaluations = 0;
  for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-13, 1e-14}) {
    Recorder<Oscillator> recorder;
    DriveOptions<double> options;
    options.method = Method::extrapolation;
    options.relative_tolerance = tolerance;
    ASSERT_EQ(recorder.run({}, {1, 0, 0}, {0, 100}, options), RunStatus::completed);
    EXPECT_NEAR(recorder.rows.back()[0], std::cos(100.0), 100 * tolerance);
    EXPECT_LE(recorder.counters.rejected, 2);
    if (evaluations > 0) {
      EXPECT_LT(recorder.counters.evaluations, 2 * evaluations) << tolerance;
    }
    evaluations = recorder.counters.evaluations;
  }
}

/// Its derivative becomes NaN beyond x = 1; x is the time.
struct BreaksDown {
  using Shape = BreaksDown;
  static constexpr std::size_t kSize = 1;
  static constexpr std::array<ComponentGroup, 1> groups() { return {{{0, 1, 1.0}}}; }
  void operator()(const std::array<double, 1>& x, std::array<double, 1>& dxdt, double) const {
    dxdt[0] = x[0] < 1 ? 1.0 : std::numeric_limits<double>::quiet_NaN();
  }
};

TEST(Driver, NaNIsANamedOutcomeAndKeepsTheRowsBeforeIt) {
  for (const Method method : kMethods) {
    SCOPED_TRACE(to_string(method));
    Recorder<BreaksDown> recorder;
    DriveOptions<double> options;
    options.method = method;
    options.fixed_step = 0.01;
    options.first_step = 0.1;
    const RunStatus status = recorder.run({}, {0}, equidistant(0.3, 10), options);
    EXPECT_TRUE(status == RunStatus::not_finite || status == RunStatus::step_underflow || status == RunStatus::not_converged);
    ASSERT_EQ(recorder.rows.size(), 4u);
    for (const auto& row : recorder.rows) EXPECT_TRUE(std::isfinite(row[0]));
  }
}

/// x' = x^2 reaches infinity at t = 1.
struct Explodes {
  using Shape = Explodes;
  static constexpr std::size_t kSize = 1;
  static constexpr std::array<ComponentGroup, 1> groups() { return {{{0, 1, 1.0}}}; }
  void operator()(const std::array<double, 1>& x, std::array<double, 1>& dxdt, double) const { dxdt[0] = x[0] * x[0]; }
};

TEST(Driver, BlowUpEnds) {
  for (const Method method : kMethods) {
    Recorder<Explodes> recorder;
    DriveOptions<double> options;
    options.method = method;
    options.fixed_step = 0.01;
    EXPECT_NE(recorder.run({}, {1}, {0, 0.5, 2}, options), RunStatus::completed);
    EXPECT_EQ(recorder.rows.size(), 2u);
  }
}

TEST(Driver, StepLimitAndInterruptEndARun) {
  for (const Method method : kMethods) {
    SCOPED_TRACE(to_string(method));
    DriveOptions<double> options;
    options.method = method;
    options.fixed_step = 0.01;
    options.step_limit = 50;
    Recorder<Oscillator> limited;
    EXPECT_EQ(limited.run({}, {1, 0, 0}, equidistant(1, 1000), options), RunStatus::step_limit);
    EXPECT_LE(limited.counters.accepted + limited.counters.rejected, 50);
    const std::atomic<bool> stop = true;
    options.watch = &stop;
    options.step_limit = 1000;
    Recorder<Oscillator> interrupted;
    EXPECT_EQ(interrupted.run({}, {1, 0, 0}, equidistant(1, 1000), options), RunStatus::interrupted);
    EXPECT_EQ(interrupted.rows.size(), 1u);
  }
}

/// A rate of 1e9 beside a duration of 1e3: a trillion steps.
struct FarTooFast {
  using Shape = FarTooFast;
  static constexpr std::size_t kSize = 2;
  static constexpr std::array<ComponentGroup, 1> groups() { return {{{0, 2, 1.0}}}; }
  void operator()(const std::array<double, 2>& x, std::array<double, 2>& dxdt, double) const {
    dxdt = {1e9 * x[1], -1e9 * x[0]};
  }
};

TEST(Driver, AnEndOutOfReachIsSeenEarly) {
  Recorder<FarTooFast> recorder;
  DriveOptions<double> options;
  options.relative_tolerance = 1e-6;
  options.first_step = 1e-9;
  options.step_limit = 2'000'000'000;
  EXPECT_EQ(recorder.run({}, {1, 0}, {0, 1e3}, options), RunStatus::step_limit);
  EXPECT_EQ(recorder.counters.accepted + recorder.counters.rejected, 1'000'000);
}

TEST(Driver, AStateThatIsNotFiniteIsRefusedAtOnce) {
  Recorder<Oscillator> recorder;
  EXPECT_EQ(recorder.run({}, {std::nan(""), 0, 0}, {0, 1}, {}), RunStatus::not_finite);
  EXPECT_TRUE(recorder.rows.empty());
}

}  // namespace
}  // namespace earthtop
