// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/physics_search.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/elementary.hpp"
#include "earthtop/error.hpp"
#include "earthtop/frames/earth.hpp"
#include "earthtop/results/results.hpp"
#include "scene/motion_alone.hpp"
#include "text/number_words.hpp"

namespace earthtop::compare {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kExplains = 0.1;     // a mistake leaves at most this part of what another program may differ by
constexpr double kMostly = 1.0 / 30;  // less than this part of what there was is little
constexpr double kDegree = std::numbers::pi / 180;

template <class Found>
const Found& best_of(const std::vector<Found>& found) {
  return *std::min_element(found.begin(), found.end(),
                           [](const Found& a, const Found& b) { return a.explanation.ratio < b.explanation.ratio; });
}

double size_of(const Suspect& suspect, double value) {
  if (suspect.size > 0) return suspect.size;
  return value != 0 ? std::abs(value) : 1;
}

double tilt_deg(const Vector3d& n) { return real::atan2(real::hypot(n.x(), n.y()), n.z()) / kDegree; }
double azimuth_deg(const Vector3d& n) { return real::atan2(n.x(), n.y()) / kDegree; }

}  // namespace

/// Whether what is left is as little as another program may differ by, and much less than there was.
bool PhysicsSearch::explains(const Explanation& one, double part_of_now) const {
  return one.ratio <= kExplains || (one.ratio <= 1 && one.ratio <= part_of_now * now_);
}

/// @param part_of_what_was  of the differences of the same reading with the reference
void PhysicsSearch::note_nearest(const Explanation& one, double part_of_what_was, const std::string& sentence) {
  // Many changes of the reading at once may mimic much.
  if (one.ratio >= nearest_.ratio || explainer_.reader().words(one.reading).size() > 1) return;
  const double before = explainer_.explained(one.reading, evidence_.reference).ratio;
  if (one.ratio <= part_of_what_was * before) nearest_ = {{sentence}, one.ratio};
}

/// The motion of a scenario at the samples' times; none where it has none.
std::optional<Tops> PhysicsSearch::predicted(const Scenario& given) const try {
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
double PhysicsSearch::predicted_until_s() const {
  constexpr double kLongest_rad = 1e5;
  return kLongest_rad / std::max(scene_.fastest_rate_rad_s(), 1e-300);
}

bool PhysicsSearch::predicts_reference() const {
  constexpr double kLongest_s = 0.5;
  const double duration_s = scene_.scenario().duration_s;
  if (scene_.costs()[0].seconds * std::min(1.0, predicted_until_s() / duration_s) > kLongest_s) return false;
  const auto tops = predicted(resolved_scenario(scene_));
  if (!tops) return false;
  ByMeasure apart;
  for (std::size_t i = 0; i < tops->size(); ++i) {
    const SeenTop &a = (*tops)[i], &b = evidence_.reference[i];
    if (evidence_.attitude) apart.attitude = std::max(apart.attitude, turn_between(a.q, b.q));
    if (evidence_.axis) apart.axis = std::max(apart.axis, angle_of(a.axis, b.axis));
    if (evidence_.rates) apart.rates = std::max(apart.rates, (a.rates - b.rates).norm());
  }
  return explainer_.ratio(apart) <= kExplains;
}

/// Names the mistake with which the motion of `base` is that of the file, read this way. @param before  what was found before
NamedMistake PhysicsSearch::mistaken(const Scenario& base, const Reading& reading, const std::string& before) {
  const auto is_motion = [&](const std::string& earlier, const Explanation& one, std::string_view words) {
    return fmt::format("{}the new result is, to {}, the motion {}{}", earlier, explainer_.left_words(one.left), words,
                       explainer_.if_words(one.reading, ", if "));
  };
  struct Found {
    std::string_view words;
    Explanation explanation;
  };
  std::vector<Found> found;
  for (const Mistake& mistake : mistakes())
    if (const auto scenario = mistake.of(Scene(base)))
      if (const auto tops = predicted(*scenario)) {
        const Explanation one = explainer_.best_reading(reading, *tops);
        if (explains(one, 1 / kAlike)) found.push_back({mistake.words, one});
        if (before.empty()) note_nearest(one, kMostly, is_motion(before, one, mistake.words));
      }
  if (found.empty()) return {};
  const Explanation best = best_of(found).explanation;
  std::string words;
  std::size_t alike = 0;
  for (const Found& one : found)
    if (one.explanation.ratio <= kAlike * best.ratio) words += (alike++ > 0 ? ", or " : "") + std::string(one.words);
  return {{is_motion(before, best, words) + (alike > 1 ? ": the file does not tell them apart" : "")}, best.ratio};
}

/// The differences over some samples, each in parts of what another program may differ by.
Eigen::VectorXd PhysicsSearch::residuals(const Tops& read, const Tops& expected, std::size_t end) const {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(9 * end));
  for (std::size_t i = 0; i < end; ++i) {
    auto part = all.segment<9>(static_cast<Eigen::Index>(9 * i));
    if (evidence_.attitude) {
      Quaterniond turn = expected[i].q.conjugate() * read[i].q;
      if (turn.w() < 0) turn.coeffs() = -turn.coeffs();
      part.head<3>() = 2 * turn.vec() / explainer_.tolerance().attitude;
    }
    if (evidence_.axis) part.segment<3>(3) = (read[i].axis - expected[i].axis) / explainer_.tolerance().axis;
    if (evidence_.rates) part.tail<3>() = (read[i].rates - expected[i].rates) / explainer_.tolerance().rates;
  }
  return all;
}

/// Fits a number of the scenario to the file, first to its first rows and then to ever more.
std::optional<PhysicsSearch::Fit> PhysicsSearch::fit(const Scenario& base, const Suspect& suspect, double from,
                                                     const Reading& reading) const {
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
    fit.explanation = explainer_.best_reading(reading, *here);
    Tops read;
    for (std::size_t i = 0; i < std::min(here->size(), beside->size()); ++i) {
      read.push_back(explainer_.reader().read(i, fit.explanation.reading));
      const double far = evidence_.attitude ? turn_between(read[i].q, (*here)[i].q) : angle_of(read[i].axis, (*here)[i].axis);
      if (far > kFar_rad && i > 1) break;
    }
    const Eigen::VectorXd rest = residuals(read, *here, read.size());
    const Eigen::VectorXd slope = (residuals(read, *beside, read.size()) - rest) / (kDifference * size);
    if (!(slope.squaredNorm() > 0)) return std::nullopt;
    const double change = -slope.dot(rest) / slope.squaredNorm();
    if (!std::isfinite(change) || std::abs(change) > 10 * size) return std::nullopt;
    fit.sure = std::max(kEqual, fit.explanation.ratio) / slope.cwiseAbs().maxCoeff();
    if (std::abs(change) < std::max(kSmallStep * size, 1e-3 * fit.sure)) break;
    fit.value += change;
  }
  const auto tops = at(fit.value);
  if (!tops) return std::nullopt;
  fit.explanation = explainer_.best_reading(reading, *tops);
  return fit;
}

std::vector<std::string> PhysicsSearch::fitted(const Scenario& base, const Reading& reading, const std::string& before) {
  constexpr double kLeastChange = 3e-6;  // phases of an inaccurate program are off by less
  struct Found {
    std::string text;
    Explanation explanation;
  };
  const auto explains_all_but = [&](const std::string& words, const Explanation& one) {
    return fmt::format("{}{} explains all but {}{}", before, words, explainer_.left_words(one.left),
                       explainer_.if_words(one.reading, ", if "));
  };
  std::vector<Found> found;
  const Scene scene(base);
  for (const Suspect& suspect : suspects()) {
    const auto from = suspect.value(scene);
    if (!from) continue;
    const auto fit = this->fit(base, suspect, *from, reading);
    if (!fit || std::abs(fit->value - *from) < kLeastChange * size_of(suspect, *from)) continue;
    std::string text =
        fmt::format("{} {:.9g} instead of {:.8g} {}", suspect.name, meant_number(fit->value, fit->sure), *from, suspect.unit);
    if (before.empty()) note_nearest(fit->explanation, kExplainsMost, explains_all_but(text, fit->explanation));
    if (explains(fit->explanation, kExplainsMost)) found.push_back({std::move(text), fit->explanation});
  }
  if (found.empty()) return {};
  const Explanation best = best_of(found).explanation;
  std::string words;
  for (const Found& one : found)
    if (one.explanation.ratio <= kAlike * best.ratio) words += (words.empty() ? "" : ", or ") + one.text;
  return {explains_all_but(words, best)};
}

/// The scenario released as the file's first row says, and what differs there in words; none where it is the reference's.
std::optional<PhysicsSearch::Release> PhysicsSearch::as_released(const Reading& reading) const {
  constexpr double kSame_rad = 1e-7, kSameOfRate = 1e-7;
  const bool has_release = evidence_.size() > 0 && evidence_.t_s.front() == 0 && reading.later == 0;
  if (!has_release || !(evidence_.attitude || evidence_.axis) || scene_.scenario().release.gimbals) return std::nullopt;
  const SeenTop top = explainer_.reader().read(0, reading);
  const SeenTop& reference = evidence_.reference.front();
  const Vector3d now = evidence_.attitude ? Vector3d(top.q * Vector3d::UnitZ()) : top.axis,
                 then = evidence_.attitude ? Vector3d(reference.q * Vector3d::UnitZ()) : reference.axis;
  const double same_rad = kSame_rad + 2 * (evidence_.rounding.attitude + evidence_.rounding.axis);
  const double same_rad_s = kSameOfRate * reference.rates.norm() + 2 * evidence_.rounding.rates;
  Scenario scenario = resolved_scenario(scene_);
  ReleaseSpec& release = scenario.release;
  std::string text;
  int differences = 0;
  const auto tell = [&](std::string_view name, double value, double before, std::string_view unit) {
    ++differences;
    text += fmt::format("{}{} {:.8g} instead of {:.8g} {}", text.empty() ? "" : ", ", name, value, before, unit);
  };
  const bool turned = evidence_.attitude ? turn_between(top.q, reference.q) > same_rad : angle_of(now, then) > same_rad;
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
    const Vector3d earth_B =
        top.q.conjugate() * Vector3d(scene_.rotation_rate_rad_s() * celestial_axis_L<double>(scene_.site()));
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

std::vector<std::string> PhysicsSearch::further(const std::vector<Reading>& readings) {
  const Scenario base = resolved_scenario(scene_);
  for (const Reading& reading : readings)
    if (NamedMistake found = mistaken(base, reading, ""); !found.sentences.empty()) return found.sentences;
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
    if (const auto tops = predicted(release.scenario)) {
      const Explanation one = explainer_.best_reading(release.reading, *tops);
      std::string sentence = fmt::format("{}; the motion from there agrees to {}{}", release.words,
                                         explainer_.left_words(one.left), explainer_.if_words(one.reading, ", if "));
      if (explains(one, kExplainsMost)) return {std::move(sentence)};
      note_nearest(one, kMostly, sentence);
    }
  for (const Release& release : releases)
    if (NamedMistake found = mistaken(release.scenario, release.reading, release.words + "; from there ");
        !found.sentences.empty())
      return found.sentences;
  constexpr std::size_t kMostFitted = 2;  // fits take the longest
  for (std::size_t i = 0; i < std::min(readings.size(), kMostFitted); ++i)
    if (auto found = fitted(base, readings[i], ""); !found.empty()) return found;
  for (std::size_t i = 0; i < std::min(releases.size(), kMostFitted); ++i)
    if (auto found = fitted(releases[i].scenario, releases[i].reading, releases[i].words + "; besides, "); !found.empty())
      return found;
  return {};
}

NamedMistake PhysicsSearch::by_name(const Reading& reading) { return mistaken(resolved_scenario(scene_), reading, ""); }

}  // namespace earthtop::compare
