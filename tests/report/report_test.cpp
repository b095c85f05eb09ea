// SPDX-License-Identifier: GPL-3.0-or-later
/// Report pages tested without a browser: what they must contain and what not. (tests/browser opens them in one.)
#include "earthtop/report/report.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "earthtop/compare/compare.hpp"
#include "earthtop/error.hpp"
#include "earthtop/measure/measurement.hpp"
#include "earthtop/results/results.hpp"
#include "report/bars.hpp"
#include "report/known_html.hpp"
#include "report/path_picture.hpp"
#include "report/shell.hpp"
#include "report/study_cells.hpp"
#include "report/thinning.hpp"
#include "results/made_up_run.hpp"
#include "support/json.hpp"
#include "support/page_data.hpp"
#include "support/temporary_directory.hpp"

namespace earthtop {
namespace {

namespace fs = std::filesystem;
using testing::between, testing::data_of, testing::TemporaryDirectory;

constexpr const char* kHostile = "</title><script>alert(1)</script>\"'&\x07";

Scenario short_top(const std::string& title) {
  Scenario scenario = parse_scenario(read_scenario_source(EARTHTOP_SCENARIOS "/toy-top.json"), {{"/motion/duration_s", "3"}});
  scenario.title = title;
  scenario.purpose = title;
  return scenario;
}

std::string page_of(const fs::path& what) { return make_report(what).html; }

TEST(Report, TheTitleIsTheSummarysNumberToItsLastBit) {
  const TemporaryDirectory dir;
  const RunResult result = run(short_top("A top"));
  write_results(result, dir.path() / "run", false);
  const std::string html = page_of(dir.path() / "run"), title = between(html, "<h1>", "</h1>");
  EXPECT_EQ(html.find("<p class=\"subject\">A top</p>\n<h1>"), html.find("<header>\n") + std::string("<header>\n").size());
  EXPECT_NE(title.find("In <data value=\"3\">3</data> s the Earth turns this top's axis "), title.npos) << title;
  const std::string number = between(title.substr(title.find("axis ")), "<data value=\"", "\"");
  double value = 0;
  std::from_chars(number.data(), number.data() + number.size(), value);
  EXPECT_EQ(value, result.drift.axis_final_rad) << title;
}

/// The header of the page of a made-up run with a last drift and its bound.
std::string header_with(double axis_rad, double bound_rad, Verdict verdict = Verdict::reliable, double t_s = 60) {
  const TemporaryDirectory dir;
  RunResult result = test::made_up_run();
  result.rows.erase(result.rows.begin() + 1, result.rows.end() - 1);
  result.rows.back().t_s = result.reached_s = t_s;
  result.verdict.verdict = verdict;
  result.verdict.reliable_until_s = t_s;
  result.rows.back().drift_axis_rad = result.drift.axis_final_rad = axis_rad;
  result.rows.back().drift_axis_bound_rad = result.drift.axis_bound_rad = bound_rad;
  write_results(result, dir.path() / "run", false);
  return between(page_of(dir.path() / "run"), "<header>", "</header>");
}

// The title has few digits, and no more than the error leaves; all of them, and the error in the same unit, are there on demand.
TEST(Report, TheTitleHasFewDigitsAndTheDetailsAll) {
  const std::string known = header_with(1.1402e-3, 6e-8);
  EXPECT_NE(known.find("In <data value=\"60\">a minute</data> the Earth turns this top's axis "), known.npos) << known;
  EXPECT_NE(known.find("axis <data value=\"0.0011402\">235.2</data> arcseconds off course</h1>"), known.npos) << known;
  EXPECT_NE(known.find("<strong><data value=\"0.0011402\">235.183</data>″</strong> ± <data value=\"6e-08\">0.012</data>″"),
            known.npos)
      << known;
  EXPECT_NE(
      known.find("<summary>This number can be trusted: <span class=\"sure\">± <data value=\"6e-08\">0.012</data>″</span>"),
      known.npos)
      << known;
  const std::string loose = header_with(1.1402e-3, 6e-5);
  EXPECT_NE(loose.find("axis <data value=\"0.0011402\">235</data> arcseconds off course"), loose.npos) << loose;
}

// Between drifts of one size the Sun's disc is the same part: 0.5331 degrees across.
TEST(Report, TheAngleIsToldBesideTheSunsDisc) {
  constexpr double kSun_rad = 1919.26 / 206264.80624709636;
  for (const auto& [share, words] : std::vector<std::pair<double, std::string>>{{20, "20 times the width of the Sun's disc"},
                                                                                {2, "2.0 times the width of the Sun's disc"},
                                                                                {1, "about the width of the Sun's disc"},
                                                                                {0.66, "about two thirds of the width"},
                                                                                {0.5, "about half the width of the Sun's disc"},
                                                                                {0.125, "about an eighth of the width"},
                                                                                {1e-4, "about 1/10,000 of the width"}}) {
    const std::string header = header_with(share * kSun_rad, 1e-12);
    EXPECT_NE(header.find(words), header.npos) << header;
  }
  EXPECT_EQ(header_with(1e-12 * kSun_rad, 1e-25).find("Sun"), std::string::npos);
}

TEST(Report, DurationsThatAreRoundAreWords) {
  for (const auto& [t_s, words] :
       std::vector<std::pair<double, std::string>>{{1, "In <data value=\"1\">a second</data> the"},
                                                   {90, "In <data value=\"90\">90</data> s the"},
                                                   {600, "In <data value=\"600\">10</data> minutes the"},
                                                   {3600, "In <data value=\"3600\">an hour</data> the"},
                                                   {86400, "In <data value=\"86400\">a day</data> the"}}) {
    const std::string header = header_with(1e-3, 1e-9, Verdict::reliable, t_s);
    EXPECT_NE(header.find(words), header.npos) << header;
  }
}

// Where the verdict is another one, the title says what is known instead, and the reason is in sight.
TEST(Report, ADoubtfulDriftIsNotTheTitle) {
  const std::string unstable = header_with(1e-3, 1e-9, Verdict::unstable),
                    noise = header_with(1e-9, 2e-9, Verdict::noise_floor),
                    marginal = header_with(1e-3, 1e-9, Verdict::marginal);
  EXPECT_NE(unstable.find("arcseconds off course, as would any other disturbance</h1>"), unstable.npos) << unstable;
  EXPECT_NE(marginal.find("arcseconds off course, at the limit of its stability</h1>"), marginal.npos) << marginal;
  EXPECT_NE(noise.find("axis by less than <data value=\"3"), noise.npos) << noise;
  for (const std::string& header : {unstable, noise, marginal}) {
    EXPECT_EQ(header.find("This number can be trusted"), header.npos) << header;
    EXPECT_LT(header.find("<div class=\"verdict "), header.find("<details>")) << header;
    EXPECT_LT(header.find("</strong>: "), header.find("<details>")) << header;
  }
}

/// The place of an element in a page; a failure where it is missing.
std::size_t place_of(const std::string& html, const std::string& element) {
  const std::size_t place = html.find(element);
  EXPECT_NE(place, html.npos) << element;
  return place;
}

// The finding, the top, the drift and why are open; the rest is folded.
TEST(Report, WhatWasFoundComesBeforeTheProtocol) {
  const TemporaryDirectory dir;
  write_results(run(short_top("A top")), dir.path() / "run", false);
  const std::string html = page_of(dir.path() / "run");
  std::size_t before = 0;
  for (const char* element :
       {"<h1>", "class=\"headline", "class=\"verdict reliable", "<canvas id=\"top\"",
        "<figure class=\"chart\" data-chart=\"parts\">", "id=\"section-why\"",
        "<details class=\"folded\" id=\"section-protocol\">", "id=\"section-your-top\"",
        "<figure class=\"chart\" data-chart=\"axis\">", "<canvas id=\"sphere\"", "id=\"section-command\""}) {
    const std::size_t place = place_of(html, element);
    EXPECT_LT(before, place) << element;
    before = place;
  }
  // One unit for what one panel draws, of the size of what it draws.
  const auto series = data_of(html).at("charts").at("parts").at("series");
  for (const char* label : {"angle", "its part in tilt", "Azimuth minus its secular line"})
    EXPECT_TRUE(std::any_of(series.begin(), series.end(), [&](const auto& s) {
      return s.at("label") == label && s.at("unit") == "arcseconds";
    })) << label;
  EXPECT_NEAR(series.at(0).at("y").back().get<double>(),
              run(short_top("A top")).drift.axis_final_rad * 648000 / 3.141592653589793, 1e-5);
}

// Each curve stands in one chart only.
TEST(Report, EachCurveIsDrawnOnce) {
  const TemporaryDirectory dir;
  for (const char* name : {"toy-top", "tippe-top", "foucault-pendulum"}) {
    write_results(run(parse_scenario(read_scenario_source(std::string(EARTHTOP_SCENARIOS "/") + name + ".json"),
                                     {{"/motion/duration_s", "2"}})),
                  dir.path() / name, false);
    std::vector<std::string> curves;
    const auto charts = data_of(page_of(dir.path() / name)).at("charts");
    for (const auto& data : charts)
      for (const auto& series : data.value("series", nlohmann::ordered_json::array())) {
        const auto y = series.at("y");
        const bool is_flat = std::all_of(y.begin(), y.end(), [&](const auto& value) { return value == y.at(0); });
        if (!is_flat) curves.push_back(y.dump());
      }
    std::sort(curves.begin(), curves.end());
    EXPECT_EQ(std::adjacent_find(curves.begin(), curves.end()), curves.end()) << name;
  }
}

Report page_of_shipped(const TemporaryDirectory& dir, const std::string& name, const std::string& duration_s) {
  write_results(
      run(parse_scenario(read_scenario_source(EARTHTOP_SCENARIOS "/" + name + ".json"), {{"/motion/duration_s", duration_s}})),
      dir.path() / "run", true);
  return make_report(dir.path() / "run");
}

// Foucault's pendulum: the plane turns by the Earth's rate times sin(latitude), less the part of the bob's own spin. Of the swings, which
// are denser than pixels, the last one is drawn strongly.
TEST(Report, APendulumShowsItsPlaneFirst) {
  const TemporaryDirectory dir;
  const Report page = page_of_shipped(dir, "foucault-pendulum", "600");
  EXPECT_LT(place_of(page.html, "id=\"rosette-rot\""), place_of(page.html, "<figure class=\"chart\" data-chart=\"plane\""));
  EXPECT_LT(place_of(page.html, "<figure class=\"chart\" data-chart=\"plane\""), place_of(page.html, "<canvas id=\"top\""));
  EXPECT_LT(place_of(page.html, "id=\"section-protocol\""),
            place_of(page.html, "<figure class=\"chart\" data-chart=\"parts\""));
  const auto series = data_of(page.html).at("charts").at("plane").at("series");
  constexpr double kRate = 7.292115e-5, kLatitude = 48.8462 * 3.141592653589793 / 180, kPart = 0.00203294775;
  const double expected = kRate * std::sin(kLatitude) * (1 - kPart) * 600 * 180 / 3.141592653589793;
  double last = 0, largest_without = 0;
  for (const auto& y : series.at(0).at("y"))
    if (y.is_number()) last = y.get<double>();
  for (const auto& y : series.at(1).at("y"))
    if (y.is_number()) largest_without = std::max(largest_without, std::abs(y.get<double>()));
  constexpr double kHalfSwing = 1.0 / 600, kSeen = 1e-3;  // the last extreme may be half a swing before the end
  EXPECT_NEAR(last, expected, (kHalfSwing + kSeen) * expected);
  EXPECT_LT(largest_without, kSeen * expected);
  const auto picture = std::ranges::find(page.pictures, std::string("rosette"), [](const auto& p) { return p.first; });
  ASSERT_NE(picture, page.pictures.end());
  EXPECT_NE(picture->second.find("The plane of the swing has turned by 1.884° clockwise"), std::string::npos);
  EXPECT_NE(picture->second.find("id=\"rosette-band\""), std::string::npos);
  EXPECT_EQ(page_of_shipped(dir, "foucault-pendulum", "4").html.find("id=\"rosette-band\""), std::string::npos)
      << "the plane does not turn by a pixel, but two swings are lines";
}

TEST(Report, AGyrocompassShowsItsSwingFirst) {
  const TemporaryDirectory dir;
  const Report page = page_of_shipped(dir, "gyrocompass-in-gimbals", "100");
  EXPECT_LT(place_of(page.html, "data-chart=\"compass\""), place_of(page.html, "<canvas id=\"top\""));
  const auto series = data_of(page.html).at("charts").at("compass").at("series");
  double least = 0;
  for (const auto& y : series.at(0).at("y")) least = std::min(least, y.get<double>());
  EXPECT_NEAR(series.at(0).at("y").at(0).get<double>(), 10, 1e-6);  // seven digits
  EXPECT_NEAR(least, -10, 0.01) /* the looks beside the turning point */ << "from the one side of North to the other";
  for (const auto& y : series.at(1).at("y"))
    EXPECT_NEAR(y.get<double>(), 10, 1e-6) /* seven digits */ << "without the Earth it stays";
}

TEST(Report, ATippeTopShowsItsTurnOverFirst) {
  const TemporaryDirectory dir;
  const Report page = page_of_shipped(dir, "tippe-top", "2");
  EXPECT_LT(place_of(page.html, "data-chart=\"turn-over\""), place_of(page.html, "<canvas id=\"top\""));
  EXPECT_NE(page.html.find(">162.5° at 2 s<"), page.html.npos);
  EXPECT_EQ(page_of_shipped(dir, "tippe-top", "0.5").html.find("data-chart=\"turn-over\""), std::string::npos)
      << "until then it has not turned over";
}

TEST(Report, AnglesHaveTheUnitOfTheirSize) {
  const TemporaryDirectory dir;
  for (const auto& [factor, unit] :
       std::vector<std::pair<double, std::string>>{{100, "degrees"}, {1, "arcseconds"}, {1e-4, "milliarcseconds"}}) {
    RunResult result = test::made_up_run();
    for (DriftRow& row : result.rows) {
      row.drift_axis_rad *= factor;
      row.drift_tilt_rad *= factor;
      row.axis_L = row.ref_axis_L = {std::sqrt(0.5), 0, std::sqrt(0.5)};
    }
    write_results(result, dir.path() / "run", true);
    const std::string html = page_of(dir.path() / "run");
    EXPECT_EQ(data_of(html).at("charts").at("parts").at("series").at(0).at("unit"), unit);
    EXPECT_NE(html.find("Angle between the two spin axes (" + unit + ")"), html.npos);
  }
}

// Sentences stand as the summary has them, as text; results without any, as old ones are, make a page, too.
TEST(Report, SaysWhyWhereTheSummaryDoes) {
  const TemporaryDirectory dir;
  RunResult result = test::made_up_run();
  write_results(result, dir.path() / "run", false);
  const std::string html = page_of(dir.path() / "run"), why = between(html, "<ol class=\"why\">", "</ol>");
  EXPECT_NE(why.find("<li>In the 60 s of this run the Earth turns by 902.46″.</li>"), why.npos) << why;
  EXPECT_NE(why.find("<li>About &lt;its&gt; vertical &amp; so on.</li>"), why.npos) << why;
  result.why.clear();
  write_results(result, dir.path() / "run", true);
  const std::string without = page_of(dir.path() / "run");
  EXPECT_EQ(without.find("section-why"), without.npos);
  EXPECT_NE(without.find("section-drift"), without.npos);
}

TEST(Report, PowersOfTenAreWrittenAsSuch) {
  EXPECT_EQ(with_powers("6.0e-09 of 1e+2, 31e-10, e-9 and 3em"), "6.0 × 10⁻⁹ of 10², 31 × 10⁻¹⁰, e-9 and 3em");
  EXPECT_EQ(with_powers("1e-05"), "10⁻⁵");
  EXPECT_EQ(with_powers("0.1e+20 and -1e-300"), "0.1 × 10²⁰ and -10⁻³⁰⁰");
}

TEST(Report, ForeignTextStaysText) {
  const TemporaryDirectory dir;
  write_results(run(short_top(kHostile)), dir.path() / "run", false);
  const std::string html = page_of(dir.path() / "run");
  EXPECT_EQ(html.find("<script>alert"), html.npos);
  EXPECT_EQ(html.find('\x07'), html.npos);
  EXPECT_NE(html.find("&lt;script&gt;alert(1)&lt;/script&gt;&quot;"), html.npos);
  data_of(html);  // still JSON
}

// A page has one security policy, one style of its own besides those of its pictures, one script, and loads nothing from
// elsewhere.
TEST(Report, NothingIsLoaded) {
  const TemporaryDirectory dir;
  write_results(run(short_top("A top")), dir.path() / "run", false);
  const std::string html = page_of(dir.path() / "run");
  EXPECT_NE(html.find("content=\"default-src 'none'; style-src 'sha256-"), html.npos);
  for (const char* loader : {"src=\"http", "href=\"http", "url(http", "@import", "<iframe", " style=\"", " onclick", " onload"})
    EXPECT_EQ(html.find(loader), html.npos) << loader;
  const std::string data = between(html, "id=\"earthtop-data\">", "</script>");
  EXPECT_LT(html.size() - data.size(), 300'000u);
}

TEST(Report, PicturesStandAlone) {
  const TemporaryDirectory dir;
  write_results(run(short_top("A top")), dir.path() / "run", false);
  const std::atomic<bool> stop = true;
  EXPECT_THROW(make_report(dir.path() / "run", Watch(&stop)), Interrupted);
  const Report report = make_report(dir.path() / "run");
  ASSERT_GE(report.pictures.size(), 3u);
  for (const auto& [name, picture] : report.pictures) {
    EXPECT_EQ(picture.rfind("<svg ", 0), 0u) << name;
    EXPECT_NE(picture.find("</svg>"), picture.npos) << name;
  }
}

TEST(Report, OfADocumentThatIsNoneIsRefused) {
  const TemporaryDirectory dir;
  for (const char* text : {"{}", "[1]", "{\"$schema\": \"earthtop-comparison-1.json\", \"pairs\": 3, \"verdict\": 1}", ""}) {
    std::ofstream(dir.path() / "document.json") << text;
    EXPECT_THROW(make_report(dir.path() / "document.json"), ScenarioError) << text;
  }
  EXPECT_THROW(make_report(dir.path()), ScenarioError);
  EXPECT_THROW(make_report(dir.path() / "nowhere"), ScenarioError);
}

std::string heading_of(const std::string& html) { return between(html, "<h1>", "</h1>"); }

TEST(Report, AComparisonShowsEveryVerdict) {
  const TemporaryDirectory dir;
  write_results(run(short_top("A top")), dir.path() / "a", false);
  Scenario other = short_top("A top");
  other.rotation_rate_rad_s *= 1.001;
  write_results(run(other), dir.path() / "b", false);
  CompareOptions options;
  options.with_curves = true;
  std::ofstream(dir.path() / "c.json") << comparison_json(compare_results(dir.path() / "a", dir.path() / "b", options));
  const std::string html = page_of(dir.path() / "c.json");
  for (const char* text : {"<strong>differs</strong>", "other scenario", "attitude_rad", "invariants.jacobi_integral.initial",
                           "data-chart=\"p0q0\""})
    EXPECT_NE(html.find(text), html.npos) << text;
  std::ifstream written(dir.path() / "c.json");
  const auto document = nlohmann::json::parse(written);
  const auto& quantities = document.at("pairs").at(0).at("quantities");
  const auto failed =
      std::count_if(quantities.begin(), quantities.end(), [](const auto& q) { return q.at("passed") == false; });
  ASSERT_GT(failed, 0);
  EXPECT_NE(heading_of(html).find(
                fmt::format(" differ: {} of {} quantities by more than their tolerances.", failed, quantities.size())),
            html.npos)
      << heading_of(html);
}

/// Under the pointer a mark says what it is, and whether it is on the front.
TEST(Report, AMarkOfABenchSaysWhatItIs) {
  const TemporaryDirectory dir;
  std::ofstream(dir.path() / "b.json") << R"({"processor": "a", "scenarios": [{"scenario": "top", "compared_error": "axis",
    "reference": {"error": {"axis_rad": 1e-13}}, "entries": [
    {"method": "taylor", "equations": "reduced, laboratory", "precision": "double", "relative_tolerance": 1e-08, "seconds": 0.001,
     "error": {"axis_rad": 1e-12}, "on_front": true},
    {"method": "gauss", "equations": "general, body", "precision": "double", "step_s": 0.5, "seconds": 0.002,
     "error": {"axis_rad": 2e-11}, "on_front": false}]}]})";
  const std::string html = page_of(dir.path() / "b.json");
  for (const char* text : {"taylor, reduced, laboratory, double, tolerance 10⁻⁸: 0.001 s, error 10⁻¹² rad; on the front\"",
                           "gauss, general, body, double, step 0.5 s: 0.002 s, error 2 × 10⁻¹¹ rad\""})
    EXPECT_NE(html.find(text), html.npos) << text;
}

/// The heading of a bench tells which method is most accurate, and which is fastest.
TEST(Report, ABenchBeginsWithWhatItFound) {
  const TemporaryDirectory dir;
  const auto heading = [&](const std::string& entries) {
    std::ofstream(dir.path() / "b.json") << R"({"processor": "a", "scenarios": [{"scenario": "top", "compared_error": "axis",
      "reference": {"error": {"axis_rad": 1e-13}}, "entries": [)" +
                                                entries + "]}]}";
    return heading_of(page_of(dir.path() / "b.json"));
  };
  const std::string taylor =
      R"({"method": "taylor", "equations": "reduced, laboratory", "precision": "double", "seconds": 0.001,
    "error": {"axis_rad": 1e-12}})";
  const std::string gauss = R"({"method": "gauss", "equations": "general, body", "precision": "double", "seconds": 0.002,
    "error": {"axis_rad": )";
  EXPECT_EQ(heading(taylor + "," + gauss + "2e-11}}"),
            "top: taylor is fastest and most accurate; it errs by 10⁻¹² rad after 0.001 s.");
  EXPECT_EQ(heading(taylor + "," + gauss + "2.5e-13}}"),
            "top: the most accurate method, gauss, errs by 2.5 × 10⁻¹³ rad after 0.002 s; the fastest, taylor, errs by 10⁻¹² "
            "rad after "
            "0.001 s.");
  EXPECT_EQ(heading(""), "No method has both a time and an error.");
}

/// A comparison with a measurement as if it had been made: azimuths that go round once, and a tilt.
MeasurementReport made_up_measurement() {
  MeasurementReport report;
  report.scenario_name = "a<top";
  report.file = "m.csv";
  report.fit = FitOutcome::converged;
  report.fitted = ChiSquared{7, 0, 8, 0.5};
  report.as_given = ChiSquared{9, 0, 10, 0.5};
  report.estimates = {{"omega_sin_latitude_rad_s", "rad/s", 5.2e-5, 5.16e-5, 3e-6, 3e-6},
                      {"tilt_deg", "deg", 20, 20.1, 0.1, 0.1}};
  report.estimates[0].finding = rate_finding(5.16e-5, 3e-6, {5.2e-5, 0}, {});
  report.estimates[0].exact = {{"gravity_m_s2", "m/s^2", 9.81, 0.01, 1.5e-3, 0}};
  report.correlation = {{1, -0.25}, {-0.25, 1}};
  report.priors = {{"tilt_deg", "tilt_deg", "deg", 20, 0.2, 0.5}};
  report.unused_priors = {{"gravity_m_s2", "it is <not> estimated"}};
  for (int i = 0; i < 10; ++i) {
    const double t = i, turned = std::remainder(6.0 - 0.7 * t, 2 * 3.141592653589793);
    report.residuals.push_back({t, static_cast<std::uint64_t>(i + 2), "azimuth", turned + 0.01, turned, 0.01, 0.02});
    report.residuals.push_back({t, static_cast<std::uint64_t>(i + 2), "tilt", 0.35, 0.34, 0.01, 0.02});
  }
  for (int i = 0; i <= 90; ++i)
    report.curve.push_back({0.1 * i, std::remainder(6.0 - 0.07 * i, 2 * 3.141592653589793), 0.34, NAN, NAN});
  return report;
}

TEST(Report, AMeasurementShowsWhatItSays) {
  const TemporaryDirectory dir;
  const MeasurementReport report = made_up_measurement();
  std::ofstream(dir.path() / "m.json") << measurement_json(report);
  const Report page = make_report(dir.path() / "m.json");
  const std::string html = page.html;
  for (const char* text :
       {"they <strong>agree",
        "the Earth&#39;s rate times sin(latitude) is 5.16 × 10⁻⁵ ± 0.30 × 10⁻⁵ rad/s: seen, zero is excluded at 17 sigma",
        "Taken as exact", ">Earth&#39;s rate times sin(latitude)</span> by one standard error", "0.002</data> m/s²", "a&lt;top",
        "Correlation of the estimates", "-0.25</data>", "Known beforehand", "it is &lt;not&gt; estimated",
        "data-chart=\"data\"", "data-chart=\"residuals\""})
    EXPECT_NE(html.find(text), html.npos) << text;
  EXPECT_EQ(heading_of(html), "The Earth&#39;s rate times sin(latitude) is 5.16 × 10⁻⁵ ± 0.30 × 10⁻⁵ rad/s.");
  MeasurementReport without = report;
  without.estimates.clear(), without.correlation.clear(), without.priors.clear();
  std::ofstream(dir.path() / "n.json") << measurement_json(without);
  EXPECT_EQ(heading_of(page_of(dir.path() / "n.json")), "The measured rows agree with the scenario a&lt;top.");
  ASSERT_EQ(page.pictures.size(), 2u);
  // The measured values follow the model over the whole turn: each lies 0.01 rad above it.
  const auto chart = data_of(html).at("charts").at("data");
  EXPECT_EQ(chart.at("x").size(), 10u) << "the measured times, not those of the curve";
  const auto& model = chart.at("series").at(0).at("y");
  const auto& measured = chart.at("series").at(1).at("y");
  for (std::size_t i = 0; i < 10; ++i) {
    const double degrees = 180 / 3.141592653589793, expected = (6.0 - 0.7 * static_cast<double>(i)) * degrees;
    EXPECT_NEAR(model.at(i).get<double>(), expected, 1e-4);  // seven digits
    EXPECT_NEAR(measured.at(i).get<double>(), expected + 0.01 * degrees, 1e-4);
  }
}

// Neighbours too far apart for counting turns: the azimuths stay from 0 to 360 degrees.
TEST(Report, AzimuthsThatCannotBeCountedOnStayInATurn) {
  MeasurementReport report = made_up_measurement();
  report.curve.clear();
  for (MeasurementResidual& residual : report.residuals)
    if (residual.quantity == "azimuth") residual.predicted = std::remainder(3.0 * residual.t_s, 2 * 3.141592653589793);
  const Figure figure = measurement_figure(report);
  for (const double y : figure.panels.at(0).lines.at(0).y)
    if (std::isfinite(y)) {
      EXPECT_GE(y, 0);
      EXPECT_LT(y, 360);
    }
}

// Some hundred of 200,000 values are drawn, the largest residual among them; the histogram counts all.
TEST(Report, OfVeryManyMeasuredValuesTheTellingOnesAreDrawn) {
  MeasurementReport report;
  for (int i = 0; i < 200'000; ++i)
    report.residuals.push_back({1e-3 * i, 2, "tilt", 0.3, 0.3, i == 77'777 ? 0.05 : 0.01 * std::sin(0.1 * i), 0.01});
  const Figure figure = measurement_figure(report);
  const Line& drawn = figure.panels.at(1).lines.at(0);
  EXPECT_LE(drawn.y.size(), 600u);
  EXPECT_EQ(*std::max_element(drawn.y.begin(), drawn.y.end()), 5);
  const Line counted = residuals_histogram(report).panels.at(0).lines.at(0);
  double sum = 0;
  for (const double number : counted.y) sum += number;
  EXPECT_EQ(sum, 200'000);
}

TEST(Plot, HasErrorBarsAndBars) {
  Figure figure{"Bars", "", {"x", ""}, {}};
  figure.panels.push_back({{"y", ""}, {}, 200});
  figure.panels[0].lines.push_back({"p", {0, 1}, {1, 2}, LineColor::blue, LineStyle::points, Marker::circle, false, {3, 0}});
  const std::string points = svg(figure);
  EXPECT_NE(points.find(">−2<"), points.npos) << "the axis has room for the lower end of the first error bar";
  EXPECT_EQ(points.find("stroke-linejoin"), points.npos) << "no line through the points";
  figure.panels[0].lines[0] = {"b", {0.5, 1.5}, {1, 2}, LineColor::blue, LineStyle::bars};
  const std::string bars = svg(figure);
  EXPECT_NE(bars.find(">0.0<"), bars.npos) << "bars begin at 0";
  EXPECT_NE(bars.find(">2.0<"), bars.npos);
  EXPECT_EQ(bars.find("nan"), bars.npos);
}

/// Results of a made-up run on a table, written to a directory, as a page.
std::string page_of_contact(const TemporaryDirectory& dir, const RunResult& result) {
  write_results(result, dir.path() / "table", true);
  return page_of(dir.path() / "table");
}

/// The smallest and the largest coordinate of a path's points, in the picture.
struct Box {
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
};
Box box_of(const std::string& html, const std::string& id) {
  std::string commands = between(html, "<path id=\"" + id + "\" d=\"", "\"");
  for (char& c : commands)
    if (c == 'M' || c == 'L') c = ' ';
  std::istringstream numbers(commands);
  Box box;
  for (double x = 0, y = 0; numbers >> x >> y;) {
    box.left = std::min(box.left, x);
    box.right = std::max(box.right, x);
    box.top = std::min(box.top, y);
    box.bottom = std::max(box.bottom, y);
  }
  return box;
}

// The prediction's tip runs in a circle, which is one in the picture, too. The drift is up to 0.12 mm beside a circle of 40 mm, so
// that it is drawn 20 times larger: at the end 2.4 mm, to the North, which is up.
TEST(Report, ATextForTheShellEndsWhereItEnds) {
  EXPECT_EQ(report::with_input("cat", "a"), "cat <<'EOF'\na\nEOF\n");
  EXPECT_EQ(report::with_input("cat", "a\nEOF\nEOF_\nb"), "cat <<'EOF__'\na\nEOF\nEOF_\nb\nEOF__\n");
  EXPECT_EQ(report::with_input("cat", "EOF"), "cat <<'EOF_'\nEOF\nEOF_\n");
}

TEST(StudyCells, DivideARangeEvenly) {
  report::CellScale scale(4);
  for (const double x : {0.0, 1.0, 2.0, 3.0, 3.999, 4.0, 8.0}) scale.include(x);
  scale.include({});
  scale.divide();
  const std::vector<std::pair<double, std::size_t>> wanted = {{0, 0}, {1, 0}, {2, 1}, {3.999, 1}, {4, 2}, {8, 3}};
  for (const auto& [x, cell] : wanted) EXPECT_EQ(scale.cell(x), cell) << x;
  EXPECT_EQ(scale.cell({}), std::nullopt);
  EXPECT_EQ(scale.json().dump(), R"({"low":0.0,"high":8.0,"cells":4,"log":false})");
}

TEST(StudyCells, OfPositiveNumbersOverTwoDecadesAreLogarithmic) {
  report::CellScale scale(3);
  for (const double x : {1e-3, 2e-3, 5e-2, 1.0}) scale.include(x);
  scale.divide();
  EXPECT_TRUE(scale.json().at("log"));
  EXPECT_EQ(scale.cell(2e-3), 0U);
  EXPECT_EQ(scale.cell(5e-2), 1U);
  EXPECT_EQ(scale.cell(1.0), 2U);
}

TEST(StudyCells, OfFewValuesAreTheValues) {
  report::CellScale numbers(4), words(2);
  for (const double x : {5.0, -1.0, 5.0}) numbers.include(x);
  for (const char* word : {"b", "a", "c", "b"}) words.include(std::string(word));
  numbers.divide();
  words.divide();
  EXPECT_EQ(numbers.json().dump(), R"({"values":[-1.0,5.0]})");
  EXPECT_EQ(numbers.cell(5.0), 1U);
  EXPECT_EQ(words.json().dump(), R"({"values":["a","b"]})");
  EXPECT_EQ(words.cell(std::string("c")), std::nullopt) << "a third word among two places";
}

TEST(StudyCells, TheMeanIsOfAllOfThem) {
  report::CellPicture::Cell cell;
  for (const auto& [number, value] : std::vector<std::pair<std::uint64_t, double>>{{7, 1.0}, {9, 2.0}, {12, 6.0}})
    cell.include(number, value);
  EXPECT_EQ(cell.count, 3U);
  EXPECT_EQ(cell.example, 7U);
  EXPECT_DOUBLE_EQ(cell.mean, 3.0);
}

TEST(Report, ThePathOfTheContactPointIsToScale) {
  const TemporaryDirectory dir;
  const std::string html = page_of_contact(dir, test::made_up_contact_run());
  const Box prediction = box_of(html, "path-ref"), motion = box_of(html, "path-rot");
  const double across = prediction.right - prediction.left;
  EXPECT_GT(across, 250);
  EXPECT_NEAR(across, prediction.bottom - prediction.top, 0.01 * across);
  EXPECT_NE(html.find("drift drawn 20 times as large"), html.npos);
  // The circle's highest point is reached last at t = 51 s, where the drift is 0.102 mm.
  EXPECT_NEAR(prediction.top - motion.top, 20 * 1.02e-4 / 0.04 * across, 0.01 * across);
  EXPECT_NEAR(motion.left, prediction.left, 0.01 * across);
  const auto data = data_of(html);
  for (const char* name : {"tip", "ref_tip"}) {
    ASSERT_EQ(data.at("packed").at("vectors").at(name).size(), 3u);
    for (const auto& component : data.at("packed").at("vectors").at(name))
      EXPECT_EQ(testing::unpacked_numbers(component).size(), 201u) << name;
  }
  EXPECT_TRUE(data.at("charts").contains("tip"));
  EXPECT_TRUE(data.at("charts").contains("force"));
}

TEST(Report, HasTheBalancesOfAContact) {
  const TemporaryDirectory dir;
  RunResult result = test::made_up_contact_run();
  EXPECT_EQ(page_of_contact(dir, result).find("Jellett"), std::string::npos);
  result.contact->rotating = {ContactBalance{1, 3, 1.5, 1e-12, 4}, ContactBalance{10, 7, -2, -2e-12, 8}};
  result.contact->reference = result.contact->rotating;
  const std::string html = page_of_contact(dir, result);
  EXPECT_NE(html.find("Jellett's integral"), std::string::npos);
  EXPECT_NE(html.find("by the work of friction"), std::string::npos);
}

TEST(Report, OfAContactSaysOnlyWhatIsTrue) {
  const TemporaryDirectory dir;
  RunResult result = test::made_up_contact_run();
  const std::string slides = page_of_contact(dir, result);
  for (const char* text : {"of where it started", "The Earth's rotation moves its end by 120 µm to the North.",
                           "Its slip falls from", "the tip rolls on", "makes it <data value=\"8e-07\">", "earlier", "later",
                           "the top stands up on its other end", "table_tilt", "Nobody knows a coefficient of friction to 1 %"})
    EXPECT_NE(slides.find(text), slides.npos) << text;
  EXPECT_EQ(slides.find("It rolls throughout"), slides.npos);
  for (DriftRow& row : result.rows) {
    row.contact->state = ContactState::roll;
    row.contact->drift_tip_xy_m = {0, 0};
    row.contact->drift_tip_m = 0;
    row.contact->tip_m = row.contact->ref_tip_m;
  }
  result.contact->changes.erase(result.contact->changes.begin());
  result.contact->events.clear();
  const std::string rolls = page_of_contact(dir, result);
  EXPECT_NE(rolls.find("It rolls throughout"), rolls.npos);
  EXPECT_NE(rolls.find("Both predictions to scale"), rolls.npos);
  for (const char* text : {"moves its end by", "Nobody knows a coefficient", "rotation makes it", "Its slip falls"})
    EXPECT_EQ(rolls.find(text), rolls.npos) << text;
}

TEST(Report, ArrowsOfABodyInGimbalsAreTheLedgers) {
  const TemporaryDirectory dir;
  const RunResult result = run(
      parse_scene(read_scenario_source(EARTHTOP_SCENARIOS "/through-gimbal-lock.json"),
                  {{"/motion/duration_s", "0.1"}, {"/motion/output_step_s", "0.1"}, {"/numerics/ledger", "\"laboratory\""}}));
  write_results(result, dir.path() / "run", false);
  const auto arrows = data_of(page_of(dir.path() / "run")).at("torques").at("coriolis_N_m");
  for (std::size_t k = 0; k < 3; ++k) {
    const double torque = result.ledger->entries.front().tau_cor_A[k];
    EXPECT_NEAR(arrows.at(k).get<double>(), torque, 1e-3 * std::abs(torque));  // four digits
  }
}

TEST(Report, OfAFixedPivotHasNoTable) {
  const TemporaryDirectory dir;
  write_results(test::made_up_run(), dir.path() / "run", false);
  const std::string html = page_of(dir.path() / "run");
  EXPECT_EQ(html.find("section-table"), html.npos);
  EXPECT_EQ(html.find("path-rot"), html.npos);
  EXPECT_FALSE(data_of(html).at("packed").contains("vectors"));
}

// A path that is a point, and one with holes, make a picture of finite numbers.
TEST(Report, PathsWithoutExtentAreDrawn) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  report::PathPicture picture;
  for (const auto& [x, y] :
       std::vector<std::pair<std::vector<double>, std::vector<double>>>{{{0, 0}, {0, 0}},
                                                                        {{}, {}},
                                                                        {{none, 1, none, 2}, {0, 1, 3, none}},
                                                                        {{1e-300, 2e-300}, {0, 0}},
                                                                        {{-1e300, 1e300}, {0, 1}}}) {
    picture.rotating = picture.reference = {"a path", x, y};
    const auto [wide, narrow] = path_svg(picture);
    const std::string svg = wide + narrow;
    EXPECT_EQ(svg.find("nan"), svg.npos) << svg;
    EXPECT_EQ(svg.find("inf"), svg.npos) << svg;
  }
}

/// Rows with a single outlier (the needle) in one of the columns.
class NeedleRows : public compare::RowSource {
 public:
  NeedleRows(std::uint64_t count, std::uint64_t needle, std::string_view column)
      : count_(count), needle_(needle), column_(*compare::trajectory_table().find(column)) {}
  bool next(compare::Row& row) override {
    if (at_ == count_) return false;
    row = {};
    row.t_s = static_cast<double>(at_);
    row.value[column_] = at_ == needle_ ? -1.0 : std::sin(0.01 * static_cast<double>(at_)) + 2;
    ++at_;
    return true;
  }
  bool has_column(std::size_t) const override { return true; }
  std::string where() const override { return ""; }

 private:
  std::uint64_t count_, needle_, at_ = 0;
  std::size_t column_;
};

TEST(Thinning, KeepsEndsAndExtremes) {
  constexpr std::uint64_t kCount = 200'000;
  for (const std::string_view column : {"drift_axis_rad", "drift_azimuth_rad", "drift_tilt_rad"})
    for (const std::uint64_t needle : {std::uint64_t{1}, std::uint64_t{77'777}, kCount - 2}) {
      NeedleRows rows(kCount, needle, column);
      const auto kept = report::thinned_rows(rows, kCount);
      EXPECT_LE(kept.size(), 8u * 251u);
      EXPECT_EQ(kept.front().t_s, 0);
      EXPECT_EQ(kept.back().t_s, static_cast<double>(kCount - 1));
      EXPECT_TRUE(
          std::any_of(kept.begin(), kept.end(), [&](const auto& row) { return row.t_s == static_cast<double>(needle); }));
      EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end(), [](const auto& a, const auto& b) { return a.t_s < b.t_s; }));
    }
  NeedleRows few(900, 5, "drift_axis_rad");
  EXPECT_EQ(report::thinned_rows(few, 900).size(), 900u);
}

TEST(Bars, LeftOutIsHatched) {
  const auto [svg, narrow] = report::bars_svg("b", "Torques", "N m", {{"a", 1e-3, false}, {"b<", 2e-9, true}});
  EXPECT_NE(narrow.find("url(#b-narrow-hatch)"), narrow.npos) << "ids differ: both are in one page";
  EXPECT_NE(svg.find("url(#b-hatch)"), svg.npos);
  EXPECT_NE(svg.find("b&lt;"), svg.npos);
}

}  // namespace
}  // namespace earthtop
