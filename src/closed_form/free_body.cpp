// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/closed_form/free_body.hpp"

#include "closed_form/elliptic.hpp"
#include "closed_form/momentum_frame.hpp"
#include "closed_form/polhode.hpp"
#include "closed_form/principal_axes.hpp"

namespace earthtop {
namespace {

/// Error bounds: of one evaluation apart from its phases, in eps of T (rad, or relative to the rate); of the constants of a
/// phase and their product with the time, in eps of Wider<T>; of the number that decides on the side of the separatrix, in eps
/// of float128 (its own scalar); and of principal axes computed from a tensor, in eps of Wider<T>.
constexpr int kEvaluationRounding = 16;
constexpr int kPhaseRounding = 12;
constexpr int kSeparationRounding = 8;
constexpr int kTensorRounding = 32;

}  // namespace

/// The constants of one motion; a uniform rotation needs only the first four.
template <class T>
struct FreeBodyMotion {
  using W = Wider<T>;

  Quaternion<T> q_NM;         ///< for a uniform rotation: q0_NB
  Vec3<T> w0_B, turn_axis_B;  ///< rate and its direction
  W half_turn_rate = W(0);    ///< secular part of dpsi/dt / 2, or |w| / 2 (rad/s)

  W phase_rate = W(0), phase0 = W(0), period = W(1);  ///< argument of the theta series at a rate and a start, and its change in
                                                      ///< half a turn
  W linear = W(0);                                    ///< see PrecessionTheta
  T elliptic_per_phase = T(1), elliptic_rate = T(0);  ///< u divided by the argument; p (1/s)
  elliptic::Lattice<T> lattice;
  elliptic::PrecessionTheta<T> theta;
  Vec3<T> rate_amplitude, direction;
  T largest_rate = T(0);
  T separation_error = T(0), largest_growth = T(1);  ///< see `growth`
  Quaternion<T> q_PB;
  Mat3<T> R_BP;

  FreeBodyRegime prepare(const PrincipalAxes<W>& axes, const Quaternion<W>& q0_NB, const Vec3<W>& w0_B);
  void prepare_circling(const Polhode<W>& f, const Quaternion<W>& q_BQ, const Quaternion<W>& q0_NB);
  ClosedFormState<T> uniform_at(T t_s) const;
  ClosedFormState<T> circling_at(T t_s) const;
  T growth(T elliptic_phase, T swept) const;
};

template <class T>
FreeBodyRegime FreeBodyMotion<T>::prepare(const PrincipalAxes<W>& axes, const Quaternion<W>& q0_NB, const Vec3<W>& w_B) {
  const Vec3<W>& I = axes.moments;
  const Quaternion<W> q_NB = q0_NB.normalized();
  const Vec3<W> w_Q = (axes.q_BP.conjugate() * Quaternion<W>{W(0), w_B} * axes.q_BP).v;
  const int components = (w_Q[0] != W(0)) + (w_Q[1] != W(0)) + (w_Q[2] != W(0));
  const FreeBodyRegime regime = components == 0                ? FreeBodyRegime::at_rest
                                : I[0] == I[1] && I[1] == I[2] ? FreeBodyRegime::spherical
                                : components == 1              ? FreeBodyRegime::principal_axis
                                                               : FreeBodyRegime::symmetric;
  if (regime == FreeBodyRegime::symmetric) {
    const Polhode<W> f = make_polhode<W>(I, w_Q);
    prepare_circling(f, axes.q_BP, q_NB);
    return f.regime;
  }
  const W size = norm(w_B);
  q_NM = converted<T>(q_NB);
  w0_B = converted<T>(w_B);
  turn_axis_B = size > W(0) ? converted<T>(Vec3<W>(w_B / size)) : Vec3<T>(Vec3<T>::Zero());
  half_turn_rate = size / W(2);
  largest_rate = static_cast<T>(size);
  if (axes.q_BP.v != Vec3<W>::Zero() && regime != FreeBodyRegime::at_rest) {
    // Rounding may have made the moments of a tensor equal, or put the rate along one of its axes; about the middle axis such
    // an error grows.
    const int i = w_Q[0] != W(0) ? 0 : w_Q[1] != W(0) ? 1 : 2;
    const W I1 = I[i], I2 = I[(i + 1) % 3], I3 = I[(i + 2) % 3], square = (I2 - I1) * (I1 - I3) / (I2 * I3);
    const W largest = std::max(I1, std::max(I2, I3)), least = std::min(I1, std::min(I2, I3));
    const W gap = std::min(real::abs(I1 - I2), real::abs(I1 - I3)), of_axis = gap > W(0) ? largest / gap : W(1);
    separation_error = static_cast<T>(W(kTensorRounding) * real::epsilon<W>() * largest / least * of_axis);
    if (regime == FreeBodyRegime::principal_axis && square > W(0)) elliptic_rate = static_cast<T>(size * real::sqrt(square));
  }
  return regime;
}

template <class T>
void FreeBodyMotion<T>::prepare_circling(const Polhode<W>& f, const Quaternion<W>& q_BQ, const Quaternion<W>& q0_NB) {
  const elliptic::Lattice<W> wide = elliptic::lattice<W>(f.m, f.m1);
  const W tangent = real::sqrt(f.tangent_squared);
  const W eta = tangent >= W(0) && real::isfinite(f.m * f.tangent_squared)
                    ? tangent * elliptic::carlson_rf<W>(W(1), W(1) + f.m * f.tangent_squared, W(1) + f.tangent_squared)
                    : W(0);
  // If C is the largest moment, dpsi/dt is smallest where dn is largest; so its periodic part decreases there.
  const elliptic::PrecessionTheta<W> wide_theta(wide, eta, -f.s);
  phase_rate = f.p * wide.rate;
  phase0 = f.u0 * wide.rate;
  period = W(2) * wide.span;
  linear = wide_theta.linear;
  half_turn_rate = f.momentum_rate / W(2) - wide_theta.slope() * phase_rate;

  const Quaternion<W> body = f.from_body.template quaternion<W>() * q_BQ.conjugate();
  const elliptic::JacobiValues<W> j = elliptic::jacobi<W>(f.u0, wide);
  const Vec3<W> l(f.direction[0] * j.cn, f.s * f.direction[1] * j.sn, f.direction[2] * j.dn);
  elliptic::UnitPhasor<W> half = wide_theta.phasor(phase0);
  const auto [s, c] = real::sin_cos(W(linear * phase0));
  half = {half.cos * c + half.sin * s, half.sin * c - half.cos * s};
  q_NM = converted<T>((q0_NB * body.conjugate() * from_momentum_frame(half, l, W(1) + l[2]).conjugate()).normalized());
  q_PB = converted<T>(body.normalized());
  const Mat3<W> R_BQ = rotation_matrix(q_BQ);
  for (int i = 0; i < 3; ++i) R_BP.col(i) = converted<T>(times<W>(R_BQ, f.from_body.inverse(Vec3<W>(Vec3<W>::Unit(i)))));

  elliptic_per_phase = static_cast<T>(W(1) / wide.rate);
  elliptic_rate = static_cast<T>(f.p);
  lattice = elliptic::lattice<T>(static_cast<T>(f.m), static_cast<T>(f.m1));
  theta = elliptic::PrecessionTheta<T>(wide_theta);
  rate_amplitude = converted<T>(Vec3<W>(f.rate_amplitude[0], f.s * f.rate_amplitude[1], f.rate_amplitude[2]));
  direction = converted<T>(Vec3<W>(f.direction[0], f.s * f.direction[1], f.direction[2]));
  largest_rate = static_cast<T>(norm(f.rate_amplitude));
  // Given moments are exact; those computed from a tensor are not.
  const bool given = q_BQ.v == Vec3<W>::Zero();
  const W eps = real::epsilon<W>(), eps_of_term = static_cast<W>(real::epsilon<float128>());
  separation_error = static_cast<T>(!given                  ? W(kTensorRounding) * eps * f.largest_ratio
                                    : f.separation_is_exact ? W(0)
                                                            : W(kSeparationRounding) * eps_of_term);
  largest_growth = static_cast<T>(given ? W(1) / f.separation : f.condition);
}

template <class T>
ClosedFormState<T> FreeBodyMotion<T>::uniform_at(T t_s) const {
  const W exact = half_turn_rate * static_cast<W>(t_s);
  const T half = static_cast<T>(reduced_phase<W>(exact, real::pi<W>()).phase);
  const auto [s, c] = real::sin_cos(half);
  ClosedFormState<T> x;
  x.q_NB = scaled_to_unit(product(q_NM, Quaternion<T>{c, Vec3<T>(s * turn_axis_B[0], s * turn_axis_B[1], s * turn_axis_B[2])}));
  x.w_NB_B = w0_B;
  const T swept = static_cast<T>(real::abs(exact));
  const T of_axes = separation_error * (T(1) + swept) * real::exp(elliptic_rate * real::abs(t_s));
  const T error =
      T(kEvaluationRounding) * real::epsilon<T>() + T(kPhaseRounding) * static_cast<T>(real::epsilon<W>()) * swept + of_axes;
  x.attitude_error = std::min(error, real::pi<T>());
  x.rate_error = largest_rate * of_axes;
  return x;
}

/// The factor by which an error of the separation is multiplied in the attitude. Such an error shifts the elliptic argument at
/// the start, and again in each period; neither shift has more effect than a torque error has on an unstable motion.
template <class T>
T FreeBodyMotion<T>::growth(T elliptic_phase, T swept) const {
  if (separation_error == T(0)) return T(0);
  const T unstable = (T(1) + swept) * real::exp(elliptic_phase);
  return (T(1) + swept) + std::min(largest_growth, unstable) +
         std::min(elliptic_phase * largest_growth, (T(1) + swept) * unstable);
}

template <class T>
ClosedFormState<T> FreeBodyMotion<T>::circling_at(T t_s) const {
  const W t = static_cast<W>(t_s);
  const ReducedPhase<W> phase = reduced_phase<W>(phase_rate * t + phase0, period);
  const T v = static_cast<T>(phase.phase), flip = phase.odd ? T(-1) : T(1);
  const elliptic::JacobiValues<T> j = elliptic::jacobi<T>(v * elliptic_per_phase, lattice);
  const T cn = flip * j.cn, sn = flip * j.sn;

  const W secular = half_turn_rate * t;
  const T half = static_cast<T>(reduced_phase<W>(secular - linear * phase.phase, real::pi<W>()).phase);
  const auto [s, c] = real::sin_cos(half);
  const elliptic::UnitPhasor<T> periodic = theta.phasor(v);
  const elliptic::UnitPhasor<T> half_turn{periodic.cos * c - periodic.sin * s, periodic.sin * c + periodic.cos * s};

  const Vec3<T> l(direction[0] * cn, direction[1] * sn, direction[2] * j.dn);
  ClosedFormState<T> x;
  x.q_NB = scaled_to_unit(product(product(q_NM, from_momentum_frame(half_turn, l, T(1) + l[2])), q_PB));
  x.w_NB_B = times<T>(R_BP, Vec3<T>(rate_amplitude[0] * cn, rate_amplitude[1] * sn, rate_amplitude[2] * j.dn));

  const T elliptic_phase = elliptic_rate * real::abs(t_s);
  const T swept = elliptic_phase + static_cast<T>(real::abs(secular));
  const T relative = T(kEvaluationRounding) * real::epsilon<T>() +
                     T(kPhaseRounding) * static_cast<T>(real::epsilon<W>()) * swept +
                     separation_error * growth(elliptic_phase, swept);
  x.attitude_error = std::min(relative, real::pi<T>());
  x.rate_error = largest_rate * relative;
  return x;
}

template <class T>
FreeBody<T>::FreeBody(const Vec3<T>& moments, const Quaternion<T>& q0_NB, const Vec3<T>& w0_NB_B) {
  using W = Wider<T>;
  auto motion = std::make_shared<FreeBodyMotion<T>>();
  regime_ = motion->prepare({converted<W>(moments), Quaternion<W>{}}, converted<W>(q0_NB), converted<W>(w0_NB_B));
  motion_ = std::move(motion);
}

template <class T>
FreeBody<T>::FreeBody(const Mat3<T>& I_BP_B, const Quaternion<T>& q0_NB, const Vec3<T>& w0_NB_B) {
  using W = Wider<T>;
  Mat3<W> tensor;
  for (int j = 0; j < 3; ++j) tensor.col(j) = converted<W>(Vec3<T>(I_BP_B.col(j)));
  auto motion = std::make_shared<FreeBodyMotion<T>>();
  regime_ = motion->prepare(principal_axes<W>(tensor), converted<W>(q0_NB), converted<W>(w0_NB_B));
  motion_ = std::move(motion);
}

template <class T>
ClosedFormState<T> FreeBody<T>::at(T t_s) const {
  switch (regime_) {
    case FreeBodyRegime::at_rest:
    case FreeBodyRegime::spherical:
    case FreeBodyRegime::principal_axis: return motion_->uniform_at(t_s);
    default: return motion_->circling_at(t_s);
  }
}

template class FreeBody<double>;
template class FreeBody<float80>;
template class FreeBody<float128>;

}  // namespace earthtop
