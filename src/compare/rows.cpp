// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/rows.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "compare/interpolate.hpp"
#include "compare/pairing.hpp"
#include "compare/survey.hpp"
#include "compare/tell.hpp"
#include "compare/tolerances.hpp"
#include "earthtop/error.hpp"
#include "earthtop/real.hpp"
#include "input/node.hpp"
#include "text/number_words.hpp"

namespace earthtop::compare {
namespace {

constexpr std::size_t kMostSeen = 200;
constexpr std::size_t kMostSpans = 1000;  // largest number of spans in a difference's curve
constexpr double kNearlySame = 0.1;  // rad: attitudes that differ by less have quaternions of the same or of opposite signs

/// Builds a difference's curve: the largest difference in each span of equally many rows. If there are too many spans, every
/// two are joined.
class CurveBuilder {
 public:
  void add(double t_s, double difference, double tolerance) {
    if (in_span_ == 0) {
      curve_.t_s.push_back(t_s);
      curve_.difference.push_back(difference);
      curve_.tolerance.push_back(tolerance);
    } else if (difference > curve_.difference.back()) {
      curve_.t_s.back() = t_s;
      curve_.difference.back() = difference;
      curve_.tolerance.back() = tolerance;
    }
    if (++in_span_ < rows_a_span_) return;
    in_span_ = 0;
    if (curve_.t_s.size() == kMostSpans) halve();
  }
  DifferenceCurve take() { return std::move(curve_); }

 private:
  void halve() {
    for (std::size_t i = 0; i < kMostSpans / 2; ++i) {
      const std::size_t larger = curve_.difference[2 * i] >= curve_.difference[2 * i + 1] ? 2 * i : 2 * i + 1;
      curve_.t_s[i] = curve_.t_s[larger];
      curve_.difference[i] = curve_.difference[larger];
      curve_.tolerance[i] = curve_.tolerance[larger];
    }
    for (auto* values : {&curve_.t_s, &curve_.difference, &curve_.tolerance}) values->resize(kMostSpans / 2);
    rows_a_span_ *= 2;
  }
  DifferenceCurve curve_;
  std::size_t rows_a_span_ = 1, in_span_ = 0;
};

std::string at_time(double t_s) { return "t = " + time_text(t_s); }

/// The rows of another source up to a time; all of them without one.
class RowsUntil : public RowSource {
 public:
  RowsUntil(RowSource& rows, std::optional<double> until_s) : rows_(rows), until_s_(until_s) {}
  bool next(Row& row) override { return rows_.next(row) && !(until_s_ && row.t_s > *until_s_); }
  bool has_column(std::size_t column) const override { return rows_.has_column(column); }
  std::string where() const override { return rows_.where(); }
  double share_read() const override { return rows_.share_read(); }
  std::vector<std::string> other_columns() const override { return rows_.other_columns(); }

 private:
  RowSource& rows_;
  std::optional<double> until_s_;
};

/// Judges one measure, row after row.
class Judge {
 public:
  Judge(const Measure& measure, Rule rule, double scale, double effect, bool with_curve)
      : measure_(measure),
        rule_(std::move(rule)),
        scale_(scale),
        effect_(effect),
        fixed_(fixed_part(rule_, scale, effect)),
        most_for_bounds_(largest_for_bounds(scale, effect)),
        with_curve_(with_curve) {
    verdict_.name = measure.name;
  }

  const Measure& measure() const { return measure_; }
  double fixed() const { return fixed_; }
  void count_interpolation(double error) { verdict_.interpolation_error = error; }

  /// @param errors  sum of both error bounds; negative where they are not known
  void judge(double t_s, const Row& reference, const Row& candidate, double errors, bool same_digits_too) {
    ++verdict_.compared;
    const double found = difference(measure_, reference, candidate);
    double tolerance = std::max(fixed_, errors > 0 ? std::min(rule_.bounds * errors, most_for_bounds_) : 0) +
                       verdict_.interpolation_error.value_or(0);
    if (rule_.times > 0) {
      const double a = reference.value[measure_.column], b = candidate.value[measure_.column];
      tolerance = are_of_one_size(a, b, rule_.times, scale_) ? std::max(rule_.times * std::abs(a), found) : 0;
    }
    if (found > verdict_.largest || verdict_.compared == 1) {
      verdict_.largest = found;
      verdict_.at_s = t_s;
      largest_errors_ = errors;
    }
    const bool passed = found <= tolerance && same_digits_too;
    const double share = tolerance > 0 ? found / tolerance : passed ? 0 : std::numeric_limits<double>::infinity();
    verdict_.share = std::max(verdict_.share, share);
    if (!passed && verdict_.violations++ == 0) verdict_.first_violation_s = t_s;
    if (!same_digits_too && found == 0 && verdict_.reason.empty())
      verdict_.reason = fmt::format("different digits at {}", at_time(t_s));
    if (found > 0 || !same_digits_too) {
      moved_ = true;
      above_ = above_ || (errors >= 0 && found > errors);
      known_ = known_ && errors >= 0;
    }
    if (with_curve_) curve_.add(t_s, found, tolerance);
  }

  /// Records a failure: a value that only one of the two has, or that is not finite.
  void miss(double t_s, std::string reason) {
    if (verdict_.violations++ == 0) verdict_.first_violation_s = t_s;
    if (verdict_.reason.empty()) verdict_.reason = std::move(reason);
  }

  QuantityVerdict take() {
    verdict_.passed = verdict_.violations == 0;
    const double errors = std::max(largest_errors_, 0.0);
    const Tolerance there = tolerance_of(rule_, scale_, effect_, errors);
    verdict_.tolerance = there.value + verdict_.interpolation_error.value_or(0);
    verdict_.origin = there.origin;
    if (verdict_.interpolation_error) verdict_.origin += interpolation_words(*verdict_.interpolation_error);
    if (verdict_.compared > 0 && largest_errors_ >= 0) verdict_.errors = largest_errors_;
    if (verdict_.at_s) verdict_.where = at_time(*verdict_.at_s);
    if (verdict_.first_violation_s) verdict_.first_violation = at_time(*verdict_.first_violation_s);
    verdict_.change = !moved_ ? Change::none : above_ ? Change::above_errors : known_ ? Change::within_errors : Change::unknown;
    verdict_.curve = curve_.take();
    return std::move(verdict_);
  }

 private:
  const Measure& measure_;
  Rule rule_;
  double scale_, effect_, fixed_, most_for_bounds_;
  bool with_curve_;
  QuantityVerdict verdict_;
  double largest_errors_ = -1;
  bool moved_ = false, above_ = false, known_ = true;
  CurveBuilder curve_;
};

/// The columns of a table's error bounds, and others that are needed to turn them into bounds on measures.
struct BoundColumns {
  explicit BoundColumns(const Table& table)
      : axis(table.find("drift_axis_bound_rad")),
        attitude(table.find("drift_attitude_bound_rad")),
        tip(table.find("drift_tip_bound_m")),
        axis_L(table.find("axis_L_x")),
        ref_axis_L(table.find("ref_axis_L_x")),
        drift(table.find("drift_axis_rad")) {}
  std::optional<std::size_t> axis, attitude, tip, axis_L, ref_axis_L, drift;
};

double sum_of(const std::optional<std::size_t>& column, const Row& a, const Row& b) {
  if (!column || a.kind[*column] != CellKind::number || b.kind[*column] != CellKind::number) return -1;
  return a.value[*column] + b.value[*column];
}

/// Sum of both results' error bounds on a measure in two rows, in its unit; negative where they are not known.
double errors_of(const Measure& measure, const BoundColumns& columns, const RowsContext& context, double rate, const Row& a,
                 const Row& b) {
  switch (measure.bound) {
    case BoundKind::none: return -1;
    case BoundKind::drift_axis: return sum_of(columns.axis, a, b);
    case BoundKind::drift_attitude: return sum_of(columns.attitude, a, b);
    case BoundKind::drift_rates: {
      const double sum = sum_of(columns.attitude, a, b);
      return sum < 0 ? -1 : rate * sum;
    }
    case BoundKind::drift_tip: return sum_of(columns.tip, a, b);
    case BoundKind::drift_tilt:
    case BoundKind::drift_azimuth: {
      double sine = 1;
      for (const auto& axis : {columns.axis_L, columns.ref_axis_L})
        if (axis) sine = std::min(sine, real::hypot(a.value[*axis], a.value[*axis + 1]));
      const double sum = sum_of(columns.axis, a, b);
      const bool is_tilt = measure.bound == BoundKind::drift_tilt;
      if (sum < 0 || sine == 0) return is_tilt ? sum : -1;
      // If both axes have an error e, their azimuths have an error e / sin(tilt), and the directions along which the drift is
      // split into its parts are turned by as much. But no tilt has a larger error than its axis.
      const double turned =
          columns.drift && context.attitude_errors_known
              ? std::min(context.attitude_errors_rad, std::abs(a.value[*columns.drift]) * context.attitude_errors_rad / sine)
              : 0;
      return is_tilt ? sum + turned : (sum + turned) / sine;
    }
    case BoundKind::attitude: return context.attitude_errors_known ? context.attitude_errors_rad : -1;
    case BoundKind::rates: return context.attitude_errors_known ? rate * context.attitude_errors_rad : -1;
  }
  return -1;
}

class Comparison {
 public:
  Comparison(const Table& table, const RowsContext& context, const CompareOptions& options)
      : table_(table), context_(context), options_(options), bounds_(table), untrusted_(context.trust.doubts.size()) {}

  /// Makes one pass over both files. @returns whether it reached the end; false if rows must be interpolated and `known` does
  /// not hold the interpolation's errors
  bool pass(const Comparand& reference, RowSource& reference_rows, RowSource& candidate_rows, const Survey& known,
            const Watch& watch);
  RowsComparison take();

 private:
  void choose_measures(const RowSource& reference, const RowSource& candidate, const Survey& known);
  void judge(const Row& reference, const Row& candidate, bool between);
  void require_fine_rows(const Survey& known) const;
  void check_span(const PairingCounts& counts, const Survey& known);

  const Table& table_;
  const RowsContext& context_;
  const CompareOptions& options_;
  BoundColumns bounds_;
  std::vector<Judge> judges_;
  RowsComparison result_;
  double rate_ = 0;
  std::uint64_t not_finite_times_ = 0, other_signs_ = 0;
  std::vector<std::uint64_t> untrusted_;  // numbers of rows that were left out, by doubt
};

void Comparison::choose_measures(const RowSource& reference, const RowSource& candidate, const Survey& known) {
  rate_ = std::max(known.largest_rate_rad_s, context_.natural_rate_rad_s);
  const auto largest_of = [&](std::string_view name) {
    for (std::size_t i = 0; i < table_.measures.size(); ++i)
      if (table_.measures[i].name == name) return known.largest[i];
    return 0.0;
  };
  const std::string foreign = printable(input::listed(candidate.other_columns()));
  const std::string_view contents = table_.file.substr(0, table_.file.find('.'));  // their files may have other names
  std::string not_compared;
  for (std::size_t i = 0; i < table_.measures.size(); ++i) {
    const Measure& measure = table_.measures[i];
    const bool in_reference = reference.has(measure), in_candidate = candidate.has(measure);
    if (!in_reference && !in_candidate) continue;
    double effect = measure.effect == "rates_rad_s" ? known.rate_effect_rad_s : largest_of(measure.effect);
    // A part of the drift that vanishes for reasons of symmetry is the rounding of the whole drift.
    if (measure.effect.starts_with("drift_") && measure.effect.ends_with("_rad"))
      effect = std::max(effect, kRoundingOfSize * largest_of("drift_axis_rad"));
    const auto rule = rule_of(measure, options_.tolerances, context_.same_computation, effect);
    if (in_reference && in_candidate && rule) {
      judges_.emplace_back(measure, *rule, known.largest[i], effect, options_.with_curves);
      if (!known.interpolation_error.empty()) judges_.back().count_interpolation(known.interpolation_error[i]);
    } else if (in_reference && !in_candidate && options_.mapping.empty()) {
      result_.findings.push_back(
          {"missing column",
           fmt::format("{} is missing in the new {}{}", measure.first_column, contents,
                       foreign.empty()
                           ? ""
                           : fmt::format(", which has {} instead: is it in another unit, or under another name?", foreign))});
    } else if (!in_reference && in_candidate && context_.both_runs) {
      result_.findings.push_back(
          {"missing column", fmt::format("{} is missing in the {} of the reference", measure.first_column, contents)});
    } else if (options_.mapping.empty() || tells_motion(measure)) {
      not_compared += (not_compared.empty() ? "" : ", ") + std::string(measure.name);
    }
  }
  if (!not_compared.empty()) result_.notes.push_back(fmt::format("not compared: {}", not_compared));
  if (judges_.empty()) result_.findings.push_back({"nothing in common", "the two have no quantity in common"});
}

/// Whether the quaternions of two attitudes point to opposite sides; of nearly the same attitude, they have opposite signs.
bool have_other_signs(const Measure& measure, const Row& a, const Row& b) {
  double cosine = 0;
  for (std::size_t i = measure.column; i < measure.column + measure.width; ++i) cosine += a.value[i] * b.value[i];
  return cosine < 0;
}

/// Whether two rows have the same digits in a measure, including those that a double does not hold. Quaternions of opposite
/// signs count as the same.
bool same_digits(const Measure& measure, const Row& a, const Row& b) {
  const double sign = measure.kind == MeasureKind::attitude && have_other_signs(measure, a, b) ? -1 : 1;
  for (std::size_t i = measure.column; i < measure.column + measure.width; ++i)
    if (a.value[i] != sign * b.value[i] || (sign > 0 && a.more_digits[i] != b.more_digits[i])) return false;
  return true;
}

void Comparison::judge(const Row& reference, const Row& candidate, bool between) {
  if (options_.tolerances.profile != Profile::bitwise)
    for (std::size_t i = 0; i < untrusted_.size(); ++i)
      if (context_.trust.doubts[i].contains(candidate.t_s)) {
        ++untrusted_[i];
        return;
      }
  if (result_.rows++ == 0) result_.span.from_s = candidate.t_s;
  result_.span.to_s = candidate.t_s;
  if (result_.seen.size() < kMostSeen && !between) result_.seen.push_back({reference, candidate});
  for (Judge& judge : judges_) {
    const Measure& measure = judge.measure();
    const Presence a = presence(measure, reference), b = presence(measure, candidate);
    const double t_s = candidate.t_s;
    if (b == Presence::not_finite || a == Presence::not_finite) {
      judge.miss(t_s, fmt::format("not a finite number in the {} at {}", b == Presence::not_finite ? "new rows" : "reference",
                                  at_time(t_s)));
    } else if (a == Presence::whole && b == Presence::whole) {
      if (measure.kind == MeasureKind::attitude && have_other_signs(measure, reference, candidate) &&
          difference(measure, reference, candidate) < kNearlySame)
        ++other_signs_;
      judge.judge(t_s, reference, candidate, errors_of(measure, bounds_, context_, rate_, reference, candidate),
                  options_.tolerances.profile != Profile::bitwise || same_digits(measure, reference, candidate));
    } else if (a != b) {
      judge.miss(t_s,
                 fmt::format("empty in the {} alone at {}", b == Presence::empty ? "new rows" : "reference", at_time(t_s)));
    }
  }
}

/// Refuses rows that are too far apart to interpolate between them.
void Comparison::require_fine_rows(const Survey& known) const {
  const auto refuse = [&](const std::string& why) {
    throw ScenarioError("", fmt::format("the two have rows at different times, and those of the reference are too far apart "
                                        "for interpolation: {}; give both the same times, run the reference with a shorter "
                                        "motion.output_step_s, or allow more (--tolerances)",
                                        why));
  };
  const double turn = known.largest_rate_rad_s * known.largest_step_s;
  if (turn > kMostTurnBetweenRows) refuse(fmt::format("the body turns by {:.3g} rad from row to row", turn));
  for (std::size_t i = 0; i < table_.measures.size(); ++i)
    for (const Judge& judge : judges_) {
      const bool is_fixed = &judge.measure() == &table_.measures[i] && judge.measure().part != RowPart::error;
      if (!is_fixed || !(known.interpolation_error[i] > judge.fixed())) continue;
      const auto [error, tolerance] = told_apart(known.interpolation_error[i], judge.fixed(), 2);
      refuse(fmt::format("the error of {} between them may be {}, above its tolerance {}", judge.measure().name, error,
                         tolerance));
    }
}

/// Finds whether a CSV file has rows outside the reference's times, or lacks a part of them.
void Comparison::check_span(const PairingCounts& counts, const Survey& known) {
  const double end_s = std::min(options_.until_s.value_or(known.last_s), known.last_s);
  if (counts.beyond > 0)
    result_.findings.push_back(
        {"extra rows",
         fmt::format("{} new rows lie outside the reference's times, {} to {}, the first one at {}", counts.beyond,
                     time_text(known.first_s), time_text(known.last_s), at_time(counts.first_beyond_s))});
  if (!counts.first_s || !options_.may_lack_rows) return;  // else missing rows say it
  if (*counts.first_s > known.first_s)
    result_.findings.push_back(
        {"part of the time", fmt::format("the new rows begin at {}, the reference at {}; write the row of the release, too",
                                         at_time(*counts.first_s), at_time(known.first_s))});
  // The last row up to `until_s` may be one step of the new rows before it.
  const double step_s = (*counts.last_s - *counts.first_s) / static_cast<double>(std::max<std::uint64_t>(result_.rows, 2) - 1);
  const double enough_s = options_.until_s ? end_s - std::max(step_s, known.largest_step_s) : end_s;
  if (*counts.last_s < enough_s)
    result_.findings.push_back(
        {"part of the time",
         fmt::format("the new rows end at {}, but {} at {}; write all of them, or compare less (--until {:.10g})",
                     at_time(*counts.last_s), options_.until_s ? "--until" : "the reference", at_time(end_s), *counts.last_s)});
}

bool Comparison::pass(const Comparand& reference, RowSource& reference_rows, RowSource& candidate_rows, const Survey& known,
                      const Watch& watch) {
  if (options_.until_s && !(*options_.until_s <= known.last_s))
    throw ScenarioError("",
                        fmt::format("--until {}: the reference ends before, at {}", *options_.until_s, at_time(known.last_s)));
  choose_measures(reference_rows, candidate_rows, known);
  const bool interpolates = !known.interpolation_error.empty();
  if (interpolates) require_fine_rows(known);
  if (known.not_finite_times > 0)
    result_.findings.push_back(
        {"not finite", fmt::format("{} times of the reference are not finite numbers", known.not_finite_times)});
  Pairing pairing(reference_rows, candidate_rows, known, reference.has_some_rows_only);
  constexpr std::uint64_t kTell = 1024;
  std::uint64_t interpolated = 0, elsewhere = 0, paired_rows = 0;
  for (;;) {
    const PairedRow paired = pairing.next();
    if (++paired_rows % kTell == 0) tell(watch, candidate_rows.share_read());
    if (paired.kind == PairKind::end) break;
    if (paired.kind == PairKind::no_time) {
      if (not_finite_times_++ == 0)
        result_.findings.push_back({"not finite", fmt::format("{}: the time is not a finite number", candidate_rows.where())});
    } else if (paired.kind == PairKind::same_time) {
      judge(*paired.reference[1], *paired.candidate, false);
    } else if (paired.kind == PairKind::between) {
      if (context_.same_scenario) {
        if (elsewhere++ == 0)
          result_.findings.push_back(
              {"other times", at_time(paired.candidate->t_s) +
                                  " is not a time of the reference, though both are results of the same scenario"});
      } else if (!interpolates) {
        return false;
      } else {
        ++interpolated;
        judge(interpolate(paired.reference, paired.candidate->t_s), *paired.candidate, true);
      }
    }
  }
  const PairingCounts& counts = pairing.counts();
  const std::uint64_t missing = interpolated > 0 ? counts.missing_outside : counts.missing_outside + counts.missing_inside;
  if (missing > 0 && !options_.may_lack_rows)
    result_.findings.push_back(
        {"missing rows",
         fmt::format("{} of the reference's {} rows are missing in the new result, the first "
                     "one at {}",
                     missing, known.rows, at_time(interpolated > 0 ? counts.first_outside_s : counts.first_missing_s))});
  else if (missing > 0)
    result_.notes.push_back(
        fmt::format("{} of the reference's {} rows are missing in the new result, which was allowed", missing, known.rows));
  result_.span.of = known.rows;
  if (context_.is_file)
    check_span(counts, known);
  else if (counts.beyond > 0)
    result_.notes.push_back(fmt::format("{} new rows lie outside the reference's times, {} to {}: not compared", counts.beyond,
                                        time_text(known.first_s), time_text(known.last_s)));
  if (counts.beyond > 0 && context_.same_scenario)
    result_.findings.push_back({"extra rows", "the new result has rows that the reference of the same scenario lacks"});
  if (interpolated > 0)
    result_.notes.push_back(
        fmt::format("{} rows lie between the reference's: they are compared with its cubic Hermite interpolation, whose error "
                    "(for rows twice as far apart) is added to the tolerances",
                    interpolated));
  for (std::size_t i = 0; i < untrusted_.size(); ++i) {
    const Doubted& doubt = context_.trust.doubts[i];
    if (untrusted_[i] > 0)
      result_.notes.push_back(fmt::format("{} rows {} were not compared, since a verdict does not trust them", untrusted_[i],
                                          std::isfinite(doubt.until_s)
                                              ? fmt::format("between {} and {}", at_time(doubt.from_s), at_time(doubt.until_s))
                                              : fmt::format("after {}", at_time(doubt.from_s))));
  }
  if (other_signs_ > 0)
    result_.notes.push_back(fmt::format("{} quaternions have the opposite sign, which is the same attitude", other_signs_));
  if (result_.rows == 0) result_.findings.push_back({"nothing in common", "no row of the new result was compared"});
  return true;
}

RowsComparison Comparison::take() {
  for (Judge& judge : judges_) result_.quantities.push_back(judge.take());
  return std::move(result_);
}

/// Refuses a file whose number of rows is not the one that its summary states: it is incomplete, or the summary is another's.
void require_stated(const Comparand& comparand, const Table& table, const CountedRows& rows) {
  if (rows.count() == 0 && !comparand.has_summary()) refuse_file(comparand.path, "has no rows");
  const auto refuse = [&](std::string message) { refuse_file(comparand.path / table.file, std::move(message)); };
  if (rows.count() == 0) refuse("has no rows; run the scenario again");
  if (!comparand.stated_rows || comparand.has_some_rows_only || *comparand.stated_rows == rows.count()) return;
  const auto& gap = rows.gap_after_s();
  refuse(fmt::format("has {} rows where its summary states {}{}: truncated or changed; run the scenario again", rows.count(),
                     *comparand.stated_rows,
                     gap ? ", and a gap after " + at_time(*gap) : ", the last at " + at_time(rows.last_s())));
}

RowsComparison compare_tables(const Comparand& reference, const Comparand& candidate, const Table& table,
                              const std::function<std::unique_ptr<RowSource>()>& open_reference,
                              const std::function<std::unique_ptr<RowSource>()>& open_candidate, const RowsContext& context,
                              const CompareOptions& options, const Watch& watch) {
  constexpr double kSurvey = 0.3;  // share of the survey in the work: it reads one of the two files
  for (bool interpolates = false;; interpolates = true) {
    const auto surveyed = open_reference();
    CountedRows surveyed_rows(*surveyed);
    const Survey known = survey(surveyed_rows, table, interpolates, watch.part(0, kSurvey), context.end_s);
    require_stated(reference, table, surveyed_rows);
    Comparison comparison(table, context, options);
    const auto reference_rows = open_reference();
    const auto candidate_rows = open_candidate();
    CountedRows counted(*candidate_rows);
    RowsUntil reference_until(*reference_rows, options.until_s), candidate_until(counted, options.until_s);
    if (!comparison.pass(reference, reference_until, candidate_until, known, watch.part(kSurvey, 1))) continue;
    require_stated(candidate, table, counted);
    return comparison.take();
  }
}

}  // namespace

RowsComparison compare_rows(const Comparand& reference, const Comparand& candidate, const RowsContext& context,
                            const CompareOptions& options) {
  return compare_tables(reference, candidate, trajectory_table(), reference.open_rows, candidate.open_rows, context, options,
                        options.watch.part(0, reference.open_torques ? 0.5 : 1));
}

RowsComparison compare_torques(const Comparand& reference, const Comparand& candidate, const RowsContext& context,
                               const CompareOptions& options) {
  return compare_tables(reference, candidate, torques_table(), reference.open_torques, candidate.open_torques, context, options,
                        options.watch.part(0.5, 1));
}

}  // namespace earthtop::compare
