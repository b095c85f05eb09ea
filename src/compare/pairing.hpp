// SPDX-License-Identifier: GPL-3.0-or-later
/// Pairing of the rows of two files by their times.
#pragma once

#include <array>
#include <cstdint>

#include "compare/row_source.hpp"
#include "compare/survey.hpp"

namespace earthtop::compare {

/// Passes on the rows of another source, counts them, and notes the first gap in their times.
class CountedRows : public RowSource {
 public:
  explicit CountedRows(RowSource& rows) : rows_(rows) {}
  bool next(Row& row) override {
    if (!rows_.next(row)) return false;
    if (count_ > 1 && !gap_after_s_ && row.t_s - last_s_ > kGap * step_s_) gap_after_s_ = last_s_;
    if (count_ > 0) step_s_ = row.t_s - last_s_;
    ++count_;
    last_s_ = row.t_s;
    return true;
  }
  bool has_column(std::size_t column) const override { return rows_.has_column(column); }
  std::string where() const override { return rows_.where(); }
  double share_read() const override { return rows_.share_read(); }
  std::vector<std::string> other_columns() const override { return rows_.other_columns(); }
  std::uint64_t count() const { return count_; }
  double last_s() const { return last_s_; }
  /// The first time (s) after which the step is more than kGap times the step before; none where there is no such time.
  const std::optional<double>& gap_after_s() const { return gap_after_s_; }

 private:
  static constexpr double kGap = 1.5;
  RowSource& rows_;
  std::uint64_t count_ = 0;
  double last_s_ = 0, step_s_ = 0;
  std::optional<double> gap_after_s_;
};

enum class PairKind {
  same_time,
  between,  ///< the candidate's time lies between two rows of the reference
  no_time,  ///< the candidate's time is not finite
  end
};

/// A row of the candidate with the rows of the reference around it. For `same_time`, reference[1] is the row of that time; for
/// `between`, reference[1] and reference[2] are the neighbours. Valid until the next call of `Pairing::next`.
struct PairedRow {
  PairKind kind = PairKind::end;
  std::array<const Row*, 4> reference{};
  const Row* candidate = nullptr;
};

struct PairingCounts {
  std::uint64_t missing_inside = 0;   ///< rows of the reference inside the candidate's times that have no partner
  std::uint64_t missing_outside = 0;  ///< rows of the reference before the candidate's first row or after its last one
  double first_missing_s = 0;         ///< the first of them all
  double first_outside_s = 0;         ///< the first of those outside
  std::uint64_t beyond = 0;           ///< rows of the candidate outside the reference's times
  double first_beyond_s = 0;
  // The times (s) from the first to the last row of the candidate inside the reference's times, or at their edge.
  std::optional<double> first_s, last_s;
};

class Pairing {
 public:
  /// @param known  survey of the reference: gives the times' accuracy
  /// @param some_rows_only  whether rows of the candidate between the reference's are skipped
  Pairing(RowSource& reference, RowSource& candidate, const Survey& known, bool some_rows_only);
  PairedRow next();
  const PairingCounts& counts() const { return counts_; }  ///< complete once `next` has given `end`

 private:
  Row& slot(std::size_t i) { return rows_[(first_ + i) % 4]; }
  bool read_reference(Row& row);
  void advance(bool outside);
  void miss(double t_s, bool outside);
  void lie_beyond(double t_s, double distance_s);
  void cover(double t_s);
  PairedRow finish();

  RowSource& reference_;
  RowSource& candidate_;
  bool some_rows_only_;
  double same_s_;  // times that differ by at most this are the same (s)
  double edge_s_;  // a row that lies beyond the reference's times by at most this lies at their edge (s)
  // Four neighbouring rows of the reference: slot(1) is the last one at or before the candidate's time (`here`), slot(0) the
  // one before it, slot(2) and slot(3) the two after it. The flags below tell which of them exist.
  std::array<Row, 4> rows_;
  std::size_t first_ = 0;
  bool has_before_ = false, has_here_ = false, has_next_ = false, has_after_ = false;
  bool matched_ = false;  // the row at or before the candidate's time has been paired
  bool started_ = false;
  Row row_;
  PairingCounts counts_;
};

}  // namespace earthtop::compare
