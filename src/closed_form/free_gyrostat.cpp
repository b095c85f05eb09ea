// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/closed_form/free_gyrostat.hpp"

#include <algorithm>

#include "closed_form/elliptic.hpp"
#include "closed_form/gyrostat_roots.hpp"
#include "closed_form/momentum_frame.hpp"
#include "closed_form/principal_axes.hpp"
#include "closed_form/wider.hpp"

namespace earthtop {
namespace {

using gyrostat::Q;

/// Error bounds: of one result, in eps of T (rad, or relative to the rate); of its periodic parts, in eps of Wider<T>; and of the
/// constants and their products with the time, in eps of 113 bits.
constexpr int kResultRounding = 4;
constexpr int kPeriodicRounding = 32;
constexpr int kConstantRounding = 64;

Q plus_or_minus(const Q& x) { return x < Q(0) ? Q(-1) : Q(1); }

template <class W>
Vec3<W> turned_by(const Quaternion<W>& q, const Vec3<W>& v) {
  return product(product(q, Quaternion<W>{W(0), v}), Quaternion<W>(q.conjugate())).v;
}

/// s and c at one argument u, where s^2 + c^2 = 1; and the speed d(s/c)/du c^2, which is dn.
template <class W>
struct GyrostatPoint {
  W s, c, dn;
  W difference = W(0);  ///< c^2 - s^2; only of complex roots
};

/// What the integrals need of the elliptic functions.
template <class W>
struct GyrostatKernel {
  bool complex = false;
  W m = W(0), m1 = W(1);
  elliptic::Lattice<W> lattice;

  /// With complex roots s and c are sine and cosine of half the amplitude of 2 u. Where the roots lie close above the real axis, the
  /// motion is slow where s = c; so their difference is taken from a function that has its zero there.
  GyrostatPoint<W> point(const W& u) const {
    if (!complex) {
      const elliptic::JacobiValues<W> j = elliptic::jacobi<W>(u, lattice);
      return {j.sn, j.cn, j.dn};
    }
    const elliptic::JacobiValues<W> j = elliptic::jacobi<W>(W(2) * u, lattice);
    const W more = real::sqrt((W(1) + real::abs(j.cn)) / W(2)), less = real::abs(j.sn) / (W(2) * more);
    const W size = j.cn < W(0) ? more : less;
    return {u < W(0) ? W(-size) : size, j.cn < W(0) ? less : more, j.dn, j.cn};
  }
  /// The integral of s^2 / (c^2 + kappa s^2) du from 0 to the point.
  W integral(const GyrostatPoint<W>& at, const W& kappa) const {
    const W c2 = at.c * at.c, s2 = at.s * at.s, p = c2 + kappa * s2;
    if (!(s2 > W(0)) || !(p > W(0)) || !real::isfinite(p)) return s2 - s2;  // 0; or NaN, for which duplication would never end
    const W rj = complex
                     ? elliptic::carlson_rj_conjugate<W>(c2, at.difference + W(2) * m1 * s2, W(2) * real::sqrt(m * m1) * s2, p)
                     : elliptic::carlson_rj<W>(c2, at.dn * at.dn, W(1), p);
    return at.s * s2 * rj / W(3);
  }
  W quarter_integral(const W& kappa) const { return integral({W(1), W(0), complex ? W(1) : W(real::sqrt(m1)), W(-1)}, kappa); }
};

}  // namespace

template <class T>
struct FreeGyrostatMotion {
  using W = Wider<T>;

  // A uniform rotation, or one about the momentum and another about the rotor's axis.
  Quaternion<Q> q0_NB;
  Vec3<Q> w0_B;
  Vec3<Q> turn_N = Vec3<Q>::Zero(), turn_B = Vec3<Q>::Zero();  ///< directions of both turns
  Q rate_N = Q(0), rate_B = Q(0), axial = Q(0);                ///< their rates; w.c

  GyrostatKernel<W> kernel;
  Quaternion<W> q_NM, q_BP;
  Q nu = Q(0), u0 = Q(0), K = Q(1);
  Q psi_rate = Q(0), psi_amplitude = Q(0);      ///< dpsi/dt at the lower end, and the factor of its integral
  Q axial_rate = Q(0), axial_amplitude = Q(0);  ///< the same of the turn about c
  Q psi_start = Q(0), psi_quarter = Q(0);       ///< the integral at the start, and over a quarter period
  Q axial_start = Q(0), axial_quarter = Q(0);
  W rho = W(0), kappa = W(0);           ///< parameters of the integrals of x and of 1 / (1 + x)
  int vanishing = 0;                    ///< the component of l that is zero at the lower end: 0 or 1
  bool both_ends = false;               ///< whether it is zero at the upper end, too
  bool dn_with_vanishing = false;       ///< whether dn is a factor of that component; else of the other one
  W amplitude[2] = {W(0), W(0)};        ///< of l1 and l2
  W low_plus = W(0), high_plus = W(0);  ///< 1 + x at the ends
  Vec3<W> rate_of_l;                    ///< G / I_i
  W relative_rate = W(0);               ///< h / I3

  T largest_rate = T(0), growth_rate = T(0);
  T far_condition = T(1),
    condition = T(1);    ///< relative error of the constants in eps: but for nearly equal roots, and with them
  T period_turn = T(0);  ///< angle turned in about a period, at most

  GyrostatRegime prepare(const Mat3<Q>& I_B, int axis, Q h, const Quaternion<Q>& q_NB, const Vec3<Q>& w_B);
  void prepare_nutation(gyrostat::Start at_start, Quaternion<Q> wide_q_BP);
  ClosedFormState<T> steady_at(T t_s) const;
  ClosedFormState<T> nutating_at(T t_s) const;
  /// The argument at a time, less full periods.
  struct Phase {
    Q turns;
    W u;
  };
  Phase phase(const Q& t) const;
  AxialTurn<T> axial_turn(T t_s, bool is_steady) const;
  T relative_error(T t_s) const;
};

template <class T>
GyrostatRegime FreeGyrostatMotion<T>::prepare(const Mat3<Q>& I_B, int axis, Q h, const Quaternion<Q>& q_NB,
                                              const Vec3<Q>& w_B) {
  // Axes of which the rotor's is the third, then principal ones.
  Mat3<Q> renumbered;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int row = (axis + 1 + i) % 3, column = (axis + 1 + j) % 3;
      renumbered(i, j) = I_B(std::max(row, column), std::min(row, column));
    }
  const PrincipalAxes<Q> principal = principal_axes<Q>(renumbered);
  const Vec3<Q>& I = principal.moments;
  Vec3<Q> w(w_B[(axis + 1) % 3], w_B[(axis + 2) % 3], w_B[axis]);
  if (principal.q_BP.v != Vec3<Q>::Zero()) w = turned_by(Quaternion<Q>(principal.q_BP.conjugate()), w);
  const Quaternion<Q> wide_q_BP = third_axis_is<Q>(axis) * principal.q_BP;

  q0_NB = q_NB.normalized(), w0_B = w_B, axial = w[2];
  const Q size = norm(w);
  rate_B = size;
  if (size > Q(0)) turn_B = w_B / size;
  const Q twice_T = I[0] * w[0] * w[0] + I[1] * w[1] * w[1] + I[2] * w[2] * w[2];
  largest_rate = static_cast<T>(real::sqrt(twice_T / std::min(I[0], std::min(I[1], I[2]))));
  if (w[0] == Q(0) && w[1] == Q(0)) return GyrostatRegime::uniform;

  const Vec3<Q> L(I[0] * w[0], I[1] * w[1], I[2] * w[2] + h);
  const Q G = norm(L);
  far_condition = condition = static_cast<T>(Q(1) + (real::abs(h) + I[2] * real::abs(w[2])) / G);
  if (I[0] == I[1]) {
    turn_N = turned_by(Quaternion<Q>(q0_NB * wide_q_BP), Vec3<Q>(L / G));
    turn_B = Vec3<Q>::Unit(axis);
    rate_N = G / I[0], rate_B = ((I[0] - I[2]) * w[2] - h) / I[0];
    return GyrostatRegime::symmetric;
  }
  const Vec3<Q> l = L / G;
  const Q across = l[0] * l[0] + l[1] * l[1];
  const gyrostat::Start start{I,
                              w,
                              l,
                              h,
                              G,
                              l[2] < Q(0) ? Q(across / (Q(1) - l[2])) : Q(Q(1) + l[2]),
                              l[2] < Q(0) ? Q(Q(1) - l[2]) : Q(across / (Q(1) + l[2]))};
  const gyrostat::Polynomial A(start, 0), B(start, 1);
  const auto is_double_root = [](const gyrostat::Polynomial& one) {
    return one.c0[gyrostat::start] == Q(0) && one.c1[gyrostat::start] == Q(0);
  };
  if (is_double_root(A) || is_double_root(B)) {
    // The rate lies along the momentum. If rounding has put it there, the error grows where that axis is unstable.
    const Q square =
        -(A.c1[gyrostat::start] * B.c1[gyrostat::start] + A.c0[gyrostat::start] * B.c2 + A.c2 * B.c0[gyrostat::start]);
    if (square > Q(0)) growth_rate = static_cast<T>(real::sqrt(square)), condition = T(1) / static_cast<T>(real::epsilon<Q>());
    return GyrostatRegime::uniform;
  }
  prepare_nutation(start, wide_q_BP);
  return kernel.complex ? GyrostatRegime::complex_roots : GyrostatRegime::real_roots;
}

template <class T>
void FreeGyrostatMotion<T>::prepare_nutation(gyrostat::Start at_start, Quaternion<Q> wide_q_BP) {
  gyrostat::Roots roots = gyrostat::find_roots(at_start);
  Q along = Q(1);
  if (roots.low.x[gyrostat::bottom] < -roots.high.x[gyrostat::top]) {  // axis 3 is reversed, and with it axis 2
    wide_q_BP = wide_q_BP * Quaternion<Q>{Q(0), Vec3<Q>(Vec3<Q>::Unit(0))};
    at_start = at_start.reversed();
    along = Q(-1);
    roots = gyrostat::find_roots(at_start);
  }
  const auto& [I, w, l, h, G, plus, minus] = at_start;
  const Q to_low = -roots.low.x[gyrostat::start], to_high = roots.high.x[gyrostat::start], width = to_low + to_high;
  const bool is_near = to_low < plus / Q(2);
  const Q least = real::epsilon<Q>() * real::epsilon<Q>();
  const Q wide_low_plus = std::max(least, is_near ? Q(plus - to_low) : roots.low.x[gyrostat::bottom]);
  const Q low_minus = minus + to_low, wide_high_plus = plus + to_high;
  GyrostatKernel<Q> wide;
  wide.complex = roots.complex;
  Q wide_rho;
  Q middle = Q(0);  // of the start, c^2 - s^2 for a unit sum
  if (roots.complex) {
    const Q below = roots.re + to_low, above = to_high - roots.re, im = roots.im;
    const Q far_low = real::hypot(below, im), far_high = real::hypot(above, im), difference = far_low - far_high;
    // What a distance from an end exceeds its part along the real axis by, without cancellation where the roots lie close above
    // it between the ends.
    const auto excess = [&](const Q& distance, const Q& part) {
      return part > Q(0) ? Q(im * im / (distance + part)) : Q(distance - part);
    };
    const Q of_low = excess(far_low, below), of_high = excess(far_high, above), product = Q(4) * far_low * far_high;
    wide_rho = far_low / far_high;
    wide.m = (width - difference) * (width + difference) / product;
    wide.m1 = (of_low + of_high) * (far_low + far_high + width) / product;
    middle = (roots.re * width + of_low * to_high - of_high * to_low) / (far_low * to_high + far_high * to_low);
  } else {
    const gyrostat::Root &p = roots.below, &q = roots.above;
    wide_rho = gyrostat::Roots::ratio(roots.low, roots.high, p);
    wide.m1 = wide_rho * gyrostat::Roots::ratio(roots.high, roots.low, q);
    const Q of_high = p.is_finite() ? Q(width / gyrostat::Gap(roots.high, p).size) : Q(1);
    wide.m = !q.is_finite()
                 ? (p.is_finite() ? of_high : Q(0))
                 : Q(of_high * ((p.is_finite() ? gyrostat::Gap(q, p).size : width) / gyrostat::Gap(q, roots.low).size));
  }
  // On a separatrix the period is infinite; a very long one serves as well, and its functions do not vanish.
  wide.m1 = std::max(wide.m1, real::scale(Q(1), -16000));
  wide.lattice = elliptic::lattice<Q>(wide.m, wide.m1);
  K = wide.lattice.K;

  vanishing = roots.low.of, both_ends = roots.high.of == vanishing;
  dn_with_vanishing = !both_ends && roots.below.of != vanishing;
  const int other = 1 - vanishing;
  const Q between = G * real::abs(I[1] - I[0]) / (I[0] * I[1]);
  nu = real::sqrt(roots.slope * between * wide_low_plus * low_minus / (width * wide_rho)) / Q(2);
  Q sizes[2];
  sizes[vanishing] = real::sqrt(roots.slope * width * wide_rho / between);
  sizes[other] = real::sqrt(wide_low_plus * low_minus);

  // x rises where the argument is between 0 and K: there l1 l2 has the sign of I1 - I2.
  const Q rises = plus_or_minus(Q(I[0] - I[1]));
  const Q of_other = l[other] != Q(0) ? plus_or_minus(l[other]) : Q(rises * plus_or_minus(l[vanishing]));
  sizes[other] *= of_other, sizes[vanishing] *= rises * of_other;
  const Q scale = to_low + wide_rho * to_high, s2 = to_low / scale, c2 = wide_rho * to_high / scale;
  GyrostatPoint<Q> start{real::sqrt(s2), real::sqrt(c2), real::sqrt(c2 + wide.m1 * s2), middle};
  if (wide.complex) {
    const Q cn = middle, sn = Q(2) * start.s * start.c;
    const Q whole = sn * elliptic::carlson_rf<Q>(cn * cn, cn * cn + wide.m1 * sn * sn, Q(1));
    u0 = (cn < Q(0) ? Q(Q(2) * K - whole) : whole) / Q(2);
  } else {
    u0 = start.s * elliptic::carlson_rf<Q>(c2, start.dn * start.dn, Q(1));
  }
  if (l[0] * l[1] * rises < Q(0)) u0 = -u0, start.s = -start.s;

  const Q wide_kappa = wide_rho * wide_high_plus / wide_low_plus, a3 = G / I[2], beyond = (G / I[other] - a3) * low_minus;
  psi_rate = (G - h) / I[2] + beyond;
  psi_amplitude = -(beyond - Q(2) * h / I[2]) * wide_rho * width / (wide_low_plus * nu);
  psi_start = wide.integral(start, wide_kappa);
  psi_quarter = wide.quarter_integral(wide_kappa);
  axial_rate = along * (w[2] - a3 * to_low);
  axial_amplitude = along * a3 * width * wide_rho / nu;
  axial_start = wide.integral(start, wide_rho);
  axial_quarter = wide.quarter_integral(wide_rho);
  const Quaternion<Q> q_MP = scaled_to_unit(from_momentum_frame<Q>({Q(1), Q(0)}, l, plus));
  q_NM = converted<W>(product(product(q0_NB, wide_q_BP), q_MP.conjugate()).normalized());
  q_BP = converted<W>(wide_q_BP);

  kernel.complex = wide.complex;
  kernel.m = static_cast<W>(wide.m), kernel.m1 = static_cast<W>(wide.m1);
  kernel.lattice = elliptic::lattice<W>(kernel.m, kernel.m1);
  rho = static_cast<W>(wide_rho), kappa = static_cast<W>(wide_kappa);
  for (int i = 0; i < 2; ++i) amplitude[i] = static_cast<W>(sizes[i]);
  low_plus = static_cast<W>(wide_low_plus), high_plus = static_cast<W>(wide_high_plus);
  rate_of_l = converted<W>(Vec3<Q>(G / I[0], G / I[1], a3));
  relative_rate = static_cast<W>(h / I[2]);

  const Q turn = static_cast<Q>(largest_rate) * (Q(1) + std::min(K, Q(100))) / nu;
  period_turn = static_cast<T>(turn);
  growth_rate = static_cast<T>(Q(2) * nu);
  const Q of_low_plus = is_near ? Q(1) : roots.low.loss[gyrostat::bottom];
  condition = static_cast<T>(std::max(roots.loss, of_low_plus)) * far_condition;
}

/// The stated error relative to an angle of 1 rad or to the rate: of the result's rounding, of the periodic parts, and of the constants,
/// also over time. Nearly equal roots change the motion no more than an unstable one grows.
template <class T>
T FreeGyrostatMotion<T>::relative_error(T t_s) const {
  const T time = real::abs(t_s), swept = largest_rate * time, turned = T(1) + period_turn + swept;
  const T growth = std::min(T(condition * turned), T(far_condition * turned * real::exp(growth_rate * time)));
  return T(kResultRounding) * real::epsilon<T>() +
         T(kPeriodicRounding) * static_cast<T>(real::epsilon<W>()) * (T(1) + period_turn) +
         T(kConstantRounding) * static_cast<T>(real::epsilon<Q>()) * (far_condition * turned + growth);
}

template <class T>
ClosedFormState<T> FreeGyrostatMotion<T>::steady_at(T t_s) const {
  const Q t = static_cast<Q>(t_s);
  const auto turn = [&](const Q& rate, const Vec3<Q>& about) {
    const auto [s, c] = real::sin_cos(static_cast<W>(reduced_phase<Q>(rate * t / Q(2), real::pi<Q>()).phase));
    return Quaternion<W>{c, Vec3<W>(s * converted<W>(about))};
  };
  const Quaternion<W> in_body = turn(rate_B, turn_B);
  ClosedFormState<T> x;
  x.q_NB = converted<T>(product(product(turn(rate_N, turn_N), converted<W>(q0_NB)), in_body));
  x.w_NB_B = converted<T>(turned_by(Quaternion<W>(in_body.conjugate()), converted<W>(w0_B)));
  return x;
}

template <class T>
auto FreeGyrostatMotion<T>::phase(const Q& t) const -> Phase {
  const Q whole = nu * t + u0, turns = real::rint(whole / (Q(2) * K));
  return {turns, static_cast<W>(whole - Q(2) * turns * K)};
}

template <class T>
ClosedFormState<T> FreeGyrostatMotion<T>::nutating_at(T t_s) const {
  const Q t = static_cast<Q>(t_s);
  const auto [turns, u] = phase(t);
  const GyrostatPoint<W> at = kernel.point(u);
  const W c2 = at.c * at.c, s2 = at.s * at.s, scale = c2 + rho * s2;

  const Q secular = psi_rate * t + psi_amplitude * (Q(2) * turns * psi_quarter - psi_start);
  const W half = static_cast<W>(reduced_phase<Q>(secular / Q(2), real::pi<Q>()).phase) +
                 static_cast<W>(psi_amplitude) * kernel.integral(at, kappa) / W(2);
  const auto [sine, cosine] = real::sin_cos(half);

  Vec3<W> l;
  const int other = 1 - vanishing;
  const W one = W(1), flip = real::rint(turns / Q(2)) != turns / Q(2) ? -one : one;
  l[vanishing] = amplitude[vanishing] * (both_ends ? at.s * at.c : flip * at.s * (dn_with_vanishing ? at.dn : one)) / scale;
  l[other] = amplitude[other] * (both_ends ? at.dn : flip * at.c * (dn_with_vanishing ? one : at.dn)) / scale;
  const W plus = (low_plus * c2 + high_plus * rho * s2) / scale;
  l[2] = plus - one;

  ClosedFormState<T> x;
  const Quaternion<W> q_MP = scaled_to_unit(from_momentum_frame<W>({cosine, sine}, l, plus));
  x.q_NB = converted<T>(scaled_to_unit(product(product(q_NM, q_MP), Quaternion<W>(q_BP.conjugate()))));
  const Vec3<W> w_P(rate_of_l[0] * l[0], rate_of_l[1] * l[1], rate_of_l[2] * l[2] - relative_rate);
  x.w_NB_B = converted<T>(turned_by(q_BP, w_P));
  return x;
}

template <class T>
AxialTurn<T> FreeGyrostatMotion<T>::axial_turn(T t_s, bool is_steady) const {
  const Q t = static_cast<Q>(t_s);
  Q angle = axial * t;
  if (!is_steady) {
    const auto [turns, u] = phase(t);
    const Q periodic = static_cast<Q>(kernel.integral(kernel.point(u), rho));
    angle = axial_rate * t + axial_amplitude * (Q(2) * turns * axial_quarter + periodic - axial_start);
  }
  const T rounded = static_cast<T>(angle);
  return {rounded, T(relative_error(t_s) + real::epsilon<T>() * real::abs(rounded))};
}

template <class T>
FreeGyrostat<T>::FreeGyrostat(const Mat3<T>& I_BP_B, int axis, const T& momentum, const Quaternion<T>& q0_NB,
                              const Vec3<T>& w0_NB_B) {
  Mat3<Q> tensor;
  for (int j = 0; j < 3; ++j) tensor.col(j) = converted<Q>(Vec3<T>(I_BP_B.col(j)));
  auto motion = std::make_shared<FreeGyrostatMotion<T>>();
  regime_ = motion->prepare(tensor, axis, static_cast<Q>(momentum), converted<Q>(q0_NB), converted<Q>(w0_NB_B));
  motion_ = std::move(motion);
}

template <class T>
bool FreeGyrostat<T>::is_steady() const {
  return regime_ == GyrostatRegime::uniform || regime_ == GyrostatRegime::symmetric;
}

template <class T>
ClosedFormState<T> FreeGyrostat<T>::at(T t_s) const {
  ClosedFormState<T> x = is_steady() ? motion_->steady_at(t_s) : motion_->nutating_at(t_s);
  const T relative = motion_->relative_error(t_s);
  x.attitude_error = std::min(relative, real::pi<T>());
  x.rate_error = motion_->largest_rate * relative;
  return x;
}

template <class T>
AxialTurn<T> FreeGyrostat<T>::axial_turn(T t_s) const {
  return motion_->axial_turn(t_s, is_steady());
}

template class FreeGyrostat<double>;
template class FreeGyrostat<float80>;
template class FreeGyrostat<float128>;

}  // namespace earthtop
