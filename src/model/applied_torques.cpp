// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/model/applied_torques.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "earthtop/frames/degrees.hpp"
#include "earthtop/frames/gravity_gradient.hpp"
#include "earthtop/model/moving_masses.hpp"

namespace earthtop {
namespace {

constexpr double kTransitionReynolds = 3e5;  ///< Schlichting, Boundary-Layer Theory, ch. V and XXI
/// Torque on both faces, C rho R^5 w^2 / 2: C = 3.87 Re^(-1/2) laminar, 0.146 Re^(-1/5) turbulent [von Karman, ZAMM 1 (1921);
/// Cochran 1934 for the first number; Schlichting, Boundary-Layer Theory, eqs. (5.56) and (21.30)].
constexpr double kLaminar = 3.87, kTurbulent = 0.146;

/// The coefficient c of -c |w|^n w: half the density times R^5 times the number above times (R^2/nu)^(n - 1).
double disc_coefficient(const AirDragSpec& disc, bool turbulent) {
  const double R = disc.disc_radius_m, reach = R * R / disc.kinematic_viscosity_m2_s;
  const double c = turbulent ? kTurbulent * real::pow(reach, -0.2) : kLaminar / std::sqrt(reach);
  return c * disc.density_kg_m3 / 2 * R * R * R * R * R;
}

std::array<GradientTerm<double>, 2> terms_of(const GravityGradientSpec& spec, const Site& site) {
  if (spec.field == GradientField::normal) return gradient_terms(gradient_L(spec, site));
  // A single term, exactly: 3 k u u^T - k 1.
  if (spec.field == GradientField::given) return {GradientTerm<double>{3 * spec.gm_over_r3_s2, Vec3<double>::UnitZ()}, {}};
  return {GradientTerm<double>{3 * geocentric_gm_over_r3(site.latitude_deg, site.height_m),
                               geocentric_up_L(site.latitude_deg, site.height_m)},
          {}};
}

/// K = kappa e e^T.
template <class T>
SupportStiffness<T> stiffness(const UnequalSupportSpec& spec, T kappa) {
  const SinCos<T> azimuth = sin_cos_degrees(T(spec.azimuth_deg));
  return {kappa * azimuth.sin * azimuth.sin, kappa * azimuth.sin * azimuth.cos, kappa * azimuth.cos * azimuth.cos};
}

template <class T>
GivenTorque<T> given_torque(const GivenTorqueSpec& spec, int mass_exponent, int time_exponent) {
  const int newton_metre = 2 * time_exponent - mass_exponent;
  GivenTorque<T> given;
  given.acts = true;
  given.in_laboratory = spec.axes == TorqueAxes::laboratory;
  if (spec.course == TorqueCourse::table) {
    std::array<std::shared_ptr<const AngleTable>, 3> rows;
    for (std::size_t i = 0; i < 3; ++i) rows[i] = spec.components[i].rows;
    given.table =
        std::make_shared<const PiecewisePath<T>>(path_of_tables<T>(rows).scaled(newton_metre).in_time_units(time_exponent));
    return given;
  }
  given.x = real::scale(T(spec.torque_N_m[0]), newton_metre);
  given.y = real::scale(T(spec.torque_N_m[1]), newton_metre);
  given.z = real::scale(T(spec.torque_N_m[2]), newton_metre);
  if (spec.course == TorqueCourse::constant) return given;
  given.oscillates = true;
  given.frequency = real::scale(T(spec.frequency_hz), time_exponent);
  given.phase = T(spec.phase_deg) * real::pi<T>() / T(180);
  return given;
}

}  // namespace

double disc_reynolds_number(const AirDragSpec& disc, double spin_rad_s) {
  return disc.disc_radius_m * disc.disc_radius_m * std::abs(spin_rad_s) / disc.kinematic_viscosity_m2_s;
}

bool is_turbulent(const AirDragSpec& disc, double spin_rad_s) {
  if (disc.flow != DiscFlow::automatic) return disc.flow == DiscFlow::turbulent;
  return disc_reynolds_number(disc, spin_rad_s) > kTransitionReynolds;
}

std::array<GradientTerm<double>, 2> gradient_terms(const Mat3<double>& gradient_L) {
  const Eigen::SelfAdjointEigenSolver<Mat3<double>> solver(gradient_L);  // eigenvalues in ascending order
  const Vec3<double>& k = solver.eigenvalues();
  // The middle eigenvalue is subtracted from all three: a multiple of the unit tensor exerts no torque.
  return {GradientTerm<double>{k[2] - k[1], solver.eigenvectors().col(2)},
          GradientTerm<double>{k[0] - k[1], solver.eigenvectors().col(0)}};
}

Mat3<double> gradient_L(const GravityGradientSpec& spec, const Site& site) {
  switch (spec.field) {
    case GradientField::given: return spherical_gradient(spec.gm_over_r3_s2, Vec3<double>::UnitZ());
    case GradientField::normal: return normal_gravity_gradient_L(site.latitude_deg, site.height_m);
    case GradientField::radial: break;
  }
  return spherical_gradient(geocentric_gm_over_r3(site.latitude_deg, site.height_m),
                            geocentric_up_L(site.latitude_deg, site.height_m));
}

template <class T>
AppliedTorques<T> make_applied_torques(const AppliedTorquesSpec& spec, const Site& site, double spin_rad_s, int mass_exponent,
                                       int time_exponent) {
  AppliedTorques<T> applied;
  applied.any = spec.any();
  applied.viscous = real::scale(T(spec.viscous_N_m_s), time_exponent - mass_exponent);
  applied.quadratic = real::scale(T(spec.quadratic_N_m_s2), -mass_exponent);
  applied.coulomb = real::scale(T(spec.coulomb_N_m), 2 * time_exponent - mass_exponent);
  if (spec.air_drag) {
    const bool turbulent = is_turbulent(*spec.air_drag, spin_rad_s);
    const T c = real::scale(T(disc_coefficient(*spec.air_drag, turbulent)), -mass_exponent);
    // The rate enters with the power 3/2 or 9/5, so that beside integer powers the unit of time enters with the power 1/2 or
    // 1/5.
    const T power = turbulent ? T(1) / T(5) : T(1) / T(2);
    (turbulent ? applied.disc_turbulent : applied.disc_laminar) = c * real::pow(T(2), power * T(time_exponent));
  }
  if (spec.gravity_gradient) {
    const auto terms = terms_of(*spec.gravity_gradient, site);
    for (std::size_t i = 0; i < terms.size(); ++i) {
      applied.gradient[i].strength = real::scale(T(terms[i].strength), 2 * time_exponent);
      for (int k = 0; k < 3; ++k) applied.gradient[i].direction_L[k] = T(terms[i].direction_L[k]);
    }
  }
  if (spec.gimbal) {
    applied.level_axis = true;
    applied.gimbal_damping = real::scale(T(spec.gimbal->damping_N_m_s), time_exponent - mass_exponent);
  }
  if (const auto& k = spec.viscous_by_axis_N_m_s) {
    T* const by_axis[] = {&applied.viscous_1, &applied.viscous_2, &applied.viscous_3};
    for (std::size_t i = 0; i < 3; ++i) *by_axis[i] = real::scale(T((*k)[i]), time_exponent - mass_exponent);
  }
  if (spec.unequal_support && !spec.unequal_support->periods_s)
    applied.support =
        stiffness<T>(*spec.unequal_support, real::scale(T(spec.unequal_support->kappa_N_m), 2 * time_exponent - mass_exponent));
  if (spec.given_torque) applied.given = given_torque<T>(*spec.given_torque, mass_exponent, time_exponent);
  return applied;
}
template AppliedTorques<double> make_applied_torques(const AppliedTorquesSpec&, const Site&, double, int, int);
template AppliedTorques<float80> make_applied_torques(const AppliedTorquesSpec&, const Site&, double, int, int);
template AppliedTorques<float128> make_applied_torques(const AppliedTorquesSpec&, const Site&, double, int, int);

template <class T>
SupportStiffness<T> support_of_periods(const UnequalSupportSpec& spec, T weight_torque) {
  const T ratio = T((*spec.periods_s)[1]) / T((*spec.periods_s)[0]);
  return stiffness<T>(spec, T(real::abs(weight_torque) * ((ratio - T(1)) * (ratio + T(1)))));
}
template SupportStiffness<double> support_of_periods(const UnequalSupportSpec&, double);
template SupportStiffness<float80> support_of_periods(const UnequalSupportSpec&, float80);
template SupportStiffness<float128> support_of_periods(const UnequalSupportSpec&, float128);

}  // namespace earthtop
