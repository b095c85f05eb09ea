// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/closed_form/special_cases.hpp"

#include "closed_form/wider.hpp"

namespace earthtop {
namespace {

/// Error bounds: of one evaluation apart from its phases, in eps of T; of a phase, in eps of Wider<T>.
constexpr int kEvaluationRounding = 16;
constexpr int kPhaseRounding = 12;

template <class T>
struct CosSin {
  T cos, sin;
};
/// Cosine and sine of a phase that is computed in the wider scalar type.
template <class T>
CosSin<T> cos_sin(Wider<T> phase) {
  using W = Wider<T>;
  const T reduced = static_cast<T>(reduced_phase<W>(phase, W(2) * real::pi<W>()).phase);
  const SinCos<T> both = real::sin_cos(reduced);
  return {both.cos, both.sin};
}

/// The quaternion of a rotation about `axis`, a unit vector, by twice `half_phase` (rad).
template <class T>
Quaternion<T> turn(const Vec3<T>& axis, Wider<T> half_phase) {
  const CosSin<T> h = cos_sin<T>(half_phase);
  return {h.cos, h.sin * axis};
}

template <class T>
T phase_error(Wider<T> phases_swept) {
  using W = Wider<T>;
  return T(kEvaluationRounding) * real::epsilon<T>() + static_cast<T>(W(kPhaseRounding) * real::epsilon<W>() * phases_swept);
}

template <class T>
struct Hyperbolic {
  T sech, tanh;
};
template <class T>
Hyperbolic<T> hyperbolic(T x) {
  const T size = real::abs(x), fall = real::exp(-size), both = T(1) + fall * fall;
  const T tanh = -real::expm1(T(-2) * size) / both;
  return {T(2) * fall / both, x < T(0) ? -tanh : tanh};
}

/// 1 - (w3 / critical spin)^2, without loss of digits where it is near 0.
template <class T>
Wider<T> subcritical_share(const SymmetricTop<T>& top, T w3) {
  const float128 spin = static_cast<float128>(top.I3) * static_cast<float128>(w3);
  const float128 critical = 4 * static_cast<float128>(top.I1) * static_cast<float128>(top.mgl);
  return static_cast<Wider<T>>((critical - spin * spin) / critical);
}

}  // namespace

template <class T>
std::optional<PrecessionRates<T>> steady_precession_rates(const SymmetricTop<T>& top, T w3, T cos_tilt) {
  using W = Wider<T>;
  const W spin = W(top.I3) * W(w3), discriminant = spin * spin - W(4) * W(top.I1) * W(top.mgl) * W(cos_tilt);
  if (!(discriminant >= W(0))) return std::nullopt;
  const W sum = spin + (spin < W(0) ? -real::sqrt(discriminant) : real::sqrt(discriminant));
  if (sum == W(0) && top.mgl != T(0) && cos_tilt == T(0)) return std::nullopt;
  const W slow = top.mgl == T(0) ? W(0) : W(2) * W(top.mgl) / sum;
  const W fast = sum == W(0) ? W(0) : sum / (W(2) * W(top.I1) * W(cos_tilt));
  return PrecessionRates<T>{static_cast<T>(slow), static_cast<T>(fast)};
}

template <class T>
ClosedFormState<T> steady_precession(const Quaternion<T>& q0_NB, T precession_rate, T w3, T t_s) {
  using W = Wider<T>;
  const Quaternion<W> start = converted<W>(q0_NB).normalized();
  const W cos_tilt = rotation_matrix(start)(2, 2), t = static_cast<W>(t_s);
  const W relative_spin = W(w3) - W(precession_rate) * cos_tilt;
  const W precession = W(precession_rate) * t / W(2), spin = relative_spin * t / W(2);
  const Vec3<T> up = Vec3<T>::UnitZ();
  ClosedFormState<T> x;
  x.q_NB = (turn<T>(up, precession) * converted<T>(start) * turn<T>(up, spin)).normalized();
  x.w_NB_B = precession_rate * transposed_times(rotation_matrix(x.q_NB), up);
  x.w_NB_B[2] = w3;
  x.attitude_error = phase_error<T>(real::abs(precession) + real::abs(spin));
  x.rate_error = real::abs(precession_rate) * x.attitude_error;
  return x;
}

template <class T>
T upright_growth_rate(const SymmetricTop<T>& top, T w3) {
  using W = Wider<T>;
  const W share = subcritical_share(top, w3);
  return share > W(0) ? static_cast<T>(real::sqrt(share * W(top.mgl) / W(top.I1))) : T(0);
}

template <class T>
ClosedFormState<T> homoclinic_top(const SymmetricTop<T>& top, T w3, T t_s) {
  using W = Wider<T>;
  const W share = subcritical_share(top, w3), t = static_cast<W>(t_s), omega = real::sqrt(W(top.mgl) / W(top.I1));
  const W wide_k = real::sqrt(share), wide_f = W(top.I3) * W(w3) / (W(2) * real::sqrt(W(top.I1) * W(top.mgl)));
  const W azimuth_rate = wide_f * omega, delta_rate = (W(top.I3) - W(top.I1)) / W(top.I1) * W(w3) / W(2);
  const W growth = omega * wide_k;
  const T f = static_cast<T>(wide_f), k = static_cast<T>(wide_k);
  const Hyperbolic<T> h = hyperbolic(static_cast<T>(growth * t));
  const CosSin<T> a = cos_sin<T>((azimuth_rate - delta_rate) * t), d = cos_sin<T>(delta_rate * t);

  // Real and imaginary parts of the two complex halves of the quaternion, and their rates.
  const T upper_re = f, upper_im = k * h.tanh, lower = k * h.sech;
  ClosedFormState<T> x;
  x.q_NB = {a.cos * upper_re - a.sin * upper_im, Vec3<T>(lower * d.cos, lower * d.sin, a.sin * upper_re + a.cos * upper_im)};
  const T upper_turn = static_cast<T>(azimuth_rate - delta_rate), lower_turn = static_cast<T>(delta_rate);
  const T upper_growth = k * static_cast<T>(growth) * h.sech * h.sech, lower_growth = -lower * static_cast<T>(growth) * h.tanh;
  const Quaternion<T> rate{
      -upper_turn * x.q_NB.v[2] - a.sin * upper_growth,
      Vec3<T>(lower_growth * d.cos - lower_turn * x.q_NB.v[1], lower_growth * d.sin + lower_turn * x.q_NB.v[0],
              upper_turn * x.q_NB.w + a.cos * upper_growth)};
  x.w_NB_B = T(2) * (x.q_NB.conjugate() * rate).v;
  x.w_NB_B[2] = w3;
  x.q_NB = x.q_NB.normalized();
  x.attitude_error = phase_error<T>((real::abs(azimuth_rate) + real::abs(delta_rate)) * real::abs(t));
  x.rate_error = (static_cast<T>(W(2) * omega) + T(2) * real::abs(lower_turn)) * x.attitude_error;
  return x;
}

template <class T>
ClosedFormState<T> separatrix_free_body(const Vec3<T>& moments, T w2, T t_s) {
  using W = Wider<T>;
  const W A = moments[0], B = moments[1], C = moments[2], w = w2, t = static_cast<W>(t_s);
  const W size1 = real::sqrt(B * (C - B) / (A * (C - A))), size3 = real::sqrt(B * (B - A) / (C * (C - A)));
  const W p = w * real::sqrt((C - B) * (B - A) / (A * C));
  const Hyperbolic<T> h = hyperbolic(static_cast<T>(p * t));
  ClosedFormState<T> x;
  x.w_NB_B = Vec3<T>(static_cast<T>(w * size1) * h.sech, w2 * h.tanh, static_cast<T>(w * size3) * h.sech);
  // L in the body at t = 0 is m = (m1, 0, m3); k = m x e2 = (-m3, 0, m1); R_0 takes m to z by the quaternion (1 + m3, 0, -m1,
  // 0).
  const T m1 = static_cast<T>(A * size1 / B), m3 = static_cast<T>(C * size3 / B);
  const Quaternion<T> R_0 = Quaternion<T>{T(1) + m3, Vec3<T>(T(0), -m1, T(0))}.normalized();
  // cos and sin of gd(x)/2, from tanh(x/2).
  const T half = hyperbolic(static_cast<T>(p * t) / T(2)).tanh, c = T(1) / real::sqrt(T(1) + half * half), s = half * c;
  const Quaternion<T> back{c, Vec3<T>(s * m3, T(0), -s * m1)};
  x.q_NB = (turn<T>(Vec3<T>(Vec3<T>::UnitZ()), w * t / W(2)) * R_0 * back).normalized();
  x.attitude_error = phase_error<T>(real::abs(w * t));
  x.rate_error = static_cast<T>(w * (W(1) + size1 + size3)) * x.attitude_error;
  return x;
}

template <class T>
LaboratoryState<T> seen_from_laboratory(const ClosedFormState<T>& state, const Vec3<T>& W_IL_L, T t_s) {
  using W = Wider<T>;
  const T size = norm(W_IL_L);
  LaboratoryState<T> x;
  x.attitude_error = state.attitude_error;
  x.rate_error = state.rate_error + size * state.attitude_error;
  x.q_LB = state.q_NB;
  x.w_LB_B = state.w_NB_B - transposed_times(rotation_matrix(state.q_NB), W_IL_L);
  if (!(size > T(0))) return x;
  const Vec3<W> wide = converted<W>(W_IL_L);
  const W wide_size = norm(wide), half = wide_size * static_cast<W>(t_s) / W(2);
  x.q_LB = (turn<T>(converted<T>(Vec3<W>(wide / wide_size)), -half) * state.q_NB).normalized();
  x.attitude_error += phase_error<T>(real::abs(half));
  x.rate_error += T(kEvaluationRounding) * real::epsilon<T>() * (norm(state.w_NB_B) + size);
  return x;
}

template <class T>
Vec3<T> balanced_gyroscope_axis_L(const Vec3<T>& axis_L, const Vec3<T>& W_IL_L, T t_s) {
  const ClosedFormState<T> still;
  return rotation_matrix(seen_from_laboratory(still, W_IL_L, t_s).q_LB) * axis_L;
}

template <class T>
T balanced_gyroscope_drift(T axis_sine, T earth_rate, T t_s) {
  return T(2) * real::asin(axis_sine * real::abs(real::sin(earth_rate * t_s / T(2))));
}

template <class T>
FirstOrder<T> sleeping_top_lean_south(const SymmetricTop<T>& top, T w3, const Vec3<T>& W_IL_L) {
  const T lag = top.I3 * w3 / top.mgl, size = norm(W_IL_L);
  return {lag * W_IL_L[1], T(2) * size * real::abs(W_IL_L[1]) * (lag * lag + top.I1 / real::abs(top.mgl))};
}

template <class T>
Vec3<T> resting_axis_L(const SymmetricTop<T>& top, T w3, const Vec3<T>& W_IL_L) {
  const Vec3<T> up = Vec3<T>::UnitZ();
  Vec3<T> n = up;
  // Each iteration reduces the error by a factor I1 |W|^2 / |mgl|.
  for (int k = 0; k < 100; ++k) {
    const T lag = (top.I3 * w3 - top.I1 * W_IL_L.dot(n)) / top.mgl;
    const Vec3<T> direction = up - lag * W_IL_L, next = direction / norm(direction);
    const bool settled = norm(Vec3<T>(next - n)) <= real::epsilon<T>();
    n = next;
    if (settled) break;
  }
  return n;
}

template <class T>
FirstOrder<T> foucault_rate(const SymmetricTop<T>& top, T amplitude, const Vec3<T>& W_IL_L) {
  const T share = top.I3 / (T(2) * top.I1), a = real::abs(amplitude), size = norm(W_IL_L);
  const T up = real::abs(W_IL_L[2]), level = real::hypot(W_IL_L[0], W_IL_L[1]);
  const T frequency = real::sqrt(-top.mgl / top.I1), slow = size / frequency;
  return {-W_IL_L[2] * (T(1) - share), up * a * a + level * a * (share + a * a) + size * slow * slow / a};
}

// T is a type, so it must not be put in parentheses.
// NOLINTBEGIN(bugprone-macro-parentheses)
#define EARTHTOP_INSTANTIATE(T)                                                                     \
  template std::optional<PrecessionRates<T>> steady_precession_rates(const SymmetricTop<T>&, T, T); \
  template ClosedFormState<T> steady_precession(const Quaternion<T>&, T, T, T);                     \
  template T upright_growth_rate(const SymmetricTop<T>&, T);                                        \
  template ClosedFormState<T> homoclinic_top(const SymmetricTop<T>&, T, T);                         \
  template ClosedFormState<T> separatrix_free_body(const Vec3<T>&, T, T);                           \
  template LaboratoryState<T> seen_from_laboratory(const ClosedFormState<T>&, const Vec3<T>&, T);   \
  template Vec3<T> balanced_gyroscope_axis_L(const Vec3<T>&, const Vec3<T>&, T);                    \
  template T balanced_gyroscope_drift(T, T, T);                                                     \
  template FirstOrder<T> sleeping_top_lean_south(const SymmetricTop<T>&, T, const Vec3<T>&);        \
  template Vec3<T> resting_axis_L(const SymmetricTop<T>&, T, const Vec3<T>&);                       \
  template FirstOrder<T> foucault_rate(const SymmetricTop<T>&, T, const Vec3<T>&);
EARTHTOP_INSTANTIATE(double)
EARTHTOP_INSTANTIATE(float80)
EARTHTOP_INSTANTIATE(float128)
#undef EARTHTOP_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace earthtop
