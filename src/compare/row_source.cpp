// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/row_source.hpp"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>

#include "earthtop/error.hpp"
#include "input/node.hpp"
#include "results/number_ranges.hpp"
#include "text/number_words.hpp"

namespace earthtop::compare {
namespace {

[[noreturn]] void refuse_at(const CsvReader& reader, std::string message) {
  throw ScenarioError(std::vector<Diagnostic>{{static_cast<int>(reader.line()), 1, "", std::move(message)}}, reader.file());
}

/// Refuses a row that is not later than the row before: rows are paired in the order of their times.
void require_later(const CsvReader& reader, double t_s, double& last_s) {
  if (t_s <= last_s)
    refuse_at(reader,
              fmt::format("the time {} is not later than that of the row before, {}", time_text(t_s), time_text(last_s)));
  if (std::isfinite(t_s)) last_s = t_s;
}

constexpr std::ptrdiff_t kDigitsOfDouble = 17;  // significant digits that read back to the same bits

/// The number of digits from the first one that is not 0.
std::ptrdiff_t significant_digits(std::string_view text) {
  text = text.substr(0, text.find_first_of("eE"));
  const std::size_t first = text.find_first_of("123456789");
  if (first == text.npos) return 0;
  return std::count_if(text.begin() + static_cast<std::ptrdiff_t>(first), text.end(),
                       [](char c) { return c >= '0' && c <= '9'; });
}

/// Whether a number's text has digits that a double does not hold.
bool has_more_digits(std::string_view text) {
  return static_cast<std::ptrdiff_t>(text.size()) > kDigitsOfDouble && significant_digits(text) > kDigitsOfDouble;
}

class OwnRows : public RowSource {
 public:
  OwnRows(const std::string& file, const Table& table) : reader_(file), table_(table) {
    const std::size_t time = reader_.find("t_s");
    std::vector<std::size_t> wanted = {time};
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      const std::size_t at = reader_.find(table.columns[i]);
      if (at == reader_.header().size()) continue;
      columns_.push_back(i);
      ranges_.push_back(range_of(table.columns[i]));
      wanted.push_back(at);
    }
    if (time == reader_.header().size() || columns_.empty())
      refuse_at(reader_, fmt::format("the header has none of the columns of {}, or no t_s; if another program wrote the file, "
                                     "say with --mapping what its columns mean",
                                     table.file));
    reader_.want(std::move(wanted));
    for (std::size_t i = 0; i < columns_.size(); ++i)
      if (const Measure& measure = table.measure_of(columns_[i]); measure.kind == MeasureKind::word)
        reader_.take_words(i + 1, measure.words);
  }

  bool next(Row& row) override {
    if (!reader_.next()) return false;
    const auto numbers = reader_.numbers();
    const auto kinds = reader_.kinds();
    row.t_s = numbers[0];
    count(kTime, reader_.text(0), row.t_s);
    require_later(reader_, row.t_s, last_s_);
    row.kind.fill(CellKind::empty);  // also of the bounds: a file without them states none
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (const std::string_view wanted = fault_of(ranges_[i], numbers[i + 1]);
          !wanted.empty() && kinds[i + 1] == CellKind::number)
        refuse_at(reader_, fmt::format("{} is {}, but must be {}", table_.columns[columns_[i]], numbers[i + 1], wanted));
      row.value[columns_[i]] = numbers[i + 1];
      row.kind[columns_[i]] = kinds[i + 1];
      const std::string_view text = reader_.text(i + 1);
      count(columns_[i], text, numbers[i + 1]);
      row.more_digits[columns_[i]] = has_more_digits(text) ? std::hash<std::string_view>()(text) : 0;
    }
    return true;
  }
  bool has_column(std::size_t column) const override {
    return std::find(columns_.begin(), columns_.end(), column) != columns_.end();
  }
  double share_read() const override { return reader_.share_read(); }
  std::string where() const override { return fmt::format("{}:{}", reader_.file(), reader_.line()); }
  std::vector<std::string> other_columns() const override {
    std::vector<std::string> others;
    for (const std::string& name : reader_.header())
      if (name != "t_s" && !table_.find(name)) others.push_back(name);
    return others;
  }

 private:
  CsvReader reader_;
  const Table& table_;
  std::vector<std::size_t> columns_;  // the table's columns that the file has
  std::vector<NumberRange> ranges_;   // of their numbers
  double last_s_ = -std::numeric_limits<double>::infinity();
};

class MappedRows : public RowSource {
 public:
  MappedRows(const std::string& file, const Mapping& mapping)
      : reader_(file, mapping.format), mapping_(mapping), R_LF_(matrix_of(mapping.world)), R_BF_(matrix_of(mapping.body)) {
    add(mapping.time_column);
    if (mapping.quaternion) quaternion_ = add_all(*mapping.quaternion, "q_LB_w");
    if (mapping.rates) rates_ = add_all(*mapping.rates, "w_LB_B_x_rad_s");
    if (mapping.axis) axis_ = add_all(*mapping.axis, "axis_L_x");
    if (quaternion_ && !axis_) axis_ = Group{0, *trajectory_table().find("axis_L_x"), 3};
    reader_.want(wanted_);
  }

  bool next(Row& row) override {
    if (mapping_.repeated == RepeatedTime::last) return next_last(row);
    const double before_s = last_s_;
    do
      if (!read(row)) return false;
    while (row.t_s == before_s);  // where no time may be repeated, `read` has refused it
    return true;
  }

  bool has_column(std::size_t column) const override {
    const auto in = [&](const std::optional<Group>& group) {
      return group && column >= group->first && column < group->first + group->size;
    };
    return in(quaternion_) || in(rates_) || in(axis_);
  }
  double share_read() const override { return reader_.share_read(); }
  std::string where() const override { return fmt::format("{}:{}", reader_.file(), reader_.line()); }

 private:
  bool read(Row& row) {
    if (!reader_.next()) return false;
    row.t_s = reader_.numbers()[0] * mapping_.time_unit_s + mapping_.time_offset_s;
    count(kTime, reader_.text(0), reader_.numbers()[0]);
    for (const auto& group : {quaternion_, rates_, axis_})
      for (std::size_t i = 0; group && group->from > 0 && i < group->size; ++i)
        count(group->first + i, reader_.text(group->from + i), reader_.numbers()[group->from + i]);
    if (row.t_s == last_s_ && mapping_.repeated == RepeatedTime::refused)
      refuse_at(reader_, fmt::format("a second row at {}; say in the mapping which one counts: time.repeated, first or last",
                                     time_text(row.t_s)));
    if (row.t_s != last_s_) require_later(reader_, row.t_s, last_s_);
    row.kind.fill(CellKind::empty);
    if (quaternion_) put_attitude(row);
    if (rates_) put_rates(row);
    if (axis_ && axis_->from > 0)
      put_vector(row, *axis_, R_LF_ * vector(*axis_));
    else if (axis_)
      put_axis_of(row);
    return true;
  }
  /// The last of the rows at the next time. One row is read ahead.
  bool next_last(Row& row) {
    if (!ahead_) has_ahead_ = read(ahead_.emplace());
    if (!has_ahead_) return false;
    do row = *ahead_;
    while ((has_ahead_ = read(*ahead_)) && ahead_->t_s == row.t_s);
    return true;
  }

  /// Columns that belong together: the place of the first of their numbers among those read (`from`; 0 if they are computed
  /// instead), the first column of the table to which they go, and their number.
  struct Group {
    std::size_t from, first, size;
  };

  void add(const std::string& column) {
    const std::size_t at = reader_.find(column);
    if (at == reader_.header().size())
      refuse_at(reader_, fmt::format("there is no column \"{}\", which {} names; the columns are {}", input::excerpt(column),
                                     mapping_.file, input::listed(reader_.header())));
    wanted_.push_back(at);
  }
  template <std::size_t n>
  Group add_all(const std::array<std::string, n>& columns, std::string_view first) {
    const Group group = {wanted_.size(), *trajectory_table().find(first), n};
    for (const std::string& column : columns) add(column);
    return group;
  }

  CellKind kind(const Group& group) const {
    const auto kinds = reader_.kinds().subspan(group.from, group.size);
    CellKind worst = CellKind::number;
    for (const CellKind kind : kinds)
      if (kind != CellKind::number) worst = kind;
    return worst;
  }
  Eigen::Vector3d vector(const Group& group) const {
    const auto numbers = reader_.numbers().subspan(group.from, group.size);
    return {numbers[0], numbers[1], numbers[2]};
  }
  void put(Row& row, const Group& group, std::span<const double> values) const {
    for (std::size_t i = 0; i < group.size; ++i) {
      row.value[group.first + i] = values[i];
      row.kind[group.first + i] = kind(group);
    }
  }
  void put_vector(Row& row, const Group& group, const Eigen::Vector3d& vector) const {
    put(row, group, std::array{vector.x(), vector.y(), vector.z()});
  }
  /// Sets the attitude from R_LB = R_LF R_FG R_GB, with the file's world axes F and body axes G.
  void put_attitude(Row& row) {
    const auto q = reader_.numbers().subspan(quaternion_->from, 4);
    Eigen::Quaterniond q_FG(q[0], q[1], q[2], q[3]);
    if (!mapping_.body_to_world) q_FG = q_FG.conjugate();
    const Eigen::Quaterniond q_LB = Eigen::Quaterniond(R_LF_) * q_FG * Eigen::Quaterniond(R_BF_).conjugate();
    put(row, *quaternion_, std::array{q_LB.w(), q_LB.x(), q_LB.y(), q_LB.z()});
  }
  /// Sets body axis 3, in laboratory axes, from the attitude.
  void put_axis_of(Row& row) const {
    const double* q = row.value.data() + quaternion_->first;
    const Eigen::Vector3d axis_L = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized() * Eigen::Vector3d::UnitZ();
    for (std::size_t i = 0; i < 3; ++i) {
      row.value[axis_->first + i] = axis_L[static_cast<Eigen::Index>(i)];
      row.kind[axis_->first + i] = row.kind[quaternion_->first];
    }
  }
  void put_rates(Row& row) const {
    put_vector(row, *rates_, rates_in_body_axes(row));
    // Rates in world axes are turned by the attitude: without it there are none.
    if (mapping_.rates_in_world_axes && row.kind[quaternion_->first] != CellKind::number)
      std::fill_n(row.kind.begin() + static_cast<std::ptrdiff_t>(rates_->first), rates_->size, row.kind[quaternion_->first]);
  }
  Eigen::Vector3d rates_in_body_axes(const Row& row) const {
    const Eigen::Vector3d given = mapping_.rate_unit_rad_s * vector(*rates_);
    if (!mapping_.rates_in_world_axes) return R_BF_ * given;
    const double* q = row.value.data() + quaternion_->first;
    return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().conjugate() * (R_LF_ * given);
  }

  CsvReader reader_;
  Mapping mapping_;
  Eigen::Matrix3d R_LF_, R_BF_;
  std::vector<std::size_t> wanted_;
  std::optional<Group> quaternion_, rates_, axis_;
  std::optional<Row> ahead_;
  bool has_ahead_ = false;
  double last_s_ = -std::numeric_limits<double>::infinity();
};

}  // namespace

void PrintedDigits::add(std::string_view text, double value) {
  if (!std::isfinite(value)) return;
  significant_ = std::max(significant_, static_cast<int>(significant_digits(text)));
  largest_ = std::max(largest_, std::abs(value));
  const std::size_t exponent = text.find_first_of("eE"), point = text.find('.');
  if (exponent == text.npos && point != text.npos) decimals_ = std::max(decimals_, static_cast<int>(text.size() - point - 1));
}

double PrintedDigits::rounding() const {
  if (significant_ == 0) return 0;
  // A number that was printed to N significant digits has fewer decimals the larger it is; one printed to D decimals has D.
  const int whole = largest_ > 0 ? static_cast<int>(std::ceil(real::log10(largest_))) : 0;
  const int last = whole - significant_;
  return 0.5 * real::power_of_ten(std::max(last, decimals_ > 0 ? -decimals_ : last));
}

bool RowSource::has(const Measure& measure) const {
  for (std::size_t i = measure.column; i < measure.column + measure.width; ++i)
    if (!has_column(i)) return false;
  return true;
}

std::unique_ptr<RowSource> open_own_csv(const std::string& file, const Table& table) {
  return std::make_unique<OwnRows>(file, table);
}

std::unique_ptr<RowSource> open_mapped_csv(const std::string& file, const Mapping& mapping) {
  return std::make_unique<MappedRows>(file, mapping);
}

}  // namespace earthtop::compare
