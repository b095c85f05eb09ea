// SPDX-License-Identifier: GPL-3.0-or-later
/// Makes the report of a torque ledger from its rows in the scalar of the run.
#pragma once

#include <type_traits>
#include <utility>
#include <vector>

#include "earthtop/run.hpp"

namespace earthtop {

template <class To, class From>
LedgerRow<To> ledger_cast(const LedgerRow<From>& row) {
  return ledger_row_from<To>(row, [](const std::array<From, 3>& v) {
    return std::array<To, 3>{static_cast<To>(v[0]), static_cast<To>(v[1]), static_cast<To>(v[2])};
  });
}

template <class T>
LedgerReport ledger_report(LedgerObserver observer, std::vector<LedgerRow<T>> rows) {
  LedgerReport report;
  report.observer = observer;
  if constexpr (std::is_same_v<T, double>) {
    report.entries = std::move(rows);
  } else {
    report.entries.reserve(rows.size());
    report.extended_entries.reserve(rows.size());
    for (const LedgerRow<T>& row : rows) {
      report.entries.push_back(ledger_cast<double>(row));
      report.extended_entries.push_back(ledger_cast<float128>(row));
    }
  }
  for (const LedgerRow<double>& entry : report.entries) report.largest.include(entry);
  return report;
}

}  // namespace earthtop
