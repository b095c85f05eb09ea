// SPDX-License-Identifier: GPL-3.0-or-later
#include "number_text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "earthtop/elementary.hpp"

namespace earthtop::tool {

std::string with_bound(double value, double bound, std::string_view unit) {
  if (!std::isfinite(value)) return "not known";
  if (!std::isfinite(bound)) return fmt::format("{:.6e} {}, bound not known", value, unit);
  int decimals = 6;
  if (value != 0 && bound > 0)
    decimals =
        static_cast<int>(std::clamp(std::floor(real::log10(std::abs(value))) - std::floor(real::log10(bound)) + 1, 1.0, 16.0));
  return fmt::format("{:.{}e} ± {:.1e} {}", value, decimals, bound, unit);
}

std::string time_with_bound(double t_s, const std::optional<double>& bound_s) {
  if (!bound_s || !(*bound_s > 0)) return fmt::format("{:.9g} s", t_s);
  const int decimals = std::clamp(static_cast<int>(std::ceil(-real::log10(*bound_s))) + 1, 0, 17);
  return fmt::format("{:.{}f} ± {:.1e} s", t_s, decimals, *bound_s);
}

std::string pictured_length(double m) {
  const double size = std::abs(m);
  if (size >= 1 || size == 0) return fmt::format("{:.5g} m", m);
  if (size >= 1e-3) return fmt::format("{:.5g} mm", m * 1e3);
  if (size >= 1e-6) return fmt::format("{:.5g} micrometres", m * 1e6);
  return fmt::format("{:.5g} nanometres", m * 1e9);
}

}  // namespace earthtop::tool
