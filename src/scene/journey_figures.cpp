// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/journey_figures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "earthtop/model/laboratory_now.hpp"
#include "scene/gimbal_rest.hpp"

namespace earthtop {
namespace {

/// Adds what a pendulous compass is tuned to: both gimbals free, with the centre of mass off the crossing of the axes.
void add_schuler(const Scene& scene, const Vec3<double>& w_IL_L, JourneyFigures& figures) {
  const auto& gimbals = scene.scenario().gimbals;
  if (!gimbals || gimbals->outer.locked || gimbals->inner.locked || !scene.scenario().rotor) return;
  const Model<double>& model = scene.model<double>();
  const double moment = norm(model.mass_moment_B), h = std::abs(gimbal_rotor_momentum(scene)), north = w_IL_L[1];
  if (!(moment > 0 && h > 0 && north > 0)) return;
  const double meridian_radius = scene.scenario().travel->figure == TravelFigure::sphere
                                     ? scene.scenario().travel->radius_m
                                     : meridian_radius_m(scene.site().latitude_deg) + scene.site().height_m;
  figures.schuler_kappa = moment * meridian_radius * north / h;
  figures.schuler_period_s = 2 * std::numbers::pi / std::sqrt(north * north + moment * scene.site().gravity_m_s2 * north / h);
}

}  // namespace

double azimuth_of(const Vec3<double>& rate_L) { return real::atan2(rate_L[0], rate_L[1]); }

JourneyFigures journey_figures_of(const Scene& scene) {
  const Model<double>& model = scene.model<double>();
  const Journey<double>& journey = model.journey;
  const double end = scene.scenario().duration_s;
  JourneyFigures figures;
  const JourneyPlace<double> last = journey.place(end);
  figures.length_m = last.length_m;
  figures.end_latitude_deg = last.latitude_deg, figures.end_longitude_deg = last.longitude_deg;
  figures.end_height_m = last.height_m;

  const Vec3<double> W0_L = scene.rotation_rate_rad_s() * celestial_axis_L<double>(scene.site());
  // The Earth's rate where the laboratory is.
  const auto earth_rate = [&](double t) {
    const SinCos<double> phi = sin_cos_degrees(journey.place(t).latitude_deg);
    return Vec3<double>(scene.rotation_rate_rad_s() * Vec3<double>(0, phi.cos, phi.sin));
  };
  const auto look = [&](double t) {
    const LaboratoryNow<double> now(model, t);
    figures.transport_rate_rad_s = std::max(figures.transport_rate_rad_s, norm(Vec3<double>(now.w_IL_L - earth_rate(t))));
    const Vec3<double>& G = now.field_L;
    if (norm(G) > 0) figures.plumb_lean_rad = std::max(figures.plumb_lean_rad, real::atan2(real::hypot(G[0], G[1]), -G[2]));
  };
  constexpr int kLooks = 400;
  for (int i = 0; i <= kLooks; ++i) look(end * i / kLooks);
  std::vector<double> times = journey.joints();
  times.insert(times.begin(), 0.0);
  for (const double t : times) {
    look(t);
    const double after = std::min(t + 1e-3 * end, end);
    const Vec3<double> change = journey.at(JourneyPart::velocity_in_L, after) - journey.at(JourneyPart::velocity_in_L, t);
    if (after > t) figures.acceleration_m_s2 = std::max(figures.acceleration_m_s2, norm(change) / (after - t));
  }

  if (const double rate = std::abs(scene.rotation_rate_rad_s()); rate > 0)
    figures.transport_over_earth = figures.transport_rate_rad_s / rate;

  const Vec3<double> start_L = LaboratoryNow<double>(model, 0.0).w_IL_L, end_L = LaboratoryNow<double>(model, end).w_IL_L;
  if (start_L[1] > 0) figures.false_north_start_rad = azimuth_of(start_L);
  if (end_L[1] > 0) figures.false_north_end_rad = azimuth_of(end_L);
  figures.wander_rad_s = start_L[2], figures.transport_wander_rad_s = start_L[2] - W0_L[2];
  if (const double noise = noise_of_table_m_s2(*scene.scenario().travel); noise > 0) figures.table_noise_m_s2 = noise;
  add_schuler(scene, start_L, figures);
  return figures;
}

}  // namespace earthtop
