// SPDX-License-Identifier: GPL-3.0-or-later
#include "drift/derivatives/drift_differences.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "drift/derivatives/moved_problem.hpp"
#include "drift/long_horizon/kicked_axes.hpp"
#include "earthtop/model/applied_motion.hpp"

namespace earthtop {
namespace {

using Problem = DriftProblem<double>;

/// Displacement of the axis, or relative change of the drift, that a difference aims at (rad, 1). The truncation error is of the
/// order of its square; the rounding of a drift, 1e-10 of it, is divided by it.
constexpr double kAim = 1e-3;
constexpr double kLeastMoved = 1e-5, kMostMoved = 4e-3, kMostAims = 4;  // moves that are used as they are (rad, 1)
constexpr double kLargestStep = 1e-2;                                   // largest step in an input, in its own scale
constexpr double kRateStep = 0.05;                                      // step in the Earth's rate, as a share of it
constexpr double kLargeDrift = 1e-4;                // drift that a difference of two axes shows with seven digits (rad)
constexpr double kAmplified = 1e-3;                 // size to which the Earth's rate brings a smaller drift (rad)
constexpr double kPhase = 0.2;                      // largest change of the nutation's phase (rad)
constexpr int kSeriesRows = 400, kTailRows = 1600;  // times at which responses are found, where those cost little
constexpr double kTailTurns = 1.2;                  // turns of the precession that have the second number of them
constexpr double kRowsThatResolve = 6;              // of a nutation: between them, a length is a parabola
constexpr double kRowsPerNutation = 16;             // of these, unless that makes too many
constexpr int kStepRows = 96, kMostStepRows = 400;  // the same where each takes steps of its own
constexpr double kRowsPerTurn = 12;                 // of the precession, unless that makes too many
constexpr double kPartnerPeriods = 0.5;             // of the nutation from a partner to its row
constexpr double kLeastInterval = 4;                // between two other rows, in periods of the nutation
constexpr double kSeenTurning = 0.02;               // part of a displacement that has to turn with the nutation to count
constexpr std::size_t kPaired = 4;                  // once in this many rows one of them has a partner
constexpr double kAxisRounding = 1e-12;             // of an axis (rad)
constexpr double kDriftRounding = 1e-10;            // of a drift, as a share of it
constexpr double kPhaseError = 1e-3;                // twice what the nutation's phase may change by its size (rad)
constexpr int kTrials = 6;

/// The axes at all rows: of the reference, and (rotating - reference) times the Earth's rate in the unit of 1 / epsilon.
struct Axes {
  std::vector<Vec3<double>> reference, drift;

  void add(double factor, const Axes& other) {
    for (std::size_t i = 0; i < reference.size(); ++i) {
      reference[i] += factor * other.reference[i];
      drift[i] += factor * other.drift[i];
    }
  }
  static Axes zero(std::size_t rows) {
    const std::vector<Vec3<double>> zeros(rows, Vec3<double>::Zero());
    return {zeros, zeros};
  }
};

/// Whether nothing but a gravity gradient acts, the one applied torque for which kicked_axes has a formula.
bool is_gradient_alone(const AppliedTorques<double>& applied) {
  bool alone = true;
  for_each_coefficient([&](double coefficient) { alone = alone && coefficient == 0; },
                       [](const std::array<GradientTerm<double>, 2>&) {}, applied);
  return alone;
}

double largest_of(const std::vector<Vec3<double>>& vectors) {
  double largest = 0;
  for (const Vec3<double>& v : vectors) largest = std::max(largest, norm(v));
  return largest;
}

class Differences {
 public:
  Differences(const Problem& problem, double time_s, const DifferenceMethods& methods, int runs, const Watch& watch)
      : problem_(problem), methods_(methods), runs_(runs), watch_(watch) {
    problem_.threshold_rad.reset();
    // Roughly the angular momentum that a torque has to turn, and the angle through which the axis goes.
    const Model<double>& m = problem_.model;
    const double I1 = m.I_BP_B(0, 0), kappa = m.I_BP_B(2, 2) * std::abs(spin()),
                 G = norm(m.mass_moment_B) * norm(m.apparent_gravity_L);
    momentum_ = kappa + std::sqrt(G * I1);
    const double end = problem_.units.time_from_s(time_s);
    turned_ = momentum_ > 0 ? G / momentum_ * end : 0;
    // A nutation of the aimed size is faster than a small one by half its square: the phase must stay the same to 5e-4 rad.
    const double phase = kappa / I1 * end;
    if (phase > 0) aim_ = std::min(kAim, std::sqrt(kPhaseError / phase));
    choose_times(time_s, real::scale(2 * real::pi<double>() * I1 / kappa, problem_.units.time_exponent));
  }

  bool kicks() const { return methods_.alone.method == Method::long_horizon; }

  /// Integrates the problem itself. Must come first. @returns whether it came to the end
  bool integrate_itself() {
    if (kicks() && !find_steps()) return false;
    const DriftTrajectory<double> run = integrate_drift(problem_, methods_.alone, next_part());
    if (!note(run)) return false;
    base_ = axes_of(run);
    samples_ = run.samples;
    drift_ = epsilon() * largest_of(base_.drift);
    return true;
  }
  const std::vector<DriftSample<double>>& samples() const { return samples_; }
  const StepCounters& counters() const { return counters_; }

  /// The largest length near a row between two others that are as far away: of the parabola through the three squares.
  static double peak_of(const std::vector<Vec3<double>>& vectors, std::size_t i) {
    const double before = vectors[i - 1].squaredNorm(), here = vectors[i].squaredNorm(), after = vectors[i + 1].squaredNorm();
    const double bend = before - 2 * here + after, slope = after - before;
    return here >= before && here >= after && bend < 0 ? std::sqrt(here - slope * slope / (8 * bend)) : 0;
  }
  /// The final and the largest lengths. The displacement is made of a slow part and of one that turns with the nutation. Half a
  /// period lies between a row and its partner, so that their sum and their difference tell the largest length within a period.
  Responses responses_of(const Axes& axes) const {
    Responses r;
    r.displacement_final = norm(axes.reference.back()), r.displacement_largest = largest_of(axes.reference);
    r.drift_final = norm(axes.drift.back()), r.drift_largest = largest_of(axes.drift);
    for (std::size_t i = dense_from_ + 1; i + 1 < samples_.size(); ++i) {
      r.displacement_largest = std::max(r.displacement_largest, peak_of(axes.reference, i));
      r.drift_largest = std::max(r.drift_largest, peak_of(axes.drift, i));
    }
    for (const std::size_t i : paired_) {
      const Vec3<double>&here = axes.reference[i], &partner = axes.reference[i - 1];
      const double slow = norm(Vec3<double>(here + partner)) / 2, turning = norm(Vec3<double>(here - partner)) / 2;
      if (turning > kSeenTurning * slow) r.displacement_largest = std::max(r.displacement_largest, slow + turning);
    }
    return r;
  }

  FollowedStep step_at(std::size_t i) const {
    const DriftState<double>& s = samples_[i].state;
    const NaturalUnits& units = problem_.units;
    return {units.time_from_s(s.t_s), s.ref_q_LB, units.rate_from_rad_s(s.ref_w_LB_B), s.q_LB, units.rate_from_rad_s(s.w_LB_B)};
  }

  /// The responses of both axes to one input. @returns nothing if an integration fails
  std::optional<Axes> by(const ProblemDerivative& d) {
    if (d.coriolis != 0) return by_coriolis();
    if (d.centrifugal != 0) return by_centrifugal();
    if (d.release != 0) return by_release();
    if (changes_rate_only(d)) return by_rate(d.W_IL_L_scaled);
    if (!adds_torque(d)) return by_steps(d, first_step(1 + turned_));
    if (!d.tide.empty() && !kicks()) return by_tide(d);
    return by_steps(d, first_step(torque_of(d) * end() / momentum_));
  }

 private:
  /// Lets long_horizon find its steps where no row has a partner: it takes none that is longer than the shortest interval.
  bool find_steps() {
    Problem coarse = problem_;
    const double end_s = problem_.times_s.back();
    coarse.times_s = {0, row_interval_s_, end_s};
    const DriftTrajectory<double> run = integrate_drift(coarse, methods_.alone, watch_.part(0, 0));
    methods_.alone.kick_steps = run.kick_steps;
    return note(run) && run.kick_steps;
  }
  double epsilon() const { return problem_.model.epsilon; }
  double spin() const { return problem_.natural_release().w_XB_B[2]; }
  /// @param period_s  of the nutation, roughly; may be infinite
  void choose_times(double time_s, double period_s) {
    const double turns = turned_ / (2 * real::pi<double>());
    problem_.times_s = {0};
    if (!kicks()) {
      // Responses grow: most are largest in the last turn of the precession, which is followed as closely as the nutation asks.
      const double tail_s = time_s * std::min(1.0, kTailTurns / turns), apart_s = period_s / kRowsPerNutation;
      const int last = static_cast<int>(std::clamp(tail_s / apart_s, double(kStepRows), double(kTailRows)));
      const double begin_s = time_s - tail_s;
      const int first = begin_s > 0 ? kSeriesRows : 0;
      if (tail_s / last < period_s / kRowsThatResolve) dense_from_ = static_cast<std::size_t>(first);
      for (int i = 1; i <= first; ++i) problem_.times_s.push_back(begin_s * (double(i) / first));
      for (int i = 1; i <= last; ++i) problem_.times_s.push_back(i == last ? time_s : begin_s + tail_s * (double(i) / last));
      return;
    }
    const double most = std::min(double(kMostStepRows), time_s / (kLeastInterval * period_s));
    const int rows = static_cast<int>(std::max(1.0, std::min(most, std::max(kRowsPerTurn * turns, double(kStepRows)))));
    row_interval_s_ = time_s / rows;
    for (int i = 1; i <= rows; ++i) {
      const double t = i == rows ? time_s : time_s * (double(i) / rows);
      if (static_cast<std::size_t>(rows - i) % kPaired == 0) {
        problem_.times_s.push_back(t - kPartnerPeriods * period_s);
        paired_.push_back(problem_.times_s.size());
      }
      problem_.times_s.push_back(t);
    }
  }
  double end() const { return problem_.units.time_from_s(problem_.times_s.back()); }
  Watch next_part() {
    const Watch part = watch_.part(double(done_) / runs_, double(done_ + 1) / runs_);
    ++done_;
    return part;
  }
  bool note(const DriftTrajectory<double>& run) {
    counters_.accepted += run.counters.accepted, counters_.rejected += run.counters.rejected;
    counters_.evaluations += run.counters.evaluations;
    return run.status == RunStatus::completed;
  }
  static Axes axes_of(const DriftTrajectory<double>& run) {
    Axes axes;
    for (const DriftSample<double>& sample : run.samples) {
      axes.reference.emplace_back(rotation_matrix(sample.state.ref_q_LB).col(2));
      axes.drift.push_back(sample.measures.axis_difference_L_scaled);
    }
    return axes;
  }

  std::optional<Axes> axes_at(const ProblemDerivative& d, double h) {
    if (kicks() && adds_torque(d)) return kicked(d, h);
    const DriftTrajectory<double> run =
        integrate_drift(moved(problem_, d, h), adds_torque(d) ? methods_.driven : methods_.alone, next_part());
    if (!note(run)) return std::nullopt;
    return axes_of(run);
  }
  /// The axes under a further torque, from walks with its kicks at two rates of the Earth: at 0 and at the true rate, or, where
  /// the drift is too small for a difference, at a larger rate and its negative, which cancels the second order.
  std::optional<Axes> kicked(const ProblemDerivative& d, double h) {
    if (!is_gradient_alone(d.applied)) return std::nullopt;
    AxisTorque torque{d.applied.gradient, d.tide, h};
    for (auto& term : torque.gradient) term.strength *= h;
    const bool amplifies = drift_ < kLargeDrift;
    const double high = amplifies && drift_ > 0 ? kAmplified / drift_ : 1, low = amplifies ? -high : 0;
    const Watch part = next_part();
    Axes axes;
    const std::vector<Vec3<double>> fast = kicked_axes(problem_, *methods_.alone.kick_steps, high, torque, part),
                                    slow = kicked_axes(problem_, *methods_.alone.kick_steps, low, torque, part);
    if (fast.size() < samples_.size() || slow.size() < samples_.size()) return std::nullopt;
    for (std::size_t i = 0; i < fast.size(); ++i) {
      const double sum = fast[i].sum() + slow[i].sum();
      if (!std::isfinite(sum)) return std::nullopt;
      axes.reference.push_back(amplifies ? Vec3<double>((fast[i] + slow[i]) / 2) : slow[i]);
      axes.drift.emplace_back((fast[i] - slow[i]) / ((high - low) * epsilon()));
    }
    return axes;
  }

  /// The size of an input's torque (natural units), largest of all rows.
  double torque_of(const ProblemDerivative& d) const {
    double largest = 0;
    Model<double> alone = problem_.model;
    alone.applied = d.applied;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const FollowedStep s = step_at(i);
      const Vec3<double> torque =
          d.tide.empty() ? applied_torque_B(alone, s.t, s.q_LB, s.w_LB_B, true)
                         : field_torque(alone.mass_moment_B,
                                        Vec3<double>(transposed_times(rotation_matrix(s.q_LB), d.tide.acceleration_L(s.t))));
      largest = std::max(largest, norm(torque));
    }
    return largest;
  }
  /// A step that moves the axis by about the aim, from a rough displacement for a unit step.
  double first_step(double moves) const { return moves > 0 ? aim_ / moves : 0; }

  /// How fast the nutation's phase at the end changes with an input (rad). The axis can then hardly move, and yet be far from
  /// linear in the input.
  double nutation_change(const ProblemDerivative& d) const {
    const Model<double>& m = problem_.model;
    const double w3 = spin();
    return std::abs(
               (d.I_BP_B(2, 2) * w3 + m.I_BP_B(2, 2) * d.w_XB_B[2] - m.I_BP_B(2, 2) * w3 * d.I_BP_B(0, 0) / m.I_BP_B(0, 0)) /
               m.I_BP_B(0, 0)) *
           end();
  }

  /// The central difference, of a step for which the axis moves by about the aim.
  std::optional<Axes> by_steps(const ProblemDerivative& d, double step) {
    if (step == 0) return Axes::zero(samples_.size());
    // A strength has no scale of its own, whereas an input is measured in its own.
    const double nutates = nutation_change(d);
    const bool phased = nutates * kLargestStep > kPhase;
    const double largest = adds_torque(d) ? 1e3 * step : phased ? kPhase / nutates : kLargestStep;
    double h = std::min(step, largest);
    for (int trial = 0; trial < kTrials; ++trial) {
      std::optional<Axes> high = axes_at(d, h);
      double moves = HUGE_VAL;
      if (high) {
        Axes change = *high;
        change.add(-1, base_);
        moves = std::max(largest_of(change.reference), drift_ > 0 ? epsilon() * largest_of(change.drift) / drift_ : 0);
      }
      if (!(moves <= kMostAims * aim_)) {
        h *= std::isfinite(moves) ? std::max(aim_ / moves, 1e-4) : 1e-2;
        continue;
      }
      if (moves < kLeastMoved && h < largest && trial + 1 < kTrials) {
        h = std::min(largest, h * std::min(aim_ / std::max(moves, 1e-12), 1e4));
        continue;
      }
      const std::optional<Axes> low = axes_at(d, -h);
      if (!low) return std::nullopt;
      Axes response = difference(*high, *low, h);
      if (!phased) return response;
      // The error of second order is removed by a difference over half the step.
      const std::optional<Axes> nearer_high = axes_at(d, h / 2), nearer_low = axes_at(d, -h / 2);
      if (!nearer_high || !nearer_low) return std::nullopt;
      Axes refined = Axes::zero(samples_.size());
      refined.add(4.0 / 3, difference(*nearer_high, *nearer_low, h / 2));
      refined.add(-1.0 / 3, response);
      return refined;
    }
    return std::nullopt;
  }
  /// The difference that the tide makes: it is so weak that no smaller step is needed.
  std::optional<Axes> by_tide(const ProblemDerivative& d) {
    if (torque_of(d) == 0) return Axes::zero(samples_.size());
    Problem other = problem_;
    const bool has_tide = !problem_.model.tide.empty();
    if (other.model.kind == SceneKind::plain) other.model.kind = SceneKind::full;
    other.model.tide = has_tide ? TideSeries<double>() : d.tide;
    const DriftTrajectory<double> run = integrate_drift(other, methods_.driven, next_part());
    if (!note(run)) return std::nullopt;
    Axes response = Axes::zero(samples_.size());
    response.add(has_tide ? -1 : 1, axes_of(run));
    response.add(has_tide ? 1 : -1, base_);
    if (!(largest_of(response.reference) <= kMostMoved)) return std::nullopt;  // it grows too much to be of the first order
    for (Vec3<double>& drift : response.drift) drift *= epsilon();
    return response;
  }
  Axes difference(const Axes& high, const Axes& low, double h) const {
    Axes response = Axes::zero(high.reference.size());
    response.add(1 / (2 * h), high);
    response.add(-1 / (2 * h), low);
    for (Vec3<double>& drift : response.drift) drift *= epsilon();
    // A change that is no more than rounding is not a response.
    const auto clear = [](std::vector<Vec3<double>>& vectors) { std::ranges::fill(vectors, Vec3<double>::Zero()); };
    if (h * largest_of(response.reference) < kAxisRounding) clear(response.reference);
    if (h * largest_of(response.drift) < kDriftRounding * drift_) clear(response.drift);
    return response;
  }

  /// The response to a change of the Earth's rate, from those to changes in the East, the North and upward.
  std::optional<Axes> by_rate(const Vec3<double>& change_scaled) {
    Axes response = Axes::zero(samples_.size());
    const double rate = norm(problem_.model.W_IL_L_scaled),
                 h = drift_ > 0 ? kRateStep * std::min(1.0, 0.1 / drift_) : kRateStep;
    for (std::size_t i = 0; i < 3; ++i) {
      const double part = change_scaled[static_cast<int>(i)] / rate;
      if (part == 0) continue;
      if (!by_rate_[i]) {
        ProblemDerivative d;
        d.W_IL_L_scaled[static_cast<int>(i)] = rate;
        const std::optional<Axes> high = axes_at(d, h), low = axes_at(d, -h);
        if (!high || !low) return std::nullopt;
        by_rate_[i] = difference(*high, *low, h);
        by_rate_[i]->reference.assign(samples_.size(), Vec3<double>::Zero());  // the Earth does not turn there
      }
      response.add(part, *by_rate_[i]);
    }
    return response;
  }
  /// The response to a change that acts on the rotating motion alone: of its axis, and not of the reference's.
  static Axes of_rotating(const Axes& both, double factor) {
    Axes response = Axes::zero(both.reference.size());
    for (std::size_t i = 0; i < both.reference.size(); ++i) response.drift[i] = factor * (both.reference[i] + both.drift[i]);
    return response;
  }
  const std::optional<Axes>& by_centrifugal() {
    if (centrifugal_) return centrifugal_;
    const Vec3<double>& W_L = problem_.model.W_IL_L;
    const double rate = norm(W_L);
    if (const std::optional<Axes> both = by(centrifugal_as_gradient(W_L))) centrifugal_ = of_rotating(*both, rate * rate);
    return centrifugal_;
  }
  /// The share s of the Earth's rate in the rates at release lets the rotating motion begin with the further rate s W.
  const std::optional<Axes>& by_release() {
    if (release_) return release_;
    ProblemDerivative d;
    d.w_XB_B = transposed_times(rotation_matrix(problem_.release.q_LB), problem_.model.W_IL_L_scaled);
    if (const std::optional<Axes> both = by(d)) release_ = of_rotating(*both, epsilon());
    return release_;
  }
  /// The Earth's rate enters by the Coriolis torque, which is linear in it, by the centrifugal torque, which is quadratic, and
  /// by the release, where that gives inertial rates: the response to a change of its logarithm is
  ///   coriolis + 2 centrifugal - (1 - s) release ,   s = 1 for rates relative to the laboratory, and otherwise 0 .
  std::optional<Axes> by_coriolis() {
    std::optional<Axes> response = by_rate(problem_.model.W_IL_L_scaled);
    if (!response || !by_centrifugal()) return std::nullopt;
    response->add(-2, *by_centrifugal());
    if (problem_.release.X == RatesRelativeTo::inertial) {
      if (!by_release()) return std::nullopt;
      response->add(1, *by_release());
    }
    return response;
  }

  Problem problem_;
  DifferenceMethods methods_;
  int runs_, done_ = 0;
  Watch watch_;
  StepCounters counters_;
  Axes base_;
  std::vector<DriftSample<double>> samples_;
  std::size_t dense_from_ = std::numeric_limits<std::size_t>::max() / 2;  ///< row after which rows resolve the nutation
  std::vector<std::size_t> paired_;                                       ///< rows whose partner is the row before
  double row_interval_s_ = 0, aim_ = kAim;
  double drift_ = 0, momentum_ = 1, turned_ = 0;
  std::array<std::optional<Axes>, 3> by_rate_;
  std::optional<Axes> centrifugal_, release_;
};

}  // namespace

DifferenceRuns difference_runs(const DriftProblem<double>& problem, const std::vector<ProblemDerivative>& inputs,
                               const DifferenceMethods& methods) {
  DifferenceRuns runs{1, 0};
  Vec3<double> rate = Vec3<double>::Zero();
  bool centrifugal = false, release = false;
  const bool kicks = methods.alone.method == Method::long_horizon;
  int torques = 0;
  for (const ProblemDerivative& d : inputs) {
    centrifugal = centrifugal || d.coriolis != 0 || d.centrifugal != 0;
    release = release || d.release != 0 || (d.coriolis != 0 && problem.release.X == RatesRelativeTo::inertial);
    if (d.coriolis != 0) rate += problem.model.W_IL_L_scaled.cwiseAbs();
    if (d.coriolis != 0 || d.centrifugal != 0 || d.release != 0) continue;
    if (changes_rate_only(d))
      rate += d.W_IL_L_scaled.cwiseAbs();
    else if (adds_torque(d))
      torques += !d.tide.empty() && !kicks ? 1 : 2;
    else
      runs.alone += 2;
  }
  for (int i = 0; i < 3; ++i) runs.alone += rate[i] > 0 ? 2 : 0;
  if (centrifugal) torques += 2;
  if (release) runs.alone += 2;
  (kicks ? runs.alone : runs.driven) += torques;
  return runs;
}

bool has_drift_differences(const DriftProblem<double>& problem) {
  const Model<double>& model = problem.model;
  const bool rests = model.platform.turn.never_turns() && norm(model.platform.pivot_offset_P) == 0;
  // The response to the Coriolis torque is taken from that to the Earth's rate, for which all the torques must act: they do in
  // the reduced form.
  return norm(model.W_IL_L) > 0 && rests && model.journey.empty() && is_reducible_when_driven(model) &&
         symmetry_axis(model.I_BP_B, model.mass_moment_B) == 2;
}

std::optional<DriftSensitivity> drift_differences(const DriftProblem<double>& problem,
                                                  const std::vector<ProblemDerivative>& inputs, double time_s,
                                                  const DifferenceMethods& methods, const Watch& watch,
                                                  const std::function<void(const FollowedStep&)>& on_step) {
  Differences differences(problem, time_s, methods, difference_runs(problem, inputs, methods).all(), watch);
  if (!differences.integrate_itself()) return std::nullopt;
  DriftSensitivity result;
  for (const ProblemDerivative& d : inputs) {
    const std::optional<Axes> axes = differences.by(d);
    if (!axes) return std::nullopt;
    result.responses.push_back(differences.responses_of(*axes));
  }
  const auto& measures = differences.samples().back().measures;
  result.axis.value = measures.axis, result.attitude.value = measures.attitude, result.tilt.value = measures.tilt;
  if (measures.azimuth_defined) result.azimuth.emplace().value = measures.azimuth;
  result.counters = differences.counters();
  if (on_step)
    for (std::size_t i = 0; i < differences.samples().size(); ++i) on_step(differences.step_at(i));
  return result;
}

}  // namespace earthtop
