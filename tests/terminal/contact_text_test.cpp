// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests the text on the terminal about the contact of a top with its table.
#include "contact_text.hpp"

#include <gtest/gtest.h>

#include "number_text.hpp"
#include "results/made_up_run.hpp"

namespace earthtop {
namespace {

using namespace tool;

std::string joined(const std::vector<LabelledLine>& lines) {
  std::string text;
  for (const LabelledLine& line : lines) text += std::string(line.label) + '|' + line.text + '\n';
  return text;
}

TEST(ContactText, TheTipsDriftHasBoundAndDirection) {
  RunResult result = test::made_up_contact_run();
  BasicContactRow<double>& last = *result.rows.back().contact;
  last.drift_tip_xy_m = {-3e-4, 1e-5};
  last.drift_tip_m = 3.0016662e-4;
  last.drift_slip_m_s = -2e-7;
  const auto lines = tip_drift_lines(result, result.rows.back(), 2e-9);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0], "3.001666e-04 ± 2.0e-09 m = 300.17 micrometres to the West");
  EXPECT_EQ(lines[1], "-3.000000e-04 m East, +1.000000e-05 m North");
  EXPECT_NE(lines[2].find("slip -2.000000e-07 m/s"), std::string::npos);
  EXPECT_TRUE(tip_drift_lines(result, test::made_up_run().rows.back(), 0).empty());
}

TEST(ContactText, OnATiltedTableTheDirectionsAreItsAxes) {
  RunResult result = test::made_up_contact_run();
  result.scene = testing::changed(result.scene, [](Scenario& s) { s.contact->table_tilt_deg = 1; });
  const auto lines = tip_drift_lines(result, result.rows.back(), 0);
  EXPECT_EQ(lines.at(0).find("North"), std::string::npos);
  EXPECT_NE(lines.at(1).find("along the table's axes 1 and 2"), std::string::npos);
}

// The time difference is rotating less reference: an event of the reference is earlier in the rotating motion where it is
// negative, one of the rotating motion earlier in the reference where it is positive.
TEST(ContactText, EventsSayWhichPredictionIsEarlier) {
  RunResult result = test::made_up_contact_run();
  const std::string text = joined(contact_event_lines(result));
  EXPECT_NE(
      text.find(
          "Contact|t = 29.7500000000 ± 1.0e-09 s, non-rotating prediction: friction has brought the slip to zero, and the "
          "tip rolls on; in the rotating one 8.000000e-07 s earlier"),
      std::string::npos)
      << text;
  EXPECT_NE(text.find("in the non-rotating one 3.000000e-06 s earlier"), std::string::npos) << text;
  result.contact->events = {{ContactEventKind::slip_started, Prediction::rotating, 1, {}, {}},
                            {ContactEventKind::lifted_off, Prediction::rotating, 2, {}, {}}};
  const auto lines = contact_event_lines(result);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_TRUE(lines[1].is_warning);
  EXPECT_EQ(lines[1].text, "the non-rotating one has no such event");
  EXPECT_NE(lines[2].text.find("the run ends"), std::string::npos);
  EXPECT_TRUE(contact_event_lines(test::made_up_run()).empty());
}

TEST(ContactText, TheMotionOfThePredictionItselfIsSaid) {
  RunResult result = test::made_up_contact_run();
  result.rows.back().drift_axis_rad = 4e-3;
  const std::string text = joined(prediction_change_lines(result));
  EXPECT_NE(text.find("axis 8.00e-03 rad, tip 8.80e-04 m per 1 % of friction coefficient (the Earth's drift of the axis is 0.5 "
                      "times that)"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("per 1 arcsec of table tilt"), std::string::npos) << text;
  EXPECT_NE(text.find("nobody knows a coefficient of friction to 1 %"), std::string::npos) << text;
  result.contact->changes.erase(result.contact->changes.begin());
  EXPECT_EQ(joined(prediction_change_lines(result)).find("coefficient of friction"), std::string::npos);
  EXPECT_TRUE(prediction_change_lines(test::made_up_run()).empty());
}

TEST(ContactText, BalancesAreThoseOfTheWorsePrediction) {
  RunResult result = test::made_up_contact_run();
  EXPECT_TRUE(contact_balance_lines(result).empty());
  result.contact->rotating = {ContactBalance{1, 3, 1.5, 1e-12, 4}, ContactBalance{10, 7, -2, -2e-12, 8}};
  result.contact->reference = {ContactBalance{1, 2, 0.5, 2e-12, 4}, ContactBalance{10, 8, -1, 4e-12, 8}};
  const std::string text = joined(contact_balance_lines(result));
  EXPECT_NE(
      text.find(
          "Balances|friction does work of -2.000000e+00 J, and the Jacobi integral changes by as much, to 5.0e-13 of its size"),
      std::string::npos)
      << text;
  EXPECT_NE(text.find("|Jellett's integral changes by +2.000000e+00 kg m^3/s, as the effects of the Earth and of friction's "
                      "moment predict, to 5.0e-13"),
            std::string::npos)
      << text;
  result.contact->rotating.jacobi->integral = 0;
  EXPECT_NE(joined(contact_balance_lines(result)).find("friction does no work"), std::string::npos);
  // Of an integral that is 0 nothing is said as a share; one motion in which it is not 0 has one.
  result.contact->rotating = {ContactBalance{}, ContactBalance{}};
  EXPECT_NE(joined(contact_balance_lines(result))
                .find("|Jellett's integral changes by +0.000000e+00 kg m^3/s, as the effects of "
                      "the Earth and of friction's moment predict, to 5.0e-13"),
            std::string::npos);
  result.contact->reference = result.contact->rotating;
  EXPECT_EQ(joined(contact_balance_lines(result)),
            "Balances|friction does no work, and the Jacobi integral is constant in both predictions\n"
            "|Jellett's integral is 0 at every time, in both predictions\n");
}

TEST(NumberText, LengthsHaveHandyUnits) {
  EXPECT_EQ(pictured_length(0), "0 m");
  EXPECT_EQ(pictured_length(-2.5), "-2.5 m");
  EXPECT_EQ(pictured_length(1.5e-3), "1.5 mm");
  EXPECT_EQ(pictured_length(2e-6), "2 micrometres");
  EXPECT_EQ(pictured_length(3e-10), "0.3 nanometres");
}

}  // namespace
}  // namespace earthtop
