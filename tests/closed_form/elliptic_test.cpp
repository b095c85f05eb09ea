// SPDX-License-Identifier: GPL-3.0-or-later
/// Elliptic integrals and functions, compared with GSL and Boost in double, with Boost in 50 digits, and with their identities
/// in every scalar type.

#include "closed_form/elliptic.hpp"

#include <gsl/gsl_sf_elljac.h>
#include <gtest/gtest.h>

#include <boost/math/special_functions/ellint_rc.hpp>
#include <boost/math/special_functions/ellint_rd.hpp>
#include <boost/math/special_functions/ellint_rf.hpp>
#include <boost/math/special_functions/ellint_rj.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <random>

namespace earthtop {
namespace {

using Wide = boost::multiprecision::cpp_bin_float_50;

template <class T>
Wide wide(T x) {
  Wide sum = 0;
  for (int part = 0; part < 4; ++part) {
    const double high = static_cast<double>(x);
    sum += high;
    x -= static_cast<T>(high);
  }
  return sum;
}

/// |x - reference| in units of eps times the reference.
template <class T>
double error_in_eps(T x, const Wide& reference) {
  return static_cast<double>(abs((wide(x) - reference) / reference)) / static_cast<double>(real::epsilon<T>());
}

template <class T>
class Elliptic : public ::testing::Test {
 protected:
  T log_uniform(double low, double high) { return static_cast<T>(std::pow(10.0, uniform(low, high))); }
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  std::mt19937_64 engine_{7};
};
using Scalars = ::testing::Types<double, float80, float128>;
struct ScalarNames {
  template <class T>
  static std::string GetName(int) {
    return sizeof(T) == 8 ? "double" : std::is_same_v<T, float128> ? "float128" : "long_double";
  }
};
TYPED_TEST_SUITE(Elliptic, Scalars, ScalarNames);

// A duplication step rounds its numbers by about 4 eps / 2 and passes on a quarter of that; sums of positive terms follow.
// Together 8 eps.
TYPED_TEST(Elliptic, CarlsonIntegralsAreBoostsIn50Digits) {
  using T = TypeParam;
  for (int k = 0; k < 60; ++k) {
    const T x = k % 5 ? this->log_uniform(-8, 8) : T(0), y = this->log_uniform(-8, 8), z = this->log_uniform(-8, 8);
    const T p = this->log_uniform(-8, 8);
    const Wide X = wide(x), Y = wide(y), Z = wide(z), P = wide(p);
    EXPECT_LT(error_in_eps(elliptic::carlson_rc<T>(x, y), boost::math::ellint_rc(X, Y)), 8);
    EXPECT_LT(error_in_eps(elliptic::carlson_rf<T>(x, y, z), boost::math::ellint_rf(X, Y, Z)), 8);
    EXPECT_LT(error_in_eps(elliptic::carlson_rd<T>(x, y, z), boost::math::ellint_rd(X, Y, Z)), 16);
    EXPECT_LT(error_in_eps(elliptic::carlson_rj<T>(x, y, z, p), boost::math::ellint_rj(X, Y, Z, P)), 16);
  }
}

TYPED_TEST(Elliptic, LatticeHasTheQuarterPeriodAndTheNomeAtBothEnds) {
  using T = TypeParam;
  for (int k = 0; k < 40; ++k) {
    const T small = this->log_uniform(-18, -0.3011);
    for (const bool flip : {false, true}) {
      const T m = flip ? T(1) - small : small, m1 = flip ? small : T(1) - small;
      const elliptic::Lattice<T> l = elliptic::lattice<T>(m, m1);
      EXPECT_LT(real::abs(l.K / elliptic::complete_k<T>(m1) - T(1)), T(8) * real::epsilon<T>());
      // ln q = -pi K'/K is the logarithm of the nome, which the lattice stores.
      const T other = elliptic::complete_k<T>(m), ratio = flip ? l.K / other : other / l.K;
      EXPECT_LT(real::abs(real::log(l.q) / (-real::pi<T>() * ratio) - T(1)), T(16) * real::epsilon<T>());
    }
  }
}

TYPED_TEST(Elliptic, LegendresRelation) {
  using T = TypeParam;
  for (int k = 0; k < 40; ++k) {
    const T m1 = T(this->uniform(1e-6, 1)), m = T(1) - m1;
    const T K = elliptic::complete_k<T>(m1), K1 = elliptic::complete_k<T>(m);
    const T E = elliptic::complete_e<T>(m1), E1 = elliptic::complete_e<T>(m);
    EXPECT_LT(real::abs(E * K1 + E1 * K - K * K1 - real::pi<T>() / T(2)), T(64) * real::epsilon<T>());
  }
}

TYPED_TEST(Elliptic, JacobiFunctionsAreBoostsIn50Digits) {
  using T = TypeParam;
  for (int k = 0; k < 60; ++k) {
    const T small = this->log_uniform(-14, -0.3011);
    const T m = k % 2 ? T(1) - small : small, m1 = T(1) - m;
    const T x = T(this->uniform(-12, 12));
    const elliptic::JacobiValues<T> j = elliptic::jacobi<T>(x, elliptic::lattice<T>(m, m1));
    Wide cn, dn;
    const Wide sn = boost::math::jacobi_elliptic(Wide(sqrt(wide(m))), wide(x), &cn, &dn);
    // The argument is reduced with an error of eps per quarter period, 2 eps |x| in all; then some 8 operations contribute.
    const double bound = (16 + 4 * std::abs(static_cast<double>(x))) * static_cast<double>(real::epsilon<T>());
    EXPECT_NEAR(static_cast<double>(wide(j.sn) - sn), 0, bound);
    EXPECT_NEAR(static_cast<double>(wide(j.cn) - cn), 0, bound);
    EXPECT_NEAR(static_cast<double>(wide(j.dn) - dn), 0, bound);
    EXPECT_LT(real::abs(real::sin(j.am) - j.sn), T(bound));
    EXPECT_LT(real::abs(real::cos(j.am) - j.cn), T(bound));
  }
}

TYPED_TEST(Elliptic, InverseOfSnIsCarlsonsRF) {
  using T = TypeParam;
  for (int k = 0; k < 60; ++k) {
    const T small = this->log_uniform(-16, -0.3011);
    const T m = k % 2 ? T(1) - small : small, m1 = k % 2 ? small : T(1) - small;
    const elliptic::Lattice<T> l = elliptic::lattice<T>(m, m1);
    for (const T x : {this->log_uniform(-30, -1), T(this->uniform(0, 0.9)) * l.K}) {
      const elliptic::JacobiValues<T> j = elliptic::jacobi<T>(x, l);
      const T back = j.sn * elliptic::carlson_rf<T>(j.cn * j.cn, j.dn * j.dn, T(1));
      EXPECT_LT(real::abs(back / x - T(1)), T(64) * real::epsilon<T>() / j.cn / j.dn) << static_cast<double>(x);
    }
  }
}

TYPED_TEST(Elliptic, LimitsOfTheParameter) {
  using T = TypeParam;
  const T bound = T(8) * real::epsilon<T>();
  for (const double at : {-7.0, -1.0, 0.0, 0.25, 3.0}) {
    const T x = T(at);
    const elliptic::JacobiValues<T> circle = elliptic::jacobi<T>(x, elliptic::lattice<T>(T(0), T(1)));
    EXPECT_LT(real::abs(circle.sn - real::sin(x)), bound);
    EXPECT_LT(real::abs(circle.cn - real::cos(x)), bound);
    EXPECT_EQ(circle.dn, T(1));
    const elliptic::JacobiValues<T> hyperbola = elliptic::jacobi<T>(x, elliptic::lattice<T>(T(1), T(0)));
    const T e = real::exp(x), sech = T(2) / (e + T(1) / e);
    EXPECT_LT(real::abs(hyperbola.sn - (e - T(1) / e) * sech / T(2)), bound);
    EXPECT_LT(real::abs(hyperbola.cn - sech), bound);
    EXPECT_LT(real::abs(hyperbola.dn - sech), bound);
  }
}

TEST(EllipticDouble, JacobiFunctionsAreGsls) {
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> argument(-10, 10), parameter(0, 1);
  for (int k = 0; k < 1000; ++k) {
    const double x = argument(engine), m = parameter(engine);
    double sn, cn, dn;
    gsl_sf_elljac_e(x, m, &sn, &cn, &dn);
    const elliptic::JacobiValues<double> j = elliptic::jacobi<double>(x, elliptic::lattice<double>(m, 1 - m));
    EXPECT_NEAR(j.sn, sn, 4e-14);  // 200 eps: what GSL loses by its own descent from |x| = 10
    EXPECT_NEAR(j.cn, cn, 4e-14);
    EXPECT_NEAR(j.dn, dn, 4e-14);
  }
}

TEST(EllipticDouble, AmplitudeIsContinuous) {
  const elliptic::Lattice<double> l = elliptic::lattice<double>(0.9, 0.1);
  double before = elliptic::jacobi<double>(-20, l).am;
  for (double x = -20; x < 20; x += 1.0 / 64) {
    const double am = elliptic::jacobi<double>(x, l).am;
    EXPECT_LT(std::abs(am - before), 1.01 / 64);  // d am / dx = dn <= 1
    before = am;
  }
}

}  // namespace
}  // namespace earthtop
