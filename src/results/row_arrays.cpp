// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/results/row_arrays.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <type_traits>

#include "results/columns.hpp"

namespace earthtop {
namespace {

RowArray described(const RowQuantity& quantity, std::size_t rows) {
  RowArray array{std::string(quantity.stem) + std::string(quantity.unit), quantity.meaning, quantity.components(),
                 quantity.words};
  array.rows = rows;
  for (std::size_t i = 0; i < quantity.width(); ++i) array.columns.push_back(quantity.column(i));
  return array;
}

template <class Row>
RowArray times(const std::vector<Row>& rows, std::size_t count) {
  RowArray array{std::string(kTimeColumn), "time since the release", "", "", false, {std::string(kTimeColumn)}, count};
  if (count > 0) array.first = &rows.front().t_s;
  array.stride_bytes = sizeof(Row);
  return array;
}

/// Points an array to the numbers of a member, or copies what is not a number in every row.
/// @param member  takes a row and gives a reference to the quantity's number, numbers, flag or word
template <class Member>
RowArray array_of(const std::vector<DriftRow>& rows, const RowQuantity& quantity, const Member& member) {
  RowArray array = described(quantity, rows.size());
  if (rows.empty()) return array;
  const auto& first = member(rows.front());
  using Value = std::remove_cvref_t<decltype(first)>;
  if constexpr (std::is_same_v<Value, double>) {
    array.first = &first;
  } else if constexpr (requires { first.data(); }) {
    array.first = first.data();
  } else if constexpr (std::is_same_v<Value, std::optional<double>>) {
    for (const DriftRow& row : rows) array.copied.push_back(member(row).value_or(std::numeric_limits<double>::quiet_NaN()));
  } else {
    for (const DriftRow& row : rows) array.places.push_back(static_cast<std::uint8_t>(member(row)));
  }
  if (array.first != nullptr) array.stride_bytes = sizeof(DriftRow);
  return array;
}

std::vector<RowArray> arrays_of(const std::vector<DriftRow>& rows) {
  std::vector<RowArray> arrays = {times(rows, rows.size())};
  for_each_drift_quantity(
      [&](auto member, const RowQuantity& quantity) { arrays.push_back(array_of(rows, quantity, member)); });
  if (!rows.empty() && rows.front().contact)
    for_each_contact_quantity([&](auto member, const RowQuantity& quantity) {
      const auto of_row = [&](const DriftRow& row) -> auto& { return member(*row.contact); };
      arrays.push_back(array_of(rows, quantity, of_row));
    });
  if (!rows.empty() && rows.front().rotor)
    for_each_rotor_quantity([&](auto member, const RowQuantity& quantity) {
      const auto of_row = [&](const DriftRow& row) -> auto& { return member(*row.rotor); };
      arrays.push_back(array_of(rows, quantity, of_row));
    });
  if (!rows.empty() && rows.front().gimbals)
    for_each_gimbal_quantity([&](auto member, const RowQuantity& quantity) {
      const auto of_row = [&](const DriftRow& row) -> auto& { return member(*row.gimbals); };
      arrays.push_back(array_of(rows, quantity, of_row));
    });
  if (!rows.empty() && rows.front().journey)
    for_each_journey_quantity([&](auto member, const RowQuantity& quantity) {
      const auto of_row = [&](const DriftRow& row) -> auto& { return member(*row.journey); };
      arrays.push_back(array_of(rows, quantity, of_row));
    });
  return arrays;
}

}  // namespace

std::vector<RowArray> row_arrays(const RunResult& result) { return arrays_of(result.rows); }
std::vector<RowArray> look_arrays(const RunResult& result) { return arrays_of(result.looks); }

std::vector<RowArray> row_array_kinds() {
  std::vector<RowArray> kinds = {times(std::vector<DriftRow>(), 0)};
  for (const DriftQuantity& quantity : kDriftQuantities) kinds.push_back(described(quantity, 0));
  return kinds;
}

std::vector<RowArray> torque_arrays(const RunResult& result) {
  if (!result.ledger) return {};
  const std::vector<LedgerRow<double>>& entries = result.ledger->entries;
  const std::size_t count = std::min(entries.size(), result.rows.size());
  std::vector<RowArray> arrays = {times(result.rows, count)};
  for (const TorqueQuantity& torque : torque_quantities()) {
    if (torque.present && !torque.present(result.modelled)) continue;
    RowArray array = described(torque, count);
    for (std::size_t row = 0; row < count; ++row)
      for (std::size_t i = 0; i < torque.width(); ++i) array.copied.push_back(*torque.value(entries[row], i));
    arrays.push_back(std::move(array));
  }
  return arrays;
}

std::vector<RowArray> torque_array_kinds() {
  std::vector<RowArray> kinds = {times(std::vector<DriftRow>(), 0)};
  for (const TorqueQuantity& torque : torque_quantities()) kinds.push_back(described(torque, 0));
  return kinds;
}

}  // namespace earthtop
