// SPDX-License-Identifier: GPL-3.0-or-later
// Keys in other people's units: the right key and the factor to its unit.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

#include "input/pointers.hpp"
#include "scenario/fields.hpp"

namespace earthtop::input {
namespace {

std::string answer(const std::string& object, const std::string& key) {
  return unknown_key(scenario::fields(), key, object).message;
}

// The factors are written out here, from the definitions of the units.
TEST(ForeignUnits, NameTheRightKeyAndTheFactor) {
  const struct {
    std::string object, key, message;
  } cases[] = {
      {"/body", "mass_g", "give mass_kg; 1 g = 0.001 kg"},
      {"/body", "mass_lb", "give mass_kg; 1 lb = 0.45359237 kg"},
      {"/body", "center_of_mass_mm", "give center_of_mass_m; 1 mm = 0.001 m"},
      {"/body", "com_cm", "give center_of_mass_m; 1 cm = 0.01 m"},
      {"/body", "inertia_g_cm2", "give inertia/principal_kg_m2; 1 g cm^2 = 1e-07 kg m^2"},
      {"/body/inertia", "matrix_g_cm2", "give matrix_kg_m2; 1 g cm^2 = 1e-07 kg m^2"},
      {"/body/solids/*", "mass_g", "give mass_kg; 1 g = 0.001 kg"},
      {"/body/solids/*", "length_mm", "give length_m; 1 mm = 0.001 m"},
      {"/body/solids/*", "length_cm", "give length_m; 1 cm = 0.01 m"},
      {"/body/solids/*", "radius_mm", "give radius_m; 1 mm = 0.001 m"},
      {"/body/solids/*", "radius_in", "give radius_m; 1 in = 0.0254 m"},
      {"/body/solids/*", "at_mm", "give at_m; 1 mm = 0.001 m"},
      {"/body/solids/*", "density_g_cm3", "give density_kg_m3; 1 g/cm^3 = 1000 kg/m^3"},
      {"/release", "spin_rps", "give spin_rad_s; 1 rps = 6.28318530717959 rad/s, or spin_rpm; 1 rps = 60 rpm"},
      {"/release", "spin_hz", "give spin_rad_s; 1 Hz = 6.28318530717959 rad/s, or spin_rpm; 1 Hz = 60 rpm"},
      {"/release", "spin_deg_s",
       "give spin_rad_s; 1 deg/s = 0.0174532925199433 rad/s, or spin_rpm; 1 deg/s = 0.166666666666667 rpm"},
      {"/release", "tilt_rad", "give tilt_deg; 1 rad = 57.2957795130823 deg"},
      {"/release", "precession_rpm", "give precession/rate_rad_s; 1 rpm = 0.10471975511966 rad/s"},
      {"/site", "lat_rad", "give latitude_deg; 1 rad = 57.2957795130823 deg"},
      {"/site", "latitude_arcmin", "give latitude_deg; 1 arcmin = 0.0166666666666667 deg"},
      {"/site", "lon_rad", "give longitude_deg; 1 rad = 57.2957795130823 deg"},
      {"/site", "height_ft", "give height_m; 1 ft = 0.3048 m"},
      {"/site", "gravity_gal", "give gravity_m_s2; 1 gal = 0.01 m/s^2"},
      {"/site", "gravity_cm_s2", "give gravity_m_s2; 1 cm/s^2 = 0.01 m/s^2"},
      {"/earth", "rotation_rate_deg_h", "give rotation_rate_rad_s; 1 deg/h = 4.84813681109536e-06 rad/s"},
      {"/motion", "duration_ms", "give duration_s; 1 ms = 0.001 s"},
      {"/motion", "duration_min", "give duration_s; 1 min = 60 s"},
      {"/motion", "output_step_ms", "give output_step_s; 1 ms = 0.001 s"},
      {"/report", "threshold_arcsec", "give threshold_rad; 1 arcsec = 4.84813681109536e-06 rad"},
      {"/contact", "tip_radius_mm", "give tip_radius_m; 1 mm = 0.001 m"},
      {"/contact", "sliding_viscosity_mN_s_m", "give sliding_viscosity_N_s_m; 1 mN s/m = 0.001 N s/m"},
      {"/effects", "coulomb_torque_mN_m", "give coulomb_torque_N_m; 1 mN m = 0.001 N m"},
      {"/effects", "viscous_torque_N_cm_s", "give viscous_torque_N_m_s; 1 N cm s = 0.01 N m s"},
      {"/effects/gravity_gradient", "gm_over_r3_h2", "give gm_over_r3_s2; 1 1/h^2 = 7.71604938271605e-08 1/s^2"},
      {"/platform", "frequency_rpm", "give frequency_hz; 1 rpm = 0.0166666666666667 Hz"},
      {"/platform", "rate_deg_s", "give rate_rad_s; 1 deg/s = 0.0174532925199433 rad/s"},
      {"/uncertainty", "spin_rpm", "give spin_rad_s; 1 rpm = 0.10471975511966 rad/s"},
  };
  for (const auto& [object, key, message] : cases) EXPECT_EQ(answer(object, key), message) << object << "/" << key;
}

TEST(ForeignUnits, AnyCaseAndAHyphenWill) {
  EXPECT_EQ(answer("/body", "MASS_G"), "give mass_kg; 1 g = 0.001 kg");
  EXPECT_EQ(answer("/release", "spin-Hz").substr(0, 15), "give spin_rad_s");
}

/// The unit of every number of a scenario is in the table of symbols: with one of its symbols replaced, its key is understood.
TEST(ForeignUnits, EveryKeyWithAUnitIsUnderstoodInAnother) {
  const std::pair<std::string, std::string> others[] = {{"kg", "g"},    {"m", "mm"}, {"s", "ms"},   {"rad", "arcmin"},
                                                        {"deg", "rad"}, {"N", "mN"}, {"hz", "kHz"}, {"arcsec", "rad"},
                                                        {"rpm", "rps"}, {"ms", "s"}, {"kn", "km_h"}};
  int walked = 0;
  for (const Field& field : scenario::fields().fields) {
    if (field.unit.empty() || field.pointer.starts_with("/criteria") || field.pointer.starts_with("/headline")) continue;
    const std::string key(field.key());
    // The unit's first symbol begins behind the last underscore at which the rest of the key spells the unit.
    std::string unit(field.unit.starts_with("1/") ? field.unit.substr(2) : field.unit);
    std::erase(unit, '^');
    for (char& c : unit) c = c == ' ' || c == '/' ? '_' : c;
    if (field.unit == "Hz") unit = "hz";
    ASSERT_TRUE(key.ends_with("_" + unit)) << field.pointer;
    const std::string stem = key.substr(0, key.size() - unit.size());
    const std::size_t letters = std::min(unit.find_first_of("_23456789"), unit.size());
    for (const auto& [symbol, other] : others) {
      if (unit.substr(0, letters) != symbol) continue;
      const std::string foreign = stem + other + unit.substr(letters);
      EXPECT_NE(answer(std::string(field.parent()), foreign).find(key + "; 1 "), std::string::npos)
          << field.pointer << " as " << foreign;
      ++walked;
    }
  }
  EXPECT_GT(walked, 60);
}

/// A key with the field's own unit, with a unit of another dimension, or with none is answered as a misspelling.
TEST(ForeignUnits, OtherKeysAreMisspellings) {
  const struct {
    std::string object, key, meant;
  } cases[] = {{"/body", "mass_KG", "mass_kg"},
               {"/body", "mass_mm", "mass_kg"},
               {"/body", "mass_grams", "mass_kg"},
               {"/site", "lat", "latitude_deg"},
               {"/site", "latitude", "latitude_deg"},
               {"/site", "lon", "longitude_deg"},
               {"/site", "long", "longitude_deg"},
               {"/release", "spin", "spin_rad_s"},
               {"/release", "spinn", "spin_rad_s"},
               {"/release", "spin_rmp", "spin_rpm"},
               {"/release", "spin_rad", "spin_rad_s"},
               {"/release", "spin_foo", "spin_rad_s"},
               {"/release", "tilt", "tilt_deg"},
               {"/motion", "duration_m", "duration_s"},
               {"/site", "gravity_g", "gravity_m_s2"},
               {"/release", "Spin_RPM", "spin_rpm"},
               {"/effects", "coulomb_torque", "coulomb_torque_N_m"}};
  for (const auto& [object, key, meant] : cases) {
    EXPECT_NE(answer(object, key).find("did you mean \"" + meant + "\""), std::string::npos)
        << key << ": " << answer(object, key);
    EXPECT_EQ(unknown_key(scenario::fields(), key, object).meant, meant);
  }
}

/// Stems without an ending, endings of any bytes, and very long keys.
TEST(ForeignUnits, HostileKeysGetAnAnswer) {
  for (const std::string& key :
       {std::string("mass_"), std::string("mass__g"), std::string("_g"), std::string("mass_g9999999999"),
        std::string("mass_g0"), std::string("mass_\xff\xfe"), std::string("mass_g_g_g_g_g_g"),
        "mass_" + std::string(100000, 'g'), std::string("mass_g\0g", 8), std::string()})
    EXPECT_NE(answer("/body", key).find("allowed here"), std::string::npos) << key.substr(0, 40);
}

/// The key that one in another unit stands for is not also reported as missing.
TEST(ForeignUnits, TheKeyMeantIsOneOfTheObject) {
  EXPECT_EQ(unknown_key(scenario::fields(), "inertia_g_cm2", "/body").meant, "inertia");
  EXPECT_EQ(unknown_key(scenario::fields(), "spin_rps", "/release").meant, "spin_rad_s");
}

}  // namespace
}  // namespace earthtop::input
