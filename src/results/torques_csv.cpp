// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <string_view>
#include <vector>

#include "earthtop/results/results.hpp"
#include "results/columns.hpp"
#include "results/csv.hpp"
#include "results/digits.hpp"

namespace earthtop {
namespace {

/// The torques that have columns in a scene's torques.csv.
std::vector<const TorqueQuantity*> torques_of(const Scene& scene) {
  std::vector<const TorqueQuantity*> torques;
  for (const TorqueQuantity& torque : torque_quantities())
    if (!torque.present || torque.present(scene)) torques.push_back(&torque);
  return torques;
}

std::string header_of(const std::vector<const TorqueQuantity*>& torques) {
  std::string header(kTimeColumn);
  for (const TorqueQuantity* torque : torques)
    for (std::size_t i = 0; i < torque->width(); ++i) header += ',' + torque->column(i);
  return header + '\n';
}

}  // namespace

void write_torques_csv(const RunResult& result, const std::function<void(std::string_view)>& sink, const Watch& watch) {
  const std::size_t rows = result.ledger ? std::min(result.ledger->entries.size(), result.rows.size()) : 0;
  const std::vector<const TorqueQuantity*> torques = torques_of(result.modelled);
  const auto append_row = [&](std::string& text, std::size_t row) {
    append_number(text, result.rows[row].t_s);
    const LedgerReport& ledger = *result.ledger;
    const bool is_double = ledger.extended_entries.empty();
    for (const TorqueQuantity* torque : torques)
      for (std::size_t i = 0; i < torque->width(); ++i) {
        text += ',';
        if (is_double)
          append_number(text, *torque->value(ledger.entries[row], i));
        else
          text += digits(*torque->extended_value(ledger.extended_entries[row], i), result.scene.scenario().precision);
      }
    text += '\n';
  };
  CsvPieces csv(header_of(torques), sink);
  for (std::size_t row = 0; row < rows; ++row) {
    if (row % 1024 == 0) watch.reach(static_cast<double>(row) / static_cast<double>(rows));
    csv.add([&](std::string& text) { append_row(text, row); });
  }
  csv.flush();
}

std::string torques_csv(const RunResult& result) {
  std::string text;
  write_torques_csv(result, [&](std::string_view piece) { text += piece; });
  return text;
}

}  // namespace earthtop
