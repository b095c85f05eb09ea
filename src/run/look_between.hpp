// SPDX-License-Identifier: GPL-3.0-or-later
/// Looks at the motion between the rows of a run: what the first integration has shown there, or what another one shows.
#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "earthtop/scenario/support.hpp"
#include "run/assemble.hpp"
#include "run/largest_drift.hpp"
#include "run/rows.hpp"

namespace earthtop {

/// Leaves only those looks that serve one of two purposes, and their samples.
template <class T>
void keep(LookFor purpose, LookFor other, Looks& looks, std::vector<DriftSample<T>>& samples) {
  Looks kept;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!looks.serves(i, purpose) && !looks.serves(i, other)) continue;
    if (kept.size() != i) samples[kept.size()] = std::move(samples[i]);
    kept.times_s.push_back(looks.times_s[i]), kept.purposes.push_back(looks.purposes[i]);
  }
  samples.resize(kept.size());
  looks = std::move(kept);
}

/// Takes the looks for trend and pictures out of the first integration, whose other samples have partners in the second one.
template <class T>
std::vector<DriftSample<double>> take_between(TwoIntegrations<T>& made) {
  std::vector<DriftSample<double>> between;
  std::vector<DriftSample<T>>& samples = made.first.samples;
  if constexpr (std::is_same_v<T, double>)
    for (std::size_t i = 0; i < samples.size(); ++i)
      if (made.looks.serves(i, LookFor::trend) || made.looks.serves(i, LookFor::picture)) between.push_back(samples[i]);
  keep(LookFor::row, LookFor::judgement, made.looks, samples);
  return between;
}

template <class T>
JudgedLook judged_look(const DriftSample<T>& sample, const DriftBound<T>& bound) {
  const auto number = [](const T& value) { return static_cast<double>(value); };
  JudgedLook look{number(sample.state.t_s), number(sample.measures.axis), number(sample.measures.attitude),
                  number(bound.axis()),     number(bound.attitude()),     number(bound.tip())};
  if (sample.rotor)
    look.rotor = {number(sample.rotor->axis.angle), number(bound.rotor_axis()), number(bound.rotor_rate()),
                  number(bound.rotor_angle())};
  if (sample.gimbals)
    look.gimbals = {std::abs(number(sample.state.epsilon * sample.gimbals->outer.diff)), number(bound.outer_angle()),
                    std::abs(number(sample.state.epsilon * sample.gimbals->inner.diff)), number(bound.inner_angle()),
                    sample.gimbals->headline};
  return look;
}

/// Makes rows of looks, without bounds.
template <class T>
std::vector<BasicDriftRow<T>> rows_of(const Scene& scene, const std::vector<ContactEvent>& events,
                                      const std::vector<DriftSample<T>>& samples) {
  const RowParts<T> parts(scene, events);
  std::vector<BasicDriftRow<T>> rows;
  rows.reserve(samples.size());
  for (const DriftSample<T>& sample : samples) rows.push_back(make_row(sample, DriftBound<T>(0), parts));
  return rows;
}

/// Fills in the looks of a result. @param between  what the first integration has shown between its rows; empty if it could not
/// @returns the azimuths at the trend's times, as far as the run got
template <class T>
std::vector<AzimuthSample> look_between(const Scene& scene, const TwoIntegrations<T>& made,
                                        std::vector<DriftSample<double>> between, std::span<const JudgedLook> judged,
                                        const Watch& watch, RunResult& result) {
  Looks looks;
  looks.add(made.plan.trend.times_s, LookFor::trend);
  looks.add(made.plan.picture.times_s, LookFor::picture);
  if (between.empty())
    between = look_again(scene, looks.times_s, made.options, made.memory(), watch.with_progress(nullptr)).samples;
  while (!between.empty() && between.back().state.t_s > result.reached_s) between.pop_back();
  std::vector<AzimuthSample> azimuths;
  for (std::size_t i = 0; i < between.size(); ++i)
    if (looks.serves(i, LookFor::trend)) azimuths.push_back(azimuth_sample(between[i]));
  keep(LookFor::picture, LookFor::picture, looks, between);
  result.looks = rows_of(scene, made.first.contact_events, between);
  result.looks_a_window = made.plan.picture.looks_a_window;
  for (DriftRow& look : result.looks) take_bounds(judged, look);
  return azimuths;
}

/// Where the search for largest values takes further looks from.
template <class T>
LookSource source_of(const Scene& scene, const TwoIntegrations<T>& made, const Watch& watch) {
  // It is not known how often the motion is integrated again: each time takes a third of what is left of the progress.
  const auto next = [watch, left = std::make_shared<double>(1)] {
    const double before = *left;
    *left *= 2.0 / 3;
    return watch.part(1 - before, 1 - *left);
  };
  const auto look = [&scene, &made, next](std::vector<double> times_s) {
    return rows_of(scene, made.first.contact_events,
                   look_again(scene, std::move(times_s), made.options, made.memory(), next()).samples);
  };
  const auto exact = [&scene, &made, next](std::vector<double> times_s) {
    DriftProblem<T> problem = scene.problem_without_rows<T>();
    problem.threshold_rad.reset();
    problem.times_s = std::move(times_s);
    problem.times_s.insert(problem.times_s.begin(), 0);
    IntegrationOptions options = made.options;
    options.kick_steps = made.first.kick_steps;
    std::vector<ExtendedDriftRow> rows;
    const LookTimer timer(*made.way);
    for (const BasicDriftRow<T>& row :
         rows_of(scene, made.first.contact_events, integrate_drift(problem, options, next()).samples))
      rows.push_back(row_cast<float128>(row));
    return rows;
  };
  return {look, exact, made.plan.picture.step_s, !std::is_same_v<T, double>};
}

}  // namespace earthtop
