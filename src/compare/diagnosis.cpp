// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/diagnosis.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <tuple>

#include "compare/evidence.hpp"
#include "compare/mistakes.hpp"
#include "compare/reading.hpp"
#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/elementary.hpp"
#include "earthtop/error.hpp"
#include "earthtop/frames/earth.hpp"
#include "scene/motion_alone.hpp"
#include "text/json.hpp"
#include "text/number_words.hpp"

namespace earthtop::compare {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using Tops = std::vector<SeenTop>;

constexpr double kPartOfEffect = 1e-3;  // differences below this part of the Earth's effect are those of another program
constexpr double kLeast_rad = 1e-8, kWithoutEarth_rad = 1e-6;
constexpr double kLeastOfRate = 1e-8, kWithoutEarthOfRate = 1e-6;  // of the largest rate
constexpr double kExplains = 0.1;                                  // a mistake leaves at most this part of such a difference,
constexpr double kExplainsMost = 1e-3;                             // or this part of what there was
constexpr double kSurely = 1e-3;          // a mistake that leaves no more needs no comparison with others
constexpr double kAlike = 3;              // what is left by two mistakes that the file does not tell apart differs by less
constexpr double kNearRelease = 1e-3;     // rad: attitudes at the release that were meant to be one
constexpr double kLeastRounding = 1e-12;  // rad, or of the rates: smaller differences are those of any computation
constexpr double kDegree = std::numbers::pi / 180;

/// The largest differences of two motions.
using Apart = ByMeasure;

struct Explanation {
  Reading reading;
  Apart left;
  double ratio = HUGE_VAL;  ///< what is left, in parts of what another program may differ by
};

class Diagnosis {
 public:
  Diagnosis(const Evidence& evidence, const Mapping& mapping, const ByMeasure& tolerance, const std::optional<Scene>& scene,
            const Watch& watch)
      : evidence_(evidence),
        tolerance_(tolerance),
        scene_(scene),
        watch_(watch),
        reader_(evidence, mapping, scene ? rate_IL_L(*scene) : Vector3d(Vector3d::Zero())),
        rate_unit_(mapping.rate_unit_rad_s) {}

  Explanation as_mapped() const { return explained(reader_.mapped(), evidence_.reference); }
  /// What explains the differences, in sentences. @param now  the differences
  std::vector<std::string> sentences(const Explanation& now);

 private:
  static Vector3d rate_IL_L(const Scene& scene) { return scene.rotation_rate_rad_s() * celestial_axis_L<double>(scene.site()); }

  Apart apart(const Reading& reading, const Tops& expected, std::size_t end) const;
  double ratio(const Apart& apart) const;
  Explanation explained(const Reading& reading, const Tops& expected) const;
  Explanation best_reading(const Reading& reading, const Tops& expected) const;
  std::vector<Reading> likely_readings() const;
  double rate_factor(const Reading& reading) const;

  /// Whether what is left is as little as another program may differ by, and much less than there was.
  bool explains(const Explanation& one, double part_of_now) const {
    return one.ratio <= kExplains || (one.ratio <= 1 && one.ratio <= part_of_now * now_.ratio);
  }
  std::optional<Tops> predicted(const Scenario& scenario) const;
  double predicted_until_s() const;
  bool predicts_reference() const;
  std::vector<std::string> physical(const std::vector<Reading>& readings);
  /// What a mistake that is known by name explains, and what it leaves.
  struct Named {
    std::vector<std::string> sentences;
    double ratio = HUGE_VAL;
  };
  Named mistaken(const Scenario& base, const Reading& reading, const std::string& before);
  std::vector<std::string> fitted(const Scenario& base, const Reading& reading, const std::string& before);
  struct Fit {
    double value = 0, sure = 0;  ///< and the change of it that would be seen
    Explanation explanation;
  };
  std::optional<Fit> fit(const Scenario& base, const Suspect& suspect, double from, const Reading& reading);
  Eigen::VectorXd residuals(const Tops& read, const Tops& expected, std::size_t end) const;
  /// A scenario that is released as the file's first row says.
  struct Release {
    Scenario scenario;
    std::string words;  ///< what differs there
    int differences = 0;
    Reading reading;
  };
  std::optional<Release> as_released(const Reading& reading) const;

  std::string left_words(const Apart& left) const;
  std::string if_words(const Reading& reading, std::string_view before) const;

  const Evidence& evidence_;
  ByMeasure tolerance_;
  const std::optional<Scene>& scene_;
  const Watch& watch_;
  Reader reader_;
  double rate_unit_;
  Explanation now_;
};

double angle_of(const Vector3d& a, const Vector3d& b) { return real::atan2(a.cross(b).norm(), a.dot(b)); }

/// The differences over the samples up to one; with shifted rows over those in a row.
Apart Diagnosis::apart(const Reading& reading, const Tops& expected, std::size_t end) const {
  Apart largest;
  end = std::min({end, expected.size(), evidence_.size()});
  if (reading.later != 0) end = std::min(end, evidence_.in_a_row);
  for (std::size_t i = reading.later < 0 ? 1 : 0; i < end; ++i) {
    const std::size_t there = i + static_cast<std::size_t>(reading.later);
    if (there >= end) continue;
    const SeenTop top = reader_.read(i, reading);
    const SeenTop& other = expected[there];
    if (evidence_.attitude) largest.attitude = std::max(largest.attitude, top.q.angularDistance(other.q));
    if (evidence_.axis) largest.axis = std::max(largest.axis, angle_of(top.axis, other.axis));
    if (evidence_.rates) largest.rates = std::max(largest.rates, (top.rates - other.rates).norm());
  }
  return largest;
}

double Diagnosis::ratio(const Apart& apart) const {
  return std::max({apart.attitude / tolerance_.attitude, apart.axis / tolerance_.axis, apart.rates / tolerance_.rates});
}

Explanation Diagnosis::explained(const Reading& reading, const Tops& expected) const {
  const Apart left = apart(reading, expected, evidence_.size());
  return {reading, left, ratio(left)};
}

/// Tries further meanings of attitudes and rates: relative to space, along other axes, in another unit.
Explanation Diagnosis::best_reading(const Reading& reading, const Tops& expected) const {
  Explanation best = explained(reading, expected);
  const auto try_one = [&](const Reading& other) {
    const Explanation one = explained(other, expected);
    if (one.ratio * kAlike < best.ratio) best = one;
  };
  for (const bool inertial_attitude : {false, true})
    for (const bool world_rates : {reader_.mapped().world_rates, !reader_.mapped().world_rates})
      for (const bool inertial_rates : {false, true}) {
        if ((inertial_attitude && !evidence_.attitude && !evidence_.axis) || (inertial_rates && !evidence_.rates) ||
            (world_rates != reader_.mapped().world_rates && !(evidence_.rates && evidence_.attitude)))
          continue;
        Reading other = reading;
        other.inertial_attitude = inertial_attitude, other.world_rates = world_rates, other.inertial_rates = inertial_rates;
        other.rate_factor = rate_factor(other);
        try_one(other);
      }
  return best;
}

/// How many times the file's rates are those of the reference, where that is the ratio of two units or an opposite sign; else 1.
double Diagnosis::rate_factor(const Reading& reading) const {
  if (!evidence_.rates) return 1;
  const std::size_t count = std::min<std::size_t>(evidence_.in_a_row, 20);
  double products = 0, squares = 0;
  for (std::size_t i = 0; i < count; ++i) {
    products += reader_.read(i, reading).rates.dot(evidence_.reference[i].rates);
    squares += evidence_.reference[i].rates.squaredNorm();
  }
  const double factor = squares > 0 ? products / squares : 1;
  constexpr double kOpposite = 1e-3;
  if (std::abs(factor + 1) < kOpposite) return -1;
  const auto unit = rate_unit_for(rate_unit_, factor);
  return unit && unit->value != rate_unit_ ? rate_unit_ / unit->value : 1;
}

/// The ways to read the file in which its first row is that of the reference, the one that its next rows agree with first.
std::vector<Reading> Diagnosis::likely_readings() const {
  struct Likely {
    double apart;
    std::size_t changes;
    Reading reading;
  };
  std::vector<Likely> likely;
  constexpr std::size_t kFirst = 20, kMost = 4;
  const auto distance = [&](const Reading& reading, std::size_t i) {
    const SeenTop top = reader_.read(i, reading);
    const SeenTop& there = evidence_.reference[i + static_cast<std::size_t>(reading.later)];
    return evidence_.attitude ? top.q.angularDistance(there.q) : angle_of(top.axis, there.axis);
  };
  const auto look_at = [&](const Reading& reading) {
    const std::size_t begin = reading.later < 0 ? 1 : 0;
    const std::size_t end = std::min(evidence_.in_a_row, kFirst) - (reading.later > 0 ? 1 : 0);
    if (begin >= end || distance(reading, begin) > kNearRelease) return;
    double sum = 0;
    for (std::size_t i = begin; i < end; ++i) sum += std::min(distance(reading, i), 1.0);
    const std::size_t changes = reader_.words(reading).size();
    if (changes > 0) likely.push_back({sum / static_cast<double>(end - begin), changes, reading});
  };
  for (const int later : {0, -1, 1}) {
    Reading reading = reader_.mapped();
    reading.later = later;
    for (const AxisTurn& world : all_turns()) {
      reading.world = world;
      if (!evidence_.attitude) {
        for (const bool reversed : {false, true}) reading.axis_reversed = reversed, look_at(reading);
        continue;
      }
      for (const AxisTurn& body : all_turns())
        for (const ScalarPart scalar : {ScalarPart::as_mapped, ScalarPart::last, ScalarPart::first})
          for (const bool world_to_body : {false, true}) {
            reading.body = body, reading.scalar = scalar, reading.world_to_body = world_to_body;
            look_at(reading);
          }
    }
  }
  std::stable_sort(likely.begin(), likely.end(), [](const Likely& a, const Likely& b) {
    constexpr double kSame = 1e-3;  // of readings that agree alike the simpler one
    return std::tuple(std::floor(a.apart / kSame), a.changes, a.apart) <
           std::tuple(std::floor(b.apart / kSame), b.changes, b.apart);
  });
  std::vector<Reading> readings;
  for (const Likely& one : likely)
    if (readings.size() < kMost) readings.push_back(one.reading);
  return readings;
}

std::string Diagnosis::left_words(const Apart& left) const {
  if (evidence_.attitude) return fmt::format("{:.2g} rad", left.attitude);
  if (evidence_.axis) return fmt::format("{:.2g} rad", left.axis);
  return fmt::format("{:.2g} rad/s", left.rates);
}

/// ", if its world axes are taken as ..."; empty for a file that is read as mapped.
std::string Diagnosis::if_words(const Reading& reading, std::string_view before) const {
  std::string text;
  for (const std::string& words : reader_.words(reading)) text += (text.empty() ? std::string(before) : " and ") + words;
  return text;
}

/// The motion of a scenario at the samples' times; none where it has none.
std::optional<Tops> Diagnosis::predicted(const Scenario& given) const try {
  const double until_s = predicted_until_s();
  std::vector<double> times_s = {0};
  std::vector<std::size_t> places;
  for (const double t_s : evidence_.t_s) {
    if (t_s > until_s) break;
    if (t_s > times_s.back()) times_s.push_back(t_s);
    places.push_back(times_s.size() - 1);
  }
  Scenario scenario = given;
  ask_for_motion_alone(scenario, times_s.back());
  const Scene scene(std::move(scenario));
  scene.require_integrable();
  scene.require_affordable();
  DriftProblem<double> problem = scene.problem<double>();
  problem.times_s = times_s;
  const auto motion = integrate_drift(problem, scene.choice().options, watch_);
  if (watch_.asks_to_stop()) throw Interrupted();
  Tops tops;
  for (const std::size_t place : places) {
    if (place >= motion.samples.size()) break;
    const auto& state = motion.samples[place].state;
    SeenTop& top = tops.emplace_back();
    top.q = Quaterniond(state.q_LB.w, state.q_LB.v[0], state.q_LB.v[1], state.q_LB.v[2]);
    top.axis = top.q * Vector3d::UnitZ();
    top.rates = state.w_LB_B;
  }
  return tops.empty() ? std::nullopt : std::optional(std::move(tops));
} catch (const ScenarioError&) {
  return std::nullopt;
}

/// The time until which motions are predicted: later rows of a long one are not (s).
double Diagnosis::predicted_until_s() const {
  constexpr double kLongest_rad = 1e5;
  return kLongest_rad / std::max(scene_->fastest_rate_rad_s(), 1e-300);
}

/// Whether the scene's own motion is that of the reference, so that others can be told from it, and is found in a moment.
bool Diagnosis::predicts_reference() const {
  constexpr double kLongest_s = 0.5;
  if (!scene_) return false;
  const double duration_s = scene_->scenario().duration_s;
  if (scene_->costs()[0].seconds * std::min(1.0, predicted_until_s() / duration_s) > kLongest_s) return false;
  const auto tops = predicted(resolved_scenario(*scene_));
  if (!tops) return false;
  Apart apart;
  for (std::size_t i = 0; i < tops->size(); ++i) {
    const SeenTop &a = (*tops)[i], &b = evidence_.reference[i];
    if (evidence_.attitude) apart.attitude = std::max(apart.attitude, a.q.angularDistance(b.q));
    if (evidence_.axis) apart.axis = std::max(apart.axis, angle_of(a.axis, b.axis));
    if (evidence_.rates) apart.rates = std::max(apart.rates, (a.rates - b.rates).norm());
  }
  return ratio(apart) <= kExplains;
}

template <class Found>
const Found& best_of(const std::vector<Found>& found) {
  return *std::min_element(found.begin(), found.end(),
                           [](const Found& a, const Found& b) { return a.explanation.ratio < b.explanation.ratio; });
}

/// Names the mistake with which the motion of `base` is that of the file, read this way. @param before  what was found before
Diagnosis::Named Diagnosis::mistaken(const Scenario& base, const Reading& reading, const std::string& before) {
  struct Found {
    std::string_view words;
    Explanation explanation;
  };
  std::vector<Found> found;
  for (const Mistake& mistake : mistakes())
    if (const auto scenario = mistake.of(Scene(base)))
      if (const auto tops = predicted(*scenario)) {
        const Explanation one = best_reading(reading, *tops);
        if (explains(one, 1 / kAlike)) found.push_back({mistake.words, one});
      }
  if (found.empty()) return {};
  const Explanation best = best_of(found).explanation;
  std::string words;
  std::size_t alike = 0;
  for (const Found& one : found)
    if (one.explanation.ratio <= kAlike * best.ratio) words += (alike++ > 0 ? ", or " : "") + std::string(one.words);
  return {{fmt::format("{}the new result is, to {}, the motion {}{}{}", before, left_words(best.left), words,
                       if_words(best.reading, ", if "), alike > 1 ? ": the file does not tell them apart" : "")},
          best.ratio};
}

/// The differences over some samples, each in parts of what another program may differ by.
Eigen::VectorXd Diagnosis::residuals(const Tops& read, const Tops& expected, std::size_t end) const {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(9 * end));
  for (std::size_t i = 0; i < end; ++i) {
    auto part = all.segment<9>(static_cast<Eigen::Index>(9 * i));
    if (evidence_.attitude) {
      Quaterniond turn = expected[i].q.conjugate() * read[i].q;
      if (turn.w() < 0) turn.coeffs() = -turn.coeffs();
      part.head<3>() = 2 * turn.vec() / tolerance_.attitude;
    }
    if (evidence_.axis) part.segment<3>(3) = (read[i].axis - expected[i].axis) / tolerance_.axis;
    if (evidence_.rates) part.tail<3>() = (read[i].rates - expected[i].rates) / tolerance_.rates;
  }
  return all;
}

double size_of(const Suspect& suspect, double value) {
  if (suspect.size > 0) return suspect.size;
  return value != 0 ? std::abs(value) : 1;
}

/// Fits a number of the scenario to the file, first to its first rows and then to ever more.
std::optional<Diagnosis::Fit> Diagnosis::fit(const Scenario& base, const Suspect& suspect, double from,
                                             const Reading& reading) {
  constexpr int kMostSteps = 16;
  constexpr double kFar_rad = 0.5, kEqual = 0.5, kDifference = 1e-6, kSmallStep = 1e-10;
  const double size = size_of(suspect, from);
  const auto at = [&](double value) {
    Scenario scenario = base;
    suspect.put(scenario, value);
    return predicted(scenario);
  };
  Fit fit;
  fit.value = from;
  for (int step = 0; step < kMostSteps; ++step) {
    const auto here = at(fit.value), beside = at(fit.value + kDifference * size);
    if (!here || !beside) return std::nullopt;
    fit.explanation = best_reading(reading, *here);
    Tops read;
    for (std::size_t i = 0; i < std::min(here->size(), beside->size()); ++i) {
      read.push_back(reader_.read(i, fit.explanation.reading));
      const double far = evidence_.attitude ? read[i].q.angularDistance((*here)[i].q) : angle_of(read[i].axis, (*here)[i].axis);
      if (far > kFar_rad && i > 1) break;
    }
    const Eigen::VectorXd rest = residuals(read, *here, read.size());
    const Eigen::VectorXd slope = (residuals(read, *beside, read.size()) - rest) / (kDifference * size);
    if (!(slope.squaredNorm() > 0)) return std::nullopt;
    const double change = -slope.dot(rest) / slope.squaredNorm();
    if (!std::isfinite(change) || std::abs(change) > 10 * size) return std::nullopt;
    fit.sure = kEqual / slope.cwiseAbs().maxCoeff();
    if (std::abs(change) < std::max(kSmallStep * size, 1e-3 * fit.sure)) break;
    fit.value += change;
  }
  const auto tops = at(fit.value);
  if (!tops) return std::nullopt;
  fit.explanation = best_reading(reading, *tops);
  return fit;
}

/// A number with the fewest digits that are the same within an error.
std::string fewest_digits(double value, double error) {
  constexpr int kMost = 9;
  for (int digits = 1; digits < kMost; ++digits) {
    std::string text = fmt::format("{:.{}g}", value, digits);
    if (std::abs(std::stod(text) - value) <= error) return text;
  }
  return fmt::format("{:.{}g}", value, kMost);
}

std::vector<std::string> Diagnosis::fitted(const Scenario& base, const Reading& reading, const std::string& before) {
  constexpr double kLeastChange = 3e-6;  // phases of an inaccurate program are off by less
  struct Found {
    std::string text;
    Explanation explanation;
  };
  std::vector<Found> found;
  const Scene scene(base);
  for (const Suspect& suspect : suspects()) {
    const auto from = suspect.value(scene);
    if (!from) continue;
    const auto fit = this->fit(base, suspect, *from, reading);
    if (!fit || !explains(fit->explanation, kExplainsMost)) continue;
    if (std::abs(fit->value - *from) < kLeastChange * size_of(suspect, *from)) continue;
    found.push_back(
        {fmt::format("{} {} instead of {:.8g} {}", suspect.name, fewest_digits(fit->value, fit->sure), *from, suspect.unit),
         fit->explanation});
  }
  if (found.empty()) return {};
  const Explanation best = best_of(found).explanation;
  std::string words;
  for (const Found& one : found)
    if (one.explanation.ratio <= kAlike * best.ratio) words += (words.empty() ? "" : ", or ") + one.text;
  return {fmt::format("{}{} explains all but {}{}", before, words, left_words(best.left), if_words(best.reading, ", if "))};
}

double tilt_deg(const Vector3d& n) { return real::atan2(real::hypot(n.x(), n.y()), n.z()) / kDegree; }
double azimuth_deg(const Vector3d& n) { return real::atan2(n.x(), n.y()) / kDegree; }

/// The scenario released as the file's first row says, and what differs there in words; none where it is the reference's.
std::optional<Diagnosis::Release> Diagnosis::as_released(const Reading& reading) const {
  constexpr double kSame_rad = 1e-7, kSameOfRate = 1e-7;
  const bool has_release = evidence_.size() > 0 && evidence_.t_s.front() == 0 && reading.later == 0;
  if (!has_release || !(evidence_.attitude || evidence_.axis) || scene_->scenario().release.gimbals) return std::nullopt;
  const SeenTop top = reader_.read(0, reading);
  const SeenTop& reference = evidence_.reference.front();
  const Vector3d now = evidence_.attitude ? Vector3d(top.q * Vector3d::UnitZ()) : top.axis,
                 then = evidence_.attitude ? Vector3d(reference.q * Vector3d::UnitZ()) : reference.axis;
  const double same_rad = kSame_rad + 2 * (evidence_.rounding.attitude + evidence_.rounding.axis);
  const double same_rad_s = kSameOfRate * reference.rates.norm() + 2 * evidence_.rounding.rates;
  Scenario scenario = resolved_scenario(*scene_);
  ReleaseSpec& release = scenario.release;
  std::string text;
  int differences = 0;
  const auto tell = [&](std::string_view name, double value, double before, std::string_view unit) {
    ++differences;
    text += fmt::format("{}{} {:.8g} instead of {:.8g} {}", text.empty() ? "" : ", ", name, value, before, unit);
  };
  const bool turned = evidence_.attitude ? top.q.angularDistance(reference.q) > same_rad : angle_of(now, then) > same_rad;
  if (turned) {
    const double tilt = tilt_deg(now), azimuth = azimuth_deg(now);
    const double least_deg = same_rad / kDegree;
    if (std::abs(tilt - tilt_deg(then)) > least_deg) tell("tilt", tilt, tilt_deg(then), "degrees");
    if (std::abs(std::remainder(azimuth - azimuth_deg(then), 360)) * real::sin(tilt * kDegree) > least_deg)
      tell("azimuth", azimuth, azimuth_deg(then), "degrees");
    if (std::abs(std::remainder(azimuth + azimuth_deg(then) - 90, 360)) * real::sin(tilt * kDegree) <= least_deg)
      text += ", as if it were counted from East";
    if (text.empty()) {
      const Quaterniond turn = reference.q.conjugate() * top.q;
      tell("spin angle", 2 * real::atan2(turn.z(), turn.w()) / kDegree + release.spin_angle_deg, release.spin_angle_deg,
           "degrees");
    }
    if (evidence_.attitude)
      release.quaternion_LB = {top.q.w(), top.q.x(), top.q.y(), top.q.z()};
    else if (!release.quaternion_LB)
      release.tilt_deg = tilt, release.azimuth_deg = azimuth;
  }
  if (evidence_.rates && (top.rates - reference.rates).norm() > same_rad_s) {
    const Vector3d earth_B = top.q.conjugate() * rate_IL_L(*scene_);
    constexpr double kSameRate = 1e-3;
    const auto across = [](const Vector3d& w) { return real::hypot(w.x(), w.y()); };
    if (evidence_.attitude && (top.rates - reference.rates + earth_B).norm() <= kSameRate * earth_B.norm()) {
      text += std::string(text.empty() ? "" : ", ") +
              "its rates by the Earth's rate, as if rates relative to the laboratory were taken as inertial";
      ++differences;
    } else {
      if (std::abs(top.rates.z() - reference.rates.z()) > same_rad_s) tell("spin", top.rates.z(), reference.rates.z(), "rad/s");
      if ((top.rates - reference.rates).head<2>().norm() > same_rad_s)
        tell("rate across the spin axis", across(top.rates), across(reference.rates), "rad/s");
    }
    release.angular_velocity_body_rad_s = {top.rates.x(), top.rates.y(), top.rates.z()};
    release.rates_relative_to = RatesRelativeTo::laboratory;
    release.precession = Precession::none;
  } else if (turned && evidence_.attitude && release.precession != Precession::none) {
    release.angular_velocity_body_rad_s = {reference.rates.x(), reference.rates.y(), reference.rates.z()};
    release.rates_relative_to = RatesRelativeTo::laboratory;
    release.precession = Precession::none;
  }
  if (text.empty()) return std::nullopt;
  return Release{std::move(scenario), "it differs at the release already: " + text, differences, reading};
}

/// Looks for a mistake in physics of a file that may be read in one of these ways: first for one that is known by name, then for another
/// release, then for another number.
std::vector<std::string> Diagnosis::physical(const std::vector<Reading>& readings) {
  const Scenario base = resolved_scenario(*scene_);
  for (const Reading& reading : readings)
    if (Named found = mistaken(base, reading, ""); !found.sentences.empty()) return found.sentences;
  std::vector<Release> releases;
  for (Reading reading : readings)
    for (const bool inertial_rates : {false, true}) {
      if (inertial_rates && !evidence_.rates) continue;
      reading.inertial_rates = inertial_rates;
      if (auto release = as_released(reading)) releases.push_back(std::move(*release));
    }
  std::stable_sort(releases.begin(), releases.end(),
                   [](const Release& a, const Release& b) { return a.differences < b.differences; });
  for (const Release& release : releases)
    if (const auto tops = predicted(release.scenario))
      if (const Explanation one = best_reading(release.reading, *tops); explains(one, kExplainsMost))
        return {fmt::format("{}; the motion from there agrees to {}{}", release.words, left_words(one.left),
                            if_words(one.reading, ", if "))};
  for (const Release& release : releases)
    if (Named found = mistaken(release.scenario, release.reading, release.words + "; from there "); !found.sentences.empty())
      return found.sentences;
  constexpr std::size_t kMostFitted = 2;  // fits take the longest
  for (std::size_t i = 0; i < std::min(readings.size(), kMostFitted); ++i)
    if (auto found = fitted(base, readings[i], ""); !found.empty()) return found;
  for (std::size_t i = 0; i < std::min(releases.size(), kMostFitted); ++i)
    if (auto found = fitted(releases[i].scenario, releases[i].reading, releases[i].words + "; besides, "); !found.empty())
      return found;
  return {};
}

std::vector<std::string> Diagnosis::sentences(const Explanation& now) {
  now_ = now;
  const auto by_reading = [&](const Explanation& one) {
    return fmt::format("the new result agrees to {} if {}", left_words(one.left), if_words(one.reading, ""));
  };
  Explanation best = best_reading(reader_.mapped(), evidence_.reference);
  const std::vector<Reading> likely = likely_readings();
  for (const Reading& reading : likely) {
    const Explanation one = best_reading(reading, evidence_.reference);
    if (one.ratio * kAlike < best.ratio) best = one;
  }
  // Several other conventions at once may look like a mistake in physics, and are less likely.
  const std::size_t changes = reader_.words(best.reading).size();
  const bool is_read = best.ratio <= 1, is_simple = is_read && changes == 1;
  if (is_simple && best.ratio <= kSurely) return {by_reading(best)};
  const bool has_physics = predicts_reference();
  if (has_physics) {
    const Named named = mistaken(resolved_scenario(*scene_), reader_.mapped(), "");
    if (!named.sentences.empty() && (!is_simple || named.ratio * kAlike < best.ratio)) return named.sentences;
  }
  if (is_read) return {by_reading(best)};
  std::vector<Reading> readings = {reader_.mapped()};
  for (const Reading& reading : likely)
    if (reading.later == 0) readings.push_back(reading);
  if (has_physics)
    if (auto found = physical(readings); !found.empty()) return found;
  const bool mostly = best.ratio <= kExplainsMost * now.ratio && best.reading != reader_.mapped();
  if (mostly) return {by_reading(best) + (has_physics ? "; no single mistake explains the rest" : "")};
  return has_physics ? std::vector<std::string>{"no single mistake explains this"} : std::vector<std::string>();
}

/// What another program may differ by, for each measure.
ByMeasure tolerance_of(const Evidence& evidence, const RowsComparison& rows) {
  const bool has_effect = evidence.effect.attitude > 0 || evidence.effect.axis > 0;
  const auto angle = [&](double effect) {
    return has_effect ? std::max(kPartOfEffect * effect, kLeast_rad) : kWithoutEarth_rad;
  };
  ByMeasure tolerance{angle(evidence.effect.attitude), angle(evidence.effect.axis),
                      has_effect ? std::max(kPartOfEffect * evidence.effect.rates, kLeastOfRate * evidence.largest_rate)
                                 : kWithoutEarthOfRate * evidence.largest_rate};
  for (const QuantityVerdict& quantity : rows.quantities)
    for (const auto& [name, one] :
         {std::pair("attitude_rad", &tolerance.attitude), {"axis_rad", &tolerance.axis}, {"rates_rad_s", &tolerance.rates}})
      if (quantity.name == name) *one = std::max(*one, 2 * quantity.interpolation_error.value_or(0));
  return tolerance;
}

/// The factor by which a file's times have to be multiplied, as its last time says, and a sentence on it.
std::pair<double, std::vector<std::string>> time_unit(double file_last_s, double reference_last_s, const Mapping& mapping) {
  constexpr double kOtherUnit = 1.5, kNear = 0.05;
  const double times = reference_last_s > 0 ? file_last_s / reference_last_s : 0;
  if (!(times > 0) || std::max(times, 1 / times) < kOtherUnit) return {1, {}};
  if (const auto unit = time_unit_for(mapping.time_unit_s, times))
    return {unit->value / mapping.time_unit_s,
            {fmt::format("its last time is {:.6g} times the reference's: its times are in {} (time.unit of the mapping)", times,
                         unit->word)}};
  for (const double ratio : {1e3, 60.0, 3600.0})
    if (std::abs(times / ratio - 1) < kNear || std::abs(times * ratio - 1) < kNear)
      return {1, {fmt::format("its last time is {:.6g} times the reference's: are its times in another unit?", times)}};
  return {1, {}};
}

std::optional<Scene> scene_of(const Comparand& reference) {
  if (!reference.has_summary() || !reference.summary->contains("scenario")) return std::nullopt;
  return examine_scenario({"", written(reference.summary->at("scenario")), false}).scene;
}

}  // namespace

std::vector<std::string> other_time_unit(const Comparand& reference, const Comparand& candidate, const Mapping& mapping,
                                         const CompareOptions& options) {
  const auto rows = reference.open_rows();
  const Watch watch = options.watch.part(0, 0);
  const Survey known = survey(*rows, trajectory_table(), false, watch);
  const Evidence evidence = gather(reference, candidate, known, mapping, 1, options.until_s, watch);
  return time_unit(evidence.last_s, known.last_s, mapping).second;
}

std::vector<std::string> diagnose(const Comparand& reference, const Comparand& candidate, const Mapping& mapping,
                                  const RowsComparison& rows, const CompareOptions& options) {
  const auto surveyed = reference.open_rows();
  const Watch watch = options.watch.part(0, 0);
  const Survey known = survey(*surveyed, trajectory_table(), false, watch);
  Evidence evidence = gather(reference, candidate, known, mapping, 1, options.until_s, watch);
  auto [factor, found] = time_unit(evidence.last_s, known.last_s, mapping);
  if (factor != 1) evidence = gather(reference, candidate, known, mapping, factor, options.until_s, watch);
  // The axis of a file that has attitudes alone follows from them.
  if (mapping.quaternion && !mapping.axis) evidence.axis = false;
  if (evidence.zeros > 0)
    found.push_back(fmt::format("{} of its {} quaternions are zero, the first one at t = {}: rows that were never filled?",
                                evidence.zeros, evidence.rows, time_text(evidence.first_zero_s)));
  if (evidence.size() == 0 || !(evidence.attitude || evidence.axis || evidence.rates)) return found;
  const double norm_error = std::max(std::abs(evidence.least_norm - 1), std::abs(evidence.largest_norm - 1));
  constexpr double kUnitNorm = 1e-7;
  if (evidence.attitude && norm_error > std::max(kUnitNorm, evidence.rounding.attitude))
    found.push_back(fmt::format("its quaternions have lengths from {:.6g} to {:.6g}, and not 1; normalise them",
                                evidence.least_norm, evidence.largest_norm));
  ByMeasure tolerance = tolerance_of(evidence, rows);
  const std::optional<Scene> scene = candidate.has_summary() ? std::nullopt : scene_of(reference);
  const Explanation now = Diagnosis(evidence, mapping, tolerance, scene, watch).as_mapped();
  const ByMeasure& rounding = evidence.rounding;
  const auto is_explained = [](double left, double by, double besides) { return left <= 2 * by + besides; };
  const bool is_rounded =
      is_explained(now.left.attitude, rounding.attitude, tolerance.attitude) &&
      is_explained(now.left.axis, rounding.axis, tolerance.axis) &&
      is_explained(now.left.rates, rounding.rates, tolerance.rates) &&
      ((now.left.attitude > kLeastRounding && is_explained(now.left.attitude, rounding.attitude, 0)) ||
       (now.left.axis > kLeastRounding && is_explained(now.left.axis, rounding.axis, 0)) ||
       (now.left.rates > kLeastRounding * evidence.largest_rate && is_explained(now.left.rates, rounding.rates, 0)));
  if (is_rounded) {
    found.push_back(
        fmt::format("its numbers have {} digits, and their rounding, up to {:.2g} rad, explains the differences; write 17",
                    evidence.digits, std::max(rounding.attitude, rounding.axis)));
    return found;
  }
  if (now.ratio <= 1) return found;
  const bool is_coarse = 2 * rounding.attitude > tolerance.attitude || 2 * rounding.axis > tolerance.axis;
  for (auto [one, other] : {std::pair(&tolerance.attitude, rounding.attitude),
                            {&tolerance.axis, rounding.axis},
                            {&tolerance.rates, rounding.rates}})
    *one = std::max(*one, 2 * other);
  Diagnosis diagnosis(evidence, mapping, tolerance, scene, watch);
  const Explanation rest = diagnosis.as_mapped();
  if (rest.ratio <= 1) return found;
  const std::vector<std::string> more = diagnosis.sentences(rest);
  found.insert(found.end(), more.begin(), more.end());
  if (is_coarse && !more.empty() && more.back().find("no single mistake") == std::string::npos)
    found.push_back(fmt::format("its numbers have {} digits, and what is left is their rounding; write 17", evidence.digits));
  return found;
}

}  // namespace earthtop::compare
