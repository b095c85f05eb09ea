// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/pairing.hpp"

#include <algorithm>
#include <cmath>

namespace earthtop::compare {

namespace {

constexpr double kSameTime = 1e-9;  // part of a step within which times count as the same
constexpr double kEdge = 1e-3;      // part of a step by which an engine's last time may have gone astray

}  // namespace

Pairing::Pairing(RowSource& reference, RowSource& candidate, const Survey& known, bool some_rows_only)
    : reference_(reference),
      candidate_(candidate),
      some_rows_only_(some_rows_only),
      same_s_(std::max(kSameTime * known.least_step_s, 4e-16 * std::abs(known.last_s))),
      edge_s_(kEdge * known.least_step_s) {
  has_here_ = read_reference(slot(1));
  has_next_ = has_here_ && read_reference(slot(2));
  has_after_ = has_next_ && read_reference(slot(3));
}

bool Pairing::read_reference(Row& row) {
  while (reference_.next(row))
    if (std::isfinite(row.t_s)) return true;
  return false;
}

/// Goes on by one row in the reference. @param outside  whether the row that is left lies outside the candidate's times
void Pairing::advance(bool outside) {
  if (!matched_) miss(slot(1).t_s, outside);
  matched_ = false;
  first_ = (first_ + 1) % 4;
  has_before_ = has_here_;
  has_here_ = has_next_;
  has_next_ = has_after_;
  has_after_ = has_next_ && read_reference(slot(3));
}

void Pairing::miss(double t_s, bool outside) {
  if (counts_.missing_inside + counts_.missing_outside == 0) counts_.first_missing_s = t_s;
  if (outside && counts_.missing_outside == 0) counts_.first_outside_s = t_s;
  ++(outside ? counts_.missing_outside : counts_.missing_inside);
}

void Pairing::cover(double t_s) {
  if (!counts_.first_s) counts_.first_s = t_s;
  counts_.last_s = t_s;
}

/// Counts a row outside the reference's times. @param distance_s  from the reference's last row, or to its first
void Pairing::lie_beyond(double t_s, double distance_s) {
  if (distance_s <= edge_s_) return cover(slot(1).t_s);
  if (counts_.beyond++ == 0) counts_.first_beyond_s = t_s;
}

PairedRow Pairing::next() {
  for (;;) {
    if (!candidate_.next(row_)) return finish();
    if (!std::isfinite(row_.t_s)) return {PairKind::no_time, {}, &row_};
    while (has_next_ && slot(2).t_s <= row_.t_s + same_s_) advance(!started_);
    started_ = true;
    const double distance = row_.t_s - slot(1).t_s;
    if (std::abs(distance) <= same_s_) {
      matched_ = true;
      cover(slot(1).t_s);
      return {PairKind::same_time, {nullptr, &slot(1), nullptr, nullptr}, &row_};
    }
    if (distance < 0 || !has_next_) {
      lie_beyond(row_.t_s, std::abs(distance));
      continue;
    }
    cover(row_.t_s);
    if (some_rows_only_) continue;
    return {
        PairKind::between, {has_before_ ? &slot(0) : &slot(1), &slot(1), &slot(2), has_after_ ? &slot(3) : &slot(2)}, &row_};
  }
}

PairedRow Pairing::finish() {
  while (has_here_) advance(!started_ || slot(1).t_s > row_.t_s);
  return {};
}

}  // namespace earthtop::compare
