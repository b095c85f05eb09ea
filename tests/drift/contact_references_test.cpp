// SPDX-License-Identifier: GPL-3.0-or-later
/// Tops on a table against reference values of 15 to 20 digits, in the laboratory's equations and in those of inertial axes.
#include <gtest/gtest.h>

#include "support/contact_references.hpp"

namespace earthtop {
namespace {

using testing::ContactReference;
using testing::ContactRow;
using testing::DriftReference;
using testing::MotionReference;
using testing::parsed;

/// Error of a vector relative to its size.
template <class T, std::size_t N>
double relative_error(const std::array<T, N>& found, const std::array<T, N>& known) {
  T error = T(0), size = T(0);
  for (std::size_t i = 0; i < N; ++i) {
    error += (found[i] - known[i]) * (found[i] - known[i]);
    size += known[i] * known[i];
  }
  return static_cast<double>(real::sqrt(T(error / size)));
}

/// The largest errors of a reference's rows, each relative to the size of its column.
struct Errors {
  double motion = 0, motion_in_inversion = 0, drift = 0, drift_in_inversion = 0;
};

template <class T, Observer O>
Errors errors_of(const ContactReference& reference, double tolerance) {
  std::vector<double> times;
  for (const MotionReference& row : reference.motions) times.push_back(row.t_s);
  for (const DriftReference& row : reference.drifts) times.push_back(row.t_s);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  const auto rows = testing::contact_rows<T, O>(reference.scene, times, tolerance);
  const auto row_at = [&](double t_s) -> const ContactRow<T>& {
    return rows[static_cast<std::size_t>(std::lower_bound(times.begin(), times.end(), t_s) - times.begin())];
  };
  Errors errors;
  for (const MotionReference& known : reference.motions) {
    const ContactRow<T>& row = row_at(known.t_s);
    const auto member = known.on_earth ? &Paired<T>::rot : &Paired<T>::ref;
    const Vec3<Paired<T>>&n = row.contact.axis_L, &p = row.contact.tip_L;
    double& worst = known.in_inversion ? errors.motion_in_inversion : errors.motion;
    worst = std::max({worst,
                      relative_error<T, 3>({n[0].*member, n[1].*member, n[2].*member},
                                           {parsed<T>(known.n[0]), parsed<T>(known.n[1]), parsed<T>(known.n[2])}),
                      relative_error<T, 2>({p[0].*member, p[1].*member}, {parsed<T>(known.p[0]), parsed<T>(known.p[1])}),
                      relative_error<T, 1>({row.spin_rad_s.*member}, {parsed<T>(known.w3)})});
  }
  for (const DriftReference& known : reference.drifts) {
    const ContactRow<T>& row = row_at(known.t_s);
    const T epsilon = row.epsilon;
    const Vec3<Paired<T>>& p = row.contact.tip_L;
    double& worst = known.in_inversion ? errors.drift_in_inversion : errors.drift;
    worst = std::max({worst, relative_error<T, 1>({row.measures.axis}, {parsed<T>(known.angle)}),
                      relative_error<T, 2>({epsilon * p[0].diff, epsilon * p[1].diff}, {parsed<T>(known.p[0]), parsed<T>(known.p[1])}),
                      relative_error<T, 1>({epsilon * row.spin_rad_s.diff}, {parsed<T>(known.w3)})});
  }
  return errors;
}

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

/// All printed digits but the last two, in 113 bits: of the frictionless, the contensou and the rolling top.
TEST(ContactReferencesInQuad, AreMetToThePrintedDigits) {
  for (ContactReference& reference : testing::contact_references()) {
    const std::string name(reference.name, 2);
    if (name != "K1" && name != "K4" && name != "K8") continue;
    std::erase_if(reference.motions, [](const MotionReference& row) { return row.t_s > 1; });
    std::erase_if(reference.drifts, [](const DriftReference& row) { return row.t_s > 1; });
    const Errors errors = errors_of<float128, Observer::laboratory>(reference, 1e-23);
    EXPECT_LT(errors.motion, 1e-18) << name;  // 20 digits are printed
    EXPECT_LT(errors.drift, 1e-15) << name;   // 17
  }
}

INSTANTIATE_TEST_SUITE_P(K, ContactReferences, ::testing::ValuesIn(testing::contact_references()),
                         [](const auto& chosen) { return std::string(chosen.param.name, 2); });

}  // namespace
}  // namespace earthtop
