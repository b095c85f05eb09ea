// SPDX-License-Identifier: GPL-3.0-or-later
/// Files of other programs: conventions that a mapping undoes, rows at other times, studies.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <fstream>
#include <numbers>

#include "compare/results_copy.hpp"
#include "compare/small_engine.hpp"
#include "earthtop/compare/compare.hpp"
#include "earthtop/error.hpp"
#include "earthtop/study/run_study.hpp"
#include "study/store.hpp"

namespace earthtop {
namespace {

namespace fs = std::filesystem;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using testing::Csv;
using testing::ShortRun;
using testing::TemporaryDirectory;
using testing::write_text;

Quaterniond attitude(const Csv& csv, std::size_t row) {
  return {csv.get(row, "q_LB_w"), csv.get(row, "q_LB_x"), csv.get(row, "q_LB_y"), csv.get(row, "q_LB_z")};
}
Vector3d rates(const Csv& csv, std::size_t row) {
  return {csv.get(row, "w_LB_B_x_rad_s"), csv.get(row, "w_LB_B_y_rad_s"), csv.get(row, "w_LB_B_z_rad_s")};
}

Quaterniond from_columns(const Vector3d& x, const Vector3d& y, const Vector3d& z) {
  Eigen::Matrix3d matrix;
  matrix << x, y, z;
  return Quaterniond(matrix);
}
const Vector3d kEastAxis(1, 0, 0), kNorthAxis(0, 1, 0), kUpAxis(0, 0, 1);

/// A convention in which another program could write the short run: its world axes F and body axes G, as directions in ours,
/// and more.
struct Convention {
  Quaterniond q_LF, q_BG;
  bool scalar_last, inverse, world_rates;
  double rate_unit;  // rad/s
  std::string mapping;
};

std::string foreign_csv(const Csv& own, const Convention& c, double time_unit_s) {
  std::ostringstream text;
  text.precision(17);
  text << "# made for a test\nclock;a;b;c;d;p;q;r\n";
  for (std::size_t i = 0; i < own.rows.size(); ++i) {
    const Quaterniond q_LB = attitude(own, i);
    Quaterniond q = c.q_LF.conjugate() * q_LB * c.q_BG;
    if (c.inverse) q = q.conjugate();
    const Vector3d w =
        (c.world_rates ? Vector3d(c.q_LF.conjugate() * (q_LB * rates(own, i))) : Vector3d(c.q_BG.conjugate() * rates(own, i))) /
        c.rate_unit;
    text << own.get(i, "t_s") / time_unit_s;
    if (c.scalar_last)
      text << ';' << q.x() << ';' << q.y() << ';' << q.z() << ';' << q.w();
    else
      text << ';' << q.w() << ';' << q.x() << ';' << q.y() << ';' << q.z();
    text << ';' << w.x() << ';' << w.y() << ';' << w.z() << '\n';
  }
  return text.str();
}

std::string mapping_text(const Convention& c, const std::string& axes) {
  return std::string(
             R"({"separator": ";", "time": {"column": "clock", "unit": "ms"}, "quaternion": {"columns": ["a", "b", "c", "d"], "order": ")") +
         (c.scalar_last ? "xyzw" : "wxyz") + R"(", "rotation": ")" + (c.inverse ? "world_to_body" : "body_to_world") +
         R"("}, "rates": {"columns": ["p", "q", "r"], "unit": ")" + (c.rate_unit == 1 ? "rad/s" : "deg/s") + R"(", "axes": ")" +
         (c.world_rates ? "world" : "body") + "\"}" + axes + "}";
}

PairReport compare_foreign(const Convention& c, const std::string& axes) {
  const TemporaryDirectory dir;
  const Csv own(ShortRun::get().path() / "trajectory.csv");
  write_text(dir.path() / "foreign.csv", foreign_csv(own, c, 1e-3));
  write_text(dir.path() / "mapping.json", mapping_text(c, axes));
  CompareOptions options;
  options.mapping = (dir.path() / "mapping.json").string();
  return compare_results(ShortRun::get().path(), dir.path() / "foreign.csv", options).pairs.at(0);
}

const Quaterniond kSame = Quaterniond::Identity();
const Quaterniond kNed = from_columns(kNorthAxis, kEastAxis, -kUpAxis), kNwu = from_columns(kNorthAxis, -kEastAxis, kUpAxis),
                  kYUp = from_columns(kEastAxis, kUpAxis, -kNorthAxis);
// A body frame with x forward: the file's x is body axis 3, its y body axis 1, its z body axis 2.
const Quaterniond kXForward = from_columns(Vector3d(0, 0, 1), Vector3d(1, 0, 0), Vector3d(0, 1, 0));
constexpr double kDegreesPerSecond = std::numbers::pi / 180;

TEST(Mapping, EveryConventionIsUndone) {
  const struct {
    Quaterniond q_LF;
    std::string axes;
  } worlds[] = {{kSame, ""},
                {kNed, R"(, "world_axes": "NED")"},
                {kNwu, R"(, "world_axes": "NWU")"},
                {kYUp, R"(, "world_axes": ["east", "up", "south"])"}};
  for (const auto& world : worlds)
    for (const bool forward : {false, true})
      for (const bool flag : {false, true}) {
        const Convention c = {world.q_LF, forward ? kXForward : kSame, flag, forward, flag, flag ? 1 : kDegreesPerSecond, ""};
        const PairReport pair = compare_foreign(c, world.axes + (forward ? R"(, "body_axes": "x-forward")" : ""));
        EXPECT_TRUE(pair.passed()) << world.axes << forward << flag;
        ASSERT_EQ(pair.quantities.size(), 3u);  // attitude, rates, axis
        for (const QuantityVerdict& verdict : pair.quantities) {
          EXPECT_LT(verdict.largest, verdict.name == "rates_rad_s" ? 1e-12 : 1e-14) << verdict.name;
          EXPECT_EQ(verdict.compared, 61u);
        }
      }
}

TEST(Mapping, AWrongConventionDiffersAndTheRightOneIsNamed) {
  const auto expect_hint = [](const Convention& written, const Convention& said, const std::string& axes,
                              const std::string& hint) {
    const TemporaryDirectory dir;
    write_text(dir.path() / "foreign.csv", foreign_csv(Csv(ShortRun::get().path() / "trajectory.csv"), written, 1e-3));
    write_text(dir.path() / "mapping.json", mapping_text(said, axes));
    CompareOptions options;
    options.mapping = (dir.path() / "mapping.json").string();
    const PairReport pair = compare_results(ShortRun::get().path(), dir.path() / "foreign.csv", options).pairs.at(0);
    EXPECT_FALSE(pair.passed()) << hint;
    const bool named = std::any_of(pair.hints.begin(), pair.hints.end(),
                                   [&](const std::string& text) { return text.find(hint) != text.npos; });
    EXPECT_TRUE(named) << hint;
  };
  const Convention plain = {kSame, kSame, false, false, false, 1, ""};
  Convention other = plain;
  other.inverse = true;
  expect_hint(other, plain, "", "world-to-body");
  other = plain;
  other.scalar_last = true;
  expect_hint(other, plain, "", "scalar part last");
  other = plain;
  other.q_LF = kNed;
  expect_hint(other, plain, "", "North, East, Down");
  other = plain;
  other.rate_unit = kDegreesPerSecond;
  expect_hint(other, plain, "", "are taken as in deg/s");
}

TEST(Mapping, SimbodyAgreesToItsOwnError) {
  const struct {
    const char* name;
    double attitude_rad, rates_rad_s;  // as stated in the files
  } scenes[] = {{"toy-top", 2 * 4.3e-9, 1.0e-6 * kDegreesPerSecond},
                {"heavy-top-benchmark", 2 * 6.9e-11, 6.4e-8 * kDegreesPerSecond}};
  for (const auto& scene : scenes) {
    const TemporaryDirectory dir;
    const Scenario scenario =
        parse_scenario(read_scenario_source(std::string(EARTHTOP_SCENARIOS) + "/" + scene.name + ".json"));
    testing::write_results_to_be_changed(run(scenario), dir.path() / "ours");
    CompareOptions options;
    options.mapping = EARTHTOP_TESTS "/data/simbody/mapping.json";
    options.may_lack_rows = true;
    options.tolerances.profile = Profile::physics;
    const PairReport pair =
        compare_results(dir.path() / "ours", fs::path(EARTHTOP_TESTS) / "data/simbody" / (std::string(scene.name) + ".csv"),
                        options)
            .pairs.at(0);
    EXPECT_TRUE(pair.passed()) << scene.name;
    for (const QuantityVerdict& verdict : pair.quantities) {
      EXPECT_EQ(verdict.compared, 101u) << verdict.name;
      EXPECT_LT(verdict.largest, verdict.name == "rates_rad_s" ? scene.rates_rad_s : scene.attitude_rad)
          << scene.name << verdict.name;
    }
  }
}

// Compared with the prediction for a laboratory that does not turn, Simbody's top on the turning Earth differs by the whole
// effect of the rotation.
TEST(Mapping, PhysicsSeesTheEarth) {
  const TemporaryDirectory dir;
  const Scenario scenario = parse_scenario(read_scenario_source(EARTHTOP_SCENARIOS "/toy-top.json"));
  testing::write_results_to_be_changed(run(scenario), dir.path() / "ours");
  Csv csv(dir.path() / "ours" / "trajectory.csv");
  for (std::size_t i = 0; i < csv.rows.size(); ++i)
    for (const char* column : {"q_LB_w", "q_LB_x", "q_LB_y", "q_LB_z", "axis_L_x", "axis_L_y", "axis_L_z"})
      csv.set(i, column, csv.get(i, std::string("ref_") + column));
  write_text(dir.path() / "ours" / "trajectory.csv", csv.text());
  CompareOptions options;
  options.mapping = EARTHTOP_TESTS "/data/simbody/mapping.json";
  options.may_lack_rows = true;
  options.tolerances.profile = Profile::physics;
  const PairReport pair =
      compare_results(dir.path() / "ours", fs::path(EARTHTOP_TESTS) / "data/simbody/toy-top.csv", options).pairs.at(0);
  EXPECT_FALSE(pair.passed());
}

TEST(Mapping, AFileIsRefusedWithAllItsErrors) {
  const TemporaryDirectory dir;
  const std::string file = (dir.path() / "m.json").string();
  const auto errors_of = [&](const std::string& text) -> std::vector<Diagnostic> {
    write_text(file, text);
    CompareOptions options;
    options.mapping = file;
    try {
      compare_results(ShortRun::get().path(), ShortRun::get().path() / "trajectory.csv", options);
    } catch (const ScenarioError& error) {
      return error.diagnostics();
    }
    return {};
  };
  EXPECT_EQ(errors_of("{}").size(), 2u);  // no time, nothing to compare
  EXPECT_EQ(errors_of(R"({"time": {"column": "t", "unit": "years"}, "axis": {"columns": ["a", "b"]}, "world_axes": "UPS",
                          "body_axes": ["1", "1", "2"], "separator": "ab"})")
                .size(),
            5u);
  const auto left_handed =
      errors_of(R"({"time": {"column": "t"}, "axis": {"columns": ["a", "b", "c"]}, "world_axes": ["east", "north", "down"]})");
  ASSERT_EQ(left_handed.size(), 1u);
  EXPECT_NE(left_handed[0].message.find("left-handed"), std::string::npos);
  const auto no_column = errors_of(R"({"time": {"column": "t"}, "axis": {"columns": ["a", "b", "c"]}})");
  ASSERT_EQ(no_column.size(), 1u);
  EXPECT_NE(no_column[0].message.find("no column \"t\""), std::string::npos);
}

/// One second of the slow heavy top of the benchmark, with the given output step.
fs::path slow_run(const TemporaryDirectory& dir, const std::string& name, const char* step) {
  const Scenario scenario =
      parse_scenario(read_scenario_source(EARTHTOP_SCENARIOS "/asymmetric-top.json"),
                     {{"/motion/duration_s", "1"}, {"/motion/output_step_s", step}, {"/release/spin_rad_s", "10"}});
  testing::write_results_to_be_changed(run(scenario), dir.path() / name);
  return dir.path() / name;
}

TEST(OtherTimes, RowsBetweenAreComparedWithAStatedError) {
  const TemporaryDirectory dir;
  const fs::path fine = slow_run(dir, "fine", "0.0002"), other = slow_run(dir, "other", "0.0037");
  CompareOptions options;
  options.tolerances.profile = Profile::physics;
  options.may_change = {"/motion/output_step_s"};
  const PairReport pair = compare_results(fine, other, options).pairs.at(0);
  EXPECT_TRUE(pair.passed());
  for (const QuantityVerdict& verdict : pair.quantities) {
    if (verdict.name != "attitude_rad" && verdict.name != "axis_rad" && verdict.name != "rates_rad_s") continue;
    ASSERT_TRUE(verdict.interpolation_error) << verdict.name;
    EXPECT_GT(verdict.largest, 0) << verdict.name;
    // The motions are the same, so the whole difference comes from interpolation. It is below the stated error, but not by more
    // than a factor of 1e4.
    EXPECT_LT(verdict.largest, *verdict.interpolation_error) << verdict.name;
    EXPECT_GT(verdict.largest, *verdict.interpolation_error / 1e4) << verdict.name;
  }
}

TEST(OtherTimes, RowsTooFarApartAreRefused) {
  const TemporaryDirectory dir;
  CompareOptions options;
  options.may_change = {"/motion/output_step_s"};
  options.tolerances.profile = Profile::physics;
  const auto refusal = [&](const fs::path& reference, const fs::path& candidate) -> std::string {
    try {
      compare_results(reference, candidate, options);
    } catch (const ScenarioError& error) {
      return error.what();
    }
    return "";
  };
  const fs::path coarse = slow_run(dir, "coarse", "0.2"), middle = slow_run(dir, "middle", "0.02"),
                 other = slow_run(dir, "other", "0.0037");
  EXPECT_NE(refusal(coarse, other).find("the body turns by"), std::string::npos);
  EXPECT_NE(refusal(middle, other).find("above its tolerance"), std::string::npos) << refusal(middle, other);
}

TEST(OtherTimes, AShiftByHalfASampleIsSeenThroughInterpolation) {
  const TemporaryDirectory dir;
  const fs::path fine = slow_run(dir, "fine", "0.0002");
  Csv csv(fine / "trajectory.csv");
  for (std::size_t i = 0; i < csv.rows.size(); ++i) csv.set(i, "t_s", csv.get(i, "t_s") + 0.0001);
  write_text(dir.path() / "late.csv", csv.text());
  CompareOptions options;
  options.tolerances.profile = Profile::physics;
  const PairReport pair = compare_results(fine / "trajectory.csv", dir.path() / "late.csv", options).pairs.at(0);
  EXPECT_FALSE(pair.passed());
}

TEST(Studies, ArePairedByPoint) {
  const TemporaryDirectory dir;
  const auto run_in = [&](const char* name, const char* tilt) {
    const Study study = parse_study({"s.json", std::string(R"({"base": ")") + EARTHTOP_SCENARIOS +
                                                   R"(/toy-top.json", "set": {"/motion/duration_s": 0.5},
      "axes": [{"pointer": "/site/latitude_deg", "values": [10, 20, 30]}, {"pointer": "/release/tilt_deg", "values": [10, )" +
                                                   tilt + "]}]}"});
    StudyRunOptions options;
    options.dir = dir.path() / name;
    run_study(study, options);
    write_study_results(study_store(options.dir));
    return options.dir;
  };
  const fs::path a = run_in("a", "20"), b = run_in("b", "20"), c = run_in("c", "20.001");
  EXPECT_TRUE(compare_results(a, study_store(b), {}).passed());
  const PairReport other = compare_results(a, c, {}).pairs.at(0);
  EXPECT_FALSE(other.passed());
  EXPECT_EQ(other.rows, 6u);
  ASSERT_FALSE(other.findings.empty());
  EXPECT_EQ(other.findings[0].kind, "other study");
  const auto drift = std::find_if(other.quantities.begin(), other.quantities.end(),
                                  [](const QuantityVerdict& q) { return q.name == "drift.axis_final_rad"; });
  ASSERT_NE(drift, other.quantities.end());
  EXPECT_FALSE(drift->passed);
  EXPECT_EQ(drift->first_violation, "point 1 (latitude_deg 10, tilt_deg 20)");
  EXPECT_EQ(drift->violations, 3u);
  update_reference(a, c, "another tilt");
  EXPECT_TRUE(compare_results(a, c, {}).passed());
  EXPECT_TRUE(fs::exists(a / "reference.json"));

  // A version that reads the same study otherwise makes other scenarios of it.
  study::Store old = study::Store::open(study_store(b), study::sqlite::Connection::Mode::read);
  study::Store other_version = study::Store::create(dir.path() / "other.sqlite", old.study(), old.shard());
  other_version.begin();
  old.for_each([&](study::PointResult point) {
    if (point.number > 3) point.scenario_sha256 = std::string(64, 'f');
    other_version.insert(point);
  });
  other_version.commit();
  other_version.finish();
  const PairReport otherwise = compare_results(study_store(b), dir.path() / "other.sqlite", {}).pairs.at(0);
  ASSERT_EQ(otherwise.findings.size(), 1u);
  EXPECT_EQ(otherwise.findings[0].text,
            "2 points are of different scenarios, the first one point 4 (latitude_deg 30, tilt_deg 10)");
}

/// The plain file of the short run, its rows changed, against the short run, with rows that may be missing.
PairReport compare_changed(const std::function<void(std::vector<std::vector<std::string>>&)>& change,
                           CompareOptions options = {}, const std::string& time = "") {
  const TemporaryDirectory dir;
  std::istringstream lines(
      foreign_csv(Csv(ShortRun::get().path() / "trajectory.csv"), {kSame, kSame, false, false, false, 1, ""}, 1));
  std::string line, text;
  std::vector<std::vector<std::string>> rows;
  for (int i = 0; std::getline(lines, line); ++i) {
    if (i < 2)
      text += line + '\n';
    else
      rows.push_back({line.substr(0, line.find(';')), line.substr(line.find(';'))});
  }
  change(rows);
  for (const auto& row : rows) text += row[0] + row[1] + '\n';
  write_text(dir.path() / "foreign.csv", text);
  write_text(dir.path() / "mapping.json",
             R"({"separator": ";", "time": {"column": "clock")" + time +
                 R"(}, "quaternion": {"columns": ["a", "b", "c", "d"]}, "rates": {"columns": ["p", "q", "r"]}})");
  options.mapping = (dir.path() / "mapping.json").string();
  options.may_lack_rows = true;
  return compare_results(ShortRun::get().path(), dir.path() / "foreign.csv", options).pairs.at(0);
}
bool has_finding(const PairReport& pair, const std::string& kind) {
  return std::any_of(pair.findings.begin(), pair.findings.end(),
                     [&](const CompareFinding& finding) { return finding.kind == kind; });
}
using Lines = std::vector<std::vector<std::string>>;

TEST(Span, SameNeedsTheWholeDurationOfTheReference) {
  const PairReport whole = compare_changed([](Lines&) {});
  EXPECT_TRUE(whole.passed());
  EXPECT_EQ(whole.rows, 61u);
  EXPECT_EQ(whole.span.of, 61u);
  EXPECT_EQ(whole.span.from_s, 0);
  EXPECT_EQ(whole.span.to_s, 6);
  const PairReport every_third = compare_changed([](Lines& rows) {
    for (std::size_t i = 0; 3 * i < rows.size(); ++i) rows[i] = rows[3 * i];
    rows.resize(21);
  });
  EXPECT_TRUE(every_third.passed());
  EXPECT_EQ(every_third.rows, 21u);
  for (const std::size_t kept : {1u, 2u, 60u}) {
    const PairReport part = compare_changed([&](Lines& rows) { rows.resize(kept); });
    EXPECT_FALSE(part.passed()) << kept;
    EXPECT_TRUE(has_finding(part, "part of the time")) << kept;
    EXPECT_NE(part.findings.back().text.find("but the reference at t = 6 s; write all of them, or compare less (--until "),
              std::string::npos);
  }
  const PairReport late = compare_changed([](Lines& rows) { rows.erase(rows.begin()); });
  EXPECT_TRUE(has_finding(late, "part of the time"));
  CompareOptions until;
  until.until_s = 3;
  const PairReport half = compare_changed([](Lines& rows) { rows.resize(31); }, until);
  EXPECT_TRUE(half.passed());
  EXPECT_EQ(half.span.to_s, 3);
  EXPECT_EQ(half.rows, 31u);
  EXPECT_FALSE(compare_changed([](Lines& rows) { rows.resize(25); }, until).passed());
  EXPECT_TRUE(compare_changed([](Lines& rows) { rows[50][1] = ";1;0;0;0;0;0;0"; }, until).passed());  // later than that
  until.until_s = 7;
  EXPECT_THROW(compare_changed([](Lines&) {}, until), ScenarioError);
  try {
    testing::compared(ShortRun::get().path(), until);
    ADD_FAILURE();
  } catch (const ScenarioError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("--until belongs to a CSV file; two results are compared to their common end, where "
                        "--allow-change /motion/duration_s allows unlike lengths"),
              std::string::npos);
  }
}

TEST(Span, RowsOutsideTheReferencesTimesAreADifference) {
  const PairReport hour = compare_changed([](Lines& rows) {
    for (auto& row : rows) row[0] = std::to_string(std::stod(row[0]) + 3600);
  });
  EXPECT_TRUE(has_finding(hour, "extra rows"));
  EXPECT_FALSE(hour.passed());
  const PairReport one = compare_changed([](Lines& rows) { rows.push_back({"6.1", rows.back()[1]}); });
  EXPECT_TRUE(has_finding(one, "extra rows"));
  EXPECT_FALSE(one.passed());
}

TEST(Span, TheRatioOfTheLastTimesNamesTheUnit) {
  const auto said = [](double factor, const std::string& time = "") {
    const PairReport pair = compare_changed(
        [&](Lines& rows) {
          for (auto& row : rows) row[0] = fmt::format("{:.17g}", std::stod(row[0]) * factor);
        },
        {}, time);
    EXPECT_FALSE(pair.passed()) << factor;
    return pair.hints.empty() ? std::string() : pair.hints.front();
  };
  EXPECT_EQ(said(1000), "its last time is 1000 times the reference's: its times are in ms (time.unit of the mapping)");
  EXPECT_EQ(said(1.0 / 60),
            "its last time is 0.0166667 times the reference's: its times are in min (time.unit of the mapping)");
  EXPECT_EQ(said(1, R"(, "unit": "min")"),
            "its last time is 60 times the reference's: its times are in s (time.unit of the mapping)");
  EXPECT_EQ(said(60), "its last time is 60 times the reference's: are its times in another unit?");
}

TEST(Mapping, SaysWhichOfTwoRowsAtOneTimeCounts) {
  const auto doubled = [](Lines& rows) {  // an event at 3 s: before it the right row, after it another
    rows.insert(rows.begin() + 31, rows[30]);
    rows[31][1] = ";1;0;0;0;0;0;0";
  };
  EXPECT_TRUE(compare_changed(doubled, {}, R"(, "repeated": "first")").passed());
  EXPECT_FALSE(compare_changed(doubled, {}, R"(, "repeated": "last")").passed());
  const auto other = [](Lines& rows) {
    rows.insert(rows.begin() + 30, rows[30]);
    rows[30][1] = ";1;0;0;0;0;0;0";
    rows.push_back(rows.back());
  };
  const PairReport last = compare_changed(other, {}, R"(, "repeated": "last")");
  EXPECT_TRUE(last.passed());
  EXPECT_EQ(last.rows, 61u);
  EXPECT_FALSE(compare_changed(other, {}, R"(, "repeated": "first")").passed());
  try {
    compare_changed(other);
    ADD_FAILURE();
  } catch (const ScenarioError& error) {
    EXPECT_NE(std::string(error.what()).find("a second row at 3 s; say in the mapping which one counts"), std::string::npos)
        << error.what();
  }
}

TEST(EngineFit, NeedsARow) {
  const TemporaryDirectory dir;
  write_text(dir.path() / "engine.csv", "t,x,y,z\n0,0,0,0\n");
  write_text(dir.path() / "mapping.json", R"({"time": {"column": "t"}, "axis": {"columns": ["x", "y", "z"]}})");
  const ScenarioSource source = read_scenario_source(std::string(EARTHTOP_SCENARIOS) + "/toy-top.json");
  try {
    fit_to_engine(source, {}, (dir.path() / "engine.csv").string(), (dir.path() / "mapping.json").string(), {"gravity_m_s2"},
                  {});
    ADD_FAILURE();
  } catch (const ScenarioError& error) {
    EXPECT_NE(std::string(error.what()).find("has no row to which anything could be fitted"), std::string::npos);
  }
}

TEST(EngineFit, FindsTheNumberThatAnotherProgramHadOtherwise) {
  const TemporaryDirectory dir;
  testing::SmallEngine engine;
  engine.gravity = 9.81;
  write_text(dir.path() / "engine.csv", testing::SmallEngine::csv(engine.run(6, 0.1, 2000)));
  write_text(
      dir.path() / "mapping.json",
      R"({"time": {"column": "t"}, "quaternion": {"columns": ["q0", "q1", "q2", "q3"]}, "rates": {"columns": ["wx", "wy", "wz"]}})");
  const ScenarioSource source = read_scenario_source(std::string(EARTHTOP_SCENARIOS) + "/toy-top.json");
  const EngineFit fit = fit_to_engine(source, {}, (dir.path() / "engine.csv").string(), (dir.path() / "mapping.json").string(),
                                      {"gravity_m_s2"}, {});
  ASSERT_EQ(fit.numbers.size(), 1u) << fit.reason;
  ASSERT_TRUE(fit.numbers[0].estimate) << fit.reason;
  constexpr double kEngineError = 1e-8;  // of steps of 5e-5 s
  EXPECT_NEAR(*fit.numbers[0].estimate, 9.81, kEngineError);
  EXPECT_EQ(fit.numbers[0].given, 9.80665);
  EXPECT_GT(fit.given_rms_rad, 1e-4);  // gravity is off by 3e-4 of itself
  EXPECT_LT(*fit.fitted_rms_rad, kEngineError);
  EXPECT_EQ(fit.rows, 61u);
}

}  // namespace
}  // namespace earthtop
