// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "earthtop/results/results.hpp"
#include "results/csv.hpp"
#include "results/digits.hpp"

namespace earthtop {
namespace {

constexpr std::string_view kHeader =
    "t_s,"
    "tau_phys_x_N_m,tau_phys_y_N_m,tau_phys_z_N_m,"
    "tau_cor_x_N_m,tau_cor_y_N_m,tau_cor_z_N_m,"
    "tau_trans_x_N_m,tau_trans_y_N_m,tau_trans_z_N_m,"
    "tau_cent_x_N_m,tau_cent_y_N_m,tau_cent_z_N_m,"
    "dL_dt_x_N_m,dL_dt_y_N_m,dL_dt_z_N_m,"
    "residual_x_N_m,residual_y_N_m,residual_z_N_m";

/// Which of kAppliedShares the scene has: those have columns of their own.
std::array<bool, kAppliedShares.size()> shares_of(const EffectsSpec& effects) {
  const AppliedTorquesSpec& applied = effects.applied;
  return {effects.tide.has_value(), applied.gravity_gradient.has_value(), applied.friction(), applied.gimbal.has_value()};
}

std::string header_of(const EffectsSpec& effects) {
  std::string header(kHeader);
  const auto shares = shares_of(effects);
  for (std::size_t i = 0; i < shares.size(); ++i)
    if (shares[i])
      for (const char axis : {'x', 'y', 'z'}) header += fmt::format(",tau_{}_{}_N_m", kAppliedShares[i], axis);
  return header + '\n';
}

template <class T, class Append>
void append_torques(std::string& text, const LedgerRow<T>& entry, const EffectsSpec& effects, Append append) {
  for (const std::array<T, 3>* torque_A :
       {&entry.tau_phys_A, &entry.tau_cor_A, &entry.tau_trans_A, &entry.tau_cent_A, &entry.dL_dt_A, &entry.residual_A})
    for (std::size_t i = 0; i < 3; ++i) {
      text += ',';
      append((*torque_A)[i]);
    }
  const auto shares = shares_of(effects);
  for (std::size_t share = 0; share < shares.size(); ++share)
    for (std::size_t i = 0; shares[share] && i < 3; ++i) {
      text += ',';
      append(entry.share_A[share][i]);
    }
}

}  // namespace

void write_torques_csv(const RunResult& result, const std::function<void(std::string_view)>& sink, const Watch& watch) {
  const std::size_t rows = result.ledger ? std::min(result.ledger->entries.size(), result.rows.size()) : 0;
  const EffectsSpec& effects = result.modelled.scenario().effects;
  const auto append_row = [&](std::string& text, std::size_t i) {
    append_number(text, result.rows[i].t_s);
    const LedgerReport& ledger = *result.ledger;
    if (ledger.extended_entries.empty())
      append_torques(text, ledger.entries[i], effects, [&](double value) { append_number(text, value); });
    else
      append_torques(text, ledger.extended_entries[i], effects,
                     [&](float128 value) { text += digits(value, result.scene.scenario().precision); });
    text += '\n';
  };
  write_csv(header_of(effects), rows, append_row, sink, watch);
}

std::string torques_csv(const RunResult& result) {
  std::string text;
  write_torques_csv(result, [&](std::string_view piece) { text += piece; });
  return text;
}

}  // namespace earthtop
