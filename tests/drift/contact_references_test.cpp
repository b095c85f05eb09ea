// SPDX-License-Identifier: GPL-3.0-or-later
/// Tops on a table against reference values of 15 to 20 digits, in the laboratory's equations and in those of inertial axes.
#include <gtest/gtest.h>

#include "support/contact_event_times.hpp"
#include "support/json.hpp"

namespace earthtop {
namespace {

using testing::ContactReference;
using testing::Errors;
using testing::errors_of;

class ContactReferences : public ::testing::TestWithParam<ContactReference> {};

template <Observer O>
void expect_reference(const ContactReference& reference) {
  const Errors errors = errors_of<double, O>(reference, 1e-14);
  EXPECT_LT(errors.motion, 1e-11);
  EXPECT_LT(errors.motion_in_inversion, 1e-9);
  EXPECT_LT(errors.drift, 1e-9);
  EXPECT_LT(errors.drift_in_inversion, 1e-8);
}
TEST_P(ContactReferences, AreMetInLaboratoryAxes) { expect_reference<Observer::laboratory>(GetParam()); }
TEST_P(ContactReferences, AreMetInInertialAxes) { expect_reference<Observer::inertial>(GetParam()); }

INSTANTIATE_TEST_SUITE_P(K, ContactReferences, ::testing::ValuesIn(testing::contact_references()),
                         [](const auto& chosen) { return std::string(chosen.param.name, 2); });

nlohmann::json made_references() {
  return testing::parse_json(testing::read_file(EARTHTOP_TESTS "/data/contact/references.json"));
}

/// Effects together, bodies without symmetry and a slope, by the references of tests/contact/reference_generator.cpp, where two
/// formulations agree to 1e-22.
TEST(ContactMadeReferences, AreMetByEveryForm) {
  const nlohmann::json known = made_references()["scenes"];
  const auto scenes = testing::more_contact_scenes();
  ASSERT_EQ(known.size(), scenes.size());
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const auto& [name, scene, t_s, symmetric] = scenes[i];
    ASSERT_EQ(known[i]["name"], name);
    EXPECT_LT(known[i]["difference_of_formulations"].get<double>(), 1e-22);
    std::vector<double> figures;
    for (const auto& figure : known[i]["figures"]) figures.push_back(std::stod(figure.get<std::string>()));
    const testing::ContactProblem<double> problem(scene);
    SCOPED_TRACE(name);
    const auto expect = [&](const auto& rows) {
      EXPECT_LT(testing::worst_error(testing::figures_of(problem, rows[0]), figures), 1e-9);
    };
    using testing::Form;
    if (symmetric) {
      expect(testing::contact_rows<double, Observer::laboratory>(scene, {t_s}, 1e-14));
      expect(testing::contact_rows<double, Observer::inertial>(scene, {t_s}, 1e-14));
    }
    expect(testing::contact_rows<double, Observer::laboratory, Form::general>(scene, {t_s}, 1e-14));
    expect(testing::contact_rows<double, Observer::inertial, Form::general>(scene, {t_s}, 1e-14));
  }
}

/// Times of inversions, of a rim's touch and of a slip's start, in both formulations.
TEST(ContactMadeReferences, TellWhenSomethingHappens) {
  const nlohmann::json known = made_references()["event_times_s"];
  const auto events = testing::named_events();
  ASSERT_EQ(known.size(), events.size());
  for (std::size_t i = 0; i < events.size(); ++i) {
    SCOPED_TRACE(events[i].name);
    ASSERT_EQ(known[i]["name"], events[i].name);
    EXPECT_LT(known[i]["difference_of_formulations"].get<double>(), 1e-24);  // of two that are made in 113 bits
    const auto expect = [&](const std::array<double, 2>& times) {
      EXPECT_NEAR(times[0] / std::stod(known[i]["reference"].get<std::string>()), 1, 1e-11);
      EXPECT_NEAR(times[1] / std::stod(known[i]["rotating"].get<std::string>()), 1, 1e-11);
    };
    expect(testing::event_times<double, Observer::laboratory>(events[i], 1e-14));
    expect(testing::event_times<double, Observer::inertial>(events[i], 1e-14));
  }
}

}  // namespace
}  // namespace earthtop
