// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/bench/bench.hpp"

#include <atomic>
#include <set>
#include <sstream>

#include "earthtop/bench/comparison.hpp"
#include "support/json.hpp"
#include "support/scenes.hpp"
#include "support/soundness.hpp"
#include "support/tolerances.hpp"

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

Contender closed_form(Workload workload, Precision precision = Precision::bits53) {
  Contender c;
  c.workload = workload;
  c.precision = precision;
  c.options.method = Method::closed_form;
  return c;
}

BenchOptions quick_options() {
  BenchOptions options;
  options.repetitions = 1;
  options.least_seconds = 1e-4;
  options.checkpoints = 7;
  return options;
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

  ASSERT_EQ(report.reference.checkpoints.size(), 11U);
  EXPECT_LT(report.reference.error.axis, 1e-17);  // of the two sources against each other, tolerance 1e-20
  EXPECT_LT(report.reference.error.drift.value(),
            1e-17 * scene.rotation_rate_rad_s * scene.duration_s);  // as many digits of the drift
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
  // The error of one entry, computed here by comparison with a run of the general model, whose bound tells how exact that is.
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
  EXPECT_NEAR(coarse.errors.drift.value(), error, exact.drift.axis_bound_rad);
  // Long double and float128: no better than their tolerance, but no worse.
  for (const std::size_t i : {10, 11})
    EXPECT_LT(report.entries[i].errors.attitude.value(), testing::truncation(contenders[i].options.relative_tolerance, 20));
}

TEST(Bench, TheReferenceOfAnAsymmetricBodyIsCertifiedToo) {
  Scenario scene = testing::asymmetric_top();
  const auto reference = certified_reference(scene, {0, 0.1, 0.2});
  EXPECT_LT(reference.error.attitude.value(), 1e-17);
  EXPECT_NE(reference.source, reference.witness);
}

// Closed forms take part as contenders and confirm the reference: a top at a pole, a free body anywhere, a top on an Earth at
// rest.
TEST(Bench, ClosedFormsTakePartWhereTheSceneHasOne) {
  Scenario at_a_pole = testing::toy_top();
  at_a_pole.site.latitude_deg = -90;
  at_a_pole.rotation_rate_rad_s = 0.2;
  Scenario free_body = testing::asymmetric_top();
  free_body.body.center_of_mass_m = {0, 0, 0};
  Scenario still = testing::non_rotating(testing::toy_top());
  const BenchOptions options = quick_options();
  for (Scenario scene : {at_a_pole, free_body, still})
    for (const RatesRelativeTo rule : {RatesRelativeTo::laboratory, RatesRelativeTo::inertial}) {
      scene.release.rates_relative_to = rule;
      scene.duration_s = 0.1;
      std::vector<Contender> contenders{closed_form(Workload::motion), closed_form(Workload::motion, Precision::bits64),
                                        contender(Workload::motion, ModelForm::general, 1e-13), closed_form(Workload::drift)};
      const BenchReport report = bench(scene, contenders, options);
      EXPECT_EQ(report.reference.witness, "closed form, float128");
      EXPECT_LT(report.reference.error.attitude.value(), 1e-17);
      EXPECT_LT(report.reference.error.drift.value_or(0), 1e-20);  // the reference's tolerance
      EXPECT_LT(report.entries[0].errors.attitude.value(), testing::rounding(100));
      EXPECT_LT(report.entries[1].errors.attitude.value(), testing::rounding<float80>(200));
      EXPECT_LT(report.entries[2].errors.attitude.value(), testing::truncation(contenders[2].options.relative_tolerance, 100));
      EXPECT_LT(report.entries[3].errors.drift.value(), testing::rounding(1));
    }
  const std::vector<Contender> none{closed_form(Workload::motion)};
  EXPECT_THROW(bench(testing::asymmetric_top(), none, options), std::invalid_argument);
}

/// A toy top on a table, for so long that friction matters.
Scenario on_table(ContactLaw law, ContactStart start) {
  Scenario scenario = testing::toy_top();
  scenario.contact = ContactSpec{.tip_radius_m = 0.002, .law = law, .friction_coefficient = 0.35, .start = start};
  scenario.duration_s = scenario.output_step_s = 0.25;
  return scenario;
}

TEST(Bench, TopsOnTablesAreTimed) {
  Scenario asymmetric = on_table(ContactLaw::rolling, ContactStart::rolling);
  testing::set_principal(asymmetric.body, 1.2e-4, 1.19e-4, 4e-5);
  const std::pair<Scenario, const char*> tops[] = {
      {on_table(ContactLaw::rolling, ContactStart::rolling), "extrapolation of the general model in inertial axes"},
      {asymmetric, "extrapolation of the general model in inertial axes"},
      {on_table(ContactLaw::coulomb, ContactStart::center_of_mass_at_rest),
       "extrapolation of the reduced model in laboratory axes"}};
  for (const auto& [scenario, witness] : tops) {
    std::vector<Contender> contenders = standard_contenders(scenario, Workload::drift);
    std::set<std::string> forms;
    for (const Contender& each : contenders) forms.insert(equations_name(each));
    EXPECT_EQ(forms.size(), scenario.contact->law == ContactLaw::coulomb ? 1U : scenario.body == asymmetric.body ? 2U : 4U);
    std::erase_if(contenders, [](const Contender& each) {
      return each.precision != Precision::bits53 || each.options.relative_tolerance < 1e-11 ||
             each.options.relative_tolerance > 1e-8;
    });
    BenchOptions options = quick_options();
    options.reference_seconds = 1;
    const BenchReport report = bench(scenario, contenders, options);
    EXPECT_TRUE(report.reference.witness.starts_with(witness)) << report.reference.witness;
    EXPECT_LT(report.reference.error.drift.value(), 1e-9 * report.largest_drift);  // what is left of two integrations at 1e-17
    for (const BenchEntry& entry : report.entries) {
      SCOPED_TRACE(describe(entry.contender));
      EXPECT_EQ(entry.status, RunStatus::completed);
      EXPECT_LT(entry.errors.drift.value(), 1e-3 * report.largest_drift);  // of tolerances from 1e-11 to 1e-8
      EXPECT_GT(entry.counters.evaluations, 0);
    }
  }
}

TEST(Bench, AReferenceThatIsNotCompletedIsRefused) {
  const std::atomic<bool> stop = true;
  try {
    certified_reference(testing::toy_top(), {0, 1}, Precision::bits64, &stop);
    FAIL();
  } catch (const ScenarioError& error) {
    EXPECT_STREQ(
        error.what(),
        "error: no reference: source and witness take more than three times as long as they may; give a shorter duration, "
        "or more time by --reference-limit");
  }
}

TEST(Bench, OfATopOnATableThereIsNoMotionAlone) {
  const Scenario scenario = on_table(ContactLaw::rolling, ContactStart::rolling);
  const std::vector<Contender> contenders{contender(Workload::motion, ModelForm::automatic, 1e-10)};
  try {
    bench(scenario, contenders, {});
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "bench: of a top on a table both motions are integrated together; take the drift");
  }
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
  EXPECT_NEAR(cost->seconds, std::pow(10, 1.5), testing::rounding(20) * 100);
  EXPECT_NEAR(cost->evaluations, 1e5, testing::rounding(20) * 1e5);
  EXPECT_FALSE(cost_at_error(entries, axis, 1e-13));
  EXPECT_FALSE(cost_at_error(entries, axis, 1e-3));
  entries[2].status = RunStatus::step_limit;
  EXPECT_FALSE(cost_at_error(entries, axis, 1e-10));
}

/// Entries with given times (s) and drift errors (rad); a negative error means that the run did not complete.
BenchReport made_up(const std::vector<std::pair<double, double>>& points) {
  BenchReport report;
  report.scenario = "made-up";
  report.options = quick_options();
  for (const auto& [seconds, error] : points) {
    BenchEntry entry;
    entry.contender = contender(Workload::drift, ModelForm::reduced, 1e-3 / static_cast<double>(report.entries.size() + 1));
    entry.seconds = entry.seconds_least = entry.seconds_most = seconds;
    entry.counters.evaluations = static_cast<std::int64_t>(1e6 * seconds);
    entry.repetitions = 1;
    if (error < 0) entry.status = RunStatus::interrupted;
    entry.errors = {std::abs(error), std::abs(error), std::abs(error)};
    report.entries.push_back(entry);
  }
  return report;
}

TEST(Bench, TheParetoFrontIsWhatNothingBeats) {
  // The third is slower and worse than the second; the fourth as exact as the second, but slower; the sixth did not complete.
  BenchReport report = made_up({{1, 1e-3}, {2, 1e-6}, {3, 1e-5}, {4, 1e-6}, {5, 1e-12}, {0.1, -1e-20}, {6, 1e-15}});
  EXPECT_EQ(pareto_front(report, ErrorKind::drift), (std::vector<bool>{true, true, false, false, true, false, true}));
  // Errors below the reference's own error do not count as better: the last two are both good to 1e-9 rad, as far as is known.
  report.reference.error.drift = 1e-9;
  EXPECT_EQ(pareto_front(report, ErrorKind::drift), (std::vector<bool>{true, true, false, false, true, false, false}));
  EXPECT_EQ(error_of(report.entries[6], report.reference, ErrorKind::drift), 1e-9);
  EXPECT_EQ(error_of(report.entries[5], report.reference, ErrorKind::drift), std::nullopt);
}

TEST(Bench, AFamilyCostsWhatLiesBetweenItsEntriesOrAtMostItsCheapest) {
  const BenchReport report = made_up({{1, 1e-7}, {10, 1e-11}});
  const auto all = families(report);
  ASSERT_EQ(all.size(), 1U);
  const auto coarse = family_cost(report, all[0], ErrorKind::drift, 1e-6),
             fine = family_cost(report, all[0], ErrorKind::drift, 1e-9);
  ASSERT_TRUE(coarse && fine);
  EXPECT_TRUE(coarse->at_most);
  EXPECT_EQ(coarse->seconds, 1);
  EXPECT_FALSE(fine->at_most);
  EXPECT_NEAR(fine->seconds, std::sqrt(10), testing::rounding(100));
  EXPECT_FALSE(family_cost(report, all[0], ErrorKind::drift, 1e-12));
}

// Another library integrates the same motion: its error falls with its tolerance, down to the round-off of a difference.
TEST(Bench, PeersComputeTheSameMotion) {
  Scenario scene = testing::asymmetric_top();
  scene.duration_s = 0.1;
  for (const RatesRelativeTo rule : {RatesRelativeTo::laboratory, RatesRelativeTo::inertial}) {
    scene.release.rates_relative_to = rule;
    std::vector<Contender> contenders;
    for (const Peer& peer : peers_built())
      for (const Workload workload : {Workload::motion, Workload::drift})
        for (const double tolerance : {1e-7, 1e-11}) {
          Contender c{workload, {}, Precision::bits53, &peer};
          c.options.relative_tolerance = tolerance;
          contenders.push_back(c);
        }
    const BenchReport report = bench(scene, contenders, quick_options());
    for (std::size_t i = 0; i < contenders.size(); i += 2) {
      SCOPED_TRACE(describe(contenders[i]));
      const BenchEntry &coarse = report.entries[i], &fine = report.entries[i + 1];
      EXPECT_EQ(fine.status, RunStatus::completed);
      EXPECT_LT(coarse.errors.attitude.value(), 1e-3);
      EXPECT_LT(fine.errors.attitude.value(), 1e-7);  // turning the Earth the wrong way would be 7e-5
      EXPECT_LT(fine.errors.axis, 0.1 * coarse.errors.axis);
      EXPECT_GT(fine.counters.evaluations, coarse.counters.evaluations);
      EXPECT_GT(coarse.counters.accepted, 7);
      if (contenders[i].workload == Workload::drift) {
        EXPECT_LT(fine.errors.drift.value(), 1e-3 * report.largest_drift);
      }
    }
  }
  Scenario on_a_turntable = scene;
  on_a_turntable.platform = PlatformSpec{};
  EXPECT_THROW(bench(on_a_turntable, std::vector<Contender>{{Workload::motion, {}, Precision::bits53, &peers_built().front()}},
                     quick_options()),
               std::invalid_argument);
}

TEST(Bench, WhatAutoTakesIsAmongTheContendersAndMarkedOnce) {
  Scenario pole = testing::toy_top();
  pole.site.latitude_deg = 90;
  pole.release.rates_relative_to = RatesRelativeTo::inertial;
  Scenario without_coriolis = testing::toy_top();
  without_coriolis.effects.coriolis = false;
  Scenario long_run = testing::toy_top();
  long_run.release.spin_rad_s = 5000;
  long_run.duration_s = 3600;
  std::set<Method> taken;
  Scenario pendulum = testing::toy_top();
  pendulum.release.spin_rad_s = 0;
  pendulum.effects.applied.quadratic_N_m_s2 = 1e-6;
  for (const Scenario& scene : {testing::toy_top(), testing::asymmetric_top(), pole, without_coriolis, long_run, pendulum}) {
    const IntegrationOptions choice = Scene(scene).choice().options;
    taken.insert(choice.method);
    for (const Workload workload : {Workload::drift, Workload::motion}) {
      const std::vector<Contender> contenders = standard_contenders(scene, workload);
      EXPECT_EQ(std::count_if(contenders.begin(), contenders.end(), [](const Contender& c) { return c.is_auto; }), 1);
      const auto automatic = std::find_if(contenders.begin(), contenders.end(), [](const Contender& c) { return c.is_auto; });
      EXPECT_EQ(automatic->options.method, choice.method);
      EXPECT_EQ(automatic->options.observer, choice.observer);
      EXPECT_EQ(automatic->options.relative_tolerance, choice.relative_tolerance);
      EXPECT_FALSE(automatic->peer);
    }
  }
  EXPECT_EQ(taken, (std::set<Method>{Method::taylor, Method::closed_form, Method::dop853, Method::fourier}));
}

TEST(Bench, ContendersThatTakeTooLongAreStoppedAndSaySo) {
  Scenario scene = testing::toy_top();
  scene.duration_s = 0.2;
  BenchOptions options = quick_options();
  options.most_seconds = 0.02;
  options.repetitions = 3;
  Contender slow = contender(Workload::drift, ModelForm::reduced, 1e-26, Precision::bits113);
  Contender finer = slow;
  finer.options.relative_tolerance = 1e-28;
  const BenchReport report =
      bench(scene, std::vector{slow, finer, contender(Workload::drift, ModelForm::reduced, 1e-8)}, options);
  EXPECT_EQ(outcome(report.entries[0]), "too_slow");
  EXPECT_LT(report.entries[0].seconds, 1);
  EXPECT_EQ(error_of(report.entries[0], report.reference, ErrorKind::drift), std::nullopt);
  EXPECT_EQ(outcome(report.entries[1]), "not_tried");
  EXPECT_EQ(outcome(report.entries[2]), "completed");
}

// Where a reference of 113 bits would take too long, one of 64 bits gives the same motion, to its own stated error.
TEST(Bench, TheCheaperReferenceAgreesWithTheOtherWithinItsStatedError) {
  for (Scenario scene : {testing::toy_top(), testing::asymmetric_top()}) {
    scene.duration_s = 0.2;
    BenchOptions options = quick_options();
    const std::vector<Contender> two{contender(Workload::drift, ModelForm::general, 1e-16, Precision::bits64)};
    const BenchReport full = bench(scene, two, options);
    options.reference_seconds = 1e-6;
    const BenchReport cheap = bench(scene, two, options);
    EXPECT_NE(full.reference.source.find("float128"), std::string::npos);
    EXPECT_NE(cheap.reference.source.find("long_double"), std::string::npos);
    const auto distance = [&](std::size_t i) {
      return std::abs(
          static_cast<double>(*full.reference.checkpoints[i].drift_axis - *cheap.reference.checkpoints[i].drift_axis));
    };
    for (std::size_t i = 0; i < full.reference.checkpoints.size(); ++i)
      EXPECT_LE(distance(i), *cheap.reference.error.drift + *full.reference.error.drift);
    EXPECT_LT(*cheap.reference.error.drift, 1e-20);  // some roundings of the drift in long double
    EXPECT_GT(*cheap.reference.error.drift, *full.reference.error.drift);
  }
}

TEST(Bench, LongScenesAreShortenedToWhatAReferenceCanAfford) {
  Scenario scene = testing::toy_top();
  scene.duration_s = 1e6;
  const Scene shortened = shortened_for_reference(scene, 10);
  EXPECT_LT(shortened.scenario().duration_s, 1e4);
  EXPECT_LE(estimated_reference_seconds(shortened, Precision::bits64), 10);
  EXPECT_GT(estimated_reference_seconds(shortened, Precision::bits64), 2);
  scene.duration_s = 1;
  EXPECT_EQ(shortened_for_reference(scene, 10).scenario().duration_s, 1);
}

std::size_t count(const std::string& text, std::string_view what) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
  return found;
}

TEST(Bench, WhatIsComparedIsWhatTheSceneHas) {
  Scenario scene = testing::toy_top();
  scene.duration_s = 0.05;
  const std::vector<Contender> drift{contender(Workload::drift, ModelForm::reduced, 1e-8)},
      motion{contender(Workload::motion, ModelForm::reduced, 1e-8)}, axis{contender(Workload::axis, ModelForm::reduced, 1e-8)};
  EXPECT_EQ(bench(scene, drift, quick_options()).compared, ErrorKind::drift);
  EXPECT_EQ(bench(scene, motion, quick_options()).compared, ErrorKind::attitude);
  EXPECT_EQ(bench(scene, axis, quick_options()).compared, ErrorKind::axis);
  EXPECT_EQ(bench(testing::non_rotating(scene), drift, quick_options()).compared, ErrorKind::attitude);
  BenchOptions options = quick_options();
  options.compared = ErrorKind::axis;
  EXPECT_EQ(bench(scene, drift, options).compared, ErrorKind::axis);
}

TEST(Bench, TheDocumentsSayTheSame) {
  const BenchReport report = made_up({{1, 1e-3}, {2, 1e-6}, {3, 1e-5}, {0.5, -1}});
  const auto json = testing::parse_json(bench_json(std::vector{report}));
  const auto& entries = json.at("scenarios").at(0).at("entries");
  ASSERT_EQ(entries.size(), 4U);
  EXPECT_EQ(json.at("processor"), processor_description());
  EXPECT_TRUE(entries.at(3).at("error").is_null());
  EXPECT_EQ(entries.at(3).at("outcome"), "too_slow");
  EXPECT_EQ(entries.at(3).at("seconds"), 0.5);

  std::istringstream csv(bench_csv(report));
  std::string header, line;
  std::getline(csv, header);
  for (std::size_t i = 0; i < 4; ++i) {
    ASSERT_TRUE(std::getline(csv, line));
    EXPECT_EQ(count(line, ","), count(header, ",") + count(line, "reduced, ") + count(processor_description(), ",")) << line;
    EXPECT_EQ(entries.at(i).at("on_front").get<bool>(), i < 2);
    EXPECT_NE(line.find(i < 2 ? ",1,0,\"" : ",0,0,\""), std::string::npos) << line;
  }
  EXPECT_FALSE(std::getline(csv, line));

  const std::string picture = svg(bench_figure(report));
  EXPECT_EQ(picture, svg(bench_figure(report)));
  EXPECT_NE(picture.find("Pareto front"), std::string::npos);
  EXPECT_EQ(count(picture, "m-2.9-2.9h5.8"), 4U);  // rkf78's squares: three entries, and the legend
  EXPECT_EQ(count(picture, "nan"), 0U);
}

}  // namespace
}  // namespace earthtop
