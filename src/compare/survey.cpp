// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/survey.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

#include "compare/interpolate.hpp"
#include "compare/tell.hpp"
#include "earthtop/elementary.hpp"

namespace earthtop::compare {
namespace {

const Measure* find_measure(const Table& table, std::string_view name) {
  const auto at = std::find_if(table.measures.begin(), table.measures.end(), [&](const Measure& m) { return m.name == name; });
  return at == table.measures.end() ? nullptr : &*at;
}

/// Size of w_LB - ref_w_LB; 0 where one of them is missing.
double rate_effect(const Measure& rates, const Measure& reference_rates, const Row& row) {
  if (presence(rates, row) != Presence::whole || presence(reference_rates, row) != Presence::whole) return 0;
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double difference = row.value[rates.column + i] - row.value[reference_rates.column + i];
    sum += difference * difference;
  }
  return std::sqrt(sum);
}

/// Finds the interpolation errors: interpolates each row from the rows around it, and compares the result with the row.
class LeaveOneOut {
 public:
  LeaveOneOut(const Table& table, std::vector<double>& errors) : table_(table), errors_(errors) {}
  void add(const Row& row) {
    last_.push_back(row);
    if (++rows_ == 5) judge({0, 0, 2, 4}, 1);  // the first span has no row before it
    if (last_.size() < 7) return;
    judge({0, 2, 4, 6}, 3);
    last_.pop_front();
  }
  void finish() {
    if (const std::size_t n = last_.size(); n >= 5) judge({n - 5, n - 3, n - 1, n - 1}, n - 2);
  }

 private:
  void judge(const std::array<std::size_t, 4>& around, std::size_t left_out) {
    const Row between =
        interpolate({&last_[around[0]], &last_[around[1]], &last_[around[2]], &last_[around[3]]}, last_[left_out].t_s);
    for (std::size_t i = 0; i < table_.measures.size(); ++i) {
      const Measure& measure = table_.measures[i];
      if (presence(measure, last_[left_out]) == Presence::whole && presence(measure, between) == Presence::whole)
        errors_[i] = std::max(errors_[i], difference(measure, last_[left_out], between));
    }
  }
  const Table& table_;
  std::vector<double>& errors_;
  std::deque<Row> last_;
  std::uint64_t rows_ = 0;
};

}  // namespace

Survey survey(RowSource& rows, const Table& table, bool with_interpolation, const Watch& watch, std::optional<double> until_s) {
  Survey found;
  found.largest.assign(table.measures.size(), 0);
  found.interpolation_error.assign(with_interpolation ? table.measures.size() : 0, 0);
  const Measure* rates = find_measure(table, "rates_rad_s");
  const Measure* reference_rates = find_measure(table, "ref_rates_rad_s");
  LeaveOneOut left_out(table, found.interpolation_error);
  constexpr std::uint64_t kTell = 1024;
  Row row;
  while (rows.next(row)) {
    if (!std::isfinite(row.t_s)) {
      ++found.not_finite_times;
      continue;
    }
    if (found.rows == 0) {
      found.first_s = row.t_s;
    } else {
      const double step = row.t_s - found.last_s;
      found.least_step_s = found.rows == 1 ? step : std::min(found.least_step_s, step);
      found.largest_step_s = std::max(found.largest_step_s, step);
    }
    found.last_s = row.t_s;
    if (++found.rows % kTell == 0) tell(watch, rows.share_read());
    if (until_s && row.t_s > *until_s) continue;
    for (std::size_t i = 0; i < table.measures.size(); ++i)
      if (presence(table.measures[i], row) == Presence::whole)
        found.largest[i] = std::max(found.largest[i], size(table.measures[i], row));
    if (rates && reference_rates)
      found.rate_effect_rad_s = std::max(found.rate_effect_rad_s, rate_effect(*rates, *reference_rates, row));
    if (with_interpolation) left_out.add(row);
  }
  if (with_interpolation) left_out.finish();
  for (std::size_t i = 0; i < table.measures.size(); ++i)
    if (&table.measures[i] == rates || &table.measures[i] == reference_rates)
      found.largest_rate_rad_s = std::max(found.largest_rate_rad_s, found.largest[i]);
  return found;
}

}  // namespace earthtop::compare
