// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/thinning.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "compare/tell.hpp"

namespace earthtop::report {
namespace {

constexpr std::uint64_t kAllUpTo = 1000, kSpans = 250;

using compare::CellKind;
using compare::Row;

/// Selects the rows of one span that must be kept.
class Span {
 public:
  explicit Span(std::vector<std::size_t> watched)
      : watched_(std::move(watched)), least_(watched_.size()), largest_(watched_.size()) {}

  void add(const Row& row) {
    if (count_++ == 0) {
      first_ = row;
      std::fill(least_.begin(), least_.end(), row);
      std::fill(largest_.begin(), largest_.end(), row);
    }
    last_ = row;
    for (std::size_t i = 0; i < watched_.size(); ++i) {
      const std::size_t column = watched_[i];
      if (row.kind[column] != CellKind::number) continue;
      if (least_[i].kind[column] != CellKind::number || row.value[column] < least_[i].value[column]) least_[i] = row;
      if (largest_[i].kind[column] != CellKind::number || row.value[column] > largest_[i].value[column]) largest_[i] = row;
    }
  }

  void flush(std::vector<Row>& kept) {
    if (count_ == 0) return;
    std::vector<Row> rows = {first_, last_};
    rows.insert(rows.end(), least_.begin(), least_.end());
    rows.insert(rows.end(), largest_.begin(), largest_.end());
    std::sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.t_s < b.t_s; });
    for (const Row& row : rows)
      if (kept.empty() || row.t_s > kept.back().t_s) kept.push_back(row);
    count_ = 0;
  }

 private:
  std::vector<std::size_t> watched_;
  std::uint64_t count_ = 0;
  Row first_, last_;
  std::vector<Row> least_, largest_;
};

}  // namespace

std::vector<Row> thinned_rows(compare::RowSource& rows, std::uint64_t count, const Watch& watch) {
  const compare::Table& table = compare::trajectory_table();
  std::vector<std::size_t> watched;
  for (const std::string_view name : {"drift_axis_rad", "drift_azimuth_rad", "drift_tilt_rad", "drift_tip_m", "slip_m_s"}) {
    const std::size_t column = *table.find(name);
    if (rows.has_column(column) || table.measure_of(column).owner == RowOwner::every_top) watched.push_back(column);
  }
  const auto span_of = [&](std::uint64_t row) { return count <= kAllUpTo ? row : row * kSpans / count; };
  std::vector<Row> kept;
  Span span(std::move(watched));
  Row row;
  for (std::uint64_t i = 0; rows.next(row); ++i) {
    if (i % 1024 == 0) compare::tell(watch, rows.share_read());
    if (!std::isfinite(row.t_s)) continue;
    span.add(row);
    if (span_of(i + 1) != span_of(i)) span.flush(kept);
  }
  span.flush(kept);
  return kept;
}

}  // namespace earthtop::report
