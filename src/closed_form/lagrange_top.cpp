// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/closed_form/lagrange_top.hpp"

#include <algorithm>
#include <limits>

#include "closed_form/complex.hpp"
#include "closed_form/lagrange_regime.hpp"
#include "closed_form/lagrange_roots.hpp"
#include "closed_form/split_number.hpp"
#include "closed_form/theta_quotient.hpp"

namespace earthtop {

/// The functions of the series at one argument: those of the low quotient (odd multiples), and those of the high quotients,
/// which vanish at or above u2.
template <class T>
struct LagrangeTop<T>::Basis {
  std::array<T, kTerms> low_re, low_im, high_re, high_im;
  T low_factor, high_factor;  ///< 1 / denominator
  T cos1, sin1;               ///< circular branch: cosine and sine of the argument
  T E = T(1), Q = T(0);       ///< hyperbolic branch: exp(-2 |v|), and q exp(2 |v|), which is 1 at the turning point u2
  Complex<T> low(const Quotient& q) const { return sum(q, low_re, low_im); }
  Complex<T> high(const Quotient& q) const { return sum(q, high_re, high_im); }
  static Complex<T> sum(const Quotient& q, const std::array<T, kTerms>& re, const std::array<T, kTerms>& im) {
    Complex<T> s;
    for (int n = kTerms - 1; n >= 0; --n) {
      s.re += q.re[n] * re[n];
      s.im += q.im[n] * im[n];
    }
    return s;
  }
  static T terms(const Quotient& q) {
    T size = T(0);
    for (int n = 0; n < kTerms; ++n) size += real::abs(q.re[n]) + real::abs(q.im[n]);
    return size;
  }
  /// |sum|^2 over the square of the largest size that the quotient can have near here: it tells how many digits its direction
  /// keeps.
  static T quality(const Quotient& q, const std::array<T, kTerms>& re, const std::array<T, kTerms>& im, bool hyperbolic,
                   const std::array<T, kTerms>& natural) {
    T size = hyperbolic ? T(0) : terms(q);
    for (int n = 0; hyperbolic && n < kTerms; ++n) size += real::abs(natural[n]);
    return norm2(sum(q, re, im)) / (size * size);
  }
};

template <class T>
void LagrangeTop<T>::evaluate_basis(T v, T v_low, Basis& b) const {
  if (!hyperbolic_) {
    const auto [s, c] = real::sin_cos(v);
    b.sin1 = s;
    b.cos1 = c;
    const T twice = T(2) * (c - s) * (c + s);
    T s0 = -s, s1 = s, c0 = c, c1 = c, d0 = twice, d1 = T(2), denominator = T(1);
    for (int n = 0; n < kTerms; ++n) {
      b.low_re[n] = b.high_im[n] = s1;
      b.low_im[n] = b.high_re[n] = c1;
      if (n > 0) denominator += (n % 2 ? -square_[n] : square_[n]) * d1;
      const T s2 = twice * s1 - s0, c2 = twice * c1 - c0, d2 = twice * d1 - d0;
      s0 = s1, s1 = s2, c0 = c1, c1 = c2, d0 = d1, d1 = d2;
    }
    b.low_factor = b.high_factor = T(1) / denominator;
    return;
  }
  const T size = real::abs(v), sign = v < T(0) ? T(-1) : T(1);
  const T root = real::exp(-size), E = b.E = root * root;
  const T beyond = (size - v_period_.high / T(2)) + (sign * v_low - v_period_.low / T(2));  // |v| - span
  const T Q = b.Q = real::isfinite(v_period_.high) ? real::exp(T(2) * beyond) : T(0);
  T denominator = T(0), power_E = T(1), power_Q = T(1);
  for (int n = 0; n < kTerms; ++n, power_E *= E, power_Q *= Q) {
    const T rising = square_[n] * power_Q, falling = pronic_[n] * power_E * E;
    b.low_re[n] = sign * (rising - falling);
    b.low_im[n] = rising + falling;
    denominator += rising + falling;
    const T up = n == 0 ? T(1) : pronic_[n - 1] * power_Q, down = n == 0 ? T(0) : square_[n] * power_E;
    b.high_re[n] = up + down;
    b.high_im[n] = sign * (up - down);
  }
  b.low_factor = T(1) / denominator;
  b.high_factor = T(2) * root / denominator;
}

/// How the constants of the motion follow from the start, in the scalar type W. Each function derives one group of the
/// top's members from the nutation's roots; `derive` calls them in the order in which they need one another.
template <class T>
template <class W>
struct LagrangeTop<T>::Derivation {
  static_assert(kTerms == elliptic::kThetaTerms<T>);

  LagrangeTop& top;
  W w3, up;              ///< spin (rad/s); 1, or -1 where up and down are exchanged
  Complex<W> A, B;       ///< the start's attitude, normalised
  Complex<T> Omega;      ///< the start's rate across the axis (rad/s)
  NutationData<W> data;  ///< divided by I1
  NutationRoots<W> roots;
  W m, m1;  ///< parameter of the elliptic functions, and 1 - m
  elliptic::Lattice<W> l;
  W v_rate = W(0), v_start = W(0);  ///< v = rate t + start is the argument of the theta functions
  Zero<W> low, high, rest;          ///< of the quotients of A, B and Omega
  W sum = W(0), difference = W(0);  ///< mean rates of arg A + arg B and of arg A - arg B, without the spin (rad/s)

  Derivation(LagrangeTop& of, const SymmetricTop<T>& body, const Quaternion<T>& q0_NB, const Vec3<T>& w0_NB_B)
      : top(of), w3(w0_NB_B[2]), A{W(q0_NB.w), W(q0_NB.v[2])}, B{W(q0_NB.v[0]), W(q0_NB.v[1])}, Omega{w0_NB_B[0], w0_NB_B[1]} {
    const W I1 = W(body.I1), beta = W(body.I3) * w3 / I1, mu = W(body.mgl) / I1;
    const W size = W(1) / real::sqrt(norm2(A) + norm2(B));
    A = size * A;
    B = size * B;
    top.flipped_ = mu < W(0);
    up = top.flipped_ ? W(-1) : W(1);
    data = nutation_data<W>(mu, beta, A, B, Complex<W>{W(Omega.re), W(Omega.im)});
    roots = nutation_roots<W>(data);
    m = ratio<W>(W(2) * data.mu * roots.width, roots.span);
    m1 = roots.span > W(0) ? roots.gap / roots.span : W(1);
    l = elliptic::lattice<W>(m, m1);
  }

  void derive() {
    set_lattice();
    set_argument();
    set_quotients();
    set_mean_rates();
    set_sizes();
    set_error_terms();
    top.set_phases(*this);
  }

  void set_lattice() {
    top.hyperbolic_ = l.hyperbolic;
    top.parameter_ = static_cast<T>(m);
    top.complementary_parameter_ = static_cast<T>(m1);
    for (int n = 0; n < kTerms; ++n) {
      top.square_[n] = static_cast<T>(l.square[n]);
      top.pronic_[n] = static_cast<T>(l.pronic[n]);
    }
    top.regime_ = lagrange_regime<W>(data, roots, W(real::epsilon<T>()));
    top.w3_ = static_cast<T>(w3);
    top.gravity_ = static_cast<T>(data.mu);
  }

  /// v is 0 where u = u1 and `span` where u = u2.
  void set_argument() {
    v_rate = l.rate * real::sqrt(roots.span) / W(2);
    if (roots.width > W(0)) {
      const W sn2 = -roots.s1 / roots.width, cn2 = roots.s2 / roots.width, dn2 = ratio<W>(roots.beyond, roots.span);
      if (cn2 + dn2 > W(0))
        v_start = sign_of(data.rate0) * l.rate * real::sqrt(sn2) * elliptic::carlson_rf<W>(cn2, dn2, W(1));
      else  // at the end of the separatrix, where the top stays for ever
        v_start = W(20000), v_rate = W(0);
    }
    top.v_rate_ = split<Split>(v_rate);
    top.v_start_ = split<Split>(v_start);
    top.v_period_ = split<Split>(l.hyperbolic ? W(2) * l.span : real::pi<W>());
  }

  void set_quotients() {
    const W twice = W(2) * data.mu;
    const W low_sign = sign_of(roots.at_bottom), high_sign = sign_of(roots.at_top), rest_sign = -up * sign_of(roots.at_rest);
    low = make_zero<W>(l, low_sign, ratio<W>(roots.bottom1, roots.bottom2), ratio<W>(roots.width, roots.bottom2),
                       ratio<W>(ratio<W>(roots.width * roots.bottom3, roots.bottom2), roots.span));
    const W high_scale = roots.top1 * roots.gap, rest_scale = roots.P1 * roots.gap;
    high = make_zero<W>(l, high_sign, ratio<W>(roots.top2 * roots.span, high_scale),
                        ratio<W>(roots.width * roots.top3, high_scale), ratio<W>(roots.width, roots.top1));
    rest = make_zero<W>(l, rest_sign, ratio<W>(roots.P2 * roots.span, rest_scale),
                        ratio<W>(twice * roots.width * roots.P3, rest_scale), ratio<W>(twice * roots.width, roots.P1));
    set_coefficients<T>(l, low, true, top.low_);
    set_coefficients<T>(l, high, false, top.high_);
    set_coefficients<T>(l, rest, false, top.rate_);
    top.winding_ = static_cast<int>(roots.top_energy >= W(0) ? -rest_sign : up * high_sign);
  }

  /// The mean rate of arg A is its rate at u = u2, that of arg B its rate at u = u1, each less what the theta quotient
  /// contributes there.
  void set_mean_rates() {
    const PhaseSlope<W> low_slope = phase_slope(l, low), high_slope = phase_slope(l, high);
    const W c1 = data.c0 - data.beta * roots.s1, c2 = data.c0 - data.beta * roots.s2;
    const W low_part = ratio<W>(c2, roots.bottom2), high_part = ratio<W>(c1, roots.top1);
    sum = (low_part + high_part) / W(2) -
          v_rate * ((low_slope.whole + high_slope.whole) - (low_slope.missing + high_slope.missing));
    difference = (low_part - high_part) / W(2) -
                 v_rate * ((low_slope.whole - high_slope.whole) - (low_slope.missing - high_slope.missing));
    top.sum_rate_ = split<Split>(sum / W(2));
    top.difference_rate_ = split<Split>((w3 + up * difference) / W(2));
    W sum_turn = W(0), difference_turn = W(0);
    if (l.hyperbolic) {
      const W low_turn = low.sign * low.eta, high_turn = high.sign * high.eta;
      sum_turn = -(low_turn + high_turn);
      difference_turn = -up * (low_turn - high_turn);
      top.sum_turn_ = split<Split>(sum_turn);
      top.difference_turn_ = split<Split>(difference_turn);
    }
    const W periods = v_rate / (l.hyperbolic ? W(2) * l.span : real::pi<W>());  // of the nutation, in a unit of time
    const W half_sum = sum / W(2) + periods * sum_turn,
            half_difference = (w3 + up * difference) / W(2) + periods * difference_turn;
    top.secular_ = {split<PhaseRate<T>>(W(2) * real::pi<W>() * periods), split<PhaseRate<T>>(half_sum + half_difference),
                    split<PhaseRate<T>>(half_sum - half_difference)};
  }

  /// The size of each quotient is set at the turning point where it is largest.
  void set_sizes() {
    const auto set_size = [](Quotient& q, T factor, W value2, const Complex<T>& s) {
      const T there = real::sqrt(norm2(s)) * factor;
      q.size = value2 > W(0) ? static_cast<T>(real::sqrt(value2)) / there : T(0);
    };
    const Split& period = top.v_period_;
    Basis basis;
    top.evaluate_basis(T(0), T(0), basis);
    set_size(top.high_, basis.high_factor, roots.top1 / W(2), basis.high(top.high_));
    set_size(top.rate_, basis.high_factor, roots.P1, basis.high(top.rate_));
    top.evaluate_basis(real::isfinite(period.high) ? period.high / T(2) : T(20000), period.low / T(2), basis);
    set_size(top.low_, basis.low_factor, roots.bottom2 / W(2), basis.low(top.low_));
  }

  /// Sets the terms that rounding in the wider scalar type adds to the error stated by `at`.
  void set_error_terms() {
    const T wide_eps = static_cast<T>(real::epsilon<W>());
    top.phase_loss_ = T(8) * wide_eps * static_cast<T>(real::abs(w3) + real::abs(sum) + real::abs(difference) + v_rate);
    top.nutation_loss_ = T(8) * wide_eps * static_cast<T>(roots.span_loss);
    if (l.hyperbolic) {
      const W most = W(std::numeric_limits<T>::max() / T(1e6));  // used if the gap is far below its own rounding
      top.period_loss_ = T(8) * wide_eps * static_cast<T>(std::min(ratio<W>(roots.gap_terms, roots.gap), most));
      top.nome_loss_ = wide_eps / T(2) * static_cast<T>(roots.gap_terms / roots.span);
    }
    if (!(data.near_top && roots.span > W(0))) return;
    top.near_top_time_ = static_cast<T>(W(1) / real::sqrt(roots.span));
    top.near_top_rate_ = static_cast<T>(real::abs(data.beta));
    top.near_top_loss_ = T(64) * wide_eps * static_cast<T>(real::sqrt(roots.top1 / W(2)));
    top.near_top_rate_loss_ = top.near_top_rate_ * top.near_top_loss_ + T(64) * wide_eps * static_cast<T>(real::sqrt(roots.P1));
  }
};

template <class T>
LagrangeTop<T>::LagrangeTop(const SymmetricTop<T>& top, const Quaternion<T>& q0_NB, const Vec3<T>& w0_NB_B,
                            ClosedFormSpan span) {
  // NOLINTNEXTLINE(bugprone-branch-clone): the same only for the widest type
  if (span == ClosedFormSpan::few_periods)
    Derivation<T>(*this, top, q0_NB, w0_NB_B).derive();
  else
    Derivation<Wider<T>>(*this, top, q0_NB, w0_NB_B).derive();
}

/// Sets the constant phases of A and B from the start. A, B and Omega are known there, and the phase of each follows from the
/// other two; the least accurate of the three (it may vanish) is not used.
template <class T>
template <class W>
void LagrangeTop<T>::set_phases(const Derivation<W>& start) {
  const auto narrow = [](const Complex<W>& x) { return Complex<T>{static_cast<T>(x.re), static_cast<T>(x.im)}; };
  const Complex<T> A = narrow(start.A), B = narrow(start.B);
  // The largest values of |low| and |high|.
  const T low_size = static_cast<T>(real::sqrt(start.roots.bottom2 / W(2))),
          high_size = static_cast<T>(real::sqrt(start.roots.top1 / W(2)));
  Basis b;
  evaluate_basis(v_start_.high, v_start_.low, b);
  Complex<T> low = b.low(low_), high = b.high(high_), rate = b.high(rate_);
  if (!hyperbolic_) rate = rate * Complex<T>{b.cos1, T(winding_) * b.sin1};
  if (!flipped_) rate = T(-1) * rate;
  const Complex<T>& low_start = flipped_ ? B : A;
  const Complex<T>& high_start = flipped_ ? A : B;
  const auto quality = [](T q, const Complex<T>& there) { return there.re != T(0) || there.im != T(0) ? q : T(-1); };
  const T low_quality = quality(Basis::quality(low_, b.low_re, b.low_im, hyperbolic_, b.low_im), low_start);
  const T high_quality = quality(Basis::quality(high_, b.high_re, b.high_im, hyperbolic_, b.high_re), high_start);
  const T rate_quality = quality(Basis::quality(rate_, b.high_re, b.high_im, hyperbolic_, b.high_re), start.Omega);

  Complex<T> low_phase = direction(low_start * conj(low)), high_phase = direction(high_start * conj(high));
  // Omega's phase is that of conj(A) B.
  Complex<T> between = direction(start.Omega * conj(rate));
  if (flipped_) between = conj(between);  // the phase of conj(low) high
  const bool low_left_out = low_quality < high_quality && low_quality < rate_quality;
  const bool high_left_out = !low_left_out && high_quality < rate_quality;
  if (low_left_out) low_phase = high_phase * conj(between);
  if (high_left_out) high_phase = low_phase * between;
  low_.cos = low_phase.re;
  low_.sin = low_phase.im;
  high_.cos = high_phase.re;
  high_.sin = high_phase.im;

  start_loss_ = gap_loss(b);
  // The rounding of the functions adds to the error, in units of eps: the largest term of each quotient, and the rounding of
  // the two phases that were just found.
  const T low_floor = low_.size * (hyperbolic_ ? T(2) : Basis::terms(low_)),
          high_floor = high_.size * (hyperbolic_ ? T(2) : Basis::terms(high_));
  const auto loss = [](T q) { return q > T(0) ? T(1) / real::sqrt(q) : T(0); };
  const T low_loss = loss(low_quality), high_loss = loss(high_quality), rate_loss = loss(rate_quality);
  const T low_lost = low_left_out ? high_loss + rate_loss : low_loss,
          high_lost = high_left_out ? low_loss + rate_loss : high_loss;
  const T lost = low_size * low_lost + high_size * high_lost;
  rate_turn_ = T(4) * real::epsilon<T>() * (low_lost + high_lost);
  attitude_floor_ = real::epsilon<T>() * (T(8) + T(4) * (low_floor + high_floor) + T(4) * lost);
  rate_floor_ =
      std::numeric_limits<T>::min() + T(8) * real::epsilon<T>() * rate_.size * (hyperbolic_ ? T(2) : Basis::terms(rate_));

  const Complex<T> rate_phase = flipped_ ? conj(high_phase) * low_phase : conj(low_phase) * high_phase;
  const T rate_sign = flipped_ ? T(1) : T(-1);
  rate_.cos = rate_sign * rate_phase.re;
  rate_.sin = rate_sign * rate_phase.im;
}

/// The relative effect of the rounding of the gap between the upper two roots at this point: largest at the highest point.
template <class T>
T LagrangeTop<T>::gap_loss(const Basis& b) const {
  if (real::isfinite(v_period_.high)) return period_loss_ * b.Q;
  return nome_loss_ < b.E ? nome_loss_ / b.E : T(1);
}

template <class T>
ClosedFormState<T> LagrangeTop<T>::at(T t) const {
  static const Split kNone{T(0), T(0)};
  static const Split kTurn = split<Split>(T(2) * real::pi<Wider<T>>());
  const PhaseRest<T> v = phase_rest(v_rate_, t, v_start_, v_period_);
  Basis b;
  evaluate_basis(v.rest, v.rest_low, b);

  Split sum_turns = kNone, difference_turns = kNone;
  if (hyperbolic_ && v.turns != T(0)) {
    const PhaseRest<T> s = phase_rest(sum_turn_, v.turns, kNone, kTurn);
    const PhaseRest<T> d = phase_rest(difference_turn_, v.turns, kNone, kTurn);
    sum_turns.high = s.rest;
    difference_turns.high = d.rest;
  }
  const Complex<T> half_sum = turned(phase_rest(sum_rate_, t, sum_turns, kTurn).rest);
  const Complex<T> half_difference = turned(phase_rest(difference_rate_, t, difference_turns, kTurn).rest);

  const Complex<T> low = (low_.size * b.low_factor) * (Complex<T>{low_.cos, low_.sin} * b.low(low_));
  const Complex<T> high = (high_.size * b.high_factor) * (Complex<T>{high_.cos, high_.sin} * b.high(high_));
  Complex<T> rate = (rate_.size * b.high_factor) * (Complex<T>{rate_.cos, rate_.sin} * b.high(rate_));
  if (!hyperbolic_) rate = rate * Complex<T>{b.cos1, T(winding_) * b.sin1};

  const Complex<T> A = half_sum * half_difference * (flipped_ ? high : low);
  const Complex<T> B = half_sum * conj(half_difference) * (flipped_ ? low : high);
  const Complex<T> back = conj(half_difference) * conj(half_difference);
  const Complex<T> Omega = back * rate;
  const T scale = T(1) / real::sqrt(norm2(A) + norm2(B));

  ClosedFormState<T> state;
  state.q_NB = {scale * A.re, {scale * B.re, scale * B.im, scale * A.im}};
  state.w_NB_B = {Omega.re, Omega.im, w3_};

  // The rounding of the set-up shifts v. The attitude then changes at the rate across the axis, the rate at its own derivative
  // 2 mu |A B|.
  const T gap_lost = gap_loss(b);  // also the relative error of `high` and Omega near the highest point
  const T shift = v_rate_.high > T(0) ? nutation_loss_ * real::abs(t) +
                                            (T(2) * period_loss_ * real::abs(v.turns) + gap_lost + start_loss_) / v_rate_.high
                                      : T(0);
  const T across = real::hypot(Omega.re, Omega.im);
  T set_up = across * shift + gap_lost * real::sqrt(norm2(high));
  T set_up_rate = across * gap_lost + gravity_ * T(2) * real::sqrt(norm2(A) * norm2(B)) * shift;
  // Next to the vertical that rounding acts as a rounding of V and of the slack (lagrange_roots.hpp). Until the nutation has
  // got under way, its effect grows with the first and second power of the time.
  if (real::abs(t) < near_top_time_) {
    const T turn = T(1) + near_top_rate_ * real::abs(t);
    set_up = std::min(set_up, near_top_loss_ * turn * turn);
    set_up_rate = std::min(set_up_rate, near_top_rate_loss_ * turn * turn);
  }
  state.attitude_error = std::min(attitude_floor_ + phase_loss_ * real::abs(t) + set_up, real::pi<T>());
  state.rate_error = rate_floor_ + across * (state.attitude_error + rate_turn_) + set_up_rate;
  return state;
}

template <class T>
SecularPhases<T> LagrangeTop<T>::secular_phases() const {
  return secular_;
}

template <class T>
T LagrangeTop<T>::nutation_period_s() const {
  return v_rate_.high > T(0) ? v_period_.high / v_rate_.high : std::numeric_limits<T>::infinity();
}

template class LagrangeTop<double>;
template class LagrangeTop<float80>;
template class LagrangeTop<float128>;

}  // namespace earthtop
