// SPDX-License-Identifier: GPL-3.0-or-later
// The sentences that say what the estimates mean.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "earthtop/elementary.hpp"
#include "earthtop/measure/measurement.hpp"
#include "measure/sigmas.hpp"
#include "measure/spoken_input.hpp"

namespace earthtop {
namespace measure {
namespace {

/// An input as a sentence calls it.
struct SpokenInput {
  std::string_view name, spoken;
};
constexpr SpokenInput kSpokenInputs[] = {
    {"omega_sin_latitude_rad_s", "the Earth's rate times sin(latitude)"},
    {"omega_cos_latitude_rad_s", "the Earth's rate times cos(latitude)"},
    {"rotation_rate_rad_s", "the Earth's rate"},
    {"/earth/rotation_rate_rad_s", "the Earth's rate"},
    {"latitude_deg", "the latitude"},
    {"/site/latitude_deg", "the latitude"},
    {"gravity_m_s2", "apparent gravity"},
    {"/site/gravity_m_s2", "apparent gravity"},
    {"spin_rad_s", "the spin"},
    {"/release/spin_rad_s", "the spin"},
    {"travel_speed_m_s", "the speed at the start"},
    {"/travel/speed_m_s", "the speed at the start"},
    {"travel_course_deg", "the course at the start"},
    {"/travel/course_deg", "the course at the start"},
    {"tilt_deg", "the tilt at release"},
    {"/release/tilt_deg", "the tilt at release"},
    {"/release/azimuth_deg", "the azimuth at release"},
    {"/release/spin_angle_deg", "the spin angle at release"},
    {"inertia_ratio", "the ratio I3/I1 of the moments about the pivot, with I1 and I2 held,"},
    {"center_of_mass_m", "the distance of the centre of mass, with the moments about the pivot held,"},
};

}  // namespace

std::string spoken_input(std::string_view name) {
  const auto* known = std::find_if(std::begin(kSpokenInputs), std::end(kSpokenInputs),
                                   [&](const SpokenInput& input) { return input.name == name; });
  return std::string(known == std::end(kSpokenInputs) ? name : known->spoken);
}

}  // namespace measure

std::string with_standard_error(double value, double error) {
  if (!(error > 0) || !std::isfinite(error)) return fmt::format("{:.8g}", value);
  const double size = std::max(std::abs(value), error);
  const double last = std::floor(real::log10(error)) - 1;  // decimal place of the last digit shown
  if (size >= 1e-3 && size < 1e6 && last >= -12)
    return fmt::format("{0:.{2}f} ± {1:.{2}f}", value, error, static_cast<int>(std::max(-last, 0.0)));
  const double decade = std::floor(real::log10(size));
  const auto digits = static_cast<int>(std::clamp(decade - last, 1.0, 16.0));
  const double unit = real::power_of_ten(static_cast<int>(std::clamp(decade, -300.0, 300.0)));
  return fmt::format("{0:.{2}f}e{3:.0f} ± {1:.{2}f}e{3:.0f}", value / unit, error / unit, digits, decade);
}

std::string estimate_sentence(const ParameterEstimate& given, bool by_scatter) {
  using namespace measure;
  if (!given.estimate || !given.standard_error) return "";
  const double error = *given.said_error(by_scatter);
  std::string text = fmt::format("{}{} is {}{}{}", given.release > 0 ? fmt::format("in release {}, ", given.release) : "",
                                 spoken_input(given.name), with_standard_error(*given.estimate, error),
                                 given.unit.empty() ? "" : " ", given.unit);
  if (!(error > 0) || !std::isfinite(error)) return text;
  if (error > *given.standard_error)
    text += fmt::format(" (the standard error that the scatter gives, {:.2g} times the one from the stated errors)",
                        error / *given.standard_error);
  if (given.finding) return text + ": " + finding_words(*given.finding);
  const double off = (given.start - *given.estimate) / error;
  return text + fmt::format("; the scenario's {:.10g} is {} sigma {} it", given.start, sigmas(std::abs(off)),
                            off < 0 ? "below" : "above");
}

std::string hint_sentence(const FitHint& hint) {
  std::string values;
  for (const FitHint::Value& v : hint.values)
    values += fmt::format("{}{} = {}{}{}", values.empty() ? "" : " with ", name_in_release(v.name, v.release),
                          with_standard_error(v.value, v.standard_error), v.unit.empty() ? "" : " ", v.unit);
  return fmt::format("{} would leave chi-squared {:.6g}, to first order; estimate {}", values, hint.chi_squared,
                     hint.values.size() > 1 ? "them" : "it");
}

}  // namespace earthtop
