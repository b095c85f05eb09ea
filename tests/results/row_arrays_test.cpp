// SPDX-License-Identifier: GPL-3.0-or-later
// Rows as arrays: they have the numbers of the files, in their order and under their names.
#include "earthtop/results/row_arrays.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "earthtop/results/results.hpp"
#include "results/columns.hpp"
#include "results/made_up_run.hpp"

namespace earthtop {
namespace {

/// The number of a component in a row, wherever the array has it.
double number_of(const RowArray& array, std::size_t row, std::size_t component) {
  if (!array.places.empty()) return array.places[row];
  if (!array.copied.empty()) return array.copied[row * array.width() + component];
  double number = 0;
  const char* const place =
      reinterpret_cast<const char*>(array.first + component) + static_cast<std::ptrdiff_t>(row) * array.stride_bytes;
  std::memcpy(&number, place, sizeof number);
  return number;
}

/// The header of a file of these arrays.
std::string header_of(const std::vector<RowArray>& arrays) {
  std::string header;
  for (const RowArray& array : arrays)
    for (const std::string& column : array.columns) header += (header.empty() ? "" : ",") + column;
  return header;
}
std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

TEST(RowArrays, HaveTheNumbersOfTheRows) {
  RunResult result = test::made_up_run();
  for (const bool with_contact : {false, true}) {
    if (with_contact)
      for (DriftRow& row : result.rows) {
        BasicContactRow<double> contact;
        contact.tip_m = {row.t_s + 0.25, -row.t_s};
        contact.drift_tip_xy_m = {1 + row.t_s, 2 + row.t_s};
        contact.state = ContactState::roll;
        row.contact = contact;
      }
    result.rows.front().drift_azimuth_rad = std::nullopt;
    result.rows.back().drift_reliable = false;
    const std::vector<RowArray> arrays = row_arrays(result);
    EXPECT_EQ(header_of(arrays), first_line(trajectory_csv(result)));
    std::size_t place = 0;
    for (const RowArray& array : arrays) {
      ASSERT_EQ(array.rows, result.rows.size()) << array.name;
      EXPECT_FALSE(array.meaning.empty()) << array.name;
      for (std::size_t i = 0; i < array.columns.size(); ++i) {
        const Column* const column = array.name == kTimeColumn ? nullptr : &trajectory_columns()[place++];
        for (std::size_t row = 0; row < array.rows; ++row) {
          const std::optional<double> expected = column ? column->value(result.rows[row]) : result.rows[row].t_s;
          const double found = number_of(array, row, i);
          EXPECT_TRUE(expected ? found == *expected : std::isnan(found)) << array.name << " " << row;
        }
      }
    }
  }
}

TEST(RowArrays, OfNumbersAreNoCopies) {
  const RunResult result = test::made_up_run();
  const std::vector<RowArray> arrays = row_arrays(result);
  ASSERT_EQ(arrays.at(1).name, "q_LB");
  EXPECT_EQ(arrays[1].first, result.rows.front().q_LB.data());
}

TEST(RowArrays, OfALedgerHaveItsTorques) {
  EXPECT_TRUE(torque_arrays(test::made_up_run()).empty());
  const RunResult result = test::made_up_run_with_ledger();
  const std::vector<RowArray> arrays = torque_arrays(result);
  EXPECT_EQ(header_of(arrays), first_line(torques_csv(result)));
  ASSERT_EQ(arrays.at(2).name, "tau_cor_N_m");
  for (std::size_t row = 0; row < arrays[2].rows; ++row)
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(number_of(arrays[2], row, i), result.ledger->entries[row].tau_cor_A[i]);
}

TEST(RowArrays, AreAllAmongTheKindsThatThereAre) {
  std::string columns(kTimeColumn);
  for (const Column& column : trajectory_columns()) columns += "," + column.name;
  EXPECT_EQ(header_of(row_array_kinds()), columns);
  EXPECT_EQ(row_array_kinds().front().meaning, "time since the release");
  EXPECT_EQ(torque_array_kinds().size(), torque_quantities().size() + 1);
}

}  // namespace
}  // namespace earthtop
