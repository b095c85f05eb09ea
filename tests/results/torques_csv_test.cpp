// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <limits>

#include "earthtop/results/results.hpp"
#include "results/made_up_run.hpp"

namespace earthtop {
namespace {

using test::made_up_run_with_ledger;

constexpr const char* kHeader =
    "t_s,tau_phys_x_N_m,tau_phys_y_N_m,tau_phys_z_N_m,tau_cor_x_N_m,tau_cor_y_N_m,tau_cor_z_N_m,"
    "tau_trans_x_N_m,tau_trans_y_N_m,tau_trans_z_N_m,tau_cent_x_N_m,tau_cent_y_N_m,tau_cent_z_N_m,"
    "dL_dt_x_N_m,dL_dt_y_N_m,dL_dt_z_N_m,residual_x_N_m,residual_y_N_m,residual_z_N_m\n";

TEST(TorquesCsv, HeaderIsTheContractsAndEveryColumnHoldsItsOwnNumber) {
  RunResult result = made_up_run_with_ledger(2);
  result.rows[1].t_s = 0.1;
  EXPECT_EQ(torques_csv(result), std::string(kHeader) + "0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18\n" +
                                     "0.1,2,4,6,8,10,12,14,16,18,20,22,24,26,28,30,32,34,36\n");
}

TEST(TorquesCsv, NumbersAreShortestAndWhatIsNotFiniteIsEmpty) {
  RunResult result = made_up_run_with_ledger(2);
  result.ledger->entries.resize(1);
  LedgerRow<double>& entry = result.ledger->entries[0];
  entry.tau_phys_A = {5e-324, std::numeric_limits<double>::quiet_NaN(), 1.0 / 3};
  entry.residual_A[2] = -std::numeric_limits<double>::infinity();
  EXPECT_EQ(torques_csv(result), std::string(kHeader) + "0,5e-324,,0.3333333333333333,4,5,6,7,8,9,10,11,12,13,14,15,16,17,\n");
}

TEST(TorquesCsv, WithoutALedgerThereIsTheHeader) { EXPECT_EQ(torques_csv(test::made_up_run()), kHeader); }

}  // namespace
}  // namespace earthtop
