// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/evidence.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compare/interpolate.hpp"
#include "compare/pairing.hpp"
#include "earthtop/elementary.hpp"
#include "earthtop/results/results.hpp"

namespace earthtop::compare {
namespace {

constexpr std::size_t kAtOnce = 60;                       // rows at the beginning that are all kept
constexpr std::size_t kMostKept = 360;                    // of all rows; then every second one of the later ones is dropped
constexpr double kNoQuaternion = 1e-6;                    // a shorter one is no attitude
constexpr int kFewestTimeDigits = 6, kDoubleDigits = 15;  // times with as many digits have been rounded

/// The rows of another source with times in another unit, up to a time.
class ScaledTimes : public RowSource {
 public:
  ScaledTimes(RowSource& rows, double factor, std::optional<double> until_s)
      : rows_(rows), factor_(factor), until_s_(until_s) {}
  bool next(Row& row) override {
    if (!rows_.next(row)) return false;
    last_s_ = row.t_s;
    row.t_s *= factor_;
    return !(until_s_ && row.t_s > *until_s_);
  }
  bool has_column(std::size_t column) const override { return rows_.has_column(column); }
  std::string where() const override { return rows_.where(); }
  double last_s() const { return last_s_; }  ///< before the factor

 private:
  RowSource& rows_;
  double factor_;
  std::optional<double> until_s_;
  double last_s_ = 0;
};

/// The columns of a trajectory that tell a top.
struct Columns {
  Columns(const char* attitude, const char* axis_x, const char* rate_x)
      : q(*trajectory_table().find(attitude)),
        axis(*trajectory_table().find(axis_x)),
        rates(*trajectory_table().find(rate_x)) {}
  std::size_t q, axis, rates;

  static bool has(const Row& row, std::size_t first, std::size_t count) {
    return std::all_of(row.kind.begin() + static_cast<std::ptrdiff_t>(first),
                       row.kind.begin() + static_cast<std::ptrdiff_t>(first + count),
                       [](CellKind kind) { return kind == CellKind::number; });
  }
  SeenTop of(const Row& row) const {
    const double* v = row.value.data();
    return {Eigen::Quaterniond(v[q], v[q + 1], v[q + 2], v[q + 3]), Eigen::Vector3d(v + axis), Eigen::Vector3d(v + rates)};
  }
};

const Columns& rotating() {
  static const Columns columns("q_LB_w", "axis_L_x", "w_LB_B_x_rad_s");
  return columns;
}
const Columns& predicted() {
  static const Columns columns("ref_q_LB_w", "ref_axis_L_x", "ref_w_LB_B_x_rad_s");
  return columns;
}

/// Collects samples: all of the first ones, and of the later ones as many as there is room for, evenly.
class Collector {
 public:
  explicit Collector(Evidence& evidence) : evidence_(evidence) {}
  void add(double t_s, const SeenTop& file, const SeenTop& reference) {
    const std::uint64_t number = count_++;
    if (number >= kAtOnce && (number - kAtOnce) % stride_ != 0) return;
    if (number < kAtOnce && !interrupted_) ++evidence_.in_a_row;
    evidence_.t_s.push_back(t_s), evidence_.file.push_back(file), evidence_.reference.push_back(reference);
    if (evidence_.size() == kMostKept) halve();
  }

  /// A row is left out.
  void interrupt() { interrupted_ = true; }

 private:
  void halve() {
    std::size_t kept = kAtOnce;
    for (std::size_t i = kAtOnce; i < evidence_.size(); i += 2, ++kept) {
      evidence_.t_s[kept] = evidence_.t_s[i];
      evidence_.file[kept] = evidence_.file[i], evidence_.reference[kept] = evidence_.reference[i];
    }
    evidence_.t_s.resize(kept), evidence_.file.resize(kept), evidence_.reference.resize(kept);
    stride_ *= 2;
  }
  Evidence& evidence_;
  std::uint64_t count_ = 0, stride_ = 1;
  bool interrupted_ = false;
};

void note_effect(const Row& row, Evidence& evidence) {
  const Columns &now = rotating(), &then = predicted();
  const SeenTop a = now.of(row), b = then.of(row);
  const auto has = [&](std::size_t one, std::size_t other, std::size_t count) {
    return Columns::has(row, one, count) && Columns::has(row, other, count);
  };
  ByMeasure& effect = evidence.effect;
  if (has(now.q, then.q, 4)) effect.attitude = std::max(effect.attitude, turn_between(a.q, b.q));
  if (has(now.axis, then.axis, 3)) effect.axis = std::max(effect.axis, angle_of(a.axis, b.axis));
  if (has(now.rates, then.rates, 3)) effect.rates = std::max(effect.rates, (a.rates - b.rates).norm());
  if (Columns::has(row, now.rates, 3)) evidence.largest_rate = std::max(evidence.largest_rate, a.rates.norm());
}

/// The error by which the components of a vector may have been rounded, in the file's unit.
double rounding_of(const RowSource& rows, std::size_t first, std::size_t count) {
  double squares = 0;
  for (std::size_t i = first; i < first + count; ++i) squares += rows.digits(i).rounding() * rows.digits(i).rounding();
  return std::sqrt(squares);
}

void note_rounding(const RowSource& rows, const Mapping& mapping, Evidence& evidence) {
  const Columns& columns = rotating();
  for (std::size_t i = 0; i < RowSource::kTime; ++i) evidence.digits = std::max(evidence.digits, rows.digits(i).significant());
  const PrintedDigits& times = rows.digits(RowSource::kTime);
  const bool rounded = times.significant() >= kFewestTimeDigits && times.significant() < kDoubleDigits;
  const double time_s = rounded ? times.rounding() * mapping.time_unit_s : 0;
  evidence.rounding.attitude = 2 * rounding_of(rows, columns.q, 4) + evidence.largest_rate * time_s;
  evidence.rounding.axis = rounding_of(rows, columns.axis, 3) + evidence.largest_rate * time_s;
  evidence.rounding.rates =
      rounding_of(rows, columns.rates, 3) * mapping.rate_unit_rad_s + evidence.largest_rate * evidence.largest_rate * time_s;
}

}  // namespace

double angle_of(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return real::atan2(a.cross(b).norm(), a.dot(b)); }

double turn_between(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  const Eigen::Quaterniond turn = a.conjugate() * b;
  return 2 * real::atan2(turn.vec().norm(), std::abs(turn.w()));
}

Evidence gather(const Comparand& reference, const Comparand& candidate, const Survey& known, const Mapping& mapping,
                double time_factor, std::optional<double> until_s, const Watch& watch) {
  Evidence evidence;
  const auto reference_rows = reference.open_rows(), file_rows = candidate.open_rows();
  file_rows->count_digits();
  ScaledTimes scaled(*file_rows, time_factor, until_s), until(*reference_rows, 1, until_s);
  const Columns& columns = rotating();
  const auto both_have = [&](std::size_t first, std::size_t count) {
    bool have = true;
    for (std::size_t i = first; i < first + count; ++i)
      have = have && reference_rows->has_column(i) && file_rows->has_column(i);
    return have;
  };
  evidence.attitude = both_have(columns.q, 4), evidence.axis = both_have(columns.axis, 3),
  evidence.rates = both_have(columns.rates, 3);
  Pairing pairing(until, scaled, known, reference.has_some_rows_only);
  Collector collector(evidence);
  const bool is_fine = known.largest_rate_rad_s * known.largest_step_s <= kMostTurnBetweenRows;
  for (PairedRow paired = pairing.next(); paired.kind != PairKind::end; paired = pairing.next()) {
    if (watch.asks_to_stop()) throw Interrupted();
    if (paired.kind == PairKind::no_time || (paired.kind == PairKind::between && !is_fine)) continue;
    const Row& row = *paired.candidate;
    const Row there = paired.kind == PairKind::between ? interpolate(paired.reference, row.t_s) : *paired.reference[1];
    ++evidence.rows;
    note_effect(there, evidence);
    const bool is_whole = (!evidence.attitude || (Columns::has(row, columns.q, 4) && Columns::has(there, columns.q, 4))) &&
                          (!evidence.axis || (Columns::has(row, columns.axis, 3) && Columns::has(there, columns.axis, 3))) &&
                          (!evidence.rates || (Columns::has(row, columns.rates, 3) && Columns::has(there, columns.rates, 3)));
    const SeenTop file = columns.of(row);
    const double norm = evidence.attitude && Columns::has(row, columns.q, 4) ? file.q.norm() : 1;
    if (norm < kNoQuaternion && evidence.zeros++ == 0) evidence.first_zero_s = row.t_s;
    if (!is_whole || norm < kNoQuaternion) {
      collector.interrupt();
      continue;
    }
    evidence.least_norm = std::min(evidence.least_norm, norm);
    evidence.largest_norm = std::max(evidence.largest_norm, norm);
    collector.add(row.t_s, file, columns.of(there));
  }
  evidence.last_s = scaled.last_s();
  note_rounding(*file_rows, mapping, evidence);
  return evidence;
}

}  // namespace earthtop::compare
