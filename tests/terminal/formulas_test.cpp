// SPDX-License-Identifier: GPL-3.0-or-later
/// Every formula that a run prints gives the number that stands beside it, to the number's last digit. The formulas are read from the
/// printed text itself, with the scenario's inputs for their symbols; a text with a formula that cannot be read fails.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <random>
#include <regex>
#include <string>
#include <vector>

#include "earthtop/frames/earth.hpp"
#include "earthtop/model/body.hpp"
#include "earthtop/model/ledger.hpp"
#include "earthtop/run.hpp"
#include "earthtop/study/run_study.hpp"
#include "screen.hpp"
#include "study_text.hpp"
#include "summary_text.hpp"
#include "support/temporary_directory.hpp"
#include "terminal/formula_reader.hpp"
#include "terminal/formula_scenes.hpp"

namespace earthtop {
namespace {

using namespace formulas;

/// The moments of inertia are a list: their names, then their numbers.
std::string without_moments(const std::string& text, const RunResult& result) {
  const std::string names = "  I1, I2, I3 ";
  const std::size_t at = text.find(names);
  if (at == std::string::npos) return text;
  const std::size_t end = text.find('\n', at);
  std::string said = text.substr(at + names.size(), end - at - names.size()), expected;
  const auto& I = result.scene.body<double>().I_BP_B;
  expected = fmt::format("{:.6g}, {:.6g}, {:.6g} kg m² about the pivot", I(0, 0), I(1, 1), I(2, 2));
  said.erase(0, said.find_first_not_of(' '));
  EXPECT_EQ(said, expected);
  return text.substr(0, at) + text.substr(end);
}

std::string printed(const RunResult& result) {
  constexpr std::size_t kWide = 100'000;  // columns: no sentence is broken
  return tool::summary_text(result, {"out", ""}, false, {kWide, false});
}

/// Formulas that runs print, each with the number of times that it has to be found at least.
const std::map<std::string, int> kPrinted = {{"Ω", 150},
                                             {"Ω t", 50},
                                             {"|Ω| t", 50},
                                             {"Ω sin(latitude)", 15},
                                             {"|Ω sin(latitude)|", 15},
                                             {"|Ω_up|", 5},
                                             {"Ω cos(latitude)", 20},
                                             {"|Ω cos(latitude)|", 20},
                                             {"Ω_north", 3},
                                             {"|Ω_north|", 3},
                                             {"-Omega sin(latitude)", 20},
                                             {"-Omega_up", 5},
                                             {"2 asin(sin(angle from the celestial axis) |sin(Omega t/2)|)", 10},
                                             {"α", 10},
                                             {"2 asin(sin(α) |sin(Ω t/2)|)", 10},
                                             {"I3 w3 Omega cos(latitude) / (m g l)", 8},
                                             {"I3 w3 Omega_north / (m g l)", 2},
                                             {"I3/(2 I1)", 10},
                                             {"2π sqrt(I1/(I3 ω3 Ω cos(latitude)))", 8},
                                             {"2π sqrt(I1/(I3 |ω3 Ω cos(latitude)|))", 8},
                                             {"2π sqrt(I1/(I3 |ω3 Ω_north|))", 3},
                                             {"I/(I + m r²)", 8},
                                             {"I/(I + m r²) r ω Ω cos(latitude)", 4},
                                             {"I/(I + m r²) r |ω Ω cos(latitude)|", 4},
                                             {"r ω times its lean", 3},
                                             {"r |ω| times its lean", 3}};

TEST(Formulas, GiveTheNumbersBesideThem) {
  std::map<std::string, int> found;
  const std::vector<Drawn> scenes = drawn_scenes();
  ASSERT_EQ(scenes.size(), 200u);
  for (const auto& [kind, scenario] : scenes) {
    const RunResult result = run(scenario);
    const std::string all = without_moments(printed(result), result);
    // The drift is that of the last row that can be trusted.
    const std::size_t drift = std::min(all.find("\nDrift after "), all.size()),
                      verdict = std::min(all.find("\nVerdict"), all.size());
    const double at_s = drift < all.size() ? std::stod(all.substr(drift + std::string_view("\nDrift after ").size())) : 0;
    std::vector<std::pair<std::string, double>> texts = {{all.substr(0, drift), result.reached_s},
                                                         {all.substr(drift, verdict - drift), at_s},
                                                         {all.substr(verdict), result.reached_s}};
    for (const TheoryReport& theory : result.theory) {
      // Only the Earth's own part of the precession is a formula.
      const std::string words = ", counterclockwise about Up, and the precession's dependence on the mean energy and momenta";
      const std::size_t in_words = theory.statement.find(words);
      const double of_earth = -result.scene.rotation_rate_rad_s() * celestial_axis_L<double>(scenario.site)[2];
      texts.emplace_back(in_words == std::string::npos
                             ? fmt::format("{} = {:.17g} {}", theory.statement, theory.predicted, theory.unit)
                             : fmt::format("{} = {:.17g} rad/s", theory.statement.substr(0, in_words), of_earth),
                         result.reached_s);
    }
    for (const auto& [text, t_s] : texts) {
      const Claims claims = claims_of(text, symbols_of(result, t_s));
      for (const auto& [formula, count] : claims.formulas) found[formula] += count;
      for (const std::string& wrong : claims.wrong) ADD_FAILURE() << kind << ": " << wrong;
      EXPECT_FALSE(has_formula(claims.unread)) << kind << ": a formula that cannot be read in\n" << claims.unread;
    }
  }
  for (const auto& [formula, least] : kPrinted) EXPECT_GE(found[formula], least) << formula;
}

/// The number after some words, with half of its last digit. @param begin  where the words are looked for
std::optional<Side> number_after(const std::string& text, std::string_view words, std::size_t begin = 0) {
  const std::size_t at = text.find(words, begin);
  if (at == std::string::npos) return std::nullopt;
  const Symbols symbols = {{"Ω", 1}, {"t", 1}};
  return Reader(text, symbols).number_with_unit(at + words.size());
}
/// Whether a printed number is one that is known to a part of itself.
bool is_number(const Side& said, long double known, long double part) {
  return std::abs(said.value - known) <= said.error + part * std::abs(known);
}

Scenario finely(Scenario s, double rows) {
  s.output_step_s = s.duration_s / rows;
  s.ledger = LedgerObserver::laboratory;
  return s;
}

/// Releases with a precession of their own, whose Coriolis torque is mostly not that of the spin.
std::vector<Scenario> with_precession() {
  std::vector<Scenario> scenes(2);
  Scenario& given = scenes[0];
  given.site = {-64.782, 0, 0, 9.80665};
  given.body.mass_kg = 0.13415;
  given.body.center_of_mass_m = {0, 0, 0.0156782};
  given.body.inertia_about = InertiaAbout::center_of_mass;
  given.body.inertia_kg_m2 = {{{6.73122e-05, 0, 0}, {0, 6.73122e-05, 0}, {0, 0, 2.13424e-05}}};
  given.release = {.tilt_deg = 24.305,
                   .azimuth_deg = -11.9,
                   .spin_angle_deg = 78,
                   .spin_rad_s = -121.998,
                   .precession = Precession::given,
                   .precession_rate_rad_s = 11.9159};
  given.duration_s = 10.2;
  Scenario& rates = scenes[1];
  rates.site = {-62.645, 0, 0, 9.9029};
  rates.body.mass_kg = 0.0157064;
  rates.body.center_of_mass_m = {0, 0, 0.0111592};
  rates.body.inertia_about = InertiaAbout::center_of_mass;
  rates.body.inertia_kg_m2 = {{{2.84544e-06, 0, 0}, {0, 2.84544e-06, 0}, {0, 0, 6.67327e-07}}};
  rates.release = {.tilt_deg = 111.52,
                   .azimuth_deg = -133.77,
                   .spin_angle_deg = 202.73,
                   .angular_velocity_body_rad_s = std::array{-18.2185, 13.8036, 202.018}};
  rates.duration_s = 2.188;
  return scenes;
}

TEST(Formulas, TheCoriolisTorqueIsTheLargestOfTheLedger) {
  constexpr double kRows = 6000, kBetweenRows = 2e-4;  // of the torque: what it may rise to between two rows
  std::vector<Scenario> scenes = with_precession();
  for (const Drawn& drawn : drawn_scenes())
    if (drawn.kind.starts_with("precessing")) scenes.push_back(drawn.scenario);
  int told = 0;
  for (const Scenario& scenario : scenes) {
    const RunResult result = run(finely(scenario, kRows));
    const std::string text = printed(result);
    const auto said = number_after(text, "a Coriolis torque acts on the spinning top, "),
               gravity = number_after(text, "times gravity's ");
    if (!said) continue;
    ++told;
    EXPECT_TRUE(is_number(*said, result.ledger->largest.tau_cor, kBetweenRows)) << text;
    ASSERT_TRUE(gravity);
    EXPECT_TRUE(is_number(*gravity, result.ledger->largest.tau_phys, kBetweenRows)) << text;
  }
  EXPECT_GE(told, 30);
  const RunResult given = run(finely(scenes[0], 8)), rates = run(finely(scenes[1], 8));
  EXPECT_NE(printed(given).find(" 2.57e-07 N m at most: "), std::string::npos) << printed(given);
  EXPECT_NE(printed(rates).find(" 2.26e-08 N m at most: "), std::string::npos) << printed(rates);
}

TEST(Formulas, TheCompassHasThePeriodOfItsMotion) {
  constexpr double kRows = 4000, kInterpolated = 1e-6;
  int told = 0;
  Scenario turntable;
  turntable.site = {30, 0, 0, 9.81};
  turntable.rotation_rate_rad_s = 0.1;
  turntable.body.mass_kg = 1.5;
  turntable.body.inertia_kg_m2 = {{{0.00175859375, 0, 0}, {0, 0.00175859375, 0}, {0, 0, 0.0034171875}}};
  turntable.release = {.tilt_deg = 90, .azimuth_deg = 20, .spin_rad_s = rad_s_from_rpm(3000)};
  turntable.effects.applied.gimbal = GimbalSpec{};
  turntable.duration_s = 10;
  std::vector<Scenario> scenes{turntable};
  for (const Drawn& drawn : drawn_scenes())
    if (drawn.kind.starts_with("compass")) scenes.push_back(drawn.scenario);
  for (const Scenario& scenario : scenes) {
    const RunResult result = run(finely(scenario, kRows));
    const std::string text = printed(result);
    const auto period = number_after(text, "these swings have the period ");
    if (!period) continue;
    ++told;
    // Angles from the astronomical meridian, and passages through it.
    const Vec3<double> pole = celestial_axis_L<double>(scenario.site);
    std::vector<double> passed_s, angles;
    for (const DriftRow& row : result.rows) {
      const double tangent =
          (row.axis_L[0] * pole[1] - row.axis_L[1] * pole[0]) / (row.axis_L[0] * pole[0] + row.axis_L[1] * pole[1]);
      const double before = angles.empty() ? 0 : angles.back(), now = std::atan(tangent);
      if (before * now < 0) passed_s.push_back(row.t_s - result.scene.scenario().output_step_s * now / (now - before));
      angles.push_back(now);
    }
    ASSERT_GE(passed_s.size(), 2u) << text;
    const double half = (passed_s.back() - passed_s.front()) / static_cast<double>(passed_s.size() - 1);
    EXPECT_TRUE(is_number(*period, 2 * half, kInterpolated)) << text;
    double torque = 0, farthest = 0;
    for (const LedgerRow<double>& row : result.ledger->entries) torque = std::max(torque, std::abs(row.tau_cor_A[2]));
    for (std::size_t i = 0; i < angles.size(); ++i)
      farthest = std::max(farthest, std::abs(angles[i] - angles[0] * std::cos(std::numbers::pi * result.rows[i].t_s / half)));
    const auto said = number_after(text, "the Coriolis torque about the vertical, "),
               off = number_after(text, "departs from a cosine of their period by ");
    ASSERT_TRUE(said && off);
    Side rough = *off;
    rough.error *= 10;                // of two digits
    constexpr double kPeriod = 1e-3;  // of the departure: the error of the interpolated period is in it
    EXPECT_TRUE(is_number(rough, farthest, kPeriod)) << farthest << text;
    EXPECT_TRUE(is_number(*said, torque, kInterpolated)) << text;
  }
  EXPECT_GE(told, 40);
  const std::string text = printed(run(finely(turntable, 8)));
  EXPECT_NE(text.find("sqrt(I1/(I3 ω3 Ω cos(latitude))) = 0.86415 s; these swings have the period 0.87072 s"),
            std::string::npos)
      << text;
}

/// The formula of the drift that nutation makes gives the theory's number, with X and b from rows that are close to each other.
TEST(Formulas, DriftByNutationIsItsFormula) {
  Scenario scenario = parse_scenario(read_scenario_source(std::string(EARTHTOP_SCENARIOS) + "/magnus-drift.json"));
  scenario.duration_s = 0.5, scenario.output_step_s = 2e-5;
  const RunResult result = run(scenario);
  const auto theory = std::ranges::find(result.theory, "magnus_drift", &TheoryReport::name);
  ASSERT_NE(theory, result.theory.end());
  std::vector<double> angles;
  for (const DriftRow& row : result.rows) angles.push_back(row.gimbals->ref_inner_angle_rad);
  const auto [least, most] = std::ranges::minmax(angles);
  const double X = (most - least) / 2, b = (most + least) / 2, sine = std::sin(b), cosine = std::cos(b);
  const Model<double>& model = result.scene.model<double>();
  const double A3 = model.gimbals.ring.I(2, 2), B1 = model.I_BP_B(0, 0), B3 = model.I_BP_B(2, 2);
  const double h = scenario.rotor->axial_kg_m2 * (scenario.rotor->spin_rad_s + scenario.release.gimbals->outer_rate_rad_s *
                                                                                   std::cos(model.gimbals.release.inner));
  const double M0 = A3 + B1 * sine * sine + B3 * cosine * cosine;
  const double expected = -h * X * X * cosine * (A3 + B3) / (2 * M0 * M0);
  constexpr double kOfRows = 1e-3;  // how far the extremes of rows are from those of the motion, and the middle from their mean
  EXPECT_NEAR(theory->predicted, expected, kOfRows * std::abs(expected));
}

/// A fit's formula is the curve that leaves the residual that is printed with it, and no other a and b leave less.
TEST(Formulas, FitsAreTheCurvesThatTheirFormulasSay) {
  const testing::TemporaryDirectory directory;
  StudyRunOptions options;
  options.dir = directory.path() / "study";
  const std::string base = std::string(EARTHTOP_SCENARIOS) + "/toy-top.json";
  const char* const kinds[] = {"linear", "sin_latitude", "cos_latitude", "logarithmic", "power_law"};
  std::string fits;
  for (const char* kind : kinds)
    fits += fmt::format(R"({}{{"kind": "{}", "axis": "latitude_deg", "quantity": "drift.axis_final_rad"}})",
                        fits.empty() ? "" : ", ", kind);
  const Study study = parse_study({"fits.json", fmt::format(R"({{"base": "{}", "set": {{"/motion/duration_s": 0.5}},
    "axes": [{{"pointer": "/site/latitude_deg", "range": {{"from": 5, "to": 85, "points": 9}}}}], "fits": [{}]}})",
                                                            base, fits)});
  const nlohmann::json document = nlohmann::json::parse(study_json(run_study(study, options).store));
  const std::string text = tool::study_text(document.dump(), 100'000);
  std::vector<std::pair<double, double>> points;
  for (const auto& point : document.at("points"))
    points.emplace_back(point.at("latitude_deg").get<double>(), point.at("drift.axis_final_rad").get<double>());
  ASSERT_EQ(points.size(), 9u);
  struct Form {
    const char* formula;
    bool of_logarithm;
    double (*regressor)(double);
  };
  const Form forms[] = {
      {"  drift.axis_final_rad = a + b latitude_deg, 9 points\n", false, [](double x) { return x; }},
      {"  drift.axis_final_rad = a + b sin(latitude_deg°), 9 points\n", false,
       [](double x) { return std::sin(x * std::numbers::pi / 180); }},
      {"  drift.axis_final_rad = a + b cos(latitude_deg°), 9 points\n", false,
       [](double x) { return std::cos(x * std::numbers::pi / 180); }},
      {"  drift.axis_final_rad = a + b ln|latitude_deg|, 9 points\n", false, [](double x) { return std::log(std::abs(x)); }},
      {"  |drift.axis_final_rad| = a |latitude_deg|^b, 9 points\n", true, [](double x) { return std::log(std::abs(x)); }}};
  for (const Form& form : forms) {
    ASSERT_NE(text.find(form.formula), std::string::npos) << text;
    long double n = 0, x = 0, y = 0, xx = 0, xy = 0, squares = 0;
    const auto value = [&](double drift) { return form.of_logarithm ? std::log(drift) : drift; };
    for (const auto& [latitude, drift] : points) {
      const long double u = form.regressor(latitude), v = value(drift);
      n += 1, x += u, y += v, xx += u * u, xy += u * v;
    }
    const long double b = (n * xy - x * y) / (n * xx - x * x), a = (y - b * x) / n;
    for (const auto& [latitude, drift] : points) {
      const long double off = value(drift) - a - b * static_cast<long double>(form.regressor(latitude));
      squares += off * off;
    }
    const std::size_t at = text.find(form.formula);
    constexpr double kResidual = 1e-6;  // a residual is a thousandth of the numbers whose rounding it has
    constexpr double kRounded = 1e-8;   // of numbers of eight digits, of which the last may be zeros
    EXPECT_TRUE(is_number(*number_after(text, "\n    a = ", at), form.of_logarithm ? std::exp(a) : a, kRounded))
        << form.formula;
    EXPECT_TRUE(is_number(*number_after(text, "\n    b = ", at), b, kRounded)) << form.formula;
    EXPECT_TRUE(is_number(*number_after(text, "\n    residual ", at), std::sqrt(squares / n), kResidual)) << form.formula;
  }
}

/// The string literals of a source, with adjacent ones joined.
std::vector<std::string> literals_of(const std::string& source) {
  static const std::regex comment("//[^\n]*"), include("#include[^\n]*"), joint("\"\\s*\n\\s*\""),
      literal("\"((?:[^\"\\\\\n]|\\\\.)*)\"");
  std::string code = std::regex_replace(source, comment, "");
  code = std::regex_replace(std::regex_replace(code, include, ""), joint, "");
  std::vector<std::string> literals;
  for (std::sregex_iterator found(code.begin(), code.end(), literal), end; found != end; ++found)
    literals.push_back((*found)[1]);
  return literals;
}

/// Each text of the sources with the sign of a formula is one that a test above finds in print, or has no number beside it.
TEST(Formulas, EveryFormulaOfTheSourcesIsHeld) {
  // How the sources spell the formulas of kPrinted, and those of fits.
  const char* const held[] = {
      "a pivot that is not equally stiff: an energy kappa (n.e)^2/2 of the body axis 3, n, and of a horizontal direction e",
      "Ω",
      "|Ω| t",
      "Ω t",
      "ω ",
      "ω3 ",
      "ω",
      "Omega",
      " sin(latitude)",
      " cos(latitude)",
      "2 asin(sin(angle from the celestial axis) |sin(Omega t/2)|)",
      "2 asin(sin(α) |sin(Ω t/2)|)",
      "mean lean I3 w3 {} / (m g l)",
      "I3/(2 I1) = {:.3g}",
      "2π sqrt(I1/(I3 {})) = {:.5g} s",
      "I/(I + m r²) r {} = {:.4g} m/s², where I/(I + m r²) = {:.4g}",
      "a + b sin({}°)",
      "a + b cos({}°)",
      "a + b ln|{}|",
      "a |{}|^b",
      "-h X^2 cos(b) (A3 + B3)/(2 M0^2)",
      "turns with the stars, by |Ω| t = {}",
      "Ω = {} rad/s; in {} it turns by {} = {:.5g} rad = {}"};
  const char* const without_number[] = {"the Earth's rate times sin(latitude)",
                                        "the Earth's rate times cos(latitude)",   // names of what is estimated
                                        "with (I3 w3)^2 of at least 2 m g l I1",  // a condition
                                        "harmonic: a in a sin(2 pi f t + phase)",
                                        "harmonic: a in center + a sin(2 pi f t + phase)",
                                        "circle: s in center + s cos(2 pi f t + phase)",
                                        "in the bearing's dry friction -T",
                                        "Equations: dL/dt = L x w + torque in body axes",
                                        "y = a + b sin(x) or a + b cos(x), x in degrees",
                                        "= a + b sin({})",  // the page's words for the laws that are held above
                                        "= a + b cos({})",
                                        "2 pi/60 rad/s each",
                                        "between the two attitudes, 0 to pi",
                                        "GM/r^3",
                                        "ratio I3/I1 of the moments",
                                        "standard error of I3/I1"};  // what a key, a column or an input is
  const std::regex unit(
      "(kg|N|m|s|rad|1)([ /](kg|m|s|rad))*[ /]?((kg|m|s) ?)*(\\^[2-4]|²|³)([ /](s|m|rad|kg)(\\^[23]|²)?)*(/s)?");
  const std::regex sign("sqrt\\(|sin\\(|cos\\(|ln\\||Ω|ω|π|\\bpi\\b|I[123]?/|[\\w)|](\\^|²|³)|\\bw3\\b|Omega");
  const auto is_one_of = [](const std::string& literal, const auto& texts) {
    return std::ranges::any_of(texts, [&](std::string_view text) {
      return text.size() < 8 ? literal == text : literal.find(text) != std::string::npos;
    });
  };
  const std::filesystem::path root = std::filesystem::path(EARTHTOP_TESTS).parent_path();
  int read = 0;
  for (const char* room : {"src", "include", "tools/earthtop"})
    for (const auto& file : std::filesystem::recursive_directory_iterator(root / room)) {
      if (file.path().extension() != ".cpp" && file.path().extension() != ".hpp") continue;
      std::ifstream stream(file.path());
      const std::string source((std::istreambuf_iterator<char>(stream)), {});
      for (const std::string& literal : literals_of(source)) {
        if (!std::regex_search(std::regex_replace(literal, unit, ""), sign)) continue;
        ++read;
        EXPECT_TRUE(is_one_of(literal, held) || is_one_of(literal, without_number)) << file.path() << ": " << literal;
      }
    }
  EXPECT_GE(read, 25);
}

}  // namespace
}  // namespace earthtop
