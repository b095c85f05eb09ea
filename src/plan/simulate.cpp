// SPDX-License-Identifier: GPL-3.0-or-later
// Simulated measurements: the scenario's own motion with normal errors.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <random>

#include "earthtop/elementary.hpp"
#include "earthtop/plan/plan.hpp"
#include "measure/error_memory.hpp"
#include "measure/quantities.hpp"
#include "plan/planned_rows.hpp"
#include "plan/preparation.hpp"

namespace earthtop {
namespace plan {
namespace {

constexpr double kPi = std::numbers::pi;

/// Standard normal numbers by Box and Muller's transformation: the same ones with every library and on every machine.
class Normal {
 public:
  explicit Normal(std::uint64_t seed) : bits_(seed) {}
  double operator()() {
    if (spare_) {
      const double number = *spare_;
      spare_.reset();
      return number;
    }
    const double radius = std::sqrt(-2 * real::log(uniform()));
    const SinCos<double> angle = real::sin_cos(2 * kPi * uniform());
    spare_ = radius * angle.sin;
    return radius * angle.cos;
  }

 private:
  double uniform() { return (static_cast<double>(bits_() >> 11) + 0.5) * 0x1p-53; }  // from 0 to 1, both excluded
  std::mt19937_64 bits_;
  std::optional<double> spare_;
};

/// The errors of one series, in its standard error.
class SeriesErrors {
 public:
  double next(double t_s, double correlation_time_s, Normal& normal) {
    const double fresh = normal();
    if (!(correlation_time_s > 0) || !has_latest_) {
      latest_ = fresh;
    } else {
      const measure::ErrorMemory memory = measure::error_memory(t_s - t_s_, correlation_time_s);
      latest_ = memory.rho * latest_ + memory.fresh * fresh;
    }
    has_latest_ = true;
    t_s_ = t_s;
    return latest_;
  }

 private:
  double latest_ = 0, t_s_ = 0;
  bool has_latest_ = false;
};

/// The axis turned by small angles along growing tilt and along growing azimuth; along North and East where it is vertical.
std::array<double, 3> turned(const std::array<double, 3>& n, double along_tilt, double along_azimuth) {
  const double angle = real::hypot(along_tilt, along_azimuth), horizontal = real::hypot(n[0], n[1]);
  if (!(angle > 0)) return n;
  const double east = horizontal > 0 ? n[0] / horizontal : 0, north = horizontal > 0 ? n[1] / horizontal : 1;
  const std::array<double, 3> down = {n[2] * east, n[2] * north, -horizontal}, clockwise = {north, -east, 0};
  const SinCos<double> part = real::sin_cos(angle);
  std::array<double, 3> moved{};
  for (std::size_t i = 0; i < 3; ++i)
    moved[i] = part.cos * n[i] + part.sin * (along_tilt * down[i] + along_azimuth * clockwise[i]) / angle;
  return moved;
}

/// An azimuth within a turn from 0, that of a plane within half of one; a tilt of at most half a turn.
double as_read(MeasuredQuantity quantity, double angle) {
  const double period = measure::row_of(quantity).period;
  if (period > 0 && quantity != MeasuredQuantity::drift_azimuth) {
    const double within = std::fmod(angle, period);
    return within < 0 ? within + period : within;
  }
  return quantity == MeasuredQuantity::tilt && angle > kPi ? 2 * kPi - angle : angle;
}

bool is_of(const PlannedQuantity& quantity, measure::Feature feature) {
  return measure::row_of(quantity.quantity).feature == feature;
}

/// Whether rows say which extreme a turning point is: one word a row, which belongs to one angle.
bool names_extremes(const MeasurementPlan& plan) {
  return std::ranges::count_if(plan.quantities,
                               [](const PlannedQuantity& one) { return is_of(one, measure::Feature::turning); }) == 1;
}

std::string header(const MeasurementPlan& plan) {
  std::string line = "t_s";
  for (const PlannedQuantity& quantity : plan.quantities) {
    const std::string_view name = to_string(quantity.quantity);
    line += quantity.quantity == MeasuredQuantity::axis ? std::string(",axis_L_x,axis_L_y,axis_L_z") : "," + quantity.name;
    line += fmt::format(",{}_se_{}", name, quantity.unit);
    if (names_extremes(plan) && is_of(quantity, measure::Feature::turning)) line += ",extreme";
    if (is_of(quantity, measure::Feature::passage)) line += ",passage_turns";
  }
  return line + '\n';
}

}  // namespace
}  // namespace plan

std::optional<std::string> simulated_measurement(const ScenarioSource& source,
                                                 const std::vector<std::pair<std::string, std::string>>& overrides,
                                                 const MeasurementPlan& wanted, std::uint64_t seed, const Watch& watch) {
  using namespace plan;
  const Scene given = scene_to_measure(source, overrides);
  const MeasurementPlan plan = completed(wanted, given);
  const std::size_t rows = count_rows(plan.every_s, *plan.until_s);
  const std::vector<double> times_s = planned_times(plan.every_s, rows);
  const Scene scene = parse_scene(source, lasting(overrides, given.scenario(), *plan.until_s));
  Measurement measurement = empty_measurement(plan.quantities, times_s);
  const measure::PredictedMotion motion = measure::predict(scene, measurement, watch);
  if (motion.status == RunStatus::interrupted) return std::nullopt;
  if (motion.status != RunStatus::completed)
    throw ScenarioError("--write-data", fmt::format("the scenario's motion ended with {}", to_string(motion.status)));
  fill_in(measurement, motion);

  std::string csv = fmt::format("# simulated by earthtop plan: {}, seed {}, correlation time {:g} s\n", given.scenario().name,
                                seed, plan.correlation_time_s);
  csv += header(plan);
  Normal normal(seed);
  std::vector<std::array<SeriesErrors, 2>> errors(plan.quantities.size());
  auto to = std::back_inserter(csv);
  auto value = measurement.values.begin();
  for (const double t_s : times_s) {
    fmt::format_to(to, "{}", t_s);
    for (std::size_t q = 0; q < plan.quantities.size(); ++q, ++value) {
      const PlannedQuantity& quantity = plan.quantities[q];
      const double first = errors[q][0].next(t_s, plan.correlation_time_s, normal) * value->standard_error;
      if (quantity.quantity == MeasuredQuantity::axis) {
        const double second = errors[q][1].next(t_s, plan.correlation_time_s, normal) * value->standard_error;
        for (const double component : turned(value->axis_L, first, second)) fmt::format_to(to, ",{}", component);
      } else {
        fmt::format_to(to, ",{}", as_read(quantity.quantity, value->value + first) / quantity.unit_size);
      }
      fmt::format_to(to, ",{}", quantity.standard_error);
      if (names_extremes(plan) && is_of(quantity, measure::Feature::turning))
        fmt::format_to(to, ",{}", value->extreme == Extreme::maximum ? "max" : "min");
      if (is_of(quantity, measure::Feature::passage)) fmt::format_to(to, ",{}", value->turns);
    }
    csv += '\n';
  }
  return csv;
}

}  // namespace earthtop
