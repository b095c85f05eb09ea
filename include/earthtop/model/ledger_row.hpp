// SPDX-License-Identifier: GPL-3.0-or-later
/// The torque ledger as a result keeps it: whose torques, and one row an instant.
#pragma once

#include <array>
#include <string_view>

namespace earthtop {

/// Whose torques a ledger lists: the frame that counts them, in its own axes. The inertial one is N, parallel to the laboratory
/// at t = 0. Without a platform, or on one that never turns, the platform's observer is the laboratory's.
enum class LedgerObserver { inertial, laboratory, platform, body };

std::string_view to_string(LedgerObserver observer);

/// What may act beside gravity and the pivot, each a share of the physical torques.
inline constexpr std::array<std::string_view, 4> kAppliedShares{"tide", "gradient", "friction", "gimbal"};

/// One instant's torques about the pivot (N m), in the axes of the observing frame: LedgerEntry (ledger.hpp) as a result keeps
/// it.
template <class T>
struct LedgerRow {
  std::array<T, 3> tau_phys_A = {};  ///< apparent gravity, what a driven pivot does, and the applied torques
  std::array<T, 3> tau_cor_A = {}, tau_trans_A = {}, tau_cent_A = {};
  std::array<T, 3> dL_dt_A = {};
  std::array<T, 3> residual_A = {};                                  ///< the sum of the four torques less dL_dt_A
  std::array<std::array<T, 3>, kAppliedShares.size()> share_A = {};  ///< of tau_phys_A, in the order of kAppliedShares
};

/// The largest norms of a ledger's torques over its rows (N m).
struct LedgerLargest {
  double tau_phys = 0;
  double tau_cor = 0;
  double tau_trans = 0;
  double tau_cent = 0;
  double dL_dt = 0;
  double residual = 0;

  void include(const LedgerRow<double>& row);
  /// The largest residual over the largest of all torques; 0 where there is no torque at all.
  double relative_residual() const;
};

}  // namespace earthtop
