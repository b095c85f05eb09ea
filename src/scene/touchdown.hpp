// SPDX-License-Identifier: GPL-3.0-or-later
/// The release of both predictions on a table: how the tip moves there, and with which force the table pushes.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/model/general_contact.hpp"
#include "earthtop/model/release.hpp"
#include "earthtop/scene/scene.hpp"

namespace earthtop {

/// In the table's axes and SI units. It refers to parts of the scene.
class Touchdown {
 public:
  explicit Touchdown(const Scene& scene)
      : spec_(*scene.scenario().contact),
        release_(scene.release<double>()),
        contact_(scene.table<double>().contact),
        start_(scene.table<double>().start),
        R_HB_(rotation_matrix(release_.q_LB)) {
    const Model<double> model =
        make_model<double>(scene.body<double>(), scene.site(), scene.rotation_rate_rad_s(), {}, nullptr);
    const Model<double> turned = in_table_axes(model, start_.q_LH);
    gravity_ = turned.apparent_gravity_L, W_ = turned.W_IL_L;
  }

  const ContactSpec& spec() const { return spec_; }
  bool is_symmetric() const { return earthtop::is_symmetric(contact_); }
  Vec3<double> r_c() const { return R_HB_ * contact_.p_OC_B; }
  double tilt_deg() const { return real::atan2(real::hypot(R_HB_(0, 2), R_HB_(1, 2)), R_HB_(2, 2)) * 180 / std::numbers::pi; }
  /// The rate relative to the table (rad/s) on the Earth, or without its rotation.
  Vec3<double> rate(bool on_earth) const {
    const Vec3<double> w = R_HB_ * release_.w_XB_B;
    return on_earth && release_.X == RatesRelativeTo::inertial ? Vec3<double>(w - W_) : w;
  }

  /// The table's reaction. @param without  a coefficient that is left out
  ContactReaction<double> reaction(bool on_earth, double Contact<double>::*without = nullptr) const {
    const Vec3<double> normal = Vec3<double>::UnitZ(), w = rate(on_earth), slip = this->slip(on_earth);
    Contact<double> contact = contact_;
    if (without) contact.*without = 0;
    // The exact law of dry friction holds a tip that does not slip.
    if (contact.law == ContactLaw::coulomb && contact.slip_floor == 0 && is_round_off(norm(slip)))
      contact.law = ContactLaw::rolling;
    const ContactSurroundings<double> around{normal, gravity_, on_earth ? W_ : Vec3<double>::Zero(), Mat3<double>::Zero()};
    const Vec3<double> momentum = turned_tensor(R_HB_, contact.I_BC_B) * w;
    return general_rates(contact, around, {R_HB_, momentum, slip, start_.p_O}).reaction;
  }

  /// The slip at release (m/s).
  Vec3<double> slip(bool on_earth) const { return slip_at_release(start_, contact_, rate(on_earth), r_c()); }
  /// Whether a slip is rounding of its terms.
  bool is_round_off(double slip) const {
    return slip <= 1e-12 * norm(rate(true)) * (norm(contact_.p_OC_B) + spec_.tip_radius_m);
  }
  /// The difference of both predictions' slips over that of their rates (m).
  double slip_apart_m() const {
    if (release_.X != RatesRelativeTo::inertial || !(norm(W_) > 0)) return 0;
    return norm(slip_difference_at_release(start_, contact_, Vec3<double>(W_ / norm(W_)), r_c()));
  }

  /// Below this the normal force is rounding of its terms (N): weight and centripetal force.
  double round_off_N() const {
    const double w = norm(rate(true));
    return 1e-12 * contact_.mass * (norm(gravity_) + w * w * (norm(contact_.p_OC_B) + spec_.tip_radius_m));
  }

  /// The slip velocity per friction impulse (1/kg) in the direction in which it is largest.
  double mobility() const {
    const Vec3<double> s = -(spec_.tip_radius_m * Vec3<double>::UnitZ() + r_c());
    const Mat3<double> inverse = turned_tensor(R_HB_, contact_.I_BC_B_inverse);
    const Vec3<double> x = s.cross(Vec3<double>::UnitX()), y = s.cross(Vec3<double>::UnitY());
    const double xx = x.dot(inverse * x), yy = y.dot(inverse * y), xy = x.dot(inverse * y);
    return 1 / contact_.mass + (xx + yy) / 2 + real::hypot((xx - yy) / 2, xy);
  }

  /// The rate (1/s) at which friction lets a small slip die out, as steps of an explicit method have to follow it; infinite where a law
  /// has a corner there, and 0 without sliding friction.
  double relaxation_rate_per_s() const { return slope() * mobility(); }

  double normal_force_N() const { return std::max(0.0, reaction(true).normal_force); }
  double largest_friction_N() const { return spec_.friction_coefficient * normal_force_N(); }

  /// The friction per slip where the slip is small (kg/s).
  double slope() const {
    switch (spec_.law) {
      case ContactLaw::frictionless:
      case ContactLaw::rolling: break;
      case ContactLaw::viscous: return spec_.sliding_viscosity_N_s_m;
      case ContactLaw::viscous_load: return spec_.sliding_viscosity_s_m * normal_force_N();
      case ContactLaw::coulomb:
        if (spec_.regularisation_m_s > 0) return largest_friction_N() / spec_.regularisation_m_s;
        break;  // the exact law's stops are events, which no step has to resolve
      case ContactLaw::contensou:
        if (spec_.friction_coefficient == 0) return 0;
        return largest_friction_N() / (contact_.slip_of_spin * spec_.patch_radius_m * std::abs(rate(true)[2]));
    }
    return 0;
  }

 private:
  const ContactSpec& spec_;
  const Release<double>& release_;
  const Contact<double>& contact_;
  const ContactRelease<double>& start_;
  Mat3<double> R_HB_;
  Vec3<double> gravity_, W_;
};

}  // namespace earthtop
