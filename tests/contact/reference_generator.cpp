// SPDX-License-Identifier: GPL-3.0-or-later
/// Writes tests/data/contact/references.json to the standard output: each motion in 113 bits in laboratory and in inertial axes,
/// with the largest difference between the two beside it.
#include <cstdio>

#include "support/contact_event_times.hpp"

extern "C" int quadmath_snprintf(char*, std::size_t, const char*, ...);

namespace earthtop::testing {
namespace {

std::string decimal(float128 number) {
  char digits[64];
  quadmath_snprintf(digits, sizeof digits, "%.19Qe", number);
  return digits;
}

template <Observer O>
std::vector<float128> figures(const NamedScene& named) {
  const ContactProblem<float128> problem(named.scene);
  if (named.symmetric) return figures_of(problem, rows_of(problem, problem.system<O>(), {named.t_s}, 1e-24)[0]);
  return figures_of(problem, rows_of(problem, problem.system<O, Form::general>(), {named.t_s}, 1e-24)[0]);
}

void write_all() {
  std::puts("{\n \"generator\": \"earthtop-contact-references: extrapolation in laboratory axes, relative tolerance 1e-24\",");
  std::puts(" \"precision\": \"float128\",\n \"digits\": 20,");
  std::puts(" \"figures\": \"axis, tip (m), inertial spin (rad/s), normal force (N): reference, rotating, difference\",");
  std::puts(" \"scenes\": [");
  bool first = true;
  for (const NamedScene& named : more_contact_scenes()) {
    const auto laboratory = figures<Observer::laboratory>(named), inertial = figures<Observer::inertial>(named);
    std::printf("%s  {\"name\": \"%s\", \"t_s\": %g, \"difference_of_formulations\": %.1e,\n   \"figures\": [",
                first ? "" : ",\n", named.name.c_str(), named.t_s, worst_error(inertial, laboratory));
    for (std::size_t i = 0; i < laboratory.size(); ++i) {
      std::printf("%s\"%s\"", i == 0 ? "" : (i % 4 == 0 ? ",\n    " : ", "), decimal(laboratory[i]).c_str());
    }
    std::printf("]}");
    first = false;
  }
  std::puts("\n ],\n \"event_times_s\": [");
  first = true;
  for (const NamedEvent& event : named_events()) {
    const auto laboratory = event_times<float128, Observer::laboratory>(event, 1e-25);
    const auto inertial = event_times<float128, Observer::inertial>(event, 1e-25);
    float128 apart = 0;
    for (std::size_t k = 0; k < 2; ++k) apart = std::max(apart, real::abs(float128(laboratory[k] / inertial[k] - 1)));
    std::printf("%s  {\"name\": \"%s\", \"difference_of_formulations\": %.1e,\n   \"reference\": \"%s\", \"rotating\": \"%s\"}",
                first ? "" : ",\n", event.name.c_str(), static_cast<double>(apart), decimal(laboratory[0]).c_str(),
                decimal(laboratory[1]).c_str());
    std::fflush(stdout);
    first = false;
  }
  std::puts("\n ]\n}");
}

}  // namespace
}  // namespace earthtop::testing

int main() { earthtop::testing::write_all(); }
