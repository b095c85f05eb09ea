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

namespace earthtop {
namespace {

constexpr long double kPi = std::numbers::pi_v<long double>;
using Symbols = std::map<std::string, long double>;

// --- Reading formulas --------------------------------------------------------------------------------------------------

/// What stands at a place of a text: a formula, or a number with its unit.
struct Side {
  long double value = 0, error = 0;  // error: half of the last digit that is printed
  std::size_t end = 0;               // of the text that was read
  bool is_formula = false;
  bool is_symbol = false;  // nothing but the name of a quantity
};

/// Reads formulas and numbers from a text.
class Reader {
 public:
  Reader(const std::string& text, const Symbols& symbols) : text_(text), symbols_(symbols) {}

  /// A number with its unit, "1.20e-3 ± 4e-7 rad", or a formula.
  std::optional<Side> side(std::size_t at) const {
    if (const auto number = number_with_unit(at)) return number;
    State state{at};
    const auto value = sum(state);
    if (!value) return std::nullopt;
    return Side{*value, 0, state.at, is_formula(state), state.is_symbol && state.factors == 1};
  }
  std::optional<Side> number_with_unit(std::size_t at) const {
    auto first = number(at);
    if (!first) return std::nullopt;
    auto unit = unit_at(first->end);
    if (unit) first->end = unit->end;
    if (follows(first->end, " ± ")) {
      if (const auto error = number(first->end + std::string_view(" ± ").size())) {
        first->end = error->end;
        if (const auto of_error = unit_at(error->end)) unit = of_error, first->end = of_error->end;
      }
    }
    if (unit) {
      first->value *= unit->value, first->error *= std::abs(unit->value);
      return first;
    }
    // A number that begins a formula is no number beside one.
    State state{at};
    if (const auto value = sum(state); value && is_formula(state)) return std::nullopt;
    return first;
  }
  bool follows(std::size_t at, std::string_view what) const { return text_.compare(at, what.size(), what) == 0; }

 private:
  struct State {
    std::size_t at;
    bool is_distinct = false, is_symbol = false, has_name = false;
    int factors = 0;
  };
  /// In a sentence a single Latin letter may be a unit or a word.
  static bool is_formula(const State& state) { return state.is_distinct || (state.has_name && state.factors > 1); }

  static bool is_letter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

  /// A printed number. Fewer than three digits are more, of which the last were zeros.
  std::optional<Side> number(std::size_t at) const {
    const std::size_t begin = at;
    if (at < text_.size() && (text_[at] == '-' || text_[at] == '+')) ++at;
    const std::size_t digits = text_.find_first_not_of("0123456789.", at);
    std::size_t end = std::min(digits, text_.size());
    while (end > at && text_[end - 1] == '.') --end;
    if (end == at || !std::isdigit(static_cast<unsigned char>(text_[at]))) return std::nullopt;
    const std::string mantissa = text_.substr(at, end - at);
    int exponent = 0;
    if (end + 2 < text_.size() && text_[end] == 'e' && (text_[end + 1] == '-' || text_[end + 1] == '+')) {
      std::size_t used = 0;
      exponent = std::stoi(text_.substr(end + 1), &used);
      end += 1 + used;
    }
    const std::size_t point = mantissa.find('.');
    int decimals = point == std::string::npos ? 0 : static_cast<int>(mantissa.size() - point - 1);
    const auto significant = [&] {
      std::string all = mantissa;
      std::erase(all, '.');
      return static_cast<int>(all.size() - std::min(all.find_first_not_of('0'), all.size()));
    };
    constexpr int kFewest = 3;
    if (significant() > 0 && significant() < kFewest) decimals += kFewest - significant();
    Side side;
    side.value = std::strtold(text_.substr(begin, end - begin).c_str(), nullptr);
    side.error = 0.5L * std::pow(10.0L, exponent - decimals);
    side.end = end;
    return side;
  }
  struct Unit {
    long double value;
    std::size_t end;
  };
  std::optional<Unit> unit_at(std::size_t at) const {
    const long double degree = kPi / 180, arcsecond = degree / 3600;
    const std::pair<std::string, long double> units[] = {
        {" |Ω| t", std::abs(symbols_.at("Ω")) * symbols_.at("t")},
        {" Ω t", symbols_.at("Ω") * symbols_.at("t")},
        {" rad/s", 1},
        {" rad", 1},
        {"°", degree},
        {"″", arcsecond},
        {" arcsec", arcsecond},
        {" milliarcsec", 1e-3L * arcsecond},
        {" microarcsec", 1e-6L * arcsecond},
        {" N m", 1},
        {" m/s²", 1},
        {" km/s", 1e3L},
        {" m/s", 1},
        {" mm/s", 1e-3L},
        {" µm/s", 1e-6L},
        {" nm/s", 1e-9L},
        {" km", 1e3L},
        {" mm", 1e-3L},
        {" µm", 1e-6L},
        {" micrometres", 1e-6L},
        {" nm", 1e-9L},
        {" nanometres", 1e-9L},
        {" kg m²", 1},
        {" kg m^3/s", 1},
        {" m", 1},
        {" s", 1},
    };
    for (const auto& [name, value] : units) {
      const std::size_t end = at + name.size();
      if (follows(at, name) && (end == text_.size() || !is_letter(text_[end]) || name.back() < 0)) return Unit{value, end};
    }
    return std::nullopt;
  }

  std::optional<long double> sum(State& s) const {
    const bool is_negative = follows(s.at, "-");
    if (is_negative) ++s.at;
    auto total = product(s);
    if (!total) return std::nullopt;
    if (is_negative) *total = -*total;
    for (;;) {
      State next = s;
      const bool minus = follows(next.at, " - ") || follows(next.at, " − ");
      if (!minus && !follows(next.at, " + ")) return total;
      next.at += follows(next.at, " − ") ? std::string_view(" − ").size() : 3;
      const auto term = product(next);
      if (!term) return total;
      *total += minus ? -*term : *term;
      s = next;
    }
  }
  std::optional<long double> product(State& s) const {
    auto total = factor(s);
    if (!total) return std::nullopt;
    for (;;) {
      State next = s;
      const bool over = follows(next.at, "/") || follows(next.at, " / ");
      if (follows(next.at, " / "))
        next.at += 3;
      else if (over)
        ++next.at;
      else if (follows(next.at, " times "))
        next.at += 7;
      else if (follows(next.at, " "))
        ++next.at;
      const auto by = factor(next);
      if (!by) return total;
      *total = over ? *total / *by : *total * *by;
      s = next;
    }
  }
  std::optional<long double> factor(State& s) const {
    auto value = atom(s);
    if (!value) return std::nullopt;
    ++s.factors;
    if (follows(s.at, "²")) *value *= *value, s.at += std::string_view("²").size(), s.is_distinct = true;
    return value;
  }
  std::optional<long double> atom(State& s) const {
    const auto inside = [&](std::string_view open, char close) -> std::optional<long double> {
      State next = s;
      next.at += open.size();
      const auto value = sum(next);
      if (!value || next.at >= text_.size() || text_[next.at] != close) return std::nullopt;
      ++next.at;
      next.is_distinct = next.is_distinct || next.is_symbol;
      s = next;
      return value;
    };
    using Function = long double (*)(long double);
    const std::pair<std::string_view, Function> functions[] = {
        {"sqrt(", std::sqrt}, {"asin(", std::asin}, {"sin(", std::sin}, {"cos(", std::cos}};
    for (const auto& [name, function] : functions)
      if (follows(s.at, name)) {
        const auto value = inside(name, ')');
        if (!value) return std::nullopt;
        s.is_distinct = true;
        return function(*value);
      }
    if (follows(s.at, "(")) return inside("(", ')');
    if (follows(s.at, "|")) {
      const auto value = inside("|", '|');
      return value ? std::optional(std::abs(*value)) : std::nullopt;
    }
    for (auto symbol = symbols_.rbegin(); symbol != symbols_.rend(); ++symbol) {  // the longer of two names comes later
      const auto& [name, value] = *symbol;
      const std::size_t end = s.at + name.size();
      if (!follows(s.at, name) || (end < text_.size() && is_letter(text_[end]))) continue;
      s.at = end, s.is_symbol = true;
      s.has_name = s.has_name || name.size() > 1;
      return value;
    }
    const std::size_t digits = std::min(text_.find_first_not_of("0123456789.", s.at), text_.size());
    if (digits == s.at || text_[s.at] == '.') return std::nullopt;
    const long double value = std::strtold(text_.substr(s.at, digits - s.at).c_str(), nullptr);
    s.at = digits;
    if (!follows(s.at, "°")) return value;
    s.at += std::string_view("°").size();
    return value * kPi / 180;
  }

  const std::string& text_;
  const Symbols& symbols_;
};

/// What a text claims, and how much of it is true.
struct Claims {
  std::map<std::string, int> formulas;  // each formula with a number beside it, and how often it was found
  std::vector<std::string> wrong;       // formulas that do not give their number
  std::string unread;                   // the rest of the text
};

Claims claims_of(const std::string& text, const Symbols& symbols) {
  constexpr long double kRounding = 1e-13L;  // of numbers that doubles have computed
  Claims claims;
  const Reader reader(text, symbols);
  for (std::size_t at = 0; at < text.size();) {
    const bool begins = at == 0 || std::string_view(" (\n").find(text[at - 1]) != std::string_view::npos;
    const auto first = begins ? reader.side(at) : std::nullopt;
    if (!first) {
      claims.unread += text[at++];
      continue;
    }
    std::vector<Side> sides{*first};
    std::vector<std::size_t> begin{at};
    while (reader.follows(sides.back().end, " = ")) {
      const auto next = reader.side(sides.back().end + 3);
      if (!next) break;
      begin.push_back(sides.back().end + 3), sides.push_back(*next);
    }
    if (sides.size() == 1 && (first->is_formula || first->is_symbol))
      for (const std::string_view link : {", which is ", ", "})
        if (reader.follows(first->end, link))
          if (const auto number = reader.number_with_unit(first->end + link.size())) {
            begin.push_back(first->end + link.size()), sides.push_back(*number);
            break;
          }
    if (sides.size() == 1) {
      if (first->is_formula || first->is_symbol) claims.unread += text.substr(at, first->end - at);
      at = first->end;
      continue;
    }
    const std::size_t end = sides.back().end;
    // The time of an event is called t, too.
    const bool is_time = first->is_symbol && text.compare(at, 4, "t = ") == 0;
    for (std::size_t i = 0; i < sides.size() && !is_time; ++i) {
      const Side& one = sides[i];
      if (one.is_formula || one.is_symbol) ++claims.formulas[text.substr(begin[i], one.end - begin[i])];
      for (std::size_t j = 0; j < i; ++j) {
        const Side& other = sides[j];
        const long double size = std::max(std::abs(one.value), std::abs(other.value));
        if (!(std::abs(one.value - other.value) <= one.error + other.error + kRounding * size))
          claims.wrong.push_back(fmt::format("{} : {:.12g} and {:.12g}", text.substr(at, end - at),
                                             static_cast<double>(other.value), static_cast<double>(one.value)));
      }
    }
    at = end;
  }
  return claims;
}

/// What a text without a formula has none of.
bool has_formula(const std::string& unread) {
  for (const char* sign : {"=", "sqrt", "sin(", "cos(", "Ω", "ω", "π", "²", "^", "/(", " × ", " * "})
    if (unread.find(sign) != std::string::npos) return true;
  return false;
}

// --- The symbols of a scene --------------------------------------------------------------------------------------------

Symbols symbols_of(const RunResult& result, double t_s) {
  const Scenario& s = result.scene.scenario();
  const Body<double>& body = result.scene.body<double>();
  const long double degree = kPi / 180, Omega = s.rotation_rate_rad_s, phi = s.site.latitude_deg * degree;
  const Vec3<double> pole = celestial_axis_L<double>(s.site);
  const long double tilt = s.release.tilt_deg * degree, azimuth = s.release.azimuth_deg * degree;
  const long double n[3] = {std::sin(tilt) * std::sin(azimuth), std::sin(tilt) * std::cos(azimuth), std::cos(tilt)};
  const long double c[3] = {pole[0], s.site.follows_ellipsoid() ? std::cos(phi) : pole[1],
                            s.site.follows_ellipsoid() ? std::sin(phi) : pole[2]};
  const long double along = n[0] * c[0] + n[1] * c[1] + n[2] * c[2];
  const long double across = std::hypot(n[1] * c[2] - n[2] * c[1], n[2] * c[0] - n[0] * c[2], n[0] * c[1] - n[1] * c[0]);
  const long double spin = s.release.spin_rad_s, I3 = body.I_BP_B(2, 2);
  const long double mgl = static_cast<long double>(body.mass) * s.site.gravity_m_s2 * body.p_PBcm_B[2];
  return {{"Ω", Omega},
          {"Omega", Omega},
          {"Ω_up", Omega * c[2]},
          {"Omega_up", Omega * c[2]},
          {"Ω_north", Omega * (s.effects.applied.gimbal ? std::hypot(c[0], c[1]) : c[1])},
          {"Omega_north", Omega * c[1]},
          {"latitude", phi},
          {"π", kPi},
          {"α", std::atan2(across, along)},
          {"angle from the celestial axis", std::atan2(across, along)},
          {"t", t_s},
          {"I", I3},
          {"I1", body.I_BP_B(0, 0)},
          {"I2", body.I_BP_B(1, 1)},
          {"I3", I3},
          {"m", body.mass},
          {"g", s.site.gravity_m_s2},
          {"l", body.p_PBcm_B[2]},
          {"r", s.contact ? s.contact->tip_radius_m : 0},
          {"ω", spin},
          {"ω3", spin},
          {"w3", spin},
          {"its lean", std::abs(I3 * spin * Omega * c[1] / mgl)}};
}

// --- Scenes ------------------------------------------------------------------------------------------------------------

class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}
  double between(double a, double b) { return std::uniform_real_distribution(a, b)(random_); }
  double log_between(double a, double b) { return std::exp(between(std::log(a), std::log(b))); }
  double sign() { return between(-1, 1) < 0 ? -1 : 1; }
  bool one_in(int n) { return between(0, n) < 1; }

  /// A symmetric top at a site, let go at rest but for its spin. @param most_earth  times the Earth's rate
  Scenario top(double most_earth) {
    Scenario s;
    s.name = "drawn";
    s.site = {between(-80, 80), 0, 0, between(9.78, 9.83)};
    if (one_in(4)) s.site.deflection = {between(-30, 30), between(-30, 30)};
    if (one_in(8)) s.site.pole = {between(-0.5, 0.5), between(-0.5, 0.5)};
    s.rotation_rate_rad_s *= sign() * log_between(1, most_earth);
    const double mass = log_between(0.01, 2), radius = log_between(0.01, 0.1), length = radius * between(0.1, 2);
    s.body.mass_kg = mass;
    s.body.inertia_about = InertiaAbout::center_of_mass;
    const double across = mass * (3 * radius * radius + length * length) / 12, along = mass * radius * radius / 2;
    s.body.inertia_kg_m2 = {{{across, 0, 0}, {0, across, 0}, {0, 0, along}}};
    s.body.center_of_mass_m = {0, 0, radius * between(0.3, 1.5)};
    s.release.tilt_deg = between(2, 150);
    s.release.azimuth_deg = between(-180, 180);
    s.release.spin_angle_deg = between(0, 360);
    s.release.spin_rad_s = sign() * log_between(50, 1000);
    return s;
  }
  static void last(Scenario& s, double duration_s) { s.duration_s = duration_s, s.output_step_s = duration_s / 8; }

  Scenario compass() {
    Scenario s = top(5000);
    s.body.center_of_mass_m = {0, 0, 0};
    s.effects.applied.gimbal = GimbalSpec{};
    s.release.tilt_deg = 90;
    const double north = s.rotation_rate_rad_s * s.release.spin_rad_s > 0 ? 0 : 180;
    s.release.azimuth_deg = north + sign() * between(0.2, 28);
    const auto& I = s.body.inertia_kg_m2;
    const double rate = std::sqrt(std::abs(I[2][2] * s.release.spin_rad_s * s.rotation_rate_rad_s *
                                           std::cos(s.site.latitude_deg * std::numbers::pi / 180) / I[0][0]));
    last(s, between(5, 25) / rate);
    return s;
  }
  Scenario precessing() {
    Scenario s = top(one_in(3) ? 100 : 1);
    const double mgl = s.body.mass_kg * s.site.gravity_m_s2 * s.body.center_of_mass_m[2];
    const double I3 = s.body.inertia_kg_m2[2][2];
    const double I1 = s.body.inertia_kg_m2[0][0] + mgl * s.body.center_of_mass_m[2] / s.site.gravity_m_s2;
    s.release.spin_rad_s = sign() * between(1.1, 6) * 2 * std::sqrt(I1 * mgl) / I3;
    const double slow = mgl / (I3 * s.release.spin_rad_s);
    if (one_in(3)) s.release.precession = Precession::given, s.release.precession_rate_rad_s = slow * between(-3, 5);
    if (one_in(3)) s.release.rates_relative_to = RatesRelativeTo::inertial;
    last(s, between(1.2, 4) * 2 * std::numbers::pi / std::abs(slow));
    return s;
  }
  Scenario free_gyro() {
    Scenario s = top(1000);
    s.body.center_of_mass_m = {0, 0, 0};
    if (!one_in(3)) s.release.rates_relative_to = RatesRelativeTo::inertial;
    last(s, between(1, 20));
    return s;
  }
  Scenario sleeping() {
    Scenario s = precessing();
    s.release = {.tilt_deg = 0, .rates_relative_to = s.release.rates_relative_to, .spin_rad_s = s.release.spin_rad_s};
    s.duration_s *= 3;
    return s;
  }
  Scenario pendulum() {
    Scenario s = top(1);
    const double length = log_between(0.3, 3);
    s.body.center_of_mass_m = {0, 0, -length};
    s.release.tilt_deg = between(0.05, 1), s.release.spin_rad_s = 0;
    last(s, between(20, 60) * 2 * std::sqrt(length));
    return s;
  }
  /// A ball, or a sleeping top, that rolls on a table.
  Scenario rolling(bool ball) {
    Scenario s = top(1);
    s.release = {.spin_rad_s = sign() * between(150, 350)};
    s.site.deflection = {}, s.site.pole = {};
    const double radius = between(0.01, 0.04), moment = 0.4 * 0.2 * radius * radius;
    s.body.mass_kg = 0.2;
    s.body.center_of_mass_m = {0, 0, ball ? 0 : 0.025};
    s.body.inertia_kg_m2 = {{{moment, 0, 0}, {0, moment, 0}, {0, 0, moment}}};
    if (!ball)
      s.body.inertia_kg_m2 = {{{5e-5, 0, 0}, {0, 5e-5, 0}, {0, 0, 6e-5}}}, s.release.spin_rad_s = sign() * between(230, 400);
    s.contact.emplace().tip_radius_m = ball ? radius : between(0.001, 0.004);
    s.contact->law = ContactLaw::rolling;
    last(s, ball ? 8 : 40);
    return s;
  }
  /// What acts otherwise, or is not symmetric.
  Scenario other() {
    Scenario s = top(1);
    last(s, 1);
    s.release.spin_rad_s = sign() * between(20, 100);
    if (one_in(2)) s.effects.applied.viscous_N_m_s = log_between(1e-8, 1e-5);
    if (one_in(4)) s.effects.applied.coulomb_N_m = log_between(1e-6, 1e-4);
    if (one_in(3)) s.body.inertia_kg_m2[1][1] *= 1.1;
    if (one_in(6)) s.effects.coriolis = false;
    if (one_in(6)) s.platform.emplace().rate_rad_s = 0.1;
    if (one_in(3)) s.body.center_of_mass_m = {0, 0, 0};
    if (one_in(6)) s.rotation_rate_rad_s = 0;
    return s;
  }

 private:
  std::mt19937 random_;
};

struct Drawn {
  std::string kind;
  Scenario scenario;
};
std::vector<Drawn> drawn_scenes() {
  Draw draw(20261126);
  std::vector<Drawn> scenes;
  const auto add = [&](int count, const char* kind, const auto& make) {
    for (int i = 0; i < count; ++i) scenes.push_back({fmt::format("{} {}", kind, i), make()});
  };
  add(45, "compass", [&] { return draw.compass(); });
  add(45, "precessing", [&] { return draw.precessing(); });
  add(25, "free gyroscope", [&] { return draw.free_gyro(); });
  add(15, "sleeping", [&] { return draw.sleeping(); });
  add(20, "pendulum", [&] { return draw.pendulum(); });
  add(12, "ball", [&] { return draw.rolling(true); });
  add(12, "walker", [&] { return draw.rolling(false); });
  add(26, "other", [&] { return draw.other(); });
  return scenes;
}

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
  return tool::summary_text(result, "out", false, {kWide, false});
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
      // Of the precession, only the Earth's own part is a formula.
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
    rough.error *= 10;  // of two digits
    EXPECT_TRUE(is_number(rough, farthest, 1e-3)) << farthest << text;
    EXPECT_TRUE(is_number(*said, torque, kInterpolated)) << text;
  }
  EXPECT_GE(told, 40);
  const std::string text = printed(run(finely(turntable, 8)));
  EXPECT_NE(text.find("sqrt(I1/(I3 ω3 Ω cos(latitude))) = 0.86415 s; these swings have the period 0.87072 s"),
            std::string::npos)
      << text;
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
    constexpr double kRounded = 1e-8;  // of numbers of eight digits, of which the last may be zeros
    EXPECT_TRUE(is_number(*number_after(text, "\n    a = ", at), form.of_logarithm ? std::exp(a) : a, kRounded))
        << form.formula;
    EXPECT_TRUE(is_number(*number_after(text, "\n    b = ", at), b, kRounded)) << form.formula;
    EXPECT_TRUE(is_number(*number_after(text, "\n    residual ", at), std::sqrt(squares / n), 1e-6)) << form.formula;
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
  const char* const held[] = {"Ω",
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
                              "Ω = {} rad/s; in {} it turns by {} = {:.5g} rad = {}"};
  const char* const without_number[] = {"the Earth's rate times sin(latitude)",
                                        "the Earth's rate times cos(latitude)",   // names of what is estimated
                                        "with (I3 w3)^2 of at least 2 m g l I1",  // a condition
                                        "harmonic: a in a sin(2 pi f t + phase)",
                                        "y = a + b sin(x) or a + b cos(x), x in degrees",
                                        "2 pi/60 rad/s each",
                                        "between the two attitudes, 0 to pi",
                                        "GM/r^3",
                                        "ratio I3/I1 of the moments",
                                        "standard error of I3/I1"};  // what a key, a column or an input is
  const std::regex unit(
      "(kg|N|m|s|rad|1)([ /](kg|m|s|rad))*[ /]?((kg|m|s) ?)*(\\^[23]|²|³)([ /](s|m|rad|kg)(\\^[23]|²)?)*(/s)?");
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
