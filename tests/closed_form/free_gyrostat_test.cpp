// SPDX-License-Identifier: GPL-3.0-or-later
/// The free gyrostat's closed form: against references of 40 digits from the equations of motion, against the free body, what is conserved,
/// its stated errors over random bodies, and a million radians.
#include "earthtop/closed_form/free_gyrostat.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <set>

#include "closed_form/error_table.hpp"
#include "earthtop/closed_form/free_body.hpp"
#include "support/contact_references.hpp"
#include "support/extended_integration.hpp"
#include "support/json.hpp"
#include "support/tolerances.hpp"

namespace earthtop::test {
namespace {

using Wide = float128;

/// Every number is exact in double.
struct GyrostatCase {
  Vec3<double> moments, w0_B;
  double h = 0;
  int axis = 2;
  Quaternion<double> q0_NB{0.5, {0.125, -0.75, 0.25}};
};

template <class T>
Vec3<T> in(const Vec3<double>& v) {
  return {T(v[0]), T(v[1]), T(v[2])};
}
template <class T>
FreeGyrostat<T> gyrostat(const GyrostatCase& c) {
  const Mat3<T> I = in<T>(c.moments).asDiagonal();
  return {I, c.axis, T(c.h), Quaternion<T>{T(c.q0_NB.w), in<T>(c.q0_NB.v)}, in<T>(c.w0_B)};
}

double off(const Vec3<Wide>& a, const Vec3<Wide>& b) { return static_cast<double>(norm<Wide>(a - b)); }

/// Bodies of all regimes: any; momenta that leave two roots complex; equal moments; small nutations; the axis of a small momentum.
GyrostatCase random_case(std::mt19937_64& engine) {
  const auto number = [&](double least, double most) { return std::uniform_real_distribution<double>(least, most)(engine); };
  GyrostatCase c;
  c.axis = std::uniform_int_distribution<int>(0, 2)(engine);
  for (int i = 0; i < 3; ++i) c.moments[i] = number(1, 3), c.w0_B[i] = number(-2, 2);
  c.h = number(-4, 4);
  const int one = (c.axis + 1) % 3, other = (c.axis + 2) % 3;
  switch (std::uniform_int_distribution<int>(0, 6)(engine)) {
    case 0: c.h = (c.moments[one] - c.moments[c.axis]) * c.w0_B[c.axis] + number(-0.1, 0.1); break;
    case 1: c.moments[one] = c.moments[other]; break;
    case 2: c.w0_B[one] *= 1e-7, c.w0_B[other] *= 1e-7; break;
    case 3: c.h *= 1e-5; break;
    case 4: c.moments[one] = c.moments[c.axis]; break;
    default: break;
  }
  return c;
}

/// dq/dt = q w / 2 and dL/dt = L x w, and the turn about the rotor's axis, integrated.
struct Integrated {
  Quaternion<Wide> q_NB;
  Vec3<Wide> w_NB_B;
  Wide turn;
};
Integrated integrated(const GyrostatCase& c, Wide t_s) {
  const Vec3<Wide> I = in<Wide>(c.moments), w0 = in<Wide>(c.w0_B);
  const auto rates = [&](const auto& x) {
    Vec3<Wide> w(x[4], x[5], x[6]);
    w[c.axis] -= Wide(c.h);
    return Vec3<Wide>(w.cwiseQuotient(I));
  };
  const auto change = [&](const std::array<Wide, 8>& x) {
    const Vec3<Wide> L(x[4], x[5], x[6]), w = rates(x), dL = L.cross(w);
    const Quaternion<Wide> dq = Quaternion<Wide>{x[0], {x[1], x[2], x[3]}} * Quaternion<Wide>{Wide(0), Vec3<Wide>(w / Wide(2))};
    return std::array<Wide, 8>{dq.w, dq.v[0], dq.v[1], dq.v[2], dL[0], dL[1], dL[2], w[c.axis]};
  };
  const Quaternion<Wide> q = wide(c.q0_NB).normalized();
  Vec3<Wide> L = I.cwiseProduct(w0);
  L[c.axis] += Wide(c.h);
  const double fastest = static_cast<double>(norm<Wide>(w0) + norm<Wide>(L) / I.minCoeff());
  const int steps = static_cast<int>(2 * fastest * std::abs(static_cast<double>(t_s))) + 1;
  const auto x = testing::extrapolated<Wide, 8>({q.w, q.v[0], q.v[1], q.v[2], L[0], L[1], L[2], Wide(0)}, t_s, steps, change);
  return {Quaternion<Wide>{x[0], {x[1], x[2], x[3]}}.normalized(), rates(x), x[7]};
}

struct Reference {
  GyrostatCase body;
  std::string name, regime;
  double t_s = 0;
  Quaternion<Wide> q_NB;
  Vec3<Wide> w_NB_B;
  Wide turn = 0;
};
std::vector<Reference> references() {
  std::vector<Reference> all;
  const auto number = [](const nlohmann::json& text) { return testing::parsed<Wide>(text.get<std::string>()); };
  const nlohmann::json file = testing::parse_json(testing::read_file(EARTHTOP_TESTS "/data/gyrostat/free_motions.json"));
  for (const nlohmann::json& one : file.at("cases")) {
    Reference made;
    made.name = one.at("name"), made.regime = one.at("regime");
    for (std::size_t i = 0; i < 3; ++i) {
      const int k = static_cast<int>(i);
      made.body.moments[k] = one.at("moments").at(i), made.body.w0_B[k] = one.at("w0_B").at(i);
      made.q_NB.v[k] = number(one.at("q_NB").at(i + 1)), made.w_NB_B[k] = number(one.at("w_NB_B").at(i));
    }
    made.q_NB.w = number(one.at("q_NB").at(0));
    made.body.h = one.at("h"), made.body.axis = one.at("axis"), made.t_s = one.at("t_s");
    made.turn = number(one.at("turn"));
    all.push_back(made);
  }
  return all;
}

constexpr const char* kRegimes[] = {"uniform", "symmetric", "real_roots", "complex_roots"};

template <class T>
void expect_reference(const Reference& known) {
  const FreeGyrostat<T> body = gyrostat<T>(known.body);
  EXPECT_EQ(kRegimes[static_cast<int>(body.regime())], known.regime);
  const ClosedFormState<T> made = body.at(T(known.t_s));
  EXPECT_LE(angle_between(wide(made.q_NB), known.q_NB), static_cast<double>(made.attitude_error));
  EXPECT_LE(off(wide(made.w_NB_B), known.w_NB_B), static_cast<double>(made.rate_error));
  const AxialTurn<T> turn = body.axial_turn(T(known.t_s));
  EXPECT_LE(real::abs(static_cast<Wide>(turn.angle) - known.turn), static_cast<Wide>(turn.error));
}

TEST(FreeGyrostat, MeetsItsReferencesWithinItsStatedErrors) {
  std::set<std::string> regimes;
  for (const Reference& known : references()) {
    SCOPED_TRACE(known.name);
    regimes.insert(known.regime);
    expect_reference<double>(known);
    expect_reference<float80>(known);
    expect_reference<Wide>(known);
    const auto stated = gyrostat<double>(known.body).at(known.t_s).attitude_error;
    EXPECT_LE(stated, 20 * real::epsilon<double>());  // far from and near a separatrix alike, as constants have 113 bits
  }
  EXPECT_EQ(regimes, (std::set<std::string>{"complex_roots", "real_roots", "symmetric", "uniform"}));
}

TEST(FreeGyrostat, RandomBodiesAreRightWithinTheirStatedErrors) {
  std::mt19937_64 engine(61);
  std::set<int> regimes;
  std::vector<double> times_wider;
  for (int k = 0; k < 200; ++k) {
    SCOPED_TRACE(k);
    const GyrostatCase c = random_case(engine);
    const double t = std::uniform_real_distribution<double>(-20, 20)(engine);
    const auto body = gyrostat<double>(c);
    const auto exact_body = gyrostat<Wide>(c);
    regimes.insert(static_cast<int>(body.regime()));
    const auto made = body.at(t);
    const auto exact = exact_body.at(Wide(t));
    const double error = angle_between(wide(made.q_NB), exact.q_NB);
    EXPECT_LE(error, made.attitude_error);
    EXPECT_LE(off(wide(made.w_NB_B), exact.w_NB_B), made.rate_error);
    EXPECT_LE(std::abs(static_cast<double>(exact_body.axial_turn(Wide(t)).angle - body.axial_turn(t).angle)),
              body.axial_turn(t).error);
    times_wider.push_back(made.attitude_error / error);
    if (k % 10 != 0) continue;
    const Integrated truth = integrated(c, Wide(t));
    // The integration is exact to 1e-26 over some hundred steps, as half the step shows.
    EXPECT_LT(angle_between(exact.q_NB, truth.q_NB), 1e-24);  // truncation of the integration at its tolerance
    EXPECT_LT(off(exact.w_NB_B, truth.w_NB_B), 1e-24);        // the same
    EXPECT_LT(std::abs(static_cast<double>(exact_body.axial_turn(Wide(t)).angle - truth.turn)), 1e-24);  // the same
  }
  EXPECT_EQ(regimes, (std::set{1, 2, 3}));
  std::ranges::sort(times_wider);
  RecordProperty("median_of_bound_over_error", std::to_string(times_wider[100]));
  EXPECT_LT(times_wider[100], 40);
}

// Without a momentum inside it is a free body, which has other formulas.
TEST(FreeGyrostat, IsAFreeBodyWithoutMomentumInside) {
  std::mt19937_64 engine(62);
  for (int k = 0; k < 50; ++k) {
    GyrostatCase c = random_case(engine);
    c.h = 0;
    const auto body = gyrostat<Wide>(c).at(Wide(7));
    const auto free = FreeBody<Wide>(in<Wide>(c.moments), wide(c.q0_NB), in<Wide>(c.w0_B)).at(Wide(7));
    EXPECT_LE(angle_between(body.q_NB, free.q_NB), static_cast<double>(body.attitude_error + free.attitude_error)) << k;
    EXPECT_LE(off(body.w_NB_B, free.w_NB_B), static_cast<double>(body.rate_error + free.rate_error)) << k;
  }
}

TEST(FreeGyrostat, KeepsMomentumAndEnergy) {
  std::mt19937_64 engine(63);
  for (int k = 0; k < 100; ++k) {
    const GyrostatCase c = random_case(engine);
    const auto body = gyrostat<Wide>(c);
    const Vec3<Wide> I = in<Wide>(c.moments);
    const auto conserved = [&](const ClosedFormState<Wide>& x) {
      Vec3<Wide> L = I.cwiseProduct(x.w_NB_B);
      const Wide energy = x.w_NB_B.dot(L);
      L[c.axis] += Wide(c.h);
      return std::pair{times<Wide>(rotation_matrix(x.q_NB), L), energy};
    };
    const auto start = body.at(Wide(0)), later = body.at(Wide(33.3)), before = body.at(Wide(-12345.6));
    for (const auto& x : {later, before}) {
      const auto [L0, E0] = conserved(start);
      const auto [L, E] = conserved(x);
      // A momentum of about 10 units turns by the attitude's error, and moments of up to 3 multiply that of the rates.
      EXPECT_LE(off(L, L0), static_cast<double>(20 * x.attitude_error + 3 * x.rate_error)) << k;
      EXPECT_LE(static_cast<double>(real::abs(E - E0)), static_cast<double>(50 * x.rate_error)) << k;
    }
  }
}

/// On a separatrix, or as near as rounding lets it be, from which the motion comes to an unstable rotation about the rotor's axis: with A = B
/// = 0 at x = 1, which is (1/I1 - 1/I3) l1^2 + (1/I2 - 1/I3) l2^2 + 2 (h/G) (1 - x) / I3 = 0.
TEST(FreeGyrostat, HasFiniteResultsOnASeparatrix) {
  const double h = 1, G = 28 * h * (1 - 3 / std::sqrt(14.));  // of L = (1, 2, 3) G / sqrt(14)
  const double L = G / std::sqrt(14.);
  const GyrostatCase c{{1, 4, 2}, {L, 2 * L / 4, (3 * L - h) / 2}, h};
  for (const double t : {1.0, 30.0, 1e4, 1e9}) {
    const auto state = gyrostat<double>(c).at(t);
    EXPECT_TRUE(std::isfinite(state.q_NB.w) && std::isfinite(gyrostat<double>(c).axial_turn(t).angle)) << t;
  }
}

TEST(FreeGyrostat, GivesNaNForWhatIsNoBody) {
  GyrostatCase c{{1, 3, 2}, {1, 0.5, 2}, 1.25};
  c.moments[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(gyrostat<double>(c).at(1).q_NB.w));
  c.moments[1] = 3, c.w0_B[0] = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(std::isnan(gyrostat<double>(c).at(1).q_NB.w));
}

/// A body with products of inertia across the rotor's axis is one in turned axes.
TEST(FreeGyrostat, TakesProductsOfInertiaAcrossTheAxis) {
  const GyrostatCase c{{1, 3, 2}, {1, 0.5, 2}, 1.25};
  const Quaternion<double> turn{0.8, {0, 0, 0.6}};
  const Mat3<double> R = rotation_matrix(turn), I = R * c.moments.asDiagonal() * R.transpose();
  const FreeGyrostat<double> turned(I, 2, c.h, c.q0_NB * turn.conjugate(), R * c.w0_B);
  const auto made = turned.at(10), plain = gyrostat<double>(c).at(10);
  // The turned tensor and rate are rounded, which 30 rad carry on.
  EXPECT_LT(angle_between(wide(made.q_NB * turn), wide(plain.q_NB)), testing::rounding(200));
  EXPECT_NEAR(turned.axial_turn(10).angle, gyrostat<double>(c).axial_turn(10).angle, testing::rounding(1000));
}

/// After a full period l and w are again what they were, and the attitude has turned about the momentum. So a motion over one period and a
/// rest, integrated, tells of any number of periods.
TEST(FreeGyrostat, StaysAccurateOverAMillionRadians) {
  for (const GyrostatCase& c : {GyrostatCase{{1, 3, 2}, {1, 0.5, 2}, 1.25}, GyrostatCase{{2, 3, 1}, {2, 0.5, 0.75}, 0.75}}) {
    // The period is where the integrated rate across the axis returns; a secant from the closed form's, which is known well enough.
    const auto away = [&](const Wide& t) { return Wide(integrated(c, t).w_NB_B[0] - Wide(c.w0_B[0])); };
    const auto body = gyrostat<Wide>(c);
    Wide period = 0;
    const auto distance = [&](double t) { return off(body.at(Wide(t)).w_NB_B, in<Wide>(c.w0_B)); };
    for (double t = 0.2; t < 40 && period == Wide(0); t += 0.01)
      if (distance(t) < 0.05 && distance(t) < distance(t + 0.01)) period = Wide(t);
    ASSERT_GT(period, Wide(0));
    Wide before = period + Wide(1e-3);
    for (int k = 0; k < 7; ++k) {
      const Wide here = away(period), there = away(before);
      if (here == there) break;
      const Wide next = period - here * (period - before) / (here - there);
      before = period, period = next;
    }
    const Integrated round = integrated(c, period);
    ASSERT_LT(off(round.w_NB_B, in<Wide>(c.w0_B)), 1e-26);  // 32 steps of an integration that is exact to 1e-28
    const Quaternion<Wide> start = wide(c.q0_NB).normalized();
    Quaternion<Wide> each = round.q_NB * start.conjugate(), turned;
    constexpr int kPeriods = 200000;
    for (int n = kPeriods; n > 0; n /= 2, each = (each * each).normalized())
      if (n % 2 == 1) turned = (turned * each).normalized();
    const Integrated rest = integrated(c, Wide(1));
    const double t = static_cast<double>(kPeriods * period + Wide(1));
    const Wide late = Wide(t) - (kPeriods * period + Wide(1));  // as t is rounded
    const Quaternion<Wide> nudge{Wide(1), Vec3<Wide>(late / Wide(2) * rest.w_NB_B)};
    const Quaternion<Wide> truth = (turned * rest.q_NB * nudge).normalized();
    const auto made = gyrostat<double>(c).at(t);
    EXPECT_GT(t * static_cast<double>(norm<Wide>(round.w_NB_B)), 1e6);
    EXPECT_LT(angle_between(wide(made.q_NB), truth), made.attitude_error);
    EXPECT_LT(made.attitude_error, 10 * real::epsilon<double>());  // of a rounding, and nothing of the time
    EXPECT_LT(angle_between(body.at(Wide(t)).q_NB, truth),
              1e-19);  // 2e5 periods of 1e-27, and the square of the nudge of 1e-10
    const AxialTurn<double> turn = gyrostat<double>(c).axial_turn(t);
    EXPECT_LE(std::abs(static_cast<double>(kPeriods * round.turn + rest.turn + late * rest.w_NB_B[2] - turn.angle)),
              turn.error);
  }
}

/// A start on a separatrix but for its rounding: the motion comes back to an unstable one, where the stated error in 113 bits grows. It is
/// held against the motion of which this start is a later state, whose own start leaves the roots well apart.
TEST(FreeGyrostat, StatesLargerErrorsNearASeparatrix) {
  const GyrostatCase near{{2, 3, 1}, {2, 1e-14, 0.75}, 0.75};
  const auto whole = gyrostat<Wide>(near);
  const auto away = whole.at(Wide(28)), later = whole.at(Wide(64));
  EXPECT_GT(off(away.w_NB_B, in<Wide>(near.w0_B)), 0.5);
  const auto from = [&](const Vec3<Wide>& w) {
    return FreeGyrostat<Wide>(in<Wide>(near.moments).asDiagonal(), 2, Wide(near.h), away.q_NB, w);
  };
  const auto again = from(away.w_NB_B).at(Wide(36));
  double growth = 0;  // of an error of the second start
  for (int i = 0; i < 3; ++i) {
    Vec3<Wide> w = away.w_NB_B;
    w[i] += away.rate_error;
    growth += angle_between(from(w).at(Wide(36)).q_NB, again.q_NB);
  }
  EXPECT_LT(later.attitude_error, 1e-27);  // some thousand roundings of 113 bits, as its roots are well apart
  EXPECT_GT(again.attitude_error, Wide(1e6) * later.attitude_error);
  EXPECT_LE(angle_between(again.q_NB, later.q_NB), static_cast<double>(again.attitude_error + later.attitude_error) + growth);
}

}  // namespace
}  // namespace earthtop::test
