// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/columns.hpp"

#include "budget/effects.hpp"
#include "earthtop/scenario/support.hpp"

namespace earthtop {
namespace {

template <class Member>
constexpr TorqueQuantity torque(std::string_view stem, std::string_view meaning, std::string_view measure, Member member,
                                bool (*present)(const Scene&) = nullptr, RowPart part = RowPart::torque,
                                std::string_view unit = "_N_m") {
  return {valued<LedgerRow<double>, LedgerRow<float128>>({stem, unit, meaning, MeasureKind::vector, part, measure}, member),
          present};
}

/// Whether the table exerts more than a normal force.
bool has_table_friction(const Scene& scene) {
  const std::optional<ContactSpec>& contact = scene.scenario().contact;
  return contact &&
         (contact->law != ContactLaw::frictionless || contact->spinning_friction_m > 0 || contact->rolling_resistance_m > 0);
}

/// Whether something moves in the body, or the body in gimbals.
bool has_parts(const Scene& scene) {
  return scene.scenario().rotor || scene.scenario().gimbals || masses_move(scene.scenario());
}
bool travels(const Scene& scene) { return scene.scenario().travel.has_value(); }
bool has_gimbals(const Scene& scene) { return scene.scenario().gimbals.has_value(); }

constexpr TorqueQuantity kTorques[] = {
    torque("tau_phys",
           "physical torque: apparent gravity, the effect of a driven pivot, and everything else that acts on the top",
           "tau_phys_N_m", [](const auto& r) { return r.tau_phys_A; }),
    torque("tau_cor", "Coriolis torque", "tau_cor_N_m", [](const auto& r) { return r.tau_cor_A; }),
    torque("tau_trans", "transverse torque", "tau_trans_N_m", [](const auto& r) { return r.tau_trans_A; }),
    torque("tau_cent", "centrifugal torque", "tau_cent_N_m", [](const auto& r) { return r.tau_cent_A; }),
    torque("dL_dt", "time derivative of the angular momentum that the observer sees, from Euler's equation", "dL_dt_N_m",
           [](const auto& r) { return r.dL_dt_A; }),
    torque(
        "residual", "sum of the four torques minus the derivative: rounding errors", "residual_N_m",
        [](const auto& r) { return r.residual_A; }, nullptr, RowPart::error),
    torque(
        "tau_tide", "part of the physical torque: the tide", "tau_tide_N_m", [](const auto& r) { return r.share_A[0]; },
        [](const Scene& scene) { return has_share(scene, kAppliedShares[0]); }),
    torque(
        "tau_gradient", "part of the physical torque: the gravity gradient", "tau_gradient_N_m",
        [](const auto& r) { return r.share_A[1]; }, [](const Scene& scene) { return has_share(scene, kAppliedShares[1]); }),
    torque(
        "tau_friction", "part of the physical torque: friction of the pivot, of the air, or of a table with the tip",
        "tau_friction_N_m", [](const auto& r) { return r.share_A[2]; },
        [](const Scene& scene) { return has_share(scene, kAppliedShares[2]) || has_table_friction(scene); }),
    torque(
        "tau_gimbal", "part of the physical torque: the gimbal", "tau_gimbal_N_m", [](const auto& r) { return r.share_A[3]; },
        [](const Scene& scene) { return has_share(scene, kAppliedShares[3]); }),
    torque(
        "tau_support", "part of the physical torque: an unequal support", "tau_support_N_m",
        [](const auto& r) { return r.share_A[4]; }, [](const Scene& scene) { return has_share(scene, kAppliedShares[4]); }),
    torque(
        "tau_given", "part of the physical torque: a given torque", "tau_given_N_m", [](const auto& r) { return r.share_A[5]; },
        [](const Scene& scene) { return has_share(scene, kAppliedShares[5]); }),
    torque(
        "tau_cor_inertia", "part of the Coriolis torque: the change of the inertia that the observer sees",
        "tau_cor_inertia_N_m", [](const auto& r) { return r.tau_cor_inertia_A; }, has_parts),
    torque(
        "tau_cor_gyroscopic", "part of the Coriolis torque: gyroscopic, of the angular momentum that the observer sees",
        "tau_cor_gyroscopic_N_m", [](const auto& r) { return r.tau_cor_gyroscopic_A; }, has_parts),
    torque(
        "force_table", "force of the table on the tip", "force_table_N", [](const auto& r) { return r.force_table_A; },
        [](const Scene& scene) { return scene.support().has_contact; }, RowPart::torque, "_N"),
    torque(
        "bearing_outer", "torque of the support on the outer gimbal, which stands beside the physical torque",
        "bearing_outer_N_m", [](const auto& r) { return r.bearing_outer_A; }, has_gimbals),
    torque(
        "bearing_inner", "torque of the outer gimbal on the body", "bearing_inner_N_m",
        [](const auto& r) { return r.bearing_inner_A; }, has_gimbals),
    torque(
        "tau_cor_transport",
        "part of the Coriolis torque: the rate of East, North and Up over the Earth, which the journey makes",
        "tau_cor_transport_N_m", [](const auto& r) { return r.tau_cor_transport_A; }, travels),
};

constexpr bool shares_are_in_order() {
  constexpr std::size_t kFirst =
      std::size(kTorques) - 6 - kAppliedShares.size();  // those of a rotor, a table, gimbals and a journey are last
  for (std::size_t i = 0; i < kAppliedShares.size(); ++i)
    if (kTorques[kFirst + i].stem.substr(4) != kAppliedShares[i]) return false;
  return true;
}
static_assert(shares_are_in_order(), "the shares' columns are those of kAppliedShares");

}  // namespace

const std::vector<Column>& trajectory_columns() {
  static const std::vector<Column> columns = [] {
    std::vector<Column> all;
    for (const DriftQuantity& quantity : kDriftQuantities)
      for (std::size_t i = 0; i < quantity.width(); ++i) all.push_back({quantity.column(i), &quantity, i});
    return all;
  }();
  return columns;
}

std::span<const TorqueQuantity> torque_quantities() { return kTorques; }

}  // namespace earthtop
