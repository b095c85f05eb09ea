// SPDX-License-Identifier: GPL-3.0-or-later
// Copy, move, destruction and comparison of a Scenario: compiled here once, so that other sources compile faster.
#include "earthtop/scenario/scenario.hpp"

#include "earthtop/frames/earth_orientation.hpp"

namespace earthtop {

Scenario::Scenario() = default;
Scenario::Scenario(const Scenario&) = default;
Scenario::Scenario(Scenario&&) noexcept = default;
Scenario& Scenario::operator=(const Scenario&) = default;
Scenario& Scenario::operator=(Scenario&&) noexcept = default;
Scenario::~Scenario() = default;
bool Scenario::operator==(const Scenario&) const = default;

std::vector<const FiledTable*> tables_of(const Scenario& scenario) {
  std::vector<const FiledTable*> tables;
  if (scenario.travel && scenario.travel->table[0].rows) tables.push_back(&scenario.travel->table[0]);
  if (scenario.platform && scenario.platform->table.rows) tables.push_back(&scenario.platform->table);
  if (scenario.rotor && scenario.rotor->table.rows) tables.push_back(&scenario.rotor->table);
  for (const MovingMassSpec& mass : scenario.moving_masses)
    if (mass.coordinates[0].rows) tables.push_back(&mass.coordinates[0]);
  if (const auto& given = scenario.effects.applied.given_torque; given && given->components[0].rows)
    tables.push_back(&given->components[0]);
  return tables;
}

double resolved_rotation_rate_rad_s(const Scenario& scenario) {
  const double excess_s = scenario.excess_length_of_day_ms * 1e-3;
  return excess_s == 0 ? scenario.rotation_rate_rad_s : earth_rate_with_length_of_day(scenario.rotation_rate_rad_s, excess_s);
}

Site resolved_site(const Scenario& scenario) {
  Site site = scenario.site;
  site.gravity_m_s2 += scenario.gravity_anomaly_m_s2;
  return site;
}

}  // namespace earthtop
