// SPDX-License-Identifier: GPL-3.0-or-later
/// The torque ledger as a result stores it: the observer, and one row for each instant.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace earthtop {

/// The observer whose torques a ledger lists, in the axes of his frame. The inertial frame is N, parallel to the laboratory at
/// t = 0. Without a platform, or on one that never turns, the platform observer is the same as the laboratory observer.
enum class LedgerObserver { inertial, laboratory, platform, body };

std::string_view to_string(LedgerObserver observer);

/// The effects that may act besides gravity and the pivot; each has its share of the physical torques.
/// `friction` is that of the pivot, of the air, or of a table with the tip; `support` that of an unequal support; `given` a
/// given torque.
inline constexpr std::array<std::string_view, 6> kAppliedShares{"tide", "gradient", "friction", "gimbal", "support", "given"};

/// The torques about the pivot, or about the centre of the tip's sphere of a top on a table, at one instant (N m), in the axes of
/// the observing frame: the stored form of LedgerEntry (ledger.hpp).
template <class T>
struct LedgerRow {
  std::array<T, 3> tau_phys_A = {};  ///< apparent gravity, the effect of a driven pivot, and the applied torques
  std::array<T, 3> tau_cor_A = {}, tau_trans_A = {}, tau_cent_A = {};
  std::array<T, 3> dL_dt_A = {};
  std::array<T, 3> residual_A = {};                                    ///< the sum of the four torques minus dL_dt_A
  std::array<std::array<T, 3>, kAppliedShares.size()> share_A = {};    ///< parts of tau_phys_A, in the order of kAppliedShares
  std::array<T, 3> tau_cor_inertia_A = {}, tau_cor_gyroscopic_A = {};  ///< the two parts of tau_cor_A
  std::array<T, 3> force_table_A = {};  ///< of a top on a table: the force of the table on the tip (N)
  /// Of a Cardan suspension: the torques of the support on the outer gimbal, and of that on the body.
  std::array<T, 3> bearing_outer_A = {}, bearing_inner_A = {};
  std::array<T, 3> tau_cor_transport_A = {};  ///< on a journey: the part of tau_cor_A that the transport rate makes
};

/// A row from anything with the members of a row or of a LedgerEntry.
/// @param stored  makes the stored form of one vector
template <class T, class Entry, class Store>
LedgerRow<T> ledger_row_from(const Entry& entry, Store stored) {
  LedgerRow<T> row{stored(entry.tau_phys_A), stored(entry.tau_cor_A), stored(entry.tau_trans_A),
                   stored(entry.tau_cent_A), stored(entry.dL_dt_A),   stored(entry.residual_A)};
  for (std::size_t i = 0; i < entry.share_A.size(); ++i) row.share_A[i] = stored(entry.share_A[i]);
  row.tau_cor_inertia_A = stored(entry.tau_cor_inertia_A), row.tau_cor_gyroscopic_A = stored(entry.tau_cor_gyroscopic_A);
  row.force_table_A = stored(entry.force_table_A);
  row.bearing_outer_A = stored(entry.bearing_outer_A), row.bearing_inner_A = stored(entry.bearing_inner_A);
  row.tau_cor_transport_A = stored(entry.tau_cor_transport_A);
  return row;
}

/// The largest norm of each torque over the rows of a ledger (N m).
struct LedgerLargest {
  double tau_phys = 0;
  double tau_cor = 0;
  double tau_trans = 0;
  double tau_cent = 0;
  double dL_dt = 0;
  double residual = 0;
  double bearing = 0;  ///< of the support on the outer gimbal, which stands beside the torques

  void include(const LedgerRow<double>& row);
  /// The largest residual over the largest of all torques; 0 if there is no torque at all.
  double relative_residual() const;
};

}  // namespace earthtop
