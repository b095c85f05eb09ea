// SPDX-License-Identifier: GPL-3.0-or-later
// Integrates stretches of a motion, to see how many steps it takes.
#include <algorithm>
#include <array>
#include <cmath>

#include "drift/derivatives/growth_work.hpp"
#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/drift/growth.hpp"
#include "earthtop/scenario/support.hpp"
#include "scene/parts.hpp"
#include "scene/second_integration.hpp"

namespace earthtop {
namespace {

/// The parts of a run, each of which a stretch at its beginning stands for. A platform may move in another way later on, and
/// friction brakes the body.
constexpr std::size_t kParts = 4;
/// The steps after which a stretch is long enough, in the precision of the integration: milliseconds of work in double, tenths of
/// a second in 113 bits.
template <class T>
constexpr double kEnough = std::is_same_v<T, double>    ? 32
                           : std::is_same_v<T, float80> ? 24
                                                        : 8;
/// Each try of a stretch is so many times as long as the one before; it is given up at twice as many steps as it may take.
constexpr double kLonger = 4, kMostSteps = 2 * kLonger;
/// A run of so many times the steps of a stretch is integrated as a whole.
constexpr double kWholeRun = 16;
/// The steps that the rule finds in the first try.
constexpr double kFewSteps = 2;

Work work_of(const StepCounters& counters) {
  return {static_cast<double>(counters.accepted + counters.rejected), static_cast<double>(counters.evaluations)};
}

Work operator*(const Work& work, double times) { return {work.steps * times, work.evaluations * times}; }
Work& operator+=(Work& sum, const Work& work) { return sum = {sum.steps + work.steps, sum.evaluations + work.evaluations}; }

/// A stretch of a motion, and the work that it took.
struct Stretch {
  double length_s;
  Work taken;
  double steps_a_second() const { return taken.steps / length_s; }
};

/// Integrates longer and longer stretches until one takes enough steps or has the whole length.
/// @param take  integrates a stretch of a given length, and returns its counters; none where it takes far too many steps
template <class Take>
std::optional<Stretch> long_enough(double first_s, double whole_s, double enough, const Take& take) {
  constexpr int kMostTries = 40;
  double length_s = std::min(first_s, whole_s);
  std::optional<Stretch> last;
  for (int i = 0; i < kMostTries && length_s > 0; ++i) {
    const std::optional<StepCounters> counters = take(length_s);
    if (!counters && last) return last;
    if (counters) {
      last = Stretch{length_s, work_of(*counters)};
      if (length_s == whole_s || last->taken.steps >= enough) return last;
    }
    length_s = counters ? std::min(kLonger * length_s, whole_s) : length_s / (kLonger * kLonger);
  }
  return std::nullopt;
}

/// The steps a second of an integration in one part of the run. What is integrated beside the motion is measured against its size
/// so far: while that grows like the time, its p-th root lengthens the steps of a method of order p, until they are as long as
/// those of the motion alone. As seen from the body it may turn, too, and then its steps stay as they are.
struct StepRate {
  double order_inverse;  ///< 1 / p, less for what turns
  double age_s;          ///< the time since which what is beside the motion has grown
  double before, then;   ///< steps a second until then, in the mean, and then
  double of_motion;      ///< steps a second of the motion alone

  /// The steps from one time of the run to another (s).
  double between(double begin_s, double end_s) const {
    const double power = 1 - order_inverse;
    const double alike_s = of_motion > 0 ? age_s * std::max(1.0, real::pow(then / of_motion, 1 / order_inverse)) : HUGE_VAL;
    const double first_s = std::clamp(age_s, begin_s, end_s), second_s = std::clamp(alike_s, begin_s, end_s);
    return before * (first_s - begin_s) +
           then * age_s / power * (real::pow(second_s / age_s, power) - real::pow(first_s / age_s, power)) +
           of_motion * (end_s - second_s);
  }
};

/// The torques of friction and of a gimbal's damping, `times` as strong.
template <class T>
void strengthen_friction(AppliedTorques<T>& applied, double times) {
  const SupportStiffness<T> support = applied.support;
  const GivenTorque<T> given = applied.given;
  for_each_coefficient([times](T& coefficient) { coefficient *= T(times); }, [](std::array<GradientTerm<T>, 2>&) {}, applied);
  applied.support = support, applied.given = given;
}

/// Looks at the stretches of one scene.
template <class T>
class Looks {
 public:
  Looks(const Scene& scene, Pace& pace)
      : scene_(&scene), pace_(&pace), bare_(bare(scene)), whole_s_(scene.scenario().duration_s) {}

  /// Puts the ratio of a method's work to the rule's into the pace.
  void see(IntegrationOptions options) {
    if (options.step_s || is_exact(options.method) || options.method == Method::long_horizon) return;
    options.stops_beyond_estimate = false;
    Pace without_looks = *pace_;
    without_looks.judgement_looks = 0;
    if (!ends_steps_at_rows(options.method)) without_looks.rows = 0;
    const Work rule = estimated_work(without_looks, options, scene_->form(options) == ModelForm::reduced);
    const Release<T>& release = bare_.template problem_without_rows<T>().release;
    auto stretch = drift_stretch(release, 0, 0, kFewSteps * whole_s_ / rule.steps, whole_s_, options);
    if (!stretch) return;
    const double at_first = stretch->steps_a_second();
    // Friction that may bring the motion to rest leaves fewer steps than those at release suggest.
    const double fewer = pace_->damping > 1 ? kMostSteps : 1;
    if (at_first * whole_s_ < kWholeRun * kEnough<T> * fewer)
      if (const auto whole = drift_counters(release, 0, 0, whole_s_, kWholeRun * kEnough<T>, options))
        stretch = Stretch{whole_s_, work_of(*whole)};
    Work found = stretch->taken;
    if (stretch->length_s == whole_s_) {
      slower_ = stretch->steps_a_second() / at_first;
    } else {
      found = {};
      // The release is a state like no other, at rest for instance.
      if (!has_parts_) begun_[0] = reached_;
      const double order_inverse =
          (scene_->scenario().effects.applied.gimbal ? 1 : kTurning) * row_of(options.method).cost.order_inverse;
      for (std::size_t part = 0; part < kParts; ++part) {
        stretch = drift_stretch(begun_[part], part, part_s(), stretch->length_s, part_s(), options);
        if (!stretch) return;
        const double motion =
            order_inverse > kHighOrder ? motion_steps_a_second(begun_[part], part, stretch->length_s, options) : 0;
        // The deviation has grown from 0 at the beginning of the stretch.
        const double mean = stretch->steps_a_second(), then = (1 - order_inverse) * mean;
        found +=
            stretch->taken * (steps_in(part, {order_inverse, stretch->length_s, mean, then, motion}) / stretch->taken.steps);
        if (!has_parts_ && part + 1 < kParts) begun_[part + 1] = reached_;
      }
      has_parts_ = true;
    }
    pace_->seen[static_cast<std::size_t>(options.method)] = {found.steps / rule.steps, found.evaluations / rule.evaluations};
  }

  /// Does the same for the growth of disturbances.
  void see_growth() {
    if constexpr (std::is_same_v<T, double>) {
      const DriftProblem<double>& problem = bare_.template problem_without_rows<double>();
      const auto tolerance = growth_tolerance(problem, whole_s_);
      if (!tolerance || has_smooth_series(problem, whole_s_)) return;
      const Work rule = variational_work(*pace_, whole_s_, *tolerance);
      const auto stretch =
          long_enough(kFewSteps * whole_s_ / rule.steps, whole_s_, kLonger * kEnough<T>,
                      [&](double length_s) -> std::optional<StepCounters> {
                        return disturbance_growth(problem, MotionKind::rotating, length_s, *tolerance).counters;
                      });
      if (!stretch) return;
      Work found = stretch->taken;
      if (stretch->length_s < whole_s_) {
        found = {};
        IntegrationOptions options;
        options.method = Method::rkf78, options.observer = Observer::body, options.form = ModelForm::general;
        options.relative_tolerance = *tolerance;
        const double at_release = motion_steps_a_second(problem.release, 0, stretch->length_s, options);
        for (std::size_t part = 0; part < kParts; ++part) {
          // Disturbances begin at their full size, and it takes them a while to grow beyond it.
          constexpr double kStepsBeforeGrowth = 1000;
          const double motion =
              has_parts_ ? motion_steps_a_second(begun_[part], part, stretch->length_s, options) : slower_ * at_release;
          const double steps_a_second = stretch->steps_a_second() * (at_release > 0 ? motion / at_release : 1);
          const StepRate rate{row_of(options.method).cost.order_inverse, kStepsBeforeGrowth / steps_a_second, steps_a_second,
                              steps_a_second, motion};
          constexpr double kSettled = 0.95;  // when disturbances have come to lie in the direction of growth, as measured
          found += stretch->taken * (kSettled * steps_in(part, rate) / stretch->taken.steps);
        }
      }
      found = {std::max(found.steps, stretch->taken.steps), std::max(found.evaluations, stretch->taken.evaluations)};
      pace_->variations_seen = {found.steps / rule.steps, found.evaluations / rule.evaluations};
    }
  }

 private:
  /// From this order on the size of the deviation hardly matters.
  static constexpr double kHighOrder = 1.0 / 16;
  /// The part of the order's effect that is left where the deviation turns as seen from the body, as measured. A gimbal leaves it
  /// one axis to turn about.
  static constexpr double kTurning = 2.0 / 3;

  /// The scene without a limit to its work, and without what takes long to set up and decides no step.
  static Scene bare(const Scene& scene) {
    Scenario scenario = scene.scenario();
    scenario.numerics.stops_beyond_estimate = false;
    if (scenario.effects.tide && !scenario.effects.tide->given) scenario.effects.tide.reset();
    return resolve(std::move(scenario));
  }
  double part_s() const { return whole_s_ / double(kParts); }
  double steps_in(std::size_t part, const StepRate& rate) const {
    return rate.between(double(part) * part_s(), double(part + 1) * part_s());
  }

  /// The problem of a stretch at the beginning of a part. All the friction of the part acts in it.
  DriftProblem<T> problem_of(const Release<T>& begun, std::size_t part, double length_s, double stands_for_s) const {
    DriftProblem<T> problem = bare_.template problem_without_rows<T>();
    problem.release = begun;
    problem.times_s = {double(part) * part_s(), double(part) * part_s() + length_s};
    problem.threshold_rad.reset();
    // Friction that brakes little in the whole run is left as it is; none may be so strong that it decides the steps.
    constexpr double kBrakes = 0.5, kWeak = 0.3;
    if (length_s < stands_for_s && pace_->damping > kBrakes)
      strengthen_friction(problem.model.applied,
                          std::clamp(kWeak * pace_->turning_rad / pace_->damping, 1.0, stands_for_s / length_s));
    return problem;
  }
  /// The counters of a stretch; none where it fails or takes more steps than it may.
  std::optional<StepCounters> drift_counters(const Release<T>& begun, std::size_t part, double stands_for_s, double length_s,
                                             double most_steps, IntegrationOptions options) {
    options.step_limit = static_cast<std::int64_t>(most_steps);
    DriftProblem<T> problem = problem_of(begun, part, length_s, stands_for_s);
    // Only rows at which steps have to end are wanted.
    const double row_s = scene_->scenario().output_step_s;
    if (ends_steps_at_rows(options.method))
      for (std::int64_t k = 1; k <= options.step_limit && double(k) * row_s < length_s; ++k)
        problem.times_s.insert(problem.times_s.end() - 1, problem.times_s.front() + double(k) * row_s);
    const auto done = integrate_drift(problem, options);
    if (done.status != RunStatus::completed) return std::nullopt;
    reached_ = {done.samples.back().state.q_LB, done.samples.back().state.w_LB_B, RatesRelativeTo::laboratory};
    return done.counters;
  }
  std::optional<Stretch> drift_stretch(const Release<T>& begun, std::size_t part, double stands_for_s, double first_s,
                                       double most_s, const IntegrationOptions& options) {
    return long_enough(first_s, most_s, kEnough<T>, [&](double length_s) {
      return drift_counters(begun, part, stands_for_s, length_s, kMostSteps * kEnough<T>, options);
    });
  }
  double motion_steps_a_second(const Release<T>& begun, std::size_t part, double length_s,
                               const IntegrationOptions& options) const {
    IntegrationOptions limited = options;
    limited.stops_beyond_estimate = false;
    limited.step_limit = static_cast<std::int64_t>(kMostSteps * kEnough<T>);
    const auto done = integrate_motion<T>(problem_of(begun, part, length_s, part_s()), limited);
    return done.status == RunStatus::completed ? work_of(done.counters).steps / length_s : 0;
  }

  const Scene* scene_;
  Pace* pace_;
  Scene bare_;
  double whole_s_;
  std::array<Release<T>, kParts> begun_;  ///< the state at the beginning of each part's stretch
  Release<T> reached_;                    ///< how the last stretch ended
  bool has_parts_ = false;                ///< whether these states are known
  double slower_ = 1;  ///< steps a second of the whole run, against those at release, where it was integrated
};

template <class T>
void look(const Scene& scene, Pace& pace) {
  const IntegrationOptions& first = scene.choice().options;
  if (scene.method_refusal(first.method)) return;
  const IntegrationOptions second = second_options(scene, first);
  Looks<T> looks(scene, pace);
  looks.see(first);
  if (second.method != first.method) looks.see(second);
  if constexpr (std::is_same_v<T, double>)
    looks.see_growth();
  else
    Looks<double>(scene, pace).see_growth();
}

}  // namespace

Pace pace_as_seen(const Scene& scene) {
  Pace pace = scene.pace_by_rule();
  switch (scene.scenario().precision) {
    case Precision::bits53: look<double>(scene, pace); break;
    case Precision::bits64: look<float80>(scene, pace); break;
    case Precision::bits113: look<float128>(scene, pace); break;
  }
  return pace;
}

bool is_too_short_to_look(const Scene& scene) {
  constexpr double kFewEvaluations = 1e4;  // the limit of a run's work is never below a hundred times as many
  if (!may_be_driven(scene.scenario()) || scene.scenario().precision != Precision::bits53) return false;
  const IntegrationOptions& options = scene.choice().options;
  if (options.step_s || is_exact(options.method)) return false;
  const bool reduced = scene.form(options) == ModelForm::reduced;
  return estimated_work(scene.pace_by_rule(), options, reduced).evaluations < kFewEvaluations;
}

}  // namespace earthtop
