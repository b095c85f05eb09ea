#include <algorithm>
#include <string_view>

#include "earthtop/results/results.hpp"
#include "results/csv.hpp"

namespace earthtop {
namespace {

constexpr std::string_view kHeader =
    "t_s,"
    "tau_phys_x_N_m,tau_phys_y_N_m,tau_phys_z_N_m,"
    "tau_cor_x_N_m,tau_cor_y_N_m,tau_cor_z_N_m,"
    "tau_trans_x_N_m,tau_trans_y_N_m,tau_trans_z_N_m,"
    "tau_cent_x_N_m,tau_cent_y_N_m,tau_cent_z_N_m,"
    "dL_dt_x_N_m,dL_dt_y_N_m,dL_dt_z_N_m,"
    "residual_x_N_m,residual_y_N_m,residual_z_N_m\n";

}  // namespace

std::string torques_csv(const RunResult& result) {
  std::string text(kHeader);
  if (!result.ledger) return text;
  const std::vector<LedgerEntry<double>>& entries = result.ledger->entries;
  const std::size_t rows = std::min(entries.size(), result.rows.size());
  constexpr std::size_t kTypicalRow = 380;  // 19 numbers of up to 20 characters
  text.reserve(kHeader.size() + rows * kTypicalRow);
  for (std::size_t i = 0; i < rows; ++i) {
    const LedgerEntry<double>& entry = entries[i];
    append_number(text, result.rows[i].t_s);
    append_fields(text, entry.tau_phys_A);
    append_fields(text, entry.tau_cor_A);
    append_fields(text, entry.tau_trans_A);
    append_fields(text, entry.tau_cent_A);
    append_fields(text, entry.dL_dt_A);
    append_fields(text, entry.residual_A);
    text += '\n';
  }
  return text;
}

}  // namespace earthtop
