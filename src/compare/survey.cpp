#include "compare/survey.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

#include "compare/interpolate.hpp"

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
  for (std::size_t i = 0; i < 3; ++i) sum += std::pow(row.value[rates.column + i] - row.value[reference_rates.column + i], 2);
  return std::sqrt(sum);
}

}  // namespace

Survey survey(RowSource& rows, const Table& table, bool with_interpolation) {
  Survey found;
  found.largest.assign(table.measures.size(), 0);
  found.interpolation_error.assign(with_interpolation ? table.measures.size() : 0, 0);
  const Measure* rates = find_measure(table, "rates_rad_s");
  const Measure* reference_rates = find_measure(table, "ref_rates_rad_s");
  constexpr std::size_t kLeaveOut = 7;  // of rows 0 to 6, row 3 as 0, 2, 4 and 6 give it
  std::deque<Row> last;
  Row row;
  while (rows.next(row)) {
    if (!std::isfinite(row.t_s)) continue;
    if (found.rows == 0) {
      found.first_s = row.t_s;
    } else {
      const double step = row.t_s - found.last_s;
      found.least_step_s = found.rows == 1 ? step : std::min(found.least_step_s, step);
      found.largest_step_s = std::max(found.largest_step_s, step);
    }
    found.last_s = row.t_s;
    ++found.rows;
    for (std::size_t i = 0; i < table.measures.size(); ++i)
      if (presence(table.measures[i], row) == Presence::whole)
        found.largest[i] = std::max(found.largest[i], size(table.measures[i], row));
    if (rates && reference_rates)
      found.rate_effect_rad_s = std::max(found.rate_effect_rad_s, rate_effect(*rates, *reference_rates, row));
    if (!with_interpolation) continue;
    last.push_back(row);
    if (last.size() < kLeaveOut) continue;
    const Row between = interpolate({&last[0], &last[2], &last[4], &last[6]}, last[3].t_s);
    for (std::size_t i = 0; i < table.measures.size(); ++i) {
      const Measure& measure = table.measures[i];
      if (presence(measure, last[3]) == Presence::whole && presence(measure, between) == Presence::whole)
        found.interpolation_error[i] = std::max(found.interpolation_error[i], difference(measure, last[3], between));
    }
    last.pop_front();
  }
  for (std::size_t i = 0; i < table.measures.size(); ++i)
    if (&table.measures[i] == rates || &table.measures[i] == reference_rates)
      found.largest_rate_rad_s = std::max(found.largest_rate_rad_s, found.largest[i]);
  return found;
}

}  // namespace earthtop::compare
