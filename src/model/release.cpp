// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/model/release.hpp"

#include <fmt/core.h>

#include "earthtop/model/contact_release.hpp"
#include "text/number_words.hpp"

namespace earthtop {
namespace {

constexpr const char* kPointer = "/release/precession";

template <class T>
Quaternion<T> about_axis(int axis, T degrees) {
  const SinCos<T> half = sin_cos_degrees(degrees / T(2));
  Quaternion<T> q;
  q.w = half.cos;
  q.v[axis] = half.sin;
  return q;
}

template <class T>
void require_symmetric_about_axis_3(const Body<T>& body) {
  const Mat3<T>& I = body.I_BP_B;
  if (I(0, 1) != T(0) || I(0, 2) != T(0) || I(1, 2) != T(0) || I(0, 0) != I(1, 1))
    throw ScenarioError(kPointer,
                        "no steady precession: the moments I1 and I2 about the pivot are not equal; give "
                        "{\"rate_rad_s\": ...} or \"none\"");
  if (body.p_PBcm_B[0] != T(0) || body.p_PBcm_B[1] != T(0))
    throw ScenarioError(kPointer,
                        "no steady precession: the centre of mass is off body axis 3; give {\"rate_rad_s\": ...} "
                        "or \"none\"");
}

/// The cosine of the tilt at which a symmetric top that leans is to precess steadily; exactly 0 where it is so to round-off.
/// @throws ScenarioError for any other body, or an axis that is vertical
template <class T>
T cosine_of_leaning(const Body<T>& body, const Quaternion<T>& q_LB) {
  require_symmetric_about_axis_3(body);
  const Mat3<T> R_LB = rotation_matrix(q_LB);
  const T cosine = R_LB(2, 2), sine = real::hypot(R_LB(0, 2), R_LB(1, 2));
  const T round_off = T(8) * real::epsilon<T>();
  if (sine <= round_off)
    throw ScenarioError(kPointer,
                        "no steady precession: the axis is vertical (tilt 0 or 180 deg), where every rate is steady; "
                        "give \"none\"");
  return real::abs(cosine) <= round_off ? T(0) : cosine;
}

/// @param steady_rate  function that gives the rate of the steady precession named, for an attitude
template <class T, class SteadyRate>
Release<T> released(const ReleaseSpec& spec, const SteadyRate& steady_rate) {
  Release<T> release;
  release.X = spec.rates_relative_to;
  if (spec.quaternion_LB) {
    const auto& q = *spec.quaternion_LB;
    release.q_LB = Quaternion<T>{T(q[0]), Vec3<T>(T(q[1]), T(q[2]), T(q[3]))}.normalized();
  } else {
    release.q_LB = release_attitude<T>(spec.tilt_deg, spec.azimuth_deg, spec.spin_angle_deg);
  }
  if (release.q_LB.w < T(0)) release.q_LB = {-release.q_LB.w, -release.q_LB.v};  // the sign convention of the results
  if (spec.angular_velocity_body_rad_s) {
    for (int i = 0; i < 3; ++i) release.w_XB_B[i] = T((*spec.angular_velocity_body_rad_s)[static_cast<std::size_t>(i)]);
    return release;
  }
  T rate = T(0);
  if (spec.precession == Precession::given)
    rate = T(spec.precession_rate_rad_s);
  else if (spec.precession != Precession::none)
    rate = steady_rate(release.q_LB);
  // The precession is about Up; the component of the rate along axis 3 is in total spin_rad_s.
  const Vec3<T> up_B = rotation_matrix(release.q_LB).row(2).transpose();
  release.w_XB_B = Vec3<T>(rate * up_B[0], rate * up_B[1], T(spec.spin_rad_s));
  return release;
}
}  // namespace

double rad_s_from_rpm(double rpm) {
  // The two roundings at 113 bits move the product by 2e-34 of itself: the rounding to double is that of the exact product but
  // for one number in 1e17.
  return static_cast<double>(float128(rpm) * real::pi<float128>() / float128(30));
}

template <class T>
Quaternion<T> release_attitude(double tilt_deg, double azimuth_deg, double spin_angle_deg) {
  return about_axis(2, T(90) - T(azimuth_deg)) * about_axis(1, T(tilt_deg)) * about_axis(2, T(spin_angle_deg));
}
template Quaternion<double> release_attitude(double, double, double);
template Quaternion<float80> release_attitude(double, double, double);
template Quaternion<float128> release_attitude(double, double, double);

template <class T>
T steady_precession_rate(const Body<T>& body, const Quaternion<T>& q_LB, T gravity, T w3, Precession which) {
  const T cosine = cosine_of_leaning(body, q_LB);
  if (cosine == T(0) && which == Precession::steady_fast)
    throw ScenarioError(kPointer,
                        "no fast steady precession: at a tilt of 90 deg there is only the slow one; take "
                        "\"steady_slow\"");
  const T spin_momentum = body.I_BP_B(2, 2) * w3;
  const T mgl = body.mass * gravity * body.p_PBcm_B[2];
  const T a = body.I_BP_B(0, 0) * cosine;
  const T discriminant = spin_momentum * spin_momentum - T(4) * a * mgl;
  if (discriminant < T(0))
    throw ScenarioError(kPointer,
                        fmt::format("no steady precession: the spin is too slow for this tilt; |spin_rad_s| must be "
                                    "at least {} rad/s",
                                    least_text(static_cast<double>(real::sqrt(T(4) * a * mgl) / body.I_BP_B(2, 2)), 9)));
  const T root = real::sqrt(discriminant);
  const T sum = spin_momentum < T(0) ? spin_momentum - root : spin_momentum + root;  // no cancellation
  if (sum == T(0))
    throw ScenarioError(kPointer,
                        "no steady precession: without spin and without a gravity torque every rate is steady or "
                        "none is; give \"none\"");
  return which == Precession::steady_fast ? sum / (T(2) * a) : T(2) * mgl / sum;
}
template double steady_precession_rate(const Body<double>&, const Quaternion<double>&, double, double, Precession);
template float80 steady_precession_rate(const Body<float80>&, const Quaternion<float80>&, float80, float80, Precession);
template float128 steady_precession_rate(const Body<float128>&, const Quaternion<float128>&, float128, float128, Precession);

template <class T>
Release<T> make_release(const ReleaseSpec& spec, const Body<T>& body, T gravity) {
  return released<T>(spec, [&](const Quaternion<T>& q_LB) {
    return steady_precession_rate(body, q_LB, gravity, T(spec.spin_rad_s), spec.precession);
  });
}
template Release<double> make_release(const ReleaseSpec&, const Body<double>&, double);
template Release<float80> make_release(const ReleaseSpec&, const Body<float80>&, float80);
template Release<float128> make_release(const ReleaseSpec&, const Body<float128>&, float128);

template <class T>
Release<T> make_release_on_table(const ReleaseSpec& spec, const Contact<T>& contact, const Body<T>& body, const Site& site) {
  return released<T>(spec, [&](const Quaternion<T>& q_HB) {
    const T cosine = cosine_of_leaning(body, q_HB);
    const auto rate = steady_precession_on_table(contact, T(site.gravity_m_s2), cosine, T(spec.spin_rad_s), spec.precession);
    if (!rate)
      throw ScenarioError(kPointer, fmt::format("no {} steady precession on this table at this spin and tilt; give a faster "
                                                "spin, {{\"rate_rad_s\": ...}} or \"none\"",
                                                spec.precession == Precession::steady_fast ? "fast" : "slow"));
    return *rate;
  });
}
template Release<double> make_release_on_table(const ReleaseSpec&, const Contact<double>&, const Body<double>&, const Site&);
template Release<float80> make_release_on_table(const ReleaseSpec&, const Contact<float80>&, const Body<float80>&, const Site&);
template Release<float128> make_release_on_table(const ReleaseSpec&, const Contact<float128>&, const Body<float128>&,
                                                 const Site&);

template <class T>
Release<T> make_release_on_table(const ReleaseSpec& spec, const ContactSpec& contact, const Body<T>& body, const Site& site) {
  return make_release_on_table<T>(spec, make_contact<T>(contact, body, site, {}, nullptr), body, site);
}
template Release<double> make_release_on_table(const ReleaseSpec&, const ContactSpec&, const Body<double>&, const Site&);
template Release<float80> make_release_on_table(const ReleaseSpec&, const ContactSpec&, const Body<float80>&, const Site&);
template Release<float128> make_release_on_table(const ReleaseSpec&, const ContactSpec&, const Body<float128>&, const Site&);

}  // namespace earthtop
