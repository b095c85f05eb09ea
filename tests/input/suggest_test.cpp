// SPDX-License-Identifier: GPL-3.0-or-later
// Suggestions: a misspelling is recognised word by word, and a word that means something else is no misspelling.
#include "input/suggest.hpp"

#include <gtest/gtest.h>

#include "input/pointers.hpp"
#include "scenario/fields.hpp"

namespace earthtop::input {
namespace {

std::string suggested(const char* given, const std::vector<std::string_view>& candidates) {
  return std::string(suggest(given, candidates).value_or("-"));
}

TEST(Suggest, EachWordMayBeMisspelt) {
  const std::vector<std::string_view> keys = {"tip_radius_m", "patch_radius_m", "center_of_mass_m", "spin_rad_s", "at_m"};
  for (const char* given : {"tip_raduis_m", "tip_radius", "Tip-Radius-M", "tip_radius_foo", "tpi_radius_m", "tipradius_m"})
    EXPECT_EQ(suggested(given, keys), "tip_radius_m") << given;
  for (const char* given : {"centre_of_mass_m", "centerofmass", "center_mass", "center_of_mas_m"})
    EXPECT_EQ(suggested(given, keys), "center_of_mass_m") << given;
  EXPECT_EQ(suggested("spinn", keys), "spin_rad_s");
  EXPECT_EQ(suggested("at", keys), "at_m");
}

TEST(Suggest, AnotherWordMeansAnotherThing) {
  const std::vector<std::string_view> keys = {"tip_radius_m", "latitude_deg", "max_tilt_deg", "inner_radius_m", "mass_kg"};
  for (const char* given : {"rim_radius_m", "top_radius_m", "rimradius_m", "tip_mass_kg", "tip_mass", "longitude_deg",
                            "tide_deg", "min_tilt_deg", "outer_radius_m", "table_mass_kg", "rotor_mass_kg", "m", "deg"})
    EXPECT_EQ(suggested(given, keys), "-") << given;
}

TEST(Suggest, AnIncompleteNameMustMeanOneCandidate) {
  EXPECT_EQ(suggested("tolerance", {"relative_tolerance", "step_s"}), "relative_tolerance");
  EXPECT_EQ(suggested("radius_m", {"tip_radius_m", "patch_radius_m"}), "-");
  EXPECT_EQ(suggested("friction", {"friction_coefficient", "spinning_friction_m"}), "friction_coefficient");  // begins so
}

std::string answer(const char* object, const std::string& key) { return unknown_key(scenario::fields(), key, object).message; }

TEST(UnknownKey, IsLookedForInTheWholeFile) {
  const struct {
    const char* object;
    const char* key;
    const char* meant;
  } cases[] = {{"", "latitude", "/site/latitude_deg"},
               {"", "mass", "/body/mass_kg"},
               {"", "lattitude_deg", "/site/latitude_deg"},
               {"/body", "tilt", "/release/tilt_deg"},
               {"", "spin", "/release/spin_rad_s"},
               {"/site", "duration", "/motion/duration_s"},
               {"", "density", "/body/solids/*/density_kg_m3"},
               {"", "tolerance", "/numerics/relative_tolerance"},
               {"", "platform_rate", "/platform/rate_rad_s"},
               {"/release", "body_mass_kg", "/body/mass_kg"},
               {"/contact", "tilt_deg", "/contact/table/tilt_deg"},
               {"", "altitude_m", "/site/height_m"},
               {"/site", "rotation_rate_rad_s", "/earth/rotation_rate_rad_s"}};
  for (const auto& [object, key, meant] : cases) {
    EXPECT_NE(answer(object, key).find(std::string("; did you mean \"") + meant + "\""), std::string::npos)
        << key << ": " << answer(object, key);
    EXPECT_EQ(unknown_key(scenario::fields(), key, object).elsewhere, meant);
  }
  EXPECT_NE(answer("", "mass_g").find("; give /body/mass_kg; 1 g = 0.001 kg"), std::string::npos);
  EXPECT_NE(answer("/site", "altitude_m").find("; did you mean \"height_m\""), std::string::npos);  // no misspelt latitude
}

/// Each wish is answered wherever its word stands in a key, and with nothing that only looks like it.
TEST(Wishes, AreAnsweredWithASentence) {
  const struct {
    const char* key;
    const char* sentence;
  } cases[] = {{"cardan", "a Cardan suspension is /gimbals"},
               {"cage_inertia", "the cage of a rotor is /body, and the rotor that turns in it is /rotor"},
               {"rings",
                "a ring as a part of the top is one of /body/solids, {\"shape\": \"ring\"}; the rings of a suspension are "
                "/gimbals/outer and /body"},
               {"tape_length_m",
                "the tape that carries a gyroscope is the torsion of /gimbals/outer, torsion_N_m_rad and torsion_rest_deg"},
               {"Ellipsoid",
                "neither a solid nor the tip can be an ellipsoid: give an ellipsoid's mass and moments as mass_kg "
                "and inertia, and its tip as a sphere, /contact/tip_radius_m"},
               {"rim_radius_m",
                "no rim or edge rolls on the table, as that of a coin does: only a spherical tip touches it, and "
                "a run ends where the rim would, at /contact/max_tilt_deg"},
               {"edge_radius_mm", "no rim or edge rolls on the table"},
               {"camera-tilt-deg",
                "what a camera's tilt and turn do to measured angles is told by /instrument/turn_east_deg, turn_north_deg "
                "and turn_up_deg"},
               {"clock_offset_s", "what a clock shows then is /instrument/time_offset_s"}};
  for (const char* object : {"", "/body", "/contact", "/effects", "/body/solids/*"})
    for (const auto& [key, sentence] : cases) {
      EXPECT_NE(answer(object, key).find(sentence), std::string::npos) << object << "/" << key << ": " << answer(object, key);
      EXPECT_EQ(answer(object, key).find("did you mean"), std::string::npos) << key;
    }
  for (const char* key : {"trim", "ringing", "offset_s", "time", "timeoffset"})
    EXPECT_EQ(scenario::fields().wish(key), nullptr) << key;
}

TEST(Wishes, AnEntryGoesWhenItsKeyComes) {
  ASSERT_FALSE(scenario::fields().wishes.empty());
  for (const Field& field : scenario::fields().fields)
    EXPECT_EQ(scenario::fields().wish(lower_case(field.key())), nullptr) << field.pointer << " has come";
}

/// The keys and other things that the sentences name are there.
TEST(Wishes, NameWhatThereIs) {
  for (const char* pointer :
       {"/body/solids/*/shape", "/gimbals/outer", "/gimbals/outer/torsion_N_m_rad", "/gimbals/outer/torsion_rest_deg", "/body",
        "/rotor", "/contact/tip_radius_m", "/contact/max_tilt_deg", "/body/inertia", "/body/mass_kg"})
    EXPECT_NE(scenario::fields().find(pointer), nullptr) << pointer;
  EXPECT_TRUE(lists(scenario::fields().find("/body/solids/*/shape")->words, "ring"));
}

}  // namespace
}  // namespace earthtop::input
