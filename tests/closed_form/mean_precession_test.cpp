// SPDX-License-Identifier: GPL-3.0-or-later
/// The mean rates of a symmetric top, compared with its whole motion and with steady precession.

#include "earthtop/closed_form/mean_precession.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "earthtop/closed_form/lagrange_top.hpp"
#include "earthtop/closed_form/special_cases.hpp"
#include "earthtop/model/release.hpp"
#include "support/tolerances.hpp"

namespace earthtop::test {
namespace {

const SymmetricTop<double> kTop{5e-4, 8e-4, 0.2}, kHanging{5e-4, 8e-4, -0.2};

/// Azimuth of the axis (rad), counterclockwise about Up from East.
double azimuth(const LagrangeTop<double>& motion, double t_s) {
  const Mat3<double> R = rotation_matrix(motion.at(t_s).q_NB);
  return std::atan2(R(1, 2), R(0, 2));
}

// Over one period the azimuth, followed in small steps, advances by the mean rate times the period.
TEST(MeanPrecession, IsTheAdvanceOfTheAzimuthInAPeriod) {
  for (const SymmetricTop<double>& top : {kTop, kHanging})
    for (const Vec3<double>& w : {Vec3<double>(0, 0, 60), Vec3<double>(3, -8, 60), Vec3<double>(5, 2, -45)}) {
      const Quaternion<double> q{0.9, Vec3<double>(0.3, -0.1, 0.2)};
      const LagrangeTop<double> motion(top, q, w);
      const double period = motion.nutation_period_s();
      double advance = 0, before = azimuth(motion, 0);
      for (int k = 1; k <= 400; ++k) {
        const double now = azimuth(motion, period * k / 400);
        advance += std::remainder(now - before, 2 * std::numbers::pi);
        before = now;
      }
      const auto rates = mean_rates(top_constants(top, q, w));
      ASSERT_TRUE(rates);
      EXPECT_NEAR(rates->nutation_rad_s * period, 2 * std::numbers::pi, testing::rounding(100));
      EXPECT_NEAR(rates->precession_rad_s * period, advance, testing::rounding(100));
    }
}

TEST(MeanPrecession, OfASteadyTopIsItsRate) {
  const double w3 = 80, tilt = 0.7;
  const auto steady = steady_precession_rates(kTop, w3, std::cos(tilt));
  ASSERT_TRUE(steady);
  const Quaternion<double> q{std::cos(tilt / 2), Vec3<double>(std::sin(tilt / 2), 0, 0)};
  for (const double rate : {steady->slow, steady->fast}) {
    const auto rates = mean_rates(top_constants(kTop, q, Vec3<double>(0, rate * std::sin(tilt), w3)));
    ASSERT_TRUE(rates);
    EXPECT_NEAR(rates->precession_rad_s, rate, 1e-11 * rates->nutation_rad_s);
  }
}

// Next to a pole the axis goes in two circles, x + iy = A e^(i a t) + B e^(i b t) with a^2 - (I3 w3/I1) a + m g l/I1 = 0 (below the
// pivot both signs turn), and its azimuth follows the larger circle. What this leaves out is the square of the distance.
TEST(MeanPrecession, NextToThePolesIsThatOfTheLargerCircle) {
  for (const SymmetricTop<double>& top : {kTop, kHanging})
    for (const double distance : {1e-3, 1e-4, 1e-5})
      for (const bool below : {false, true}) {
        const double w3 = 80, pole = below ? -1 : 1, half = top.I3 * w3 / top.I1 / 2 * pole;
        const double root = std::sqrt(half * half - pole * top.mgl / top.I1);
        const double slow = half - (half > 0 ? root : -root), fast = half + (half > 0 ? root : -root);
        const double tilt = below ? std::numbers::pi - distance : distance;
        const Quaternion<double> q{std::cos(tilt / 2), Vec3<double>(std::sin(tilt / 2), 0, 0)};
        for (const double part : {0.2, 0.9}) {  // of the fast circle
          const double rate = (1 - part) * slow + part * fast;
          const auto rates = mean_rates(top_constants(top, q, Vec3<double>(0, rate * std::sin(tilt), w3)));
          ASSERT_TRUE(rates) << distance << below;
          constexpr double kRoundings = 16;
          const double tolerance = distance * distance + kRoundings * 0x1p-52;
          EXPECT_NEAR(rates->precession_rad_s, part < 0.5 ? slow : fast, tolerance * std::abs(fast)) << distance << below;
          EXPECT_NEAR(rates->nutation_rad_s, 2 * root, tolerance * std::abs(fast)) << distance << below;
        }
      }
}

/// A top released with a precession (rad/s) at a tilt (degrees), and the mean rates of its motion, from sums in 90 digits.
struct Case {
  double I1, I3, mgl, tilt_deg, w3, rate, precession, nutation;
};
const Case kCases[] = {{0.0005, 0.0008, 0.2, 1e-12, 80.0, 0.0, 3.2052633857173455, 121.589473228565312},
                       {0.0005, 0.0008, -0.2, 1e-12, 80.0, 0.0, -3.05221845696084054, 134.104436913921685},
                       {0.0005, 0.0008, 0.2, 1e-12, 80.0, 3.0, 3.2052633857173455, 121.589473228565312},
                       {0.0005, 0.0008, -0.2, 1e-12, 80.0, 3.0, -3.05221845696084054, 134.104436913921685},
                       {0.0005, 0.0008, 0.2, 1e-12, -120.0, 7.0, -2.10644324555598135, 187.787113508888043},
                       {0.0005, 0.0008, -0.2, 1e-12, -120.0, 7.0, 2.06120537705010285, 196.122410754100211},
                       {0.0005, 0.0008, 0.2, 1e-12, 10000.0, 0.0, 0.025000039062622071, 15999.9499999218752},
                       {0.0005, 0.0008, -0.2, 1e-12, 10000.0, 0.0, -0.02499996093762207, 16000.0499999218757},
                       {0.0005, 0.0008, 0.2, 1e-06, 80.0, 0.0, 3.20526338571734548, 121.589473228565314},
                       {0.0005, 0.0008, -0.2, 1e-06, 80.0, 0.0, -3.05221845696084055, 134.104436913921684},
                       {0.0005, 0.0008, 0.2, 1e-06, 80.0, 3.0, 3.20526338571734548, 121.589473228565313},
                       {0.0005, 0.0008, -0.2, 1e-06, 80.0, 3.0, -3.05221845696084055, 134.104436913921684},
                       {0.0005, 0.0008, 0.2, 1e-06, -120.0, 7.0, -2.10644324555598134, 187.787113508888043},
                       {0.0005, 0.0008, -0.2, 1e-06, -120.0, 7.0, 2.06120537705010285, 196.12241075410021},
                       {0.0005, 0.0008, 0.2, 1e-06, 10000.0, 0.0, 0.025000039062622071, 15999.9499999218752},
                       {0.0005, 0.0008, -0.2, 1e-06, 10000.0, 0.0, -0.02499996093762207, 16000.0499999218757},
                       {0.0005, 0.0008, 0.2, 0.01, 80.0, 0.0, 3.20526338429202747, 121.589473336911158},
                       {0.0005, 0.0008, -0.2, 0.01, 80.0, 0.0, -3.05221845792422459, 134.104436829124632},
                       {0.0005, 0.0008, 0.2, 0.01, 80.0, 3.0, 3.20526338442577732, 121.589473330412848},
                       {0.0005, 0.0008, -0.2, 0.01, 80.0, 3.0, -3.05221845774049852, 134.104436835830592},
                       {0.0005, 0.0008, 0.2, 0.01, -120.0, 7.0, -2.10644324500776463, 187.787113587645332},
                       {0.0005, 0.0008, -0.2, 0.01, -120.0, 7.0, 2.06120537735747529, 196.122410690965778},
                       {0.0005, 0.0008, 0.2, 0.01, 10000.0, 0.0, 0.025000039062621476, 15999.9499999226367},
                       {0.0005, 0.0008, -0.2, 0.01, 10000.0, 0.0, -0.024999960937622665, 16000.0499999211141},
                       {0.0005, 0.0008, 0.2, 0.5, 80.0, 0.0, 3.2052598224608922, 121.589744090684855},
                       {0.0005, 0.0008, -0.2, 0.5, 80.0, 0.0, -3.05222086541323579, 134.104224922228652},
                       {0.0005, 0.0008, 0.2, 0.5, 80.0, 3.0, 3.20526015682441017, 121.589727845421825},
                       {0.0005, 0.0008, -0.2, 0.5, 80.0, 3.0, -3.05222040610737054, 134.10424168678052},
                       {0.0005, 0.0008, 0.2, 0.5, -120.0, 7.0, -2.10644187503419773, 187.787310400024722},
                       {0.0005, 0.0008, -0.2, 0.5, -120.0, 7.0, 2.0612061454779379, 196.122252919007168},
                       {0.0005, 0.0008, 0.2, 0.5, 10000.0, 0.0, 0.0250000390611346721, 15999.9500018257369},
                       {0.0005, 0.0008, -0.2, 0.5, 10000.0, 0.0, -0.0249999609391094317, 16000.0499980180438},
                       {0.0005, 0.0008, 0.2, 20.0, 80.0, 0.0, 3.19965958324711767, 122.016539049582278},
                       {0.0005, 0.0008, -0.2, 20.0, 80.0, 0.0, -3.0560520658980356, 133.767651855966272},
                       {0.0005, 0.0008, 0.2, 20.0, 80.0, 3.0, 3.20016689795287252, 121.991827565331017},
                       {0.0005, 0.0008, -0.2, 20.0, 80.0, 3.0, -3.05534078432105666, 133.793597218185482},
                       {0.0005, 0.0008, 0.2, 20.0, -120.0, 7.0, -2.10430081066418105, 188.096862115808776},
                       {0.0005, 0.0008, -0.2, 20.0, -120.0, 7.0, 2.06242645975875696, 195.872396624348442},
                       {0.0005, 0.0008, 0.2, 20.0, 10000.0, 0.0, 0.0250000367068365112, 15999.9530153136833},
                       {0.0005, 0.0008, -0.2, 20.0, 10000.0, 0.0, -0.0249999632933505118, 16000.046984575762},
                       {0.0005, 0.0008, 0.2, 75.0, 80.0, 0.0, 3.14136345712631967, 126.593194891764513},
                       {0.0005, 0.0008, -0.2, 75.0, 80.0, 0.0, -3.10220093086015528, 129.812603857267561},
                       {0.0005, 0.0008, 0.2, 75.0, 80.0, 3.0, 3.14491225914921273, 126.41540675932722},
                       {0.0005, 0.0008, -0.2, 75.0, 80.0, 3.0, -3.09593778153405307, 130.039228511595579},
                       {0.0005, 0.0008, 0.2, 75.0, -120.0, 7.0, -2.08379167702130843, 191.31953866547722},
                       {0.0005, 0.0008, -0.2, 75.0, -120.0, 7.0, 2.07679177967125205, 193.04499376899604},
                       {0.0005, 0.0008, 0.2, 75.0, 10000.0, 0.0, 0.0250000101100132332, 15999.9870591518496},
                       {0.0005, 0.0008, -0.2, 75.0, 10000.0, 0.0, -0.0249999898897753352, 16000.0129410563593},
                       {0.0005, 0.0008, 0.2, 120.0, 80.0, 0.0, 3.08521754652684645, 131.247199287206014},
                       {0.0005, 0.0008, -0.2, 120.0, 80.0, 0.0, -3.16104098496109732, 125.020416770243592},
                       {0.0005, 0.0008, 0.2, 120.0, 80.0, 3.0, 3.08771934611707063, 131.118092101002919},
                       {0.0005, 0.0008, -0.2, 120.0, 80.0, 3.0, -3.15530930194835194, 125.225441747807029},
                       {0.0005, 0.0008, 0.2, 120.0, -120.0, 7.0, -2.06802229971850443, 194.377777182287214},
                       {0.0005, 0.0008, -0.2, 120.0, -120.0, 7.0, 2.0941508818958182, 189.881178614946741},
                       {0.0005, 0.0008, 0.2, 120.0, 10000.0, 0.0, 0.0249999804686889655, 16000.0250000683594},
                       {0.0005, 0.0008, -0.2, 120.0, 10000.0, 0.0, -0.0250000195311889645, 15999.9750000683602},
                       {0.0005, 0.0008, 0.2, 179.0, 80.0, 0.0, 3.0522280906775248, 134.103588958407293},
                       {0.0005, 0.0008, -0.2, 179.0, 80.0, 0.0, -3.20524913315508043, 121.590556647087376},
                       {0.0005, 0.0008, 0.2, 179.0, 80.0, 3.0, 3.05222902904914996, 134.103539618168959},
                       {0.0005, 0.0008, -0.2, 179.0, 80.0, 3.0, -3.20524656022223722, 121.590647826217447},
                       {0.0005, 0.0008, 0.2, 179.0, -120.0, 7.0, -2.06120705254049366, 196.121909665250901},
                       {0.0005, 0.0008, -0.2, 179.0, -120.0, 7.0, 2.10643939137850625, 187.787752687699466},
                       {0.0005, 0.0008, 0.2, 179.0, 10000.0, 0.0, 0.0249999609435714036, 16000.049992306693},
                       {0.0005, 0.0008, -0.2, 179.0, 10000.0, 0.0, -0.0250000390566725887, 15999.9500075371769},
                       {0.0005, 0.0008, 0.2, 179.999, 80.0, 0.0, 3.05221845697047438, 134.104436913073714},
                       {0.0005, 0.0008, -0.2, 179.999, 80.0, 0.0, -3.20526338570309232, 121.589473229648771},
                       {0.0005, 0.0008, 0.2, 179.999, 80.0, 3.0, 3.05221845697141282, 134.10443691302437},
                       {0.0005, 0.0008, -0.2, 179.999, 80.0, 3.0, -3.20526338570051904, 121.589473229739962},
                       {0.0005, 0.0008, 0.2, 179.999, -120.0, 7.0, -2.06120537705177826, 196.122410753599118},
                       {0.0005, 0.0008, -0.2, 179.999, -120.0, 7.0, 2.10644324555212704, 187.787113509527238},
                       {0.0005, 0.0008, 0.2, 179.999, 10000.0, 0.0, 0.024999960937622076, 16000.0499999218681},
                       {0.0005, 0.0008, -0.2, 179.999, 10000.0, 0.0, -0.025000039062622065, 15999.9499999218828},
                       {0.0005, 0.0008, 0.2, 179.999999, 80.0, 0.0, 3.05221845696084055, 134.104436913921684},
                       {0.0005, 0.0008, -0.2, 179.999999, 80.0, 0.0, -3.20526338571734548, 121.589473228565314},
                       {0.0005, 0.0008, 0.2, 179.999999, 80.0, 3.0, 3.05221845696084055, 134.104436913921684},
                       {0.0005, 0.0008, -0.2, 179.999999, 80.0, 3.0, -3.20526338571734548, 121.589473228565314},
                       {0.0005, 0.0008, 0.2, 179.999999, -120.0, 7.0, -2.06120537705010285, 196.12241075410021},
                       {0.0005, 0.0008, -0.2, 179.999999, -120.0, 7.0, 2.10644324555598135, 187.787113508888043},
                       {0.0005, 0.0008, 0.2, 179.999999, 10000.0, 0.0, 0.02499996093762207, 16000.0499999218757},
                       {0.0005, 0.0008, -0.2, 179.999999, 10000.0, 0.0, -0.025000039062622071, 15999.9499999218752},
                       {45.01, 0.01, -147.0, 3.8226, 0.0, 0.18068, 1.80698496382921924, 3.61336739245983039},
                       {45.01, 0.01, -147.0, 3.8226, 0.0, 0.018068, 1.80671877335558531, 3.61337729343919103},
                       {45.01, 0.01, -147.0, 3.8226, 0.0, 0.0018068, 1.80669170888779751, 3.61337739244864494},
                       {45.01, 0.01, -147.0, 3.8226, 0.0, 0.00018068, 1.8066889979857171, 3.61337739343873945}};

// From 1e-12 to 179.999999 degrees, and along ellipses of a pendulum as narrow as 1e-4: to 1e-13 of itself, and the precession beside
// half the nutation (Airy's rate) to the last digit of a double.
TEST(MeanPrecession, HasAllDigitsNextToThePolesAndOnNarrowEllipses) {
  constexpr double kAsked = 1e-13,
                   kRounding = 1e-15;  // the precession's is what is promised; the nutation's is that of its sums
  for (const Case& c : kCases) {
    SCOPED_TRACE(::testing::Message() << c.mgl << " " << c.tilt_deg << " " << c.w3 << " " << c.rate);
    const Quaternion<float128> q_LB = release_attitude<float128>(c.tilt_deg, 0, 20);
    const Vec3<float128> up_B = rotation_matrix(q_LB).row(2).transpose(), w_B(c.rate * up_B[0], c.rate * up_B[1], c.w3);
    const auto rates = mean_rates(top_constants(SymmetricTop<float128>{c.I1, c.I3, c.mgl}, q_LB, w_B));
    ASSERT_TRUE(rates);
    EXPECT_NEAR(rates->precession_rad_s, c.precession, kAsked * std::abs(c.precession));
    EXPECT_LE(std::abs(rates->precession_rad_s - c.precession), rates->precession_bound_rad_s);
    EXPECT_LE(rates->precession_bound_rad_s, kAsked * std::abs(c.precession));
    EXPECT_NEAR(rates->nutation_rad_s, c.nutation, kRounding * c.nutation);
  }
}

// Near a separatrix the sums converge slowly: the bound says so, and beyond 1 % there is no figure.
TEST(MeanPrecession, IsWithinItsBoundNearASeparatrix) {
  const auto with = [](double energy) {  // a hanging pendulum without spin that turns a little about Up, near the top
    BasicTopConstants<float128> c;
    c.gravity = -2, c.up = {float128(energy) + float128(2), float128(1e-7)};
    c.down = {float128(energy) - float128(2), float128(1e-7)};
    return mean_rates(c);
  };
  // From sums of 1,024 to 131,072 steps in 40 digits.
  for (const auto& [distance, precession] :
       {std::pair(1e-2, 0.35829268728615212), {1e-4, 0.23513533618195284}, {1e-6, 0.18596652411878466}}) {
    const auto rates = with(2 - distance);
    ASSERT_TRUE(rates) << distance;
    EXPECT_LE(std::abs(rates->precession_rad_s - precession), rates->precession_bound_rad_s) << distance;
    constexpr double kTruncated = 1e-7;  // rad/s: 16,384 steps, the most that are taken, leave this at the nearest one
    EXPECT_LE(rates->precession_bound_rad_s, kTruncated) << distance;
  }
}

// There is none on the way to the upright position, which takes for ever, and for a top without torque.
TEST(MeanPrecession, OfWhichThereIsNone) {
  EXPECT_FALSE(mean_rates(top_constants(kTop, Quaternion<double>(), Vec3<double>(0, 0, 10))));
  EXPECT_FALSE(
      mean_rates(top_constants({5e-4, 8e-4, 0}, Quaternion<double>{0.9, Vec3<double>(0.3, 0, 0)}, Vec3<double>(1, 0, 60))));
}

}  // namespace
}  // namespace earthtop::test
