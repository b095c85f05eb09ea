// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/number_words.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "text/short_number.hpp"

namespace earthtop {
namespace {

constexpr double kArcsecond = std::numbers::pi / 648000;

TEST(NumberWords, AnAngleIsToldInTheUnitOfItsSize) {
  EXPECT_EQ(angle_text(235.19 * kArcsecond), "235.19″");
  EXPECT_EQ(angle_text(-235.19 * kArcsecond), "-235.19″");
  EXPECT_EQ(angle_text(3600 * kArcsecond), "1.0000°");
  EXPECT_EQ(angle_text(3599 * kArcsecond), "3599.0″");
  EXPECT_EQ(angle_text(12345.6 * kArcsecond, 3), "3.43°");
  EXPECT_EQ(angle_text(231.4 * kArcsecond, 2), "231″") << "no exponent";
  EXPECT_EQ(angle_text(0.05 * kArcsecond, 3), "50.0 milliarcsec");
  EXPECT_EQ(angle_text(5e-6 * kArcsecond, 3), "5.00 microarcsec");
  EXPECT_EQ(angle_text(0.01234e-6 * kArcsecond, 3), "0.0123 microarcsec");
  EXPECT_EQ(angle_text(2.0627e-15 * kArcsecond, 3), "2.06e-09 microarcsec");
  EXPECT_EQ(angle_text(0), "0″");
  EXPECT_EQ(angle_unit(std::numeric_limits<double>::quiet_NaN()).name, "arcseconds");
}

TEST(NumberWords, ALengthIsToldInTheUnitOfItsSize) {
  EXPECT_EQ(length_unit(2e3).name, "km");
  EXPECT_EQ(length_unit(1).name, "m");
  EXPECT_EQ(length_unit(-2e-3).name, "mm");
  EXPECT_EQ(length_unit(2e-6).name, "µm");
  EXPECT_EQ(length_unit(2e-12).name, "nm");
  EXPECT_EQ(length_unit(0).name, "m");
}

struct Case {
  double value, error;
  const char *shown, *shown_error;
};

TEST(NumberWords, ANumberEndsWhereItsErrorDoes) {
  for (const Case& c :
       {Case{235.189123456789, 0.0123, "235.189", "0.012"}, Case{235.189123456789, 12.3, "235", "12"},
        Case{235.189123456789, 1230, "235", "1230"}, Case{235.189123456789, 6.01e-9, "235.1891234568", "6.0e-09"},
        Case{450.1234561, 1.96e-6, "450.1234561", "0.0000020"}, Case{1.5, 0.0996, "1.50", "0.10"},
        Case{5.2533929e-5, 4.2e-9, "5.25339e-05", "4.2e-09"}, Case{-5.2533929e-5, 4.2e-9, "-5.25339e-05", "4.2e-09"},
        Case{0, 0.0123, "0.000", "0.012"}, Case{1e-9, 0.0123, "0.000", "0.012"}, Case{2.5, 0, "2.5", "0"},
        Case{-1e-9, 0.0123, "0.000", "0.012"}, Case{0, 3.3e-26, "0", "3.3e-26"},
        Case{1.0 / 3, 1e-30, "0.3333333333333333", "1.0e-30"}}) {
    const KnownNumber known = known_number(c.value, c.error);
    EXPECT_EQ(known.value, c.shown);
    EXPECT_EQ(known.error, c.shown_error);
  }
}

TEST(NumberWords, ATitleHasFewDigits) {
  for (const auto& [value, error, text] : std::vector<std::tuple<double, double, std::string>>{{235.1889, 3e-9, "235.2"},
                                                                                               {235.1889, 12, "235"},
                                                                                               {999.96, 0, "1000"},
                                                                                               {999.94, 0, "999.9"},
                                                                                               {9.9996, 1e-9, "10.00"},
                                                                                               {0.18718526, 0, "0.1872"},
                                                                                               {36, 1e-6, "36.00"},
                                                                                               {1.2345678e-7, 0, "1.235e-07"},
                                                                                               {0, 1, "0"}})
    EXPECT_EQ(short_number(value, error), text) << value;
}

TEST(NumberWords, NumbersThatDifferAreTold) {
  using Two = std::pair<std::string, std::string>;
  EXPECT_EQ(told_apart(3, 4, 2), Two("3", "4"));
  EXPECT_EQ(told_apart(60.0000012, 60, 2), Two("60.000001", "60"));
  EXPECT_EQ(told_apart(2'000'001, 2'000'000, 3), Two("2000001", "2000000"));
  EXPECT_EQ(told_apart(1.24e-9, 1.2e-9, 2, 'e'), Two("1.24e-09", "1.20e-09"));
  EXPECT_EQ(told_apart(1, std::nextafter(1, 2), 2), Two("1", "1.0000000000000002"));
  EXPECT_EQ(told_apart(1.25, 1.25, 2), Two("1.2", "1.2"));
  EXPECT_EQ(told_apart(1, std::numeric_limits<double>::infinity(), 2).first, "1");
}

TEST(NumberWords, ALimitIsRoundedToWhatIsAllowed) {
  EXPECT_EQ(least_text(3), "3");
  EXPECT_EQ(least_text(0), "0");
  EXPECT_EQ(least_text(60 / 1'999'999.0), "3.00001e-05");
  EXPECT_EQ(most_text(60 / 1'999'999.0), "3e-05");
  EXPECT_EQ(least_text(-60 / 1'999'999.0), "-3e-05");
  EXPECT_EQ(most_text(-2.00001, 3), "-2.01");
  EXPECT_EQ(least_text(9.99996, 5), "10");
  EXPECT_EQ(least_text(std::numeric_limits<double>::infinity()), "inf");
  constexpr double kLastDigit = 1.1e-5;  // rounding up in the sixth digit of 100000, and that of the quotient
  for (double x = 1e-300; x < 1e300; x *= 1234.56789) {
    EXPECT_GE(std::stod(least_text(x)), x);
    EXPECT_LE(std::stod(most_text(x)), x);
    EXPECT_NEAR(std::stod(least_text(x)) / x, 1, kLastDigit);
  }
}

TEST(NumberWords, NothingIsASizeOfNothing) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(share_of(1, 4), 0.25);
  EXPECT_EQ(share_of(0, -4), 0);
  for (const auto& [part, whole] :
       {std::pair(0.0, 0.0), {1.0, 0.0}, {kInfinity, 1.0}, {1.0, kInfinity}, {1.0, 1e-320}, {NAN, 1.0}})
    EXPECT_EQ(share_of(part, whole), std::nullopt) << part << " of " << whole;
}

TEST(TimeText, HasNoRoundingOfItsLastDigits) {
  EXPECT_EQ(time_text(32.300000000000004), "32.3 s");
  EXPECT_EQ(time_text(13.264999999999999), "13.265 s");
  EXPECT_EQ(time_text(0.1 + 0.2), "0.3 s");
  EXPECT_EQ(time_text(60), "60 s");
  EXPECT_EQ(time_text(0), "0 s");
  EXPECT_EQ(time_text(1e9), "1000000000 s");
  EXPECT_EQ(time_text(86400.125), "86400.125 s");
  EXPECT_EQ(time_text(1e-12), "1e-12 s");
}

}  // namespace
}  // namespace earthtop
