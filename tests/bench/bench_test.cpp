#include "earthtop/bench/bench.hpp"

#include "support/scenes.hpp"
#include "support/soundness.hpp"

namespace earthtop {
namespace {

Contender contender(Workload workload, ModelForm form, double tolerance, Precision precision = Precision::bits53) {
  Contender c;
  c.workload = workload;
  c.precision = precision;
  c.options.form = form;
  c.options.method = Method::rkf78;
  c.options.relative_tolerance = tolerance;
  return c;
}

TEST(Bench, ErrorsAreThoseAgainstTheReferenceAndFallWithTheTolerance) {
  Scenario scene = testing::toy_top();
  scene.duration_s = 0.5;
  std::vector<Contender> contenders;
  for (const Workload workload : {Workload::axis, Workload::motion, Workload::drift})
    for (const double tolerance : {1e-6, 1e-10, 1e-14})
      contenders.push_back(contender(workload, ModelForm::reduced, tolerance));
  contenders.push_back(contender(Workload::drift, ModelForm::general, 1e-10));
  contenders.push_back(contender(Workload::drift, ModelForm::reduced, 1e-16, Precision::bits64));
  contenders.push_back(contender(Workload::drift, ModelForm::reduced, 1e-16, Precision::bits113));
  BenchOptions options;
  options.repetitions = 3;
  options.least_seconds = 1e-4;
  options.checkpoints = 10;
  const BenchReport report = bench(scene, contenders, options);

  ASSERT_EQ(report.reference.samples.size(), 11U);
  EXPECT_LT(report.reference.error.axis, 1e-17);  // of the two sources against each other, tolerance 1e-20
  EXPECT_LT(report.reference.error.drift.value(), 1e-19);
  ASSERT_EQ(report.entries.size(), contenders.size());
  for (std::size_t i = 0; i < contenders.size(); ++i) {
    const BenchEntry& entry = report.entries[i];
    SCOPED_TRACE(describe(entry.contender));
    EXPECT_EQ(entry.status, RunStatus::completed);
    EXPECT_GT(entry.counters.evaluations, 100);
    EXPECT_GT(entry.seconds, 0);
    EXPECT_LE(entry.seconds_least, entry.seconds);
    EXPECT_GE(entry.seconds_most, entry.seconds);
    EXPECT_EQ(entry.errors.attitude.has_value(), contenders[i].workload != Workload::axis);
    EXPECT_EQ(entry.errors.drift.has_value(), contenders[i].workload == Workload::drift);
    if (i % 3 != 0 && i < 9) {
      EXPECT_LT(entry.errors.axis, 1e-2 * report.entries[i - 1].errors.axis);
      EXPECT_GT(entry.counters.evaluations, report.entries[i - 1].counters.evaluations);
    }
  }
  // The error of one entry, taken by hand: against a run of the general model, whose bound says what that is worth.
  const BenchEntry& coarse = report.entries[6];
  Scenario fine = scene;
  fine.numerics.observer = Observer::body;
  fine.output_step_s = scene.duration_s / 10;
  Scenario rough = fine;
  rough.numerics = contenders[6].options;
  const RunResult exact = run(fine), computed = run(rough);
  double error = 0;
  for (std::size_t i = 0; i < exact.rows.size(); ++i)
    error = std::max(error, std::abs(exact.rows[i].drift_axis_rad - computed.rows[i].drift_axis_rad));
  EXPECT_NEAR(coarse.errors.drift.value(), error, 1e-3 * error);
  EXPECT_LT(report.entries[10].errors.attitude.value(), 1e-12);  // long double: no better than its tolerance, but no worse
  EXPECT_LT(report.entries[11].errors.attitude.value(), 1e-13);
}

TEST(Bench, TheReferenceOfAnAsymmetricBodyIsCertifiedToo) {
  Scenario scene = testing::asymmetric_top();
  const auto reference = certified_reference(scene, {0, 0.1, 0.2}, 1e-20);
  EXPECT_LT(reference.error.attitude.value(), 1e-17);
  EXPECT_NE(reference.source, reference.witness);
}

// Closed forms are contenders and witnesses: a top at a pole, a free body anywhere, a top on an Earth that stands still.
TEST(Bench, ClosedFormsTakePartWhereTheSceneHasOne) {
  Scenario at_a_pole = testing::toy_top();
  at_a_pole.site.latitude_deg = -90;
  at_a_pole.rotation_rate_rad_s = 0.2;
  Scenario free_body = testing::asymmetric_top();
  free_body.body.center_of_mass_m = {0, 0, 0};
  Scenario still = testing::non_rotating(testing::toy_top());
  BenchOptions options;
  options.repetitions = 1;
  options.least_seconds = 1e-4;
  options.checkpoints = 7;
  for (Scenario scene : {at_a_pole, free_body, still})
    for (const RatesRelativeTo rule : {RatesRelativeTo::laboratory, RatesRelativeTo::inertial}) {
      scene.release.rates_relative_to = rule;
      scene.duration_s = 0.1;
      std::vector<Contender> contenders{contender(Workload::closed_form, ModelForm::automatic, 0),
                                        contender(Workload::closed_form, ModelForm::automatic, 0, Precision::bits64),
                                        contender(Workload::motion, ModelForm::general, 1e-13)};
      const BenchReport report = bench(scene, contenders, options);
      EXPECT_EQ(report.reference.witness, "closed form, float128");
      EXPECT_LT(report.reference.error.attitude.value(), 1e-17);
      EXPECT_LT(report.reference.error.drift.value_or(0), 1e-17);
      EXPECT_LT(report.entries[0].errors.attitude.value(), 1e-13);
      EXPECT_LT(report.entries[1].errors.attitude.value(), 1e-16);
      EXPECT_LT(report.entries[2].errors.attitude.value(), 1e-9);
      EXPECT_EQ(report.entries[0].counters.evaluations, 8);
    }
  const std::vector<Contender> none{contender(Workload::closed_form, ModelForm::automatic, 0)};
  EXPECT_THROW(bench(testing::asymmetric_top(), none, options), std::invalid_argument);
}

TEST(Bench, CostAtAnErrorLiesOnTheLineBetweenTwoEntries) {
  std::vector<BenchEntry> entries(3);
  for (std::size_t i = 0; i < 3; ++i) {
    entries[i].errors.axis = std::pow(10, -4.0 - 4.0 * static_cast<double>(i));
    entries[i].seconds = std::pow(10, static_cast<double>(i));
    entries[i].counters.evaluations = static_cast<std::int64_t>(100 * std::pow(100, static_cast<double>(i)));
  }
  const auto axis = [](const BenchErrors& errors) { return errors.axis; };
  const auto cost = cost_at_error(entries, axis, 1e-10);
  ASSERT_TRUE(cost);
  EXPECT_NEAR(cost->seconds, std::pow(10, 1.5), 1e-12 * 100);
  EXPECT_NEAR(cost->evaluations, 1e5, 1e-7);
  EXPECT_FALSE(cost_at_error(entries, axis, 1e-13));
  EXPECT_FALSE(cost_at_error(entries, axis, 1e-3));
  entries[2].status = RunStatus::step_limit;
  EXPECT_FALSE(cost_at_error(entries, axis, 1e-10));
}

}  // namespace
}  // namespace earthtop
