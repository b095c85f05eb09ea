#include <algorithm>
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
    "residual_x_N_m,residual_y_N_m,residual_z_N_m\n";

template <class T, class Append>
void append_torques(std::string& text, const LedgerEntry<T>& entry, Append append) {
  for (const Vec3<T>* torque_A :
       {&entry.tau_phys_A, &entry.tau_cor_A, &entry.tau_trans_A, &entry.tau_cent_A, &entry.dL_dt_A, &entry.residual_A})
    for (int i = 0; i < 3; ++i) {
      text += ',';
      append((*torque_A)[i]);
    }
}

}  // namespace

void write_torques_csv(const RunResult& result, const std::function<void(std::string_view)>& sink) {
  const std::size_t rows = result.ledger ? std::min(result.ledger->entries.size(), result.rows.size()) : 0;
  const auto append_row = [&](std::string& text, std::size_t i) {
    append_number(text, result.rows[i].t_s);
    const LedgerReport& ledger = *result.ledger;
    if (ledger.extended_entries.empty())
      append_torques(text, ledger.entries[i], [&](double value) { append_number(text, value); });
    else
      append_torques(text, ledger.extended_entries[i],
                     [&](float128 value) { text += digits(value, result.scenario.precision); });
    text += '\n';
  };
  write_csv(std::string(kHeader), rows, append_row, sink);
}

std::string torques_csv(const RunResult& result) {
  std::string text;
  write_torques_csv(result, [&](std::string_view piece) { text += piece; });
  return text;
}

}  // namespace earthtop
