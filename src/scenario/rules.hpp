// SPDX-License-Identifier: GPL-3.0-or-later
/// The words of a scenario and their values, the keys that each word allows (for a solid's shape, a platform's motion or a
/// criterion's kind), and the methods and precisions. The table of fields, the codec and the schema read the same rows.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

#include "earthtop/frames/travel_spec.hpp"
#include "earthtop/integrate/options.hpp"
#include "earthtop/model/applied_torques_spec.hpp"
#include "earthtop/model/body_spec.hpp"
#include "earthtop/model/contact_spec.hpp"
#include "earthtop/model/moving_masses_spec.hpp"
#include "earthtop/model/platform_spec.hpp"
#include "earthtop/model/release_spec.hpp"
#include "earthtop/model/rotor_spec.hpp"
#include "earthtop/scenario/criterion.hpp"
#include "scenario/quantities.hpp"

namespace earthtop::scenario {

/// A word and its value.
template <class Value>
struct Word {
  std::string_view word;
  Value value;
};

inline constexpr std::array kInertiaPoints = {Word<InertiaAbout>{"pivot", InertiaAbout::pivot},
                                              Word<InertiaAbout>{"center_of_mass", InertiaAbout::center_of_mass}};
inline constexpr std::array kRateFrames = {Word<RatesRelativeTo>{"laboratory", RatesRelativeTo::laboratory},
                                           Word<RatesRelativeTo>{"inertial", RatesRelativeTo::inertial}};
inline constexpr std::array kPrecessions = {Word<Precession>{"none", Precession::none},
                                            Word<Precession>{"steady_slow", Precession::steady_slow},
                                            Word<Precession>{"steady_fast", Precession::steady_fast}};
inline constexpr std::array kDiscFlows = {Word<DiscFlow>{"auto", DiscFlow::automatic},
                                          Word<DiscFlow>{"laminar", DiscFlow::laminar},
                                          Word<DiscFlow>{"turbulent", DiscFlow::turbulent}};

/// Return the row with this word, or with this value. The row must exist: a scenario's words have been checked before.
template <class Rows>
constexpr const auto& row_of_word(const Rows& rows, std::string_view word) {
  return *std::find_if(rows.begin(), rows.end(), [&](const auto& row) { return row.word == word; });
}
template <class Rows, class Value>
constexpr const auto& row_of(const Rows& rows, Value value) {
  return *std::find_if(rows.begin(), rows.end(), [&](const auto& row) { return row.value == value; });
}

/// The words of such rows as a field lists them: joined by '|' at compile time.
template <const auto& rows>
struct WordsOf {
  static constexpr std::size_t kSize = [] {
    std::size_t size = rows.size() - 1;
    for (const auto& row : rows) size += row.word.size();
    return size;
  }();
  static constexpr std::array<char, kSize> kLetters = [] {
    std::array<char, kSize> letters{};
    std::size_t end = 0;
    for (const auto& row : rows) {
      if (end > 0) letters[end++] = '|';
      for (const char c : row.word) letters[end++] = c;
    }
    return letters;
  }();
  static constexpr std::string_view text{kLetters.data(), kSize};
};

using earthtop::Need;

struct ShapeRule {
  std::string_view word;
  SolidShape value;
  Need radius, inner_radius, length;  ///< a length that is required is above 0
};

inline constexpr std::array kShapeRules = {
    ShapeRule{"disc", SolidShape::disc, Need::required, Need::none, Need::optional},
    ShapeRule{"cylinder", SolidShape::cylinder, Need::required, Need::none, Need::required},
    ShapeRule{"ring", SolidShape::ring, Need::required, Need::required, Need::optional},
    ShapeRule{"cone", SolidShape::cone, Need::required, Need::none, Need::required},
    ShapeRule{"sphere", SolidShape::sphere, Need::required, Need::optional, Need::none},
    ShapeRule{"rod", SolidShape::rod, Need::optional, Need::none, Need::required},
};

struct MotionRule {
  std::string_view word;
  PlatformMotion value;
  std::string_view required;  ///< keys that the motion needs, separated by '|'
  std::string_view allowed;   ///< members of kMotionKeys that it allows
};

inline constexpr std::string_view kMotionKeys =
    "rate_rad_s|acceleration_rad_s2|amplitude_rad|frequency_hz|phase_deg|file|file_sha256";
inline constexpr std::array kMotionRules = {
    MotionRule{"constant", PlatformMotion::constant, "rate_rad_s", "rate_rad_s"},
    MotionRule{"ramp", PlatformMotion::ramp, "acceleration_rad_s2", "rate_rad_s|acceleration_rad_s2"},
    MotionRule{"harmonic", PlatformMotion::harmonic, "amplitude_rad|frequency_hz", "amplitude_rad|frequency_hz|phase_deg"},
    MotionRule{"table", PlatformMotion::table, "file", "file|file_sha256"},
    MotionRule{"course", PlatformMotion::course, "", ""},
};

/// The keys that the path of a journey must and may have.
struct TravelRule {
  std::string_view word;
  TravelPath value;
  std::string_view required, allowed;  ///< members of kTravelKeys, separated by '|'
};
inline constexpr std::string_view kTravelKeys = "course_deg|speed_m_s|speed_kn|legs|file|file_sha256";
inline constexpr std::array kTravelPaths = {
    TravelRule{"rhumb", TravelPath::rhumb, "course_deg", "course_deg|speed_m_s|speed_kn|legs"},
    TravelRule{"geodesic", TravelPath::geodesic, "course_deg", "course_deg|speed_m_s|speed_kn|legs"},
    TravelRule{"table", TravelPath::table, "file", "file|file_sha256"},
};
inline constexpr std::array kTravelReferences = {Word<TravelReference>{"same_path", TravelReference::same_path},
                                                 Word<TravelReference>{"at_rest", TravelReference::at_rest}};
inline constexpr std::array kTravelEotvos = {Word<TravelEotvos>{"rotating", TravelEotvos::rotating},
                                             Word<TravelEotvos>{"both", TravelEotvos::both},
                                             Word<TravelEotvos>{"off", TravelEotvos::off}};
inline constexpr std::array kTravelFigures = {Word<TravelFigure>{"wgs84", TravelFigure::wgs84},
                                              Word<TravelFigure>{"sphere", TravelFigure::sphere}};

inline constexpr std::array kTorqueAxes = {Word<TorqueAxes>{"body", TorqueAxes::body},
                                           Word<TorqueAxes>{"laboratory", TorqueAxes::laboratory}};
/// The keys that a given torque's course must and may have.
struct CourseRule {
  std::string_view word;
  TorqueCourse value;
  std::string_view required, allowed;  ///< members of kCourseKeys, separated by '|'
};
inline constexpr std::string_view kCourseKeys = "torque_N_m|frequency_hz|phase_deg|file|file_sha256";
inline constexpr std::array kTorqueCourses = {
    CourseRule{"constant", TorqueCourse::constant, "torque_N_m", "torque_N_m"},
    CourseRule{"harmonic", TorqueCourse::harmonic, "torque_N_m|frequency_hz", "torque_N_m|frequency_hz|phase_deg"},
    CourseRule{"table", TorqueCourse::table, "file", "file|file_sha256"},
};

/// The keys that a rotor's drive must and may have. A table has the rate at release, too. The bearing's friction belongs to a rotor without a drive.
struct DriveRule {
  std::string_view word;
  RotorDrive value;
  std::string_view required, allowed;  ///< members of kDriveKeys, separated by '|'
};

inline constexpr std::string_view kDriveKeys =
    "spin_rad_s|spin_rpm|file|file_sha256|acceleration_rad_s2|amplitude_rad_s|frequency_hz|phase_deg|viscous_torque_N_m_s|"
    "coulomb_torque_N_m|regularisation_rad_s";
inline constexpr std::array kDriveRules = {
    DriveRule{"none", RotorDrive::none, "", "spin_rad_s|spin_rpm|viscous_torque_N_m_s|coulomb_torque_N_m|regularisation_rad_s"},
    DriveRule{"constant", RotorDrive::constant, "", "spin_rad_s|spin_rpm"},
    DriveRule{"ramp", RotorDrive::ramp, "acceleration_rad_s2", "spin_rad_s|spin_rpm|acceleration_rad_s2"},
    DriveRule{"harmonic", RotorDrive::harmonic, "amplitude_rad_s|frequency_hz",
              "spin_rad_s|spin_rpm|amplitude_rad_s|frequency_hz|phase_deg"},
    DriveRule{"table", RotorDrive::table, "file", "file|file_sha256"},
};

inline constexpr std::array kMassCarriers = {Word<MassCarrier>{"body", MassCarrier::body},
                                             Word<MassCarrier>{"outer", MassCarrier::outer}};

/// The keys that the motion of a mass must and may have.
struct MassMotionRule {
  std::string_view word;
  MassMotion value;
  std::string_view required, allowed;  ///< members of kMassMotionKeys, separated by '|'
};

inline constexpr std::string_view kMassMotionKeys =
    "center_m|amplitude_m|start_m|axis|frequency_hz|phase_deg|times_s|points_m|file|file_sha256";
inline constexpr std::array kMassMotionRules = {
    MassMotionRule{"fixed", MassMotion::fixed, "center_m", "center_m"},
    MassMotionRule{"harmonic", MassMotion::harmonic, "center_m|amplitude_m|frequency_hz",
                   "center_m|amplitude_m|frequency_hz|phase_deg"},
    MassMotionRule{"circle", MassMotion::circle, "center_m|start_m|axis|frequency_hz",
                   "center_m|start_m|axis|frequency_hz|phase_deg"},
    MassMotionRule{"waypoints", MassMotion::waypoints, "times_s|points_m", "times_s|points_m"},
    MassMotionRule{"table", MassMotion::table, "file", "file|file_sha256"},
};

/// The coefficients that a law of friction must and may have.
struct ContactLawRule {
  std::string_view word;
  ContactLaw value;
  std::string_view required, allowed;  ///< members of kContactLawKeys, separated by '|'
};

inline constexpr std::string_view kContactLawKeys =
    "sliding_viscosity_N_s_m|sliding_viscosity_s_m|friction_coefficient|regularisation_m_s|patch_radius_m|static_coefficient";
inline constexpr std::array kContactLaws = {
    ContactLawRule{"frictionless", ContactLaw::frictionless, "", ""},
    ContactLawRule{"viscous", ContactLaw::viscous, "sliding_viscosity_N_s_m", "sliding_viscosity_N_s_m"},
    ContactLawRule{"viscous_load", ContactLaw::viscous_load, "sliding_viscosity_s_m", "sliding_viscosity_s_m"},
    ContactLawRule{"coulomb", ContactLaw::coulomb, "friction_coefficient", "friction_coefficient|regularisation_m_s"},
    ContactLawRule{"contensou", ContactLaw::contensou, "friction_coefficient|patch_radius_m",
                   "friction_coefficient|patch_radius_m"},
    ContactLawRule{"rolling", ContactLaw::rolling, "", "static_coefficient"},
};
/// The words of `start`; the remaining start is given by `tip_velocity_m_s`.
inline constexpr std::array kContactStarts = {
    Word<ContactStart>{"tip_at_rest", ContactStart::tip_at_rest}, Word<ContactStart>{"rolling", ContactStart::rolling},
    Word<ContactStart>{"center_of_mass_at_rest", ContactStart::center_of_mass_at_rest}};

inline constexpr std::array kCompositions = {Composition::automatic, Composition::aba82,   Composition::aba84,
                                             Composition::aba864,    Composition::aba1064, Composition::rkn6,
                                             Composition::kahan_li8};

/// The keys that a criterion of a kind must and may have besides kind, set, why and slow.
struct CriterionRule {
  std::string_view word;
  CriterionKind value;
  std::string_view required, allowed;  ///< members of kCriterionKeys
  std::string_view quantities;         ///< allowed quantities; empty if it has none
};

inline constexpr std::string_view kCriterionKeys = "quantity|values|at_s|until_s|tolerance";
inline constexpr std::array kCriterionRules = {
    CriterionRule{"value", CriterionKind::value, "quantity|values|tolerance", "quantity|values|tolerance|at_s", kValues},
    CriterionRule{"invariant", CriterionKind::invariant, "quantity|tolerance", "quantity|tolerance", kInvariants},
    CriterionRule{"closed_form", CriterionKind::closed_form, "quantity|tolerance", "quantity|tolerance|until_s", kClosedForms},
    CriterionRule{"equivalence", CriterionKind::equivalence, "quantity|tolerance", "quantity|tolerance|until_s", kRelations},
    CriterionRule{"exactly_zero", CriterionKind::exactly_zero, "quantity", "quantity", kZeros},
    CriterionRule{"order", CriterionKind::order, "quantity|tolerance", "quantity|tolerance|values", kOrders},
    CriterionRule{"verdict", CriterionKind::verdict, "quantity", "quantity|values", kVerdicts},
    CriterionRule{"refused", CriterionKind::refused, "set", "", ""},
};

/// All quantities that criteria of any kind may use.
inline constexpr std::string_view kAllQuantities = Spelled<[](const auto& add) {
  bool first = true;
  for (const CriterionRule& rule : kCriterionRules) {
    if (rule.quantities.empty()) continue;
    if (!first) add("|");
    first = false;
    add(rule.quantities);
  }
}>::text;

inline constexpr std::array kPrecisions = {Precision::bits53, Precision::bits64, Precision::bits113};

}  // namespace earthtop::scenario
