// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/model/model.hpp"

#include <algorithm>
#include <cmath>

namespace earthtop {

NaturalUnits natural_units(const Body<double>& body, const Release<double>& release, double gravity_m_s2,
                           double earth_rate_rad_s, const Platform<double>* platform) {
  const double largest_moment = std::max({body.I_BP_B(0, 0), body.I_BP_B(1, 1), body.I_BP_B(2, 2)});
  const double pendulum_rate = std::sqrt(body.mass * std::abs(gravity_m_s2) * norm(body.p_PBcm_B) / largest_moment);
  double fastest = std::max({norm(release.w_XB_B), pendulum_rate, std::abs(earth_rate_rad_s)});
  if (platform != nullptr) {
    const PrescribedMotion<double>& turn = platform->turn;
    fastest = std::max({fastest, std::abs(turn.rate), std::sqrt(std::abs(turn.acceleration)), 6.3 * std::abs(turn.frequency)});
    if (turn.table) fastest = std::max({fastest, turn.table->largest_rate(), std::sqrt(turn.table->largest_acceleration())});
    if (turn.journey) fastest = std::max(fastest, turn.journey->turned(0, 1));
  }
  // Where next to nothing moves, gravity in longer units of time would be beyond a double.
  constexpr double kSlowest = 0x1p-300;  // rad/s
  if (fastest > 0) fastest = std::max(fastest, kSlowest);
  NaturalUnits units;
  std::frexp(largest_moment, &units.mass_exponent);
  if (fastest > 0) {
    int rate_exponent = 0;
    std::frexp(fastest, &rate_exponent);
    units.time_exponent = -rate_exponent;
  }
  return units;
}

namespace {

template <class T, class Derived>
void rescale(Eigen::MatrixBase<Derived>& m, int exponent) {
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    for (Eigen::Index j = 0; j < m.cols(); ++j) m(i, j) = real::scale(m(i, j), exponent);
}

}  // namespace

template <class T>
Model<T> make_model(const Body<T>& body, const Site& site, double earth_rate_rad_s, const TorqueWeights<T>& weights,
                    const Platform<T>* platform, const NaturalUnits& units) {
  Model<T> model;
  model.I_BP_B = body.I_BP_B;
  model.I_BP_B_inverse = body.I_BP_B_inverse;
  model.S_BP_B = body.S_BP_B;
  model.mass_moment_B = body.mass * body.p_PBcm_B;
  model.apparent_gravity_L = apparent_gravity_L<T>(site);
  rescale<T>(model.I_BP_B, -units.mass_exponent);
  rescale<T>(model.I_BP_B_inverse, units.mass_exponent);
  rescale<T>(model.S_BP_B, -units.mass_exponent);
  rescale<T>(model.mass_moment_B, -units.mass_exponent);
  rescale<T>(model.apparent_gravity_L, 2 * units.time_exponent);

  const T rate = units.rate_from_rad_s(T(earth_rate_rad_s));
  const T size = real::abs(rate);
  model.epsilon = size < T(1) && size > T(0) ? size : T(1);
  // rate / epsilon is -1, 0, 1 or the rate itself: nothing is rounded, however small the rate is.
  model.W_IL_L_scaled = (rate / model.epsilon) * celestial_axis_L<T>(site);
  model.W_IL_L = model.epsilon * model.W_IL_L_scaled;

  model.weights = weights;
  const bool weighed = weights.coriolis != T(1) || weights.transverse != T(1) || weights.centrifugal != T(1);
  if (platform != nullptr) {
    model.platform = *platform;
    model.platform.turn = in_time_units(platform->turn, units.time_exponent);
  }
  model.kind = weighed || platform != nullptr ? SceneKind::full : SceneKind::plain;
  return model;
}
template Model<double> make_model(const Body<double>&, const Site&, double, const TorqueWeights<double>&,
                                  const Platform<double>*, const NaturalUnits&);
template Model<float80> make_model(const Body<float80>&, const Site&, double, const TorqueWeights<float80>&,
                                   const Platform<float80>*, const NaturalUnits&);
template Model<float128> make_model(const Body<float128>&, const Site&, double, const TorqueWeights<float128>&,
                                    const Platform<float128>*, const NaturalUnits&);

}  // namespace earthtop
